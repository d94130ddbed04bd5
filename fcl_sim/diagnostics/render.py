"""Draw a diagnostic as text: place, excerpt, caret, hint."""

import unicodedata
from collections.abc import Iterable

from fcl_sim.diagnostics.diagnostic import Diagnostic, Place, Severity
from fcl_sim.diagnostics.source import Span

EXCERPT_WIDTH = 100
"""Characters of a line that are shown; of a longer line, those around the caret."""

FURTHER_PLACES = 5
"""Places that are named after the first; the others are counted."""

_HIDDEN = frozenset(("Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"))
_CUT = "…"


def render(diagnostic: Diagnostic) -> str:
    """Return a diagnostic in several lines of plain text.

    The first line is `file:line:column: severity[code]: message`, as compilers
    print it and editors read it; then the excerpt with its caret, the further
    places, and the hint. A place with a label is drawn in full, as it is what
    the first one clashes with; one without is a further occurrence. Characters
    that would steer a terminal are shown as `�`.
    """
    first, *others = diagnostic.places or (Place(),)
    head = f"{diagnostic.severity}[{diagnostic.code}]: {printable(diagnostic.message)}"
    position = _position(first)
    lines = [f"{position}: {head}" if position else head]
    lines += _excerpt(first)
    again = [each for each in others if not each.label]
    lines += [f"  also at {_position(each)}" for each in again[:FURTHER_PLACES]]
    if len(again) > FURTHER_PLACES:
        rest = len(again) - FURTHER_PLACES
        lines.append(f"  and at {rest} more place{'' if rest == 1 else 's'}")
    for each in [each for each in others if each.label][:FURTHER_PLACES]:
        lines.append(f"  {_position(each)}: {printable(each.label)}")
        lines += _excerpt(Place(each.span))
    if diagnostic.hint:
        lines.append(f"  hint: {printable(diagnostic.hint)}")
    return "\n".join(lines)


def render_all(diagnostics: Iterable[Diagnostic]) -> str:
    """Return several diagnostics, drawn one after the other, and their count."""
    drawn = list(diagnostics)
    return "\n".join([*(render(each) for each in drawn), summary(drawn)])


def summary(diagnostics: Iterable[Diagnostic]) -> str:
    """Return the number of errors, warnings and notes, such as `1 error, 2 warnings`."""
    drawn = list(diagnostics)
    counts = []
    for severity in Severity:
        count = sum(each.severity is severity for each in drawn)
        if count:
            counts.append(f"{count} {severity}{'' if count == 1 else 's'}")
    return ", ".join(counts) or "no findings"


def printable(text: str) -> str:
    """Return a text on one line, with `�` for every character that is not meant to be seen."""
    if text.isprintable():
        return text
    return "".join("�" if unicodedata.category(each) in _HIDDEN else each for each in text.expandtabs(1))


def _position(place: Place) -> str:
    name = printable(place.name)
    if place.span is None:
        return name
    return f"{name}:{place.span.line}:{place.span.column}"


def _excerpt(place: Place) -> list[str]:
    if place.span is None:
        return []
    number = str(place.span.line)
    shown, margin, width = _window(place.span)
    label = f" {printable(place.label)}" if place.label else ""
    return [
        f"  {number} | {shown}".rstrip(),
        f"  {' ' * len(number)} | {' ' * margin}{'^' * width}{label}",
    ]


def _window(span: Span) -> tuple[str, int, int]:
    """Return the part of the line that is shown, and where in it the caret begins and how wide it is."""
    text = printable(span.source.line_text(span.line))
    begin = span.column - 1
    end = min(begin + span.end - span.start, len(text))
    if len(text) <= EXCERPT_WIDTH:
        first, last = 0, len(text)
    else:
        first = max(0, min(begin - EXCERPT_WIDTH // 2, len(text) - EXCERPT_WIDTH))
        last = first + EXCERPT_WIDTH
    before = (_CUT if first else "") + text[first:begin]
    marked = text[begin : min(end, last)]
    after = text[min(end, last) : last] + (_CUT if last < len(text) else "")
    return before + marked + after, _columns(before), max(1, _columns(marked))


def _columns(text: str) -> int:
    """Return how many columns of a terminal a text takes."""
    if text.isascii():
        return len(text)
    return sum(_column(each) for each in text)


def _column(character: str) -> int:
    if unicodedata.combining(character):
        return 0
    return 2 if unicodedata.east_asian_width(character) in {"W", "F"} else 1

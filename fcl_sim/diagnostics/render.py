"""Draw a diagnostic as text: place, excerpt, caret, hint."""

from fcl_sim.diagnostics.diagnostic import Diagnostic, Place

EXCERPT_WIDTH = 100
FURTHER_PLACES = 5


def render(diagnostic: Diagnostic) -> str:
    """Return a diagnostic in several lines of plain text.

    The first line is `file:line:column: severity[code]: message`, as compilers
    print it and editors read it; then the excerpt with its caret, the further
    places, and the hint.
    """
    first, *others = diagnostic.places or (Place(),)
    head = f"{diagnostic.severity}[{diagnostic.code}]: {diagnostic.message}"
    position = _position(first)
    lines = [f"{position}: {head}" if position else head]
    lines += _excerpt(first)
    for other in others[:FURTHER_PLACES]:
        lines.append(f"  also at {_position(other)}" + (f": {other.label}" if other.label else ""))
    if len(others) > FURTHER_PLACES:
        lines.append(f"  and at {len(others) - FURTHER_PLACES} more places")
    if diagnostic.hint:
        lines.append(f"  hint: {diagnostic.hint}")
    return "\n".join(lines)


def _position(place: Place) -> str:
    if place.span is None:
        return place.file
    return f"{place.name}:{place.span.line}:{place.span.column}"


def _excerpt(place: Place) -> list[str]:
    if place.span is None:
        return []
    span = place.span
    text = span.source.line_text(span.line).expandtabs(1)
    column = span.column - 1
    width = max(1, min(span.end - span.start, len(text) - column))
    start = max(0, column - EXCERPT_WIDTH // 2) if len(text) > EXCERPT_WIDTH else 0
    shown = text[start : start + EXCERPT_WIDTH]
    caret = " " * (column - start) + "^" * min(width, EXCERPT_WIDTH - (column - start))
    number = str(span.line)
    margin = " " * len(number)
    label = f" {place.label}" if place.label else ""
    return [f"  {number} | {shown}", f"  {margin} | {caret}{label}"]

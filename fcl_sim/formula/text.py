"""A text within a file: a formula stands in a string of a TOML file, and its faults are shown there."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from fcl_sim.diagnostics import Diagnostic, InputFault, Place, Source, Span


@dataclass(frozen=True, slots=True)
class Text:
    """A formula as written; `offsets` has for each character, and the end, where it stands in `source`."""

    text: str
    source: Source = field(compare=False, repr=False)
    offsets: Sequence[int] = field(compare=False, repr=False)

    def span(self, start: int, end: int) -> Span:
        """Return where the characters `start` to `end` (exclusive) stand."""
        first = self.offsets[start]
        last = self.offsets[end - 1] + 1 if end > start else first
        return Span(self.source, first, max(first, last))


def plain(text: str, name: str = "<formula>") -> Text:
    """Return a text that stands in no file."""
    return Text(text, Source(name, text), range(len(text) + 1))


def fault(code: str, message: str, span: Span, hint: str = "") -> InputFault:
    """Return the fault of a formula."""
    return InputFault([finding(code, message, span, hint)])


def finding(code: str, message: str, span: Span, hint: str = "", other: Place | None = None) -> Diagnostic:
    """Return a finding about a formula; `other` is a second place that it clashes with."""
    places = (Place(span=span),) if other is None else (Place(span=span), other)
    return Diagnostic(code=code, message=message, places=places, hint=hint)

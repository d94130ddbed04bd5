"""One finding, as data: drawing it is the renderer's work."""

from dataclasses import dataclass, replace
from enum import StrEnum

from fcl_sim.diagnostics.source import Span


class Severity(StrEnum):
    """How grave a finding is. Only errors stop a run."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


@dataclass(frozen=True, slots=True)
class Place:
    """Where a finding is: a span, or a whole file when no text was read.

    `label` is a short remark drawn beside the caret, or empty.
    """

    span: Span | None = None
    label: str = ""
    file: str = ""

    @property
    def name(self) -> str:
        """The file, as the user calls it."""
        return self.span.source.name if self.span else self.file


@dataclass(frozen=True, slots=True, kw_only=True)
class Diagnostic:
    """A finding about a user's input.

    `code` is a row of `diagnostics.codes.CODES`; `message` says what is wrong,
    `hint` what would be right, `places` where: the first is the guilty one,
    the others are further occurrences or what it clashes with.
    """

    code: str
    message: str
    severity: Severity = Severity.ERROR
    places: tuple[Place, ...] = ()
    hint: str = ""

    @property
    def is_error(self) -> bool:
        """Whether this finding stops a run."""
        return self.severity is Severity.ERROR

    def within(self, file: str) -> "Diagnostic":
        """Return the finding, at a whole file where it has no place of its own."""
        return self if self.places else replace(self, places=(Place(file=file),))

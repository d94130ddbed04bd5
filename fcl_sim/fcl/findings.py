"""Collects what a stage has to say about a text: one mistake is one message."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from itertools import islice
from typing import Protocol

from fcl_sim.diagnostics import Diagnostic, Place, Severity, Source, Span, nearest
from fcl_sim.model import Level, Note

MOST_FINDINGS = 100
"""Of different errors in one stage, and of warnings and notes; what follows is left unsaid, once that
has been said."""

MOST_HINTS = 25
MOST_NAMES = 400
LONGEST_NAME = 60
"""Bounds of the search for a near name: comparing words is slow, and texts can be hostile."""


Hint = str | Callable[[], str]
"""A hint, or how to make it once it is known that it will be shown."""


class Spanned(Protocol):
    """Anything that has a beginning and an end in the text."""

    @property
    def start(self) -> int:
        """Offset of the first character."""

    @property
    def end(self) -> int:
        """Offset behind the last character."""


@dataclass(frozen=True, slots=True)
class Stretch:
    """Characters `start` to `end` (exclusive)."""

    start: int
    end: int


@dataclass(slots=True)
class _Entry:
    code: str
    message: str
    severity: Severity
    hint: str
    places: list[Place] = field(default_factory=list)
    related: list[Place] = field(default_factory=list)


class Findings:
    """Findings about one source, in the order in which they are found.

    Findings that say the same are one diagnostic with several places.
    """

    def __init__(self, source: Source) -> None:
        self.source = source
        self._entries: dict[tuple[str, str], _Entry] = {}
        self._counts = {True: 0, False: 0}
        self._hints = 0
        self.notes: list[Note] = []
        """What the text uses beyond Tables 8 and 9, in the order in which it is found."""

    def feature(self, code: str, feature: str, at: Spanned) -> None:
        """Note a feature of the Open Level; `code` is a row of `features.FEATURES`."""
        self.notes.append(Note(code, feature, Level.OPEN, self.span(at)))

    def error(
        self, code: str, message: str, at: Spanned, hint: Hint = "", related: Sequence[Place] = ()
    ) -> None:
        """Add an error at `at`; `related` are places that it clashes with."""
        self._add(Severity.ERROR, code, message, at, hint, related)

    def warning(
        self, code: str, message: str, at: Spanned, hint: Hint = "", related: Sequence[Place] = ()
    ) -> None:
        """Add a warning at `at`."""
        self._add(Severity.WARNING, code, message, at, hint, related)

    def note(self, code: str, message: str, at: Spanned, hint: Hint = "") -> None:
        """Add a note at `at`."""
        self._add(Severity.NOTE, code, message, at, hint, ())

    def _add(
        self, severity: Severity, code: str, message: str, at: Spanned, hint: Hint, related: Sequence[Place]
    ) -> None:
        is_error = severity is Severity.ERROR
        if (code, message) not in self._entries:
            if self._counts[is_error] >= MOST_FINDINGS:
                what = "errors" if is_error else "warnings and notes"
                code, message = "FCL199", f"more than {MOST_FINDINGS} different {what}: the rest is not shown"
                severity = Severity.ERROR if is_error else Severity.WARNING
                hint, related = "mend the first ones and read again", ()
            else:
                self._counts[is_error] += 1
        entry = self._entries.get((code, message))
        if entry is None:
            text = hint if isinstance(hint, str) else hint()
            entry = _Entry(code, message, severity, text, related=list(related))
            self._entries[code, message] = entry
        elif code == "FCL199":
            return
        entry.places.append(Place(self.span(at)))

    def span(self, at: Spanned) -> Span:
        """Return the place of `at` in the source."""
        return Span(self.source, at.start, at.end)

    def place(self, at: Spanned, label: str) -> Place:
        """Return a further place, with what it has to do with the finding."""
        return Place(self.span(at), label)

    def near(self, name: str, known: Iterable[str]) -> str | None:
        """Return the known name that was probably meant, within the bounds above."""
        self._hints += 1
        if self._hints > MOST_HINTS or len(name) > LONGEST_NAME:
            return None
        return nearest(name, islice(known, MOST_NAMES))

    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """Return what was found."""
        return tuple(
            Diagnostic(
                code=each.code,
                message=each.message,
                severity=each.severity,
                places=(*each.places, *each.related),
                hint=each.hint,
            )
            for each in self._entries.values()
        )


def in_order(diagnostics: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Return diagnostics in the order of the text."""
    return tuple(sorted(diagnostics, key=_offset))


def _offset(diagnostic: Diagnostic) -> int:
    span = diagnostic.places[0].span if diagnostic.places else None
    return span.start if span else -1

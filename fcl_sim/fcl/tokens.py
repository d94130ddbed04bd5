"""Tokens: the words of a text and where they stand."""

from dataclasses import dataclass
from enum import Enum

from fcl_sim.diagnostics import Diagnostic, Source, Span
from fcl_sim.model import Note

SHOWN_LENGTH = 40


class Kind(Enum):
    """What sort of word a token is."""

    NAME = "name"
    NUMBER = "number"
    LITERAL = "literal"
    """A literal with a base or a type: `16#FF`, `REAL#1.5`."""
    MIXED = "mixed"
    """Begins with a digit and is no number: the rule label `3a`."""
    SYMBOL = "symbol"
    STRAY = "stray"
    """Without a meaning in FCL; the scanner has already said so."""
    END = "end"


@dataclass(frozen=True, slots=True)
class Token:
    """A word of the text, beginning at offset `start`.

    `key` is what it is compared by: letter case does not count (S1).
    """

    kind: Kind
    text: str
    key: str
    start: int

    @property
    def end(self) -> int:
        """Offset behind the last character."""
        return self.start + len(self.text)

    @property
    def shown(self) -> str:
        """The word as a message quotes it."""
        text = self.text if len(self.text) <= SHOWN_LENGTH else self.text[:SHOWN_LENGTH] + "…"
        return f"`{text}`"

    def span(self, source: Source) -> Span:
        """Return the place of the word in `source`, the text it was scanned from."""
        return Span(source, self.start, self.end)


@dataclass(frozen=True, slots=True)
class Comment:
    """A comment with its signs, beginning at offset `start` (S13).

    To the end of the line go those that begin with `//`, and fuzzylite's with
    `#`, or with `%` at the beginning of a line (S15).
    """

    text: str
    start: int

    @property
    def end(self) -> int:
        """Offset behind the last character."""
        return self.start + len(self.text)


@dataclass(frozen=True, slots=True, kw_only=True)
class Scan:
    """A text taken apart: the last token is of kind END."""

    source: Source
    tokens: tuple[Token, ...]
    comments: tuple[Comment, ...]
    diagnostics: tuple[Diagnostic, ...]
    notes: tuple[Note, ...] = ()

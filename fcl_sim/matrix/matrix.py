"""The nouns: a matrix and its cells."""

from dataclasses import dataclass, field

from fcl_sim.diagnostics import Span

ANY = "*"
"""The row or column of rules that take no term of an input."""


@dataclass(frozen=True, slots=True)
class Word:
    """A name in a matrix, and where it stands in a table that was read."""

    text: str
    span: Span | None = field(default=None, compare=False, repr=False)

    @property
    def key(self) -> str:
        """The name as names are compared: letter case is ignored (S1)."""
        return self.text.casefold()


@dataclass(frozen=True, slots=True)
class Entry:
    """A conclusion in a cell: a term of the output, and its weight, a number or the name of an input."""

    term: Word
    weight: float | str = 1.0


Cell = tuple[Entry, ...]
"""What is concluded where a row and a column meet; nothing where there is no rule."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Matrix:
    """What the rules conclude on `output`, at each term of the input `down` and each of `across`.

    `cells` has a row for each of `rows` with a cell for each of `columns`; each
    of these is a term or ANY. Of a single input the only column is ANY, and
    `across` is empty.
    """

    output: Word
    down: Word
    across: Word
    rows: tuple[Word, ...]
    columns: tuple[Word, ...]
    cells: tuple[tuple[Cell, ...], ...]

"""What a Concept block declares of itself."""

from collections.abc import Callable
from dataclasses import dataclass

from numpy import floating, int64
from numpy.typing import NDArray

Ints = NDArray[int64]
"""The words of a block in INT arithmetic."""

Reals = NDArray[floating]
"""The words of a block in REAL arithmetic: binary32, as on the PLC; a kernel takes binary64 as well."""

CEILING = 32
"""Inputs that a block's symbol can be stretched to (p. 37)."""

STRUCTURE = ("MD.n", *(f"MD.term{i}" for i in range(1, 10)))
"""Words of the structures FUZ_MD_INT and FUZ_MD_REAL (p. 47)."""

TERM1 = 1
"""Where the terms begin in a structure."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BlockType:
    """A kind of block of the FUZZY library, in one arithmetic.

    Inputs are words: `leading`, then those that stretching the symbol adds,
    `stem` with a number from 1, at least `least` of them; beyond `most` the
    block reports an error. `outputs` are words too. A member of a structure
    is a word with a dot.

    `kernel` takes the inputs' words, how many the stretched ones are, the
    outputs' words, which hold the last values, and, where `number` is INT,
    how to round. It returns the number of an event (`concept.events`).
    """

    name: str
    summary: str
    equation: str
    source: str
    number: str
    leading: tuple[str, ...]
    stem: str
    least: int
    most: int
    outputs: tuple[str, ...]
    kernel: Callable[..., int]

    def inputs(self, count: int) -> tuple[str, ...]:
        """Return the words of the inputs when `count` of them carry the stem."""
        return (*self.leading, *(f"{self.stem}{i}" for i in range(1, count + 1)))

"""A space in slabs that fit into memory, the largest first, as many as a budget allows."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import prod

from fcl_sim.proof.cubes import Cube
from fcl_sim.proof.space import Run, Space

CHUNK = 4_000_000
"""Cells of a slab."""


@dataclass(frozen=True, slots=True)
class Budget:
    """How many cells are looked at; what is beyond is left, and told."""

    cells: int = 60_000_000


@dataclass(frozen=True, slots=True)
class Slab:
    """A part of a space: the same with one run of each of its first variables; `part` is its share.

    Where the space has no end the share is by number.
    """

    space: Space
    at: tuple[int, ...]
    part: Fraction

    def cubes(self, cubes: Sequence[Cube]) -> list[Cube]:
        """Return what cubes of the whole space are in the slab."""
        return [
            {axis: flags for axis, flags in each.items() if axis >= len(self.at)}
            for each in cubes
            if all(each[axis][run] for axis, run in enumerate(self.at) if axis in each)
        ]


def slabs(space: Space, budget: Budget) -> Iterator[Slab]:
    """Yield slabs, the largest first, until the budget is used up; the whole space where it is small."""
    fixed = 0
    while prod(space.shape[fixed:]) > min(CHUNK, budget.cells):
        fixed += 1
    parts = [_parts(runs, bounded=space.is_bounded) for runs in space.runs[:fixed]]
    corners = product(*(range(len(each)) for each in parts))
    shares = [
        (prod((parts[axis][run] for axis, run in enumerate(at)), start=Fraction(1)), at) for at in corners
    ]
    allowed = max(1, budget.cells // max(1, prod(space.shape[fixed:])))
    for part, at in sorted(shares, key=lambda each: -each[0])[:allowed]:
        runs = (*((space.runs[axis][run],) for axis, run in enumerate(at)), *space.runs[fixed:])
        yield Slab(Space(space.variables, runs, fixed), at, part)


def _product(parts: Sequence[Sequence[Fraction]], at: Sequence[int]) -> Fraction:
    return prod((own[run] for own, run in zip(parts, at, strict=True)), start=Fraction(1))


def _parts(runs: Sequence[Run], *, bounded: bool) -> list[Fraction]:
    if not bounded:
        return [Fraction(1, len(runs))] * len(runs)
    widths = [each.width or Fraction(0) for each in runs]
    whole = sum(widths, Fraction(0))
    return [each / whole for each in widths]

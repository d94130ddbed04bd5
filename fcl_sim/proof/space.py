"""The space of the inputs that a set of cubes depends on: its axes, condensed to the runs that differ."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import lcm, prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fcl_sim.model import Degree, FunctionBlock
from fcl_sim.proof.axes import Axis, Cell, End, Flags, axis, degree_axis
from fcl_sim.proof.cubes import Cube, asked
from fcl_sim.proof.universe import Universe


@dataclass(frozen=True, slots=True)
class Side:
    """An interval of one input; None is no end, and an end that is `closed` belongs to it."""

    low: End
    high: End
    low_closed: bool = True
    high_closed: bool = True

    @property
    def is_point(self) -> bool:
        """Whether it has no width."""
        return self.low is not None and self.low == self.high

    def has(self, other: "Side") -> bool:
        """Return whether all of another interval is in this one."""
        from_low = self.low is None or (
            other.low is not None
            and (self.low < other.low or (self.low == other.low and self.low_closed >= other.low_closed))
        )
        to_high = self.high is None or (
            other.high is not None
            and (
                self.high > other.high or (self.high == other.high and self.high_closed >= other.high_closed)
            )
        )
        return from_low and to_high


@dataclass(frozen=True, slots=True)
class Run:
    """Neighbouring cells of an axis, `first` to `last`, among which nothing differs."""

    first: Cell
    last: Cell

    @property
    def width(self) -> Fraction | None:
        """How wide they are together; None without end."""
        if self.first.low is None or self.last.high is None:
            return None
        return self.last.high - self.first.low

    def to(self, other: "Run") -> Side:
        """Return the interval from this run to another at or above it."""
        first, last = self.first, other.last
        return Side(first.low, last.high, first.is_point, last.is_point)


@dataclass(frozen=True, slots=True)
class Space:
    """A product of runs of cells: `variables` and for each its `runs`.

    Of a slab of a larger space, the first `fixed` variables have one run each.
    """

    variables: tuple[str, ...]
    runs: tuple[tuple[Run, ...], ...]
    fixed: int = 0

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of runs of each variable."""
        return tuple(map(len, self.runs))

    @property
    def size(self) -> int:
        """Number of product cells."""
        return prod(self.shape)

    def sides(self, low: Sequence[int], high: Sequence[int]) -> dict[str, Side]:
        """Return the box from the runs `low` to `high`; a variable that it does not bound is left out."""
        found = {}
        for place, (name, runs) in enumerate(zip(self.variables, self.runs, strict=True)):
            first, last = low[place], high[place]
            if place < self.fixed or (first, last) != (0, len(runs) - 1):
                found[name] = runs[first].to(runs[last])
        return found

    @property
    def is_bounded(self) -> bool:
        """Whether every variable has both ends."""
        return all(
            runs[0].to(runs[-1]).low is not None and runs[-1].last.high is not None for runs in self.runs
        )

    def share(self, cells: Flags) -> Fraction | None:
        """Return which part of the whole the cells are; None where that has no end, 0 if it has no width."""
        if not self.is_bounded:
            return None
        if any(runs[0].to(runs[-1]).is_point for runs in self.runs):
            return Fraction(0)
        if not cells.any():
            return Fraction(0)
        parts: NDArray[Any] = cells
        whole = 1
        for runs in reversed(self.runs):
            widths = [run.width or Fraction(0) for run in runs]
            scale = lcm(*(each.denominator for each in widths))
            own = [int(each * scale) for each in widths]
            whole *= sum(own)
            parts = _summed(parts, own, whole)
        return Fraction(int(parts.item()), whole)


def _summed(rest: NDArray[Any], widths: Sequence[int], most: int) -> NDArray[Any]:
    """Return the weighted sums along the last axis, `most` at most: in int64 where that suffices."""
    wide = np.flatnonzero(np.array(widths, object)).tolist()
    kind: type[Any] = np.int64 if most < 2**62 else object
    return np.asarray(rest[..., wide].astype(kind) @ np.array([widths[each] for each in wide], kind))


def axes_of(
    block: FunctionBlock, universe: Universe, cuts: Mapping[str, Iterable[Fraction]] | None = None
) -> tuple[Axis, ...]:
    """Return an axis for each input that has terms, or is brought in as a degree or a weight."""
    further = cuts or {}
    terms = {each.variable.casefold(): each for each in block.fuzzifications}
    degrees = set(brought(block))
    found = []
    for each in block.inputs:
        name = each.name.casefold()
        own = further.get(name, ())
        if name in terms and terms[name].terms:
            as_degree = name in degrees
            found.append(
                axis(each.name, terms[name], universe.of(name), own, as_degree=as_degree, reach=universe.of)
            )
        elif name in degrees:
            found.append(degree_axis(each.name, universe.of(name), own))
    return tuple(found)


def brought(block: FunctionBlock) -> Iterator[str]:
    """Yield the variables that stand in conditions or weights as degrees, in lower case."""
    yield from (each.variable.casefold() for each in asked(block) if isinstance(each, Degree))
    for rule_block in block.rule_blocks:
        for rule in rule_block.rules:
            for conclusion in rule.conclusions:
                if isinstance(conclusion.weight, str):
                    yield conclusion.weight.casefold()


def condensed(axes: Sequence[Axis], groups: Sequence[Sequence[Cube]]) -> tuple[Space, list[list[Cube]]]:
    """Return the space of the axes that groups of cubes depend on, and the groups within it."""
    used = sorted({place for cubes in groups for cube in cubes for place in cube})
    runs, starts = [], []
    for place in used:
        rows = np.array([cube[place] for cubes in groups for cube in cubes if place in cube])
        changes = (rows[:, 1:] != rows[:, :-1]).any(axis=0)
        ends = [0, *(np.flatnonzero(changes) + 1).tolist(), rows.shape[1]]
        cells = axes[place].cells
        runs.append(tuple(Run(cells[first], cells[last - 1]) for first, last in pairwise(ends)))
        starts.append(np.array(ends[:-1]))
    narrowed: list[list[Cube]] = [
        [{new: cube[old][starts[new]] for new, old in enumerate(used) if old in cube} for cube in cubes]
        for cubes in groups
    ]
    return Space(tuple(axes[place].variable for place in used), tuple(runs)), narrowed

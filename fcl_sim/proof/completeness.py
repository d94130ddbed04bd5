"""Where an output is undefined, and where it is hardly defined."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from itertools import islice

import numpy as np

from fcl_sim.engine.switches import switched
from fcl_sim.model import FunctionBlock
from fcl_sim.proof.axes import Axis, Flags
from fcl_sim.proof.boxes import boxes_of
from fcl_sim.proof.coupled import are_apart, possible
from fcl_sim.proof.cubes import Cube, firings, left_out, painted
from fcl_sim.proof.examples import undefined_in
from fcl_sim.proof.nearest import Missing, missing_at
from fcl_sim.proof.parted import parted
from fcl_sim.proof.points import Point, witness
from fcl_sim.proof.slabs import Budget, Slab, slabs
from fcl_sim.proof.space import Side, Space, axes_of, condensed
from fcl_sim.proof.strength import strong_axes
from fcl_sim.proof.terms import barren
from fcl_sim.proof.universe import Universe
from fcl_sim.proof.witnesses import Witnesses

EPSILON = 0.05
"""The part of the strongest degree from which on a term counts, where nothing is said."""

BOXES = 20
"""Boxes that are made of a gap; the rest is told as a share alone."""

Cubes = list[Cube]


class Certainty(StrEnum):
    """How sure a finding is."""

    EXACT = "exact"
    """It is so there and nowhere else."""
    BOUNDED = "bounded"
    """It is so there; elsewhere it may be so, too."""


@dataclass(frozen=True, slots=True)
class Box:
    """A box of the input space, by variable; one that is not named may have any value."""

    sides: Mapping[str, Side]

    @property
    def is_thin(self) -> bool:
        """Whether it has no volume: a point, or a part of a line or plane."""
        return any(each.is_point for each in self.sides.values())


@dataclass(frozen=True, slots=True, kw_only=True)
class Gap:
    """Where no rule concludes on an output, or none that counts.

    `share` is its part of the universe, None where that has no end or inputs
    are coupled. `boxes` cover all of it, or where there is `more` the largest
    part. `witness` lies in the first box, and has a number for every input;
    `missing` tells which rule would fire there.
    """

    boxes: tuple[Box, ...]
    more: bool
    share: Fraction | None
    witness: Point
    missing: Missing

    def has_all_of(self, variable: str, side: Side) -> bool:
        """Return whether one of the boxes has an interval of an input, whatever the others are."""
        return any(each.sides.keys() == {variable} and each.sides[variable].has(side) for each in self.boxes)


@dataclass(frozen=True, slots=True, kw_only=True)
class Completeness:
    """What is known of an output: its gap, if it has one, and where it is hardly defined.

    `example` is a point without a rule where it is not known in general, if one was found.
    Each box of `parts` has places without a rule, and others with one, by half-spaces.
    `doubt` is the part of the universe of which it is not known, None where
    that has no measure; `proved` the part that was looked at, by number of cells
    where the universe has no end. Unless it is `whole`, something was left, be
    it edges that have no part.
    """

    output: str
    gap: Gap | None
    weak: Gap | None
    parts: Gap | None = None
    example: Point | None = None
    certainty: Certainty
    doubt: Fraction | None
    proved: Fraction
    whole: bool


def completeness(
    block: FunctionBlock, universe: Universe, epsilon: float = EPSILON, budget: Budget | None = None
) -> tuple[Completeness, ...]:
    """Return for each output with terms on which a rule concludes where it is defined.

    With `epsilon`, a term counts from that part of the strongest degree of its
    input on (proof.strength).
    """
    return tuple(_Prover(switched(block), universe, epsilon, budget or Budget()).outputs())


@dataclass(frozen=True, slots=True)
class _Covers:
    """The cubes that an output has."""

    surely: Cubes
    possibly: Cubes


class _Prover:
    def __init__(self, block: FunctionBlock, universe: Universe, epsilon: float, budget: Budget) -> None:
        self._block, self._universe, self._budget = block, universe, budget
        self._least = Fraction(repr(epsilon))
        self._axes = axes_of(block, universe)
        self._strong: Mapping[str, _Covers] = {}
        if epsilon > 0.0:
            self._axes, strong = strong_axes(block, self._axes, universe, self._least)
            self._strong = _covers(block, strong, epsilon)
        self._covers = _covers(block, self._axes)

    def outputs(self) -> Iterator[Completeness]:
        for output in self._block.defuzzifications:
            name = output.variable.casefold()
            if name in self._covers and output.enabled:
                yield self._output(output.variable, self._covers[name])

    def _output(self, name: str, covers: _Covers) -> Completeness:
        space, (surely, possibly) = condensed(self._axes, [covers.surely, covers.possibly])
        found = _Found(self, name)
        doubt: Fraction | None = Fraction(0)
        unsure = False
        example: Point | None = None
        proved, seen = Fraction(0), 0
        for slab in slabs(space, self._budget):
            allowed = possible(slab.space, self._axes, self._universe)
            undefined = left_out(slab.space.shape, slab.cubes(possibly))
            open_cells = np.asarray(~undefined & left_out(slab.space.shape, slab.cubes(surely)))
            found.add(slab, undefined, allowed)
            if allowed is None and example is None and open_cells.any():
                example = self._example(name, slab.space, open_cells)
            unsure = unsure or bool((open_cells if allowed is None else open_cells & allowed).any())
            own = None if allowed is not None else slab.space.share(open_cells)
            doubt = None if own is None or doubt is None else doubt + own * slab.part
            proved += slab.part
            seen += slab.space.size
        coupled = not are_apart(self._universe.couplings)
        parts = None
        if unsure and seen == space.size and not self._universe.couplings:
            looked_into = self._parts(name)
            if looked_into is not None:
                unsure, parts, doubt = looked_into
        return Completeness(
            output=name,
            gap=found.gap(),
            parts=parts,
            example=example if unsure and parts is None else None,
            weak=self._weak(name, covers) if seen == space.size else None,
            certainty=Certainty.BOUNDED if unsure or coupled or seen < space.size else Certainty.EXACT,
            doubt=doubt,
            proved=proved,
            whole=seen == space.size,
        )

    def _example(self, name: str, space: Space, cells: Flags) -> Point | None:
        return undefined_in(self._block, self._axes, self._universe, name, space, cells)

    def _parts(self, name: str) -> tuple[bool, Gap | None, Fraction | None] | None:
        """Return whether doubtful cells have places without a rule, where, their share; None if unknown."""
        axes = axes_of(self._block, self._universe)
        own = _covers(self._block, axes)[name.casefold()]
        space, (surely, possibly) = condensed(axes, [own.surely, own.possibly])
        slab, *others = slabs(space, self._budget)
        if others:
            return None
        doubtful = np.asarray(painted(space.shape, possibly) & left_out(space.shape, surely))
        looked_into = parted(self._block, axes, name, space, doubtful)
        if looked_into is None:
            return None
        if not looked_into.cells.any():
            return False, None, Fraction(0)
        found = _Found(self, name, at=looked_into.place)
        found.add(slab, looked_into.cells, None)
        return True, found.gap(), space.share(looked_into.cells)

    def _weak(self, name: str, covers: _Covers) -> Gap | None:
        """Return where no rule counts, less what lies around a place where none fires at all."""
        strong = self._strong.get(name.casefold())
        if strong is None:
            return None
        space, (fires, counts) = condensed(self._axes, [covers.possibly, strong.possibly])
        found = _Found(self, name, self._least)
        parts = list(slabs(space, self._budget))
        for slab in parts if len(parts) == 1 else ():
            allowed = possible(slab.space, self._axes, self._universe)
            weak = left_out(slab.space.shape, slab.cubes(counts))
            undefined = left_out(slab.space.shape, slab.cubes(fires))
            found.add(slab, _apart(weak, undefined), allowed)
        return found.gap()

    def point(self, sides: Mapping[str, Side]) -> Point | None:
        """Return a witness in a box that keeps to the couplings."""
        return Witnesses(self._block, self._axes, self._universe).inside(sides)

    def completed(self, place: Point) -> Point:
        """Return a place as a point, which has a number for every input."""
        point = witness(self._block, self._axes, {}, self._universe)
        return {name: place.get(name, value) for name, value in point.items()}

    def missing(self, output: str, point: Point, box: Box, least: Fraction) -> Missing:
        """Return what is missing at a witness in a box."""
        return missing_at(self._block, output, point, box.sides.keys(), least)


class _Found:
    """A gap that is put together slab by slab."""

    def __init__(
        self, prover: _Prover, output: str, least: Fraction = Fraction(0), at: Point | None = None
    ) -> None:
        self._prover, self._output, self._least = prover, output, least
        self._boxes: list[Box] = []
        self._more = False
        self._share: Fraction | None = Fraction(0)
        self._point = None if at is None else prover.completed(at)

    def add(self, slab: Slab, cells: Flags, allowed: Flags | None) -> None:
        """Add the cells of a slab that couplings leave."""
        wanted = cells if allowed is None else np.asarray(cells & allowed)
        space = slab.space
        own = space.share(cells) if allowed is None else None
        self._share = None if own is None or self._share is None else self._share + own * slab.part
        if not wanted.any():
            return
        free = None if allowed is None else np.asarray(~allowed)
        boxes = [
            (box, Box(space.sides(box.low, box.high)))
            for box in islice(boxes_of(space, wanted, free), BOXES - len(self._boxes) + 1)
        ]
        if self._point is None:
            self._point = self._prover.point(
                self._seed(space, wanted, boxes[0][1], coupled=allowed is not None)
            )
        self._more = self._more or len(self._boxes) + len(boxes) > BOXES
        self._boxes = [*self._boxes, *(told for _, told in boxes)][:BOXES]

    def _seed(self, space: Space, wanted: Flags, box: Box, *, coupled: bool) -> Mapping[str, Side]:
        """Return where a witness is to be: in a box, or in a cell of it where inputs are coupled."""
        if not coupled:
            return box.sides
        at = tuple(int(each) for each in np.argwhere(wanted)[0])
        return {
            name: runs[run].to(runs[run])
            for name, runs, run in zip(space.variables, space.runs, at, strict=True)
        }

    def gap(self) -> Gap | None:
        """Return the gap; None where there is none."""
        if not self._boxes or self._point is None:
            return None
        return Gap(
            boxes=tuple(self._boxes),
            more=self._more,
            share=self._share,
            witness=self._point,
            missing=self._prover.missing(self._output, self._point, self._boxes[0], self._least),
        )


def _covers(block: FunctionBlock, axes: Sequence[Axis], least: float = 0.0) -> dict[str, _Covers]:
    """Return for each variable that is concluded the cubes of all its conclusions."""
    surely = firings(block, axes, certain=True, least=least)
    exact = all(each.exact for each in surely)
    possibly = surely if exact else firings(block, axes, certain=False, least=least)
    found: dict[str, _Covers] = {}
    idle = barren(block)
    for one, other in zip(surely, possibly, strict=True):
        own = found.setdefault(one.conclusion.variable.casefold(), _Covers([], []))
        if (one.conclusion.variable.casefold(), (one.conclusion.term or "").casefold()) not in idle:
            own.surely.extend(one.cubes)
            own.possibly.extend(other.cubes)
    return found


def _apart(weak: Flags, undefined: Flags) -> Flags:
    """Return the weak cells that do not hang together with undefined ones, by sides, edges or corners."""
    near = undefined
    if not undefined.any():
        return weak
    while (weak & ~near).any():
        grown = near
        for axis in range(weak.ndim):
            grown = _widened(grown, axis)
        grown = near | (grown & weak)
        if np.array_equal(grown, near):
            break
        near = grown
    return np.asarray(weak & ~near)


def _widened(cells: Flags, axis: int) -> Flags:
    """Return cells with their neighbours along an axis."""
    found = np.moveaxis(cells.copy(), axis, 0)
    own = np.moveaxis(cells, axis, 0)
    found[1:] |= own[:-1]
    found[:-1] |= own[1:]
    return np.moveaxis(found, 0, axis)

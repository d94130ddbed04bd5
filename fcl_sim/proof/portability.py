"""What other engines make of the same text: where, by how much, and why.

Each habit of another engine that the model can say is said in it, and the two
laws are compared (proof.apart).
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from math import ceil, floor, log10

import numpy as np

from fcl_sim.block import Block
from fcl_sim.diagnostics import InputFault
from fcl_sim.engine.assemble import assemble
from fcl_sim.model import FunctionBlock
from fcl_sim.proof.apart import PART, Apart, apart
from fcl_sim.proof.habits import Habit, habits_of
from fcl_sim.proof.law import Extreme, cells_of
from fcl_sim.proof.space import axes_of
from fcl_sim.proof.universe import Stretch, Universe

POINTS = 40_000
"""Points at which laws are compared that are not bounded."""
DIGITS = 7
"""Significant digits of a witness at which one is told as it was found."""
MOST = 0.95
"""The part of the largest difference that a witness of fewer digits shows."""


@dataclass(frozen=True, slots=True)
class Otherwise:
    """A habit that changes an output: it is `ours` at a point `at`, and by the habit `theirs`."""

    habit: Habit
    output: str
    at: Mapping[str, float]
    ours: float
    theirs: float


def otherwise(block: FunctionBlock, universe: Universe) -> Iterator[Otherwise]:
    """Yield for each habit the output that it changes most."""
    habits = list(habits_of(block))
    if not habits:
        return
    ours = Block(block, assemble(block))
    for habit in habits:
        found = [each for theirs in habit.readings for each in _differences(ours, theirs, universe)]
        if found:
            theirs, worst = max(found, key=lambda each: abs(each[1].new - each[1].old))
            at = worst.largest.at if worst.largest else {}
            yield _shown(habit, (ours, theirs), worst, _near(at, universe))


def _differences(ours: Block, model: FunctionBlock, universe: Universe) -> Iterator[tuple[Block, Apart]]:
    """Yield the outputs that a reading changes by more than a part of their reach, with the block."""
    try:
        theirs = Block(model, assemble(model))
    except InputFault:  # a reading that no engine can evaluate
        return
    for each in apart(ours, theirs, universe, coarse=True):
        found = _sampled(ours, theirs, each.output, universe) if each.unknown else each
        if found is not None and found.largest is not None and found.largest.reached > found.threshold:
            yield theirs, found


def _sampled(ours: Block, theirs: Block, output: str, universe: Universe) -> Apart | None:
    """Return the largest difference among points on, between and beside breakpoints; None without any."""
    axes = {each.variable: each for each in axes_of(ours.function_block, universe)}
    cells = cells_of(ours.inputs, axes, universe)
    random = np.random.default_rng(0)
    chosen = random.integers(0, len(cells), POINTS)
    parts = random.choice((0.0, 0.5, 1.0, *random.random(6)), (POINTS, len(ours.inputs)))
    points = cells.low[chosen] + parts * (cells.high[chosen] - cells.low[chosen])
    columns = dict(zip(ours.inputs, points.T, strict=True))
    old, new = (each.evaluate(columns)[output] for each in (ours, theirs))
    apart_by = np.nan_to_num(np.abs(new - old))
    at = int(np.argmax(apart_by))
    reached = float(apart_by[at])
    place = dict(zip(ours.inputs, points[at].tolist(), strict=True))
    return Apart(
        output=output,
        threshold=PART * float(np.ptp(old[np.isfinite(old)])) if np.isfinite(old).any() else 0.0,
        largest=Extreme(reached, float("inf"), place, is_exact=False),
        old=float(old[at]),
        new=float(new[at]),
    )


def _shown(
    habit: Habit, blocks: tuple[Block, Block], worst: Apart, points: Iterable[Mapping[str, float]]
) -> Otherwise:
    """Return a habit with the first point that shows most of the difference."""
    found = Otherwise(habit, worst.output, {}, worst.old, worst.new)
    for at in points:
        ours, theirs = (float(each.evaluate(at)[worst.output]) for each in blocks)
        found = Otherwise(habit, worst.output, at, ours, theirs)
        if abs(theirs - ours) >= MOST * abs(worst.new - worst.old):
            break
    return found


def _near(at: Mapping[str, float], universe: Universe) -> Iterator[Mapping[str, float]]:
    """Yield points of few digits around one, those of the fewest first, and at last the point itself."""
    for digits in range(1, DIGITS):
        for values in product(*(_rounded(each, digits) for each in at.values())):
            point = dict(zip(at, values, strict=True))
            if all(_is_within(value, universe.of(name)) for name, value in point.items()):
                yield point
    yield at


def _is_within(value: float, stretch: Stretch | None) -> bool:
    return stretch is None or stretch[0] <= value <= stretch[1]


def _rounded(value: float, digits: int) -> Iterable[float]:
    """Return a number with so many significant digits, downwards and upwards."""
    step = 10.0 ** (floor(log10(abs(value))) + 1 - digits) if value else 1.0
    return dict.fromkeys(float(f"{end(value / step) * step:.{digits + 1}g}") for end in (floor, ceil))

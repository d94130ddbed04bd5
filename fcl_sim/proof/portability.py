"""What other engines make of the same text: where, by how much, and why.

Each habit of another engine that the model can say is said in it, and the two
laws are compared (proof.apart).
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from fcl_sim.block import Block
from fcl_sim.diagnostics import InputFault
from fcl_sim.engine.assemble import assemble
from fcl_sim.model import FunctionBlock
from fcl_sim.proof.apart import PART, Apart, apart
from fcl_sim.proof.few_digits import shown
from fcl_sim.proof.habits import Habit, habits_of
from fcl_sim.proof.law import Extreme, cells_of
from fcl_sim.proof.space import axes_of
from fcl_sim.proof.universe import Universe

POINTS = 40_000
"""Points at which laws are compared that are not bounded."""


@dataclass(frozen=True, slots=True)
class Otherwise:
    """A habit that changes an output, and by how much."""

    habit: Habit
    apart: Apart


def otherwise(block: FunctionBlock, universe: Universe) -> Iterator[Otherwise]:
    """Yield for each habit the output that it changes most."""
    habits = list(habits_of(block))
    if not habits:
        return
    ours = Block(block, assemble(block))
    for habit in habits:
        found = [each for theirs in habit.readings for each in _differences(ours, theirs, universe)]
        if found:
            yield Otherwise(habit, max(found, key=lambda each: abs(each.new - each.old)))


def _differences(ours: Block, model: FunctionBlock, universe: Universe) -> Iterator[Apart]:
    """Yield the outputs that a reading changes by more than a part of their reach."""
    try:
        theirs = Block(model, assemble(model))
    except InputFault:  # a reading that no engine can evaluate
        return
    for each in apart(ours, theirs, universe, coarse=True):
        found = _sampled(ours, theirs, each.output, universe) if each.unknown else each
        if found is not None and found.largest is not None and found.largest.reached > found.threshold:
            yield found


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
        shown=shown((ours, theirs), output, place, cells.reach, universe),
    )

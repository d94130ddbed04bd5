"""Where an output is at the end of its reach because nothing but its outermost singleton is concluded."""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice

import numpy as np

from fcl_sim.engine.switches import switched
from fcl_sim.model import FunctionBlock, Method, Singleton
from fcl_sim.proof.axes import Axis
from fcl_sim.proof.boxes import boxes_of
from fcl_sim.proof.completeness import Box
from fcl_sim.proof.cubes import Cube, firings, left_out, painted
from fcl_sim.proof.slabs import Budget, slabs
from fcl_sim.proof.space import condensed

BOXES = 6


@dataclass(frozen=True, slots=True, kw_only=True)
class Saturation:
    """Where an output is `value`, one end of its reach, and does not move.

    `share` is the part of the universe, None where that has no end; `boxes` are the
    largest of it, all of them unless there is `more`.
    """

    value: float
    share: Fraction | None
    boxes: tuple[Box, ...]
    more: bool


def saturations(block: FunctionBlock, axes: Sequence[Axis], output: str) -> tuple[Saturation, ...]:
    """Return where an output of singletons under CoGS stays at its least, and at its largest place.

    Only what is known exactly is told, and not where inputs are coupled.
    """
    own = next(each for each in block.defuzzifications if each.variable.casefold() == output.casefold())
    places = {
        each.name.casefold(): float(each.shape.value)
        for each in own.terms
        if isinstance(each.shape, Singleton) and not isinstance(each.shape.value, str)
    }
    if own.method is not Method.COGS or len(places) < len(own.terms) or own.clamped:
        return ()
    cubes: dict[str, list[Cube]] = {}
    for each in firings(switched(block), axes, certain=True):
        if each.conclusion.variable.casefold() == output.casefold() and each.cubes:
            if not each.exact:
                return ()
            cubes.setdefault((each.conclusion.term or "").casefold(), []).extend(each.cubes)
    values = sorted({places[term] for term in cubes})
    if len(values) < 2:
        return ()
    return tuple(
        found
        for value in (values[0], values[-1])
        for found in [_saturation(axes, cubes, places, value)]
        if found is not None
    )


def _saturation(
    axes: Sequence[Axis], cubes: dict[str, list[Cube]], places: dict[str, float], value: float
) -> Saturation | None:
    ends = [cube for term, own in cubes.items() if places[term] == value for cube in own]
    others = [cube for term, own in cubes.items() if places[term] != value for cube in own]
    space, groups = condensed(axes, [ends, others])
    parts = list(slabs(space, Budget()))
    if len(parts) != 1:
        return None
    cells = np.asarray(painted(space.shape, groups[0]) & left_out(space.shape, groups[1]))
    if not cells.any():
        return None
    boxes = [Box(space.sides(box.low, box.high)) for box in islice(boxes_of(space, cells), BOXES + 1)]
    return Saturation(
        value=value, share=space.share(cells), boxes=tuple(boxes[:BOXES]), more=len(boxes) > BOXES
    )

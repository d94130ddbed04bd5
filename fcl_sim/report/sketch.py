"""Plants as sketches to scale: pieces in metres, some of which move with a plant's outputs.

A sketch is data, so that paper and page draw the same: a piece is placed by the
motions of the groups around it. A plant has one where its file declares what
the sketch is drawn of; that of a user with the same name and other outputs has
none.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

import numpy as np

from fcl_sim.loop.diagram import PlantNode
from fcl_sim.report.words import number, with_unit
from fcl_sim.testbench import Run

Point = tuple[float, float]

Role = Literal["ground", "body", "load", "line", "fluid", "mark"]
"""What a piece is: what stands still, what moves, what is carried, a rope, a liquid, a mark."""

ROOM = 0.06
"""What is shown around the pieces, as a share of the width."""


@dataclass(frozen=True, slots=True)
class Motion:
    """A signal of the plant by its whole name, times `factor`."""

    signal: str
    factor: float = 1.0


@dataclass(frozen=True, slots=True)
class Piece:
    """A line through points, in metres, y upwards; closed, it is filled."""

    points: tuple[Point, ...]
    role: Role
    closed: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class Group:
    """Pieces that move together: grown about the origin, turned (degrees, anticlockwise), then moved."""

    parts: tuple["Piece | Group", ...]
    across: Motion | None = None
    turn: Motion | None = None
    grow: Motion | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Sketch:
    """A plant: its pieces, the corners of what is shown, in metres, and in words what is drawn."""

    group: Group
    low: Point
    high: Point
    about: str


def sketches_of(runs: Sequence[Run]) -> list[Sketch | None]:
    """Return of each run its plant as a sketch, None where there is none; all show the same place."""
    made = [_sketch_of(run) for run in runs]
    shown = [each for each in made if each is not None]
    if not shown:
        return list(made)
    low = (min(each.low[0] for each in shown), min(each.low[1] for each in shown))
    high = (max(each.high[0] for each in shown), max(each.high[1] for each in shown))
    return [
        None if each is None else Sketch(group=each.group, low=low, high=high, about=each.about)
        for each in made
    ]


def _sketch_of(run: Run) -> Sketch | None:
    plant = run.diagram.plant
    declared = plant.model.declaration
    draw, outputs, parameters = PLANTS.get(declared.name, (None, (), ()))
    declares = {each.name for each in declared.outputs} | {each.name for each in declared.parameters}
    names = {f"{plant.name}.{each}" for each in outputs}
    if draw is None or not declares.issuperset((*outputs, *parameters)) or not names <= set(run.trace.names):
        return None
    return draw(plant, _parameters(plant), run)


def _parameters(plant: PlantNode) -> Mapping[str, float]:
    return {each.name: each.default for each in plant.model.declaration.parameters} | dict(plant.parameters)


def _crane(plant: PlantNode, given: Mapping[str, float], run: Run) -> Sketch:
    """Return the crane from its side: the load's angle is positive ahead, which is to the right."""
    length = given["cable_length"]
    across, up = 1.22, 1.295  # half the end of a container of 40 ft, ISO 668
    position = run.trace[f"{plant.name}.position"]
    finite = position[np.isfinite(position)]
    reach = length + across
    left, right = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 0.0)
    left, right = min(left, 0.0) - min(reach, 4.0), max(right, 0.0) + min(reach, 4.0)
    rail = Piece(((left - reach, 0.0), (right + reach, 0.0)), "ground", closed=False)
    target = Piece(((0.0, -length - 2.0 * up), (0.0, 1.2)), "mark", closed=False)
    trolley = Piece(((-1.6, 0.15), (1.6, 0.15), (1.6, 0.9), (-1.6, 0.9)), "body")
    rope = Piece(((0.0, 0.15), (0.0, -length + up)), "line", closed=False)
    box = Piece(
        ((-across, -length - up), (across, -length - up), (across, -length + up), (-across, -length + up)),
        "load",
    )
    hanging = Group(parts=(rope, box), turn=Motion(f"{plant.name}.angle"))
    driven = Group(parts=(hanging, trolley), across=Motion(f"{plant.name}.position"))
    room = ROOM * (right - left)
    return Sketch(
        group=Group(parts=(rail, target, driven)),
        low=(left, -length - up - room),
        high=(right, 1.4 + room),
        about=f"Trolley and container on {with_unit(length, 'm')} of rope, to scale; "
        "the dashed line is the target, the container is seen from its end.",
    )


def _cone(plant: PlantNode, given: Mapping[str, float], run: Run) -> Sketch:  # noqa: ARG001  as all draw
    """Return the cone with its liquid, which is a smaller cone of the same shape."""
    rim, radius = given["rim"], given["radius"]
    slope = radius / rim
    liquid = Piece(((0.0, 0.0), (slope, 1.0), (-slope, 1.0)), "fluid")
    wall = Piece(((-radius, rim), (0.0, 0.0), (radius, rim)), "ground", closed=False)
    room = ROOM * 2.0 * radius
    return Sketch(
        group=Group(parts=(Group(parts=(liquid,), grow=Motion(f"{plant.name}.height")), wall)),
        low=(-radius - room, -room),
        high=(radius + room, rim + room),
        about=f"Cone of {with_unit(rim, 'm')} height and {number(radius)} m radius at the rim, to scale.",
    )


Draw = Callable[[PlantNode, Mapping[str, float], Run], Sketch]

PLANTS: Mapping[str, tuple[Draw, tuple[str, ...], tuple[str, ...]]] = MappingProxyType(
    {
        "crane": (_crane, ("position", "angle"), ("cable_length",)),
        "cone": (_cone, ("height",), ("rim", "radius")),
    }
)
"""By the name of a plant: what draws it, and of which outputs and parameters."""

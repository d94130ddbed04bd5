"""The plants that have a sketch, drawn from their parameters.

A plant has one where its file declares what the sketch is drawn of; that of a
user with the same name and other outputs has none.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from math import cos, pi, radians, sin
from types import MappingProxyType

import numpy as np

from fcl_sim.loop.diagram import PlantNode
from fcl_sim.report.sketch import Delayed, Group, Motion, Paint, Piece, Point, Reading, Role, Sketch, Tint
from fcl_sim.report.words import number, with_unit
from fcl_sim.testbench import Run

ROOM = 0.06
"""What is shown around the pieces, as a share of the width."""


def sketches_of(runs: Sequence[Run]) -> list[Sketch | None]:
    """Return of each run its plant as a sketch, None where there is none; all show the same place."""
    made = [_sketch_of(run) for run in runs]
    shown = [each for each in made if each is not None]
    if not shown:
        return list(made)
    low = (min(each.low[0] for each in shown), min(each.low[1] for each in shown))
    high = (max(each.high[0] for each in shown), max(each.high[1] for each in shown))
    return [None if each is None else replace(each, low=low, high=high) for each in made]


def _sketch_of(run: Run) -> Sketch | None:
    plant = run.diagram.plant
    declared = plant.model.declaration
    draw, signals, parameters = PLANTS.get(declared.name, (None, (), ()))
    own = {each.name for each in declared.parameters}
    names = {f"{plant.name}.{each}" for each in signals}
    if draw is None or not own.issuperset(parameters) or not names <= set(run.trace.names):
        return None
    return draw(plant.name, _parameters(plant), run)


def _parameters(plant: PlantNode) -> Mapping[str, float]:
    return {each.name: each.default for each in plant.model.declaration.parameters} | dict(plant.parameters)


def _box(low: Point, high: Point, role: Role, colour: Tint | Paint | None = None) -> Piece:
    return Piece((low, (high[0], low[1]), high, (low[0], high[1])), role, colour=colour)


def _pipe(*points: Point) -> Piece:
    return Piece(points, "line", closed=False)


def _valve(at: Point, size: float, command: Motion) -> list[Piece | Group]:
    """Return the sign of a valve with the bar above it that its opening, -1 to 1, fills from the line."""
    x, y = at
    wings = [
        Piece(((x, y), (x + side * size, y + 0.6 * size), (x + side * size, y - 0.6 * size)), "body")
        for side in (-1.0, 1.0)
    ]
    foot, half, high = y + 1.5 * size, 0.5 * size, 3.0 * size
    stem = _pipe((x, y), (x, foot))
    frame = _pipe(
        (x - half, foot), (x + half, foot), (x + half, foot + high), (x - half, foot + high), (x - half, foot)
    )
    filled = Group(parts=(_box((-half, 0.0), (half, high), "load"),), rise=command, at=(x, foot))
    return [*wings, stem, filled, frame]


def _arrow(at: Point, size: float, flow: Motion) -> Group:
    """Return a head that points to the right, as large as a flow."""
    return Group(
        parts=(Piece(((0.0, 0.5 * size), (size, 0.0), (0.0, -0.5 * size)), "body"),), grow=flow, at=at
    )


def _crane(name: str, given: Mapping[str, float], run: Run) -> Sketch:
    """Return the crane from its side: the load's angle is positive ahead, which is to the right."""
    length = given["cable_length"]
    across, up = 1.22, 1.295  # half the end of a container of 40 ft, ISO 668
    position = run.trace[f"{name}.position"]
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
    hanging = Group(parts=(rope, box), turn=Motion(f"{name}.angle"))
    driven = Group(parts=(hanging, trolley), across=Motion(f"{name}.position"))
    room = ROOM * (right - left)
    return Sketch(
        group=Group(parts=(rail, target, driven)),
        low=(left, -length - up - room),
        high=(right, 1.4 + room),
        about=f"Trolley and container on {with_unit(length, 'm')} of rope, to scale; "
        "the dashed line is the target, the container is seen from its end.",
    )


def _cone(name: str, given: Mapping[str, float], run: Run) -> Sketch:  # noqa: ARG001  as all draw
    """Return the cone with its liquid, which is a smaller cone of the same shape."""
    rim, radius = given["rim"], given["radius"]
    slope = radius / rim
    liquid = Piece(((0.0, 0.0), (slope, 1.0), (-slope, 1.0)), "fluid")
    wall = Piece(((-radius, rim), (0.0, 0.0), (radius, rim)), "ground", closed=False)
    room = ROOM * 2.0 * radius
    return Sketch(
        group=Group(parts=(Group(parts=(liquid,), grow=Motion(f"{name}.height")), wall)),
        low=(-radius - room, -0.12 * rim),
        high=(radius + room, rim + room),
        about=f"Cone of {with_unit(rim, 'm')} height and {number(radius)} m radius at the rim, to scale.",
        readings=(Reading((0.0, -0.07 * rim), f"{name}.height"),),
    )


def _bath(name: str, given: Mapping[str, float], run: Run) -> Sketch:  # noqa: ARG001  as all draw
    """Return the water as a cube of its mass, with the steam's valve before it and the draw-off behind."""
    side = (given["mass"] / 1000.0) ** (1.0 / 3.0)
    cold, hot = given["supply"], 100.0
    water = _box((0.0, 0.0), (side, side), "fluid", Tint(Motion(f"{name}.water"), cold, hot))
    wall = Piece(((0.0, 1.12 * side), (0.0, 0.0), (side, 0.0), (side, 1.12 * side)), "ground", closed=False)
    low, high = 0.12 * side, 0.28 * side
    coil = [(side * (0.12 + 0.076 * each), high if each % 2 else low) for each in range(11)]
    steam = _pipe((-0.95 * side, low), *coil)
    off = _pipe((side, low), (1.4 * side, low))
    valve = _valve((-0.5 * side, low), 0.16 * side, Motion(f"{name}.valve_opening", 0.01))
    drawn = _arrow((1.4 * side, low), 0.14 * side, Motion(f"{name}.demand"))
    below = -0.14 * side
    return Sketch(
        group=Group(parts=(water, wall, steam, off, *valve, drawn)),
        low=(-1.0 * side, -0.26 * side),
        high=(1.65 * side, 1.2 * side),
        about=f"{with_unit(given['mass'], 'kg')} of water as a cube of {with_unit(side, 'm', 2)}, to scale, "
        f"the darker the warmer from {_range(cold, hot)}; before it the steam, its pressure and how far its "
        "valve is open, behind it the draw-off, 1 as usual.",
        readings=(
            Reading((0.5 * side, 0.62 * side), f"{name}.water", on=True),
            Reading((-0.5 * side, below), f"{name}.pressure"),
            Reading((-0.5 * side, 1.02 * side), f"{name}.valve_opening"),
            Reading((1.25 * side, below), f"{name}.demand"),
        ),
    )


def _range(low: float, high: float) -> str:
    return f"{number(low)} to {with_unit(high, 'degC')}"


PIPE_CELLS = 12
"""Stretches of the pipe that are coloured apart."""

SEAM = 0.1
"""Part of a stretch that the next one covers, so that no line shows between them."""


def _exchanger(name: str, given: Mapping[str, float], run: Run) -> Sketch:  # noqa: ARG001  as all draw
    """Return exchanger and pipe, areas as masses of water; a cell of the pipe holds what entered it."""
    side = given["mass"] ** 0.5
    high = 0.16 * side
    length = given["pipe_mass"] / high
    cold, hot = 10.0, 70.0
    water = _box((0.0, 0.0), (side, side), "fluid", Tint(Motion(f"{name}.water"), cold, hot))
    corners = ((0.0, 0.0), (side, 0.0), (side, side), (0.0, side), (0.0, 0.0))
    wall = Piece(corners, "ground", closed=False)
    foot = 0.62 * side
    step = length / PIPE_CELLS
    cells = [
        _box(
            (side + step * each, foot),
            (side + step * (each + 1 + SEAM), foot + high),
            "fluid",
            Tint(_piped(name, given["pipe_mass"] * (each + 0.5) / PIPE_CELLS), cold, hot),
        )
        for each in range(PIPE_CELLS)
    ]
    end = side + length
    edges = [_pipe((side, y), (end, y)) for y in (foot, foot + high)]
    low = 0.14 * side
    coil = [(side * (0.12 + 0.076 * each), 0.3 * side if each % 2 else low) for each in range(11)]
    steam = _pipe((-0.95 * side, low), *coil)
    inlet = _pipe((-1.45 * side, 0.92 * side), (0.0, 0.92 * side))
    valve = _valve((-0.5 * side, low), 0.13 * side, Motion(f"{name}.valve_opening", 0.01))
    flow = _arrow((end, foot + 0.5 * high), 0.2 * side, Motion(f"{name}.flow"))
    return Sketch(
        group=Group(parts=(water, *cells, *edges, wall, steam, inlet, *valve, flow)),
        low=(-1.5 * side, -0.3 * side),
        high=(end + 0.7 * side, 1.3 * side),
        has_scale=False,
        about=f"{with_unit(given['mass'], 'kg')} of water in the exchanger and "
        f"{with_unit(given['pipe_mass'], 'kg')} in its pipe, areas as masses, the darker the warmer from "
        f"{_range(cold, hot)}; the pipe holds what entered it. Above the inlet, below the steam's valve, "
        "at the end what leaves and what the sensor reads.",
        readings=(
            Reading((0.5 * side, 1.15 * side), f"{name}.water"),
            Reading((-0.82 * side, 1.08 * side), f"{name}.inlet"),
            Reading((-0.5 * side, -0.16 * side), f"{name}.valve_opening"),
            Reading((end - 0.3 * side, foot + high + 0.18 * side), f"{name}.flow"),
            Reading((end - 0.3 * side, foot - 0.18 * side), f"{name}.delivered"),
            Reading((end - 0.5 * side, foot - 0.48 * side), f"{name}.outlet", "sensor"),
        ),
    )


def _piped(name: str, mass: float) -> Delayed:
    return Delayed(f"{name}.water", f"{name}.flow", mass)


OVEN_LENGTH = 60.0
"""Of the belt in the oven, m, as its file has it."""


def _oven(name: str, given: Mapping[str, float], run: Run) -> Sketch:  # noqa: ARG001  as all draw
    """Return the tunnel along its belt; the piece behind it has the colour that the camera sees."""
    half, high, belt = 0.5 * OVEN_LENGTH, 9.0, 2.2
    cold, hot = 190.0, 270.0
    zones = [
        _box(
            (half * each, 0.0),
            (half * (each + 1), high),
            "fluid",
            Tint(Motion(f"{name}.temperature_{each + 1}"), cold, hot),
        )
        for each in range(2)
    ]
    walls = [_pipe((x, 0.0), (x, high)) for x in (0.0, half, OVEN_LENGTH)]
    shell = [_pipe((0.0, y), (OVEN_LENGTH, y)) for y in (0.0, high)]
    chain = _pipe((-6.0, belt), (OVEN_LENGTH + 9.0, belt))
    dough = [_piece(4.0 * each - 4.5, belt) for each in range(16)]
    colour = Paint(*(Motion(f"{name}.{each}") for each in ("red", "green", "blue")))
    left = _box((OVEN_LENGTH + 2.0, belt), (OVEN_LENGTH + 8.0, belt + 2.8), "body", colour)
    return Sketch(
        group=Group(parts=(*zones, *walls, *shell, chain, *dough, left)),
        low=(-7.0, -4.5),
        high=(OVEN_LENGTH + 16.0, high + 4.5),
        has_scale=False,
        about=f"Two zones of {number(half)} m, heights enlarged, the darker the hotter from "
        f"{_range(cold, hot)}; above the humidity of the air, below the heaters. The piece at the end has "
        "the colour that the camera sees; above it its distance from dough, below it its moisture.",
        readings=(
            *(
                Reading((half * (each + 0.5), 6.9), f"{name}.temperature_{each + 1}", on=True)
                for each in range(2)
            ),
            *(
                Reading((half * (each + 0.5), -2.3), f"{name}.heater_{each + 1}", "heater")
                for each in range(2)
            ),
            Reading((half, high + 2.3), f"{name}.humidity"),
            Reading((OVEN_LENGTH + 7.5, belt + 5.2), f"{name}.colour"),
            Reading((OVEN_LENGTH + 7.5, belt - 2.3), f"{name}.residual"),
        ),
    )


def _piece(left: float, belt: float) -> Piece:
    return _box((left, belt), (left + 2.0, belt + 1.0), "ground")


def _vessel(name: str, given: Mapping[str, float], run: Run) -> Sketch:  # noqa: ARG001  as all draw
    """Return the receiver as a lying cylinder twice as long as wide, with its gauge and its flows."""
    across = (2.0 * given["volume"] / pi) ** (1.0 / 3.0)
    radius, dial = 0.5 * across, 0.34 * across
    cold, hot = 0.0, 40.0
    shell = tuple(_ends(across, radius))
    gas = Piece(shell, "fluid", colour=Tint(Motion(f"{name}.gas_temperature"), cold, hot))
    wall = Piece((*shell, shell[0]), "ground", closed=False)
    centre = (0.0, radius + 0.25 * across + dial)
    face = Piece(tuple(_arc(centre, dial, 0.0, 360.0)), "line", closed=False)
    scale = Piece(tuple(_arc(centre, 0.8 * dial, -45.0, 225.0)), "line", closed=False)
    zero = (0.72 * dial * cos(radians(225.0)), 0.72 * dial * sin(radians(225.0)))
    pointer = Group(
        parts=(Piece(((0.0, 0.0), zero), "ground", closed=False),),
        turn=Motion(f"{name}.gauge_pressure", -270.0 / (given["header_pressure"] or 1.0)),
        at=centre,
    )
    neck = _pipe((0.0, radius), (0.0, centre[1] - dial))
    end = 1.25 * across
    pipes = [_pipe((side * end, 0.0), (side * (end + 0.75 * across), 0.0)) for side in (-1.0, 1.0)]
    valve = _valve((-end - 0.4 * across, 0.0), 0.14 * across, Motion(f"{name}.valve", 0.01))
    low = -0.2 * across
    return Sketch(
        group=Group(parts=(gas, wall, neck, face, scale, pointer, *pipes, *valve)),
        low=(-end - 1.05 * across, -radius - 0.3 * across),
        high=(end + 1.05 * across, centre[1] + dial + 0.08 * across),
        about=f"{with_unit(given['volume'], 'm3')} of gas as a cylinder {with_unit(across, 'm', 3)} wide, to "
        f"scale, the darker the warmer from {_range(cold, hot)}; the gauge goes to "
        f"{with_unit(given['header_pressure'], 'kPa')}, what the header has. At the left the valve, below 0 "
        "to the atmosphere, and the inflow, at the right what leaves.",
        readings=(
            Reading((0.0, 0.1 * across), f"{name}.gas_temperature", on=True),
            Reading((0.0, -0.22 * across), f"{name}.mass", on=True),
            Reading((1.05 * across, centre[1]), f"{name}.gauge_pressure"),
            Reading((-end - 0.4 * across, 0.85 * across), f"{name}.valve"),
            Reading((-end - 0.52 * across, low - 0.1 * across), f"{name}.inflow"),
            Reading((end + 0.52 * across, low - 0.1 * across), f"{name}.outflow"),
        ),
    )


def _arc(centre: Point, radius: float, begin: float, end: float, flat: float = 1.0) -> list[Point]:
    angles = np.radians(np.linspace(begin, end, 25))
    return [(centre[0] + flat * radius * float(cos(a)), centre[1] + radius * float(sin(a))) for a in angles]


def _ends(half: float, radius: float) -> list[Point]:
    """Return the outline of a lying cylinder with dished ends."""
    right = _arc((half, 0.0), radius, -90.0, 90.0, 0.5)
    return [*right, *((-x, y) for x, y in reversed(right))]


Draw = Callable[[str, Mapping[str, float], Run], Sketch]

PLANTS: Mapping[str, tuple[Draw, tuple[str, ...], tuple[str, ...]]] = MappingProxyType(
    {
        "crane": (_crane, ("position", "angle"), ("cable_length",)),
        "cone": (_cone, ("height",), ("rim", "radius")),
        "bath": (_bath, ("water", "pressure", "valve_opening", "demand"), ("mass", "supply")),
        "exchanger": (
            _exchanger,
            ("water", "valve_opening", "flow", "inlet", "delivered", "outlet"),
            ("mass", "pipe_mass"),
        ),
        "oven": (
            _oven,
            (
                *(f"{each}_{zone}" for each in ("temperature", "heater") for zone in (1, 2)),
                *("humidity", "colour", "residual", "red", "green", "blue"),
            ),
            (),
        ),
        "vessel": (
            _vessel,
            ("gauge_pressure", "gas_temperature", "mass", "inflow", "outflow", "valve"),
            ("volume", "header_pressure"),
        ),
    }
)
"""By the name of a plant: what draws it, and of which signals and parameters."""

"""A plant to scale at several instants of a run, side by side: how it moves, at a glance."""

from collections.abc import Iterator, Sequence
from functools import partial
from math import cos, radians, sin

import numpy as np
from numpy.typing import NDArray

from fcl_sim.loop.trace import Trace
from fcl_sim.report import style
from fcl_sim.report.canvas import Axes, Figure, Line, Shape, Text
from fcl_sim.report.pictures import Picture
from fcl_sim.report.sketch import Group, Motion, Piece, Role, Sketch, sketches_of
from fcl_sim.report.words import joined, number, one_line, with_unit
from fcl_sim.testbench import Run

COUNT = 6
"""Stills of a run."""
WIDE = 1.4
"""A sketch so many times as wide as high has two stills in a row, any other all."""
GAP = 5.0
HEADING = 4.0
TALLEST = 60.0
"""Height of a still in mm, at most."""
REST = 0.01
"""A signal rests where it stays within this part of its range."""
BEHIND = 0.15
"""How much of its time a run is shown at rest, as a part of what went before."""

Places = tuple[tuple[float, float], ...]
Matrix = NDArray[np.float64]

FACES: dict[Role, str] = {
    "ground": "#dfe3e7",
    "body": "#8fa6bd",
    "load": style.COLOURS[1],
    "fluid": "#8fb4d6",
    "line": "",
    "mark": "",
}
"""What fills the pieces of each role."""


def stills_of(run: Run) -> list[Picture]:
    """Return the picture of a run's plant at several instants; nothing where it has no sketch."""
    (sketch,) = sketches_of([run])
    if sketch is None or len(run.trace.ticks) < 2:
        return []
    instants = _instants(sketch, run.trace)
    times = [with_unit(float(run.trace.time[each]), "s", 4) for each in instants]
    return [
        Picture(
            name=f"{run.variant}-stills",
            caption=f"Run {one_line(run.variant)}: the plant at {joined(times)}. {sketch.about}",
            alt=_alt(sketch, run.trace, instants),
            draw=partial(draw, sketch, run.trace, instants),
        )
    ]


def draw(sketch: Sketch, trace: Trace, instants: Sequence[int]) -> Figure:
    """Return a plant at some samples of a trace, all in one scale."""
    across, up = sketch.high[0] - sketch.low[0], sketch.high[1] - sketch.low[1]
    columns = 2 if across > WIDE * up else len(instants)
    width = (style.WIDTH - (columns - 1) * GAP) / columns
    height = width * up / across
    if height > TALLEST:
        width, height = width * TALLEST / height, TALLEST
    rows = -(-len(instants) // columns)
    figure = Figure(rows * (HEADING + height) + (rows - 1) * GAP)
    for place, sample in enumerate(instants):
        row, column = divmod(place, columns)
        top = row * (HEADING + height + GAP) + HEADING
        axes = figure.place(column * (style.WIDTH + GAP) / columns, top, width, height, f"sample {sample}")
        axes.x, axes.y = (sketch.low[0], sketch.high[0]), (sketch.low[1], sketch.high[1])
        told = with_unit(float(trace.time[sample]), "s", 4)
        axes.add(Text(0.0, 1.0, told, style.SMALL, up="bottom", shift=(0.0, 0.6), parts=True))
        for order, (piece, points) in enumerate(placed(sketch.group, trace, sample)):
            _draw_piece(axes, piece, points, 2.0 + 0.01 * order)
    return figure


def _draw_piece(axes: Axes, piece: Piece, points: Places, z: float) -> None:
    x, y = ([each[at] for each in points] for at in (0, 1))
    if piece.role == "mark":
        axes.add(Line(x, y, style.FAINT, 0.6, (4, 2), z=z))
    elif piece.closed:
        axes.add(Shape(x, y, FACES[piece.role], edge=style.INK, width=0.6, z=z))
    else:
        axes.add(Line(x, y, style.INK, 1.2 if piece.role == "ground" else 0.7, z=z))


def placed(group: Group, trace: Trace, sample: int) -> Iterator[tuple[Piece, Places]]:
    """Yield every piece of a group with its points in metres, where it is at a sample of a trace."""
    yield from _placed(group, trace, sample, np.eye(3))


def _placed(group: Group, trace: Trace, sample: int, around: Matrix) -> Iterator[tuple[Piece, Places]]:
    own = around @ _motion(group, trace, sample)
    for part in group.parts:
        if isinstance(part, Group):
            yield from _placed(part, trace, sample, own)
        else:
            points = own @ np.array([(x, y, 1.0) for x, y in part.points]).T
            yield part, tuple((float(x), float(y)) for x, y in points[:2].T)


def _motion(group: Group, trace: Trace, sample: int) -> Matrix:
    """Return what a group does to its parts, as a matrix (3, 3): grown, turned, then moved."""
    size = _value(group.grow, trace, sample, 1.0)
    angle = radians(_value(group.turn, trace, sample, 0.0))
    across = _value(group.across, trace, sample, 0.0)
    turned = [[cos(angle) * size, -sin(angle) * size, across], [sin(angle) * size, cos(angle) * size, 0.0]]
    return np.array([*turned, [0.0, 0.0, 1.0]])


def _value(motion: Motion | None, trace: Trace, sample: int, otherwise: float) -> float:
    return otherwise if motion is None else motion.factor * float(trace[motion.signal][sample])


def _signals(group: Group) -> Iterator[str]:
    yield from (each.signal for each in (group.across, group.turn, group.grow) if each is not None)
    for part in group.parts:
        if isinstance(part, Group):
            yield from _signals(part)


def _instants(sketch: Sketch, trace: Trace) -> list[int]:
    """Return samples at even times, from the first until shortly after everything has come to rest."""
    last = 0
    finite = np.ones(len(trace.ticks), dtype=bool)
    for name in _signals(sketch.group):
        values = trace[name]
        finite &= np.isfinite(values)
        moves = np.abs(values - values[-1]) > REST * float(np.ptp(values[np.isfinite(values)]))
        last = max(last, int(np.flatnonzero(moves).max(initial=0)))
    end = min(int(np.flatnonzero(finite).max(initial=0)), int(last * (1.0 + BEHIND)))
    return list(dict.fromkeys(int(each) for each in np.linspace(0, end, COUNT).round()))


def _alt(sketch: Sketch, trace: Trace, instants: Sequence[int]) -> str:
    names = list(dict.fromkeys(_signals(sketch.group)))
    told = []
    for sample in instants:
        values = [f"{one_line(each)} {_told(trace, each, sample)}" for each in names]
        told.append(f"at {number(float(trace.time[sample]), 4)} s {joined(values)}")
    return f"{sketch.about} {'; '.join(told)}."


def _told(trace: Trace, name: str, sample: int) -> str:
    return with_unit(float(trace[name][sample]), trace.units[name], 3)

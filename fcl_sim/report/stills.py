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
from fcl_sim.report.plant_sketches import sketches_of
from fcl_sim.report.ranges import width
from fcl_sim.report.sketch import Amount, Group, Paint, Piece, Role, Sketch, Tint
from fcl_sim.report.words import joined, number, one_line, with_unit
from fcl_sim.testbench import Run

COUNT = 6
"""Stills of a run."""
WIDE, WIDEST = 1.3, 4.0
"""Sketches more times as wide as high have three stills in a row, then two; any other all."""
GAP = 5.0
HEADING = 4.0
TIME, READ = 6, 4
"""Digits of the time of a still, and of what is read on it."""
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
    times = [with_unit(float(run.trace.time[each]), "s", TIME) for each in instants]
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
    columns = 2 if across > WIDEST * up else 3 if across > WIDE * up else len(instants)
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
        told = with_unit(float(trace.time[sample]), "s", TIME)
        axes.add(Text(0.0, 1.0, told, style.SMALL, up="bottom", shift=(0.0, 0.6), parts=True))
        for order, (piece, points) in enumerate(placed(sketch.group, trace, sample)):
            _draw_piece(axes, piece, points, 2.0 + 0.01 * order, _face(piece, trace, sample))
        for each in sketch.readings:
            told = f"{each.word} {_told(trace, each.signal, sample, READ)}".strip()
            axes.add(Text(*each.at, told, style.SMALL, across="center", up="center", z=8.0))
    return figure


def _face(piece: Piece, trace: Trace, sample: int) -> str:
    """Return what fills a piece at a sample; paper where a signal is not a number there."""
    if isinstance(piece.colour, Paint):
        return _hex([each.at(trace, sample) for each in piece.colour.parts])
    if isinstance(piece.colour, Tint):
        tint = piece.colour
        part = (tint.value.at(trace, sample) - tint.low) / ((tint.high - tint.low) or 1.0)
        stops = np.linspace(0.0, 1.0, len(style.WARMTH))
        channels = zip(*(_parts(each) for each in style.WARMTH), strict=True)
        return _hex([float(np.interp(part, stops, each)) for each in channels])
    return FACES[piece.role]


def _parts(colour: str) -> tuple[int, ...]:
    return tuple(int(colour[at : at + 2], 16) for at in (1, 3, 5))


def _hex(parts: Sequence[float]) -> str:
    if not np.isfinite(parts).all():
        return style.PAPER
    return "#" + "".join(f"{min(max(round(each), 0), 255):02x}" for each in parts)


def _draw_piece(axes: Axes, piece: Piece, points: Places, z: float, face: str) -> None:
    x, y = ([each[at] for each in points] for at in (0, 1))
    if piece.role == "mark":
        axes.add(Line(x, y, style.FAINT, 0.6, (4, 2), z=z))
    elif piece.closed:
        axes.add(
            Shape(
                x, y, face, edge="" if piece.colour and piece.role == "fluid" else style.INK, width=0.6, z=z
            )
        )
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
    """Return what a group does to its parts, as a matrix (3, 3): raised, grown, turned, then moved."""
    size = _value(group.grow, trace, sample, 1.0)
    high = size * _value(group.rise, trace, sample, 1.0)
    angle = radians(_value(group.turn, trace, sample, 0.0))
    across = _value(group.across, trace, sample, 0.0) + group.at[0]
    turned = [
        [cos(angle) * size, -sin(angle) * high, across],
        [sin(angle) * size, cos(angle) * high, group.at[1]],
    ]
    return np.array([*turned, [0.0, 0.0, 1.0]])


def _value(motion: Amount | None, trace: Trace, sample: int, otherwise: float) -> float:
    return otherwise if motion is None else motion.at(trace, sample)


def _signals(group: Group) -> Iterator[str]:
    motions = (group.across, group.turn, group.grow, group.rise)
    yield from (each.signal for each in motions if each is not None)
    for part in group.parts:
        if isinstance(part, Group):
            yield from _signals(part)
        elif isinstance(part.colour, Tint):
            yield from part.colour.value.signals
        elif isinstance(part.colour, Paint):
            yield from (each.signal for each in part.colour.parts)


def signals_of(sketch: Sketch) -> list[str]:
    """Return the signals that a sketch shows, each once."""
    return list(dict.fromkeys([*_signals(sketch.group), *(each.signal for each in sketch.readings)]))


def _instants(sketch: Sketch, trace: Trace) -> list[int]:
    """Return samples at even times, from the first until shortly after everything has come to rest."""
    last = 0
    finite = np.ones(len(trace.ticks), dtype=bool)
    for name in signals_of(sketch):
        values = trace[name]
        finite &= np.isfinite(values)
        moves = np.abs(values - values[-1]) > REST * width(values[np.isfinite(values)])
        last = max(last, int(np.flatnonzero(moves).max(initial=0)))
    end = min(int(np.flatnonzero(finite).max(initial=0)), int(last * (1.0 + BEHIND)))
    return list(dict.fromkeys(int(each) for each in np.linspace(0, end, COUNT).round()))


def _alt(sketch: Sketch, trace: Trace, instants: Sequence[int]) -> str:
    names = signals_of(sketch)
    told = []
    for sample in instants:
        values = [f"{one_line(each)} {_told(trace, each, sample)}" for each in names]
        told.append(f"at {number(float(trace.time[sample]), TIME)} s {joined(values)}")
    return f"{sketch.about} {'; '.join(told)}."


def _told(trace: Trace, name: str, sample: int, digits: int = 3) -> str:
    return with_unit(float(trace[name][sample]), trace.units[name], digits)

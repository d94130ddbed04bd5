"""Round times on the way of a run over a map: a dot, and beside it the time, where nothing else stands."""

from collections.abc import Iterator

import numpy as np

from fcl_sim.loop.trace import Values
from fcl_sim.report import style
from fcl_sim.report.canvas import Across, Axes, Dot, Text, Up
from fcl_sim.report.frame import ticks
from fcl_sim.report.sampling import Track
from fcl_sim.report.vector import extent

MOST_TIMES = 14
"""Round times that are marked on a track, at most."""
APART = 6.0
"""What lies between two of them in mm, at least."""
STROKE = 0.5
"""What the way takes to each side with the paper around it, in mm."""
RIM = 1.2
"""What a dot and its time keep from the edge of a map, and a time from the dots of others, in mm."""
SIDES: tuple[tuple[Across, Up, float, float], ...] = (
    ("left", "bottom", 0.8, 0.5),
    ("left", "top", 0.8, -0.5),
    ("right", "bottom", -0.8, 0.5),
    ("right", "top", -0.8, -0.5),
)
"""How a time may stand beside its dot: alignment and shift in mm."""

Box = tuple[float, float, float, float]
"""Left, lower, right and upper end in mm."""


def draw_times(axes: Axes, track: Track) -> None:
    """Mark round times on a track, each where it covers least of the way, if it meets no other there."""
    if len(track.time) != len(track.x) or len(track.time) < 2:
        return
    (left, right), (low, high) = axes.x, axes.y
    way = np.stack(
        [(track.x - left) / (right - left) * axes.width, (track.y - low) / (high - low) * axes.height]
    )
    dots = [way[:, 0], way[:, -1]]
    boxes: list[Box] = []
    for each in ticks(float(track.time[0]), float(track.time[-1]), MOST_TIMES)[1:]:
        sample = min(int(np.searchsorted(track.time, each.at - 1e-9)), len(track.x) - 1)
        place = way[:, sample]
        if min(float(np.hypot(*(place - other))) for other in dots) < APART:
            continue
        at = (float(track.x[sample]), float(track.y[sample]))
        found = [
            (_covered(box, way), text, box)
            for text, box in _beside(at, place, f"{each.label} s")
            if _is_free(box, axes, dots, boxes)
        ]
        if found:
            _, text, box = min(found, key=lambda one: one[0])
            dots.append(place)
            boxes.append(box)
            axes.add(Dot(*at, "circle", style.INK, 2.6, halo=1.2, z=5.5), text)


def _beside(at: tuple[float, float], place: Values, told: str) -> Iterator[tuple[Text, Box]]:
    """Yield a time as it may stand at a place, with what it takes of the map."""
    across, up = (float(each) for each in place)
    for side, above, right, high in SIDES:
        text = Text(*at, told, style.LEAST, across=side, up=above, shift=(right, high), backed=0.15, z=5.6)
        start, upper, end, lower = extent(text)
        yield text, (across + right + start, up + high - lower, across + right + end, up + high - upper)


def _is_free(box: Box, axes: Axes, dots: list[Values], boxes: list[Box]) -> bool:
    left, low, right, high = box
    inside = min(left, low, axes.width - right, axes.height - high) >= RIM
    beside = all(max(left - x, x - right) >= RIM or max(low - y, y - high) >= RIM for x, y in dots)
    return inside and beside and all(_are_apart(box, other) for other in boxes)


def _are_apart(one: Box, other: Box) -> bool:
    across, down = max(one[0] - other[2], other[0] - one[2]), max(one[1] - other[3], other[1] - one[3])
    return across >= RIM or down >= 0.0


def _covered(box: Box, way: Values) -> int:
    """Return how many points of a way lie below a time."""
    x, y = way
    across = (x > box[0] - STROKE) & (x < box[2] + STROKE)
    return int((across & (y > box[1] - STROKE) & (y < box[3] + STROKE)).sum())

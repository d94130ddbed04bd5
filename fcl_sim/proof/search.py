"""The largest value of something over a region, by branch and bound.

Every box has an upper bound; a box whose bound is no larger than what was
reached somewhere is done with. The others are halved along the side that is
longest for what the region is.
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from fcl_sim.proof.degrees import Boxes

Values = NDArray[np.float64]

STEPS = 60
"""Times that boxes are halved."""
MOST_SIDES = 6
AT_ONCE = 2048
"""Boxes that are halved at a time, those with the largest bounds first."""


@dataclass(frozen=True, slots=True)
class Search:
    """The largest value found, `reached` at `at`; nothing is above `bound`."""

    reached: float
    bound: float
    at: Values

    @property
    def gap(self) -> float:
        """By how much the bound is above what was reached."""
        return self.bound - self.reached


def largest(
    boxes: Boxes,
    bound: Callable[[Boxes], Values],
    value: Callable[[Values], Values],
    tolerance: float,
    steps: int = STEPS,
    at_once: int = AT_ONCE,
) -> Search:
    """Return the largest `value` at points (n, inputs) over boxes, to a tolerance if the steps suffice.

    `bound` gives for boxes (n,) what no value within is above.
    """
    sizes = np.maximum(boxes.high.max(axis=0) - boxes.low.min(axis=0), 1e-300)
    bounds = bound(boxes)
    reached, at = _reached(_corners(boxes), value, -np.inf, boxes.middle[0])
    fresh = boxes
    for _ in range(steps):
        reached, at = _reached(fresh, value, reached, at)
        open_ = bounds > reached + tolerance
        boxes, bounds = Boxes(boxes.low[open_], boxes.high[open_]), bounds[open_]
        if not len(boxes):
            break
        order = np.argsort(-bounds, kind="stable")
        chosen, rest = order[:at_once], order[at_once:]
        fresh = halved(Boxes(boxes.low[chosen], boxes.high[chosen]), sizes)
        parents = np.concatenate([bounds[chosen], bounds[chosen]])
        fresh_bounds = np.minimum(bound(fresh), parents)
        boxes = Boxes(np.vstack([boxes.low[rest], fresh.low]), np.vstack([boxes.high[rest], fresh.high]))
        bounds = np.concatenate([bounds[rest], fresh_bounds])
    left = float(bounds.max()) if len(boxes) else reached + tolerance
    return Search(float(reached), max(float(reached), left), at)


def _reached(
    boxes: Boxes, value: Callable[[Values], Values], reached: float, at: Values
) -> tuple[float, Values]:
    """Return the largest value at middles and corners of boxes, if it is above what was reached."""
    if not len(boxes):
        return reached, at
    points = np.vstack([boxes.middle, boxes.low, boxes.high])
    values = value(points)
    values = np.where(np.isnan(values), -np.inf, values)
    best = int(np.argmax(values))
    return (float(values[best]), points[best]) if values[best] > reached else (reached, at)


def _corners(boxes: Boxes) -> Boxes:
    """Return the corners of boxes as boxes; of those with many sides, the two outermost alone."""
    inputs = boxes.low.shape[1]
    if inputs > MOST_SIDES:
        return boxes
    sides = [np.array(each, np.bool_) for each in product((False, True), repeat=inputs)]
    corners = np.unique(np.vstack([np.where(each, boxes.high, boxes.low) for each in sides]), axis=0)
    return Boxes(corners, corners)


def halved(boxes: Boxes, sizes: Values) -> Boxes:
    """Return both halves of each box along its longest side."""
    widths = (boxes.high - boxes.low) / sizes
    side = np.argmax(widths, axis=1)
    rows = np.arange(len(boxes))
    middle = 0.5 * boxes.low[rows, side] + 0.5 * boxes.high[rows, side]
    low, high = boxes.low.copy(), boxes.high.copy()
    high[rows, side] = middle
    low[rows, side] = middle
    return Boxes(np.vstack([boxes.low, low]), np.vstack([high, boxes.high]))

"""Slopes of a law on both sides of a point, from its values nearby.

A fuzzy law is smooth in pieces, and an operating point often lies just where
two of them meet: at the peak of a term, or where MIN changes from one degree
to the other. So each side is differentiated by itself. The pieces' ends are not
known beforehand: the slope is taken from values at distances that halve, by a
cubic through four of them, and the distance is chosen at which it settles best.
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import combinations, product

import numpy as np
from numpy.typing import NDArray

Values = NDArray[np.float64]
Law = Callable[[Values], Values]
"""Inputs (n, points) → outputs (m, points)."""

LARGEST, SMALLEST = 8, 34
"""Distances are the span of an input times 2**-8 down to 2**-34."""
SETTLED = 1e-4
"""How well a slope must settle, as a part of it; one that does not is that of a jump."""
ALIKE = 1e-6
"""Slopes that differ less, as a part of the law's magnitude over the span, are one."""
NEARBY = 2.0**-20
"""Distance, as a part of the span, at which changes of several inputs at once are compared."""
COUPLED = 1e3
"""They differ where it is by more than so many times the error of slopes: a curved law bends a little."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Slopes:
    """∂output/∂input on either side, (m, n); NaN where the law jumps or has no finite slope.

    `alike` tells, (m, n), where a difference of two slopes is no more than
    error; `couples` whether small changes of several inputs at once change an
    output otherwise than each by itself, together.
    """

    below: Values
    above: Values
    alike: Values
    couples: bool


def slopes(law: Law, point: Values, spans: Values) -> Slopes:
    """Return the slopes of `law` at `point`, (n,), whose inputs vary over `spans`, (n,)."""
    units = 2.0 ** np.floor(np.log2(spans))
    exponents = np.array([0, *range(LARGEST, SMALLEST + 1)])
    sides = [_side(law, point, sign * units, exponents) for sign in (-1.0, 1.0)]
    (below, reach_below), (above, reach_above) = sides
    alike = ALIKE * np.maximum(reach_below, reach_above)[:, None] / units
    return Slopes(
        below=below, above=above, alike=alike, couples=_couples(law, point, units, (below, above), alike)
    )


def _side(law: Law, point: Values, units: Values, exponents: Values) -> tuple[Values, Values]:
    """Return the slopes to one side, and the largest magnitude that each output had there."""
    n, count = point.size, exponents.size
    points = np.repeat(point[:, None], n * count + 1, axis=1)
    for i in range(n):
        points[i, 1 + i * count : 1 + (i + 1) * count] += units[i] * 2.0**-exponents
    values = law(points)
    slope = np.empty((values.shape[0], n))
    reach = np.nanmax(np.abs(values), axis=1)
    for i in range(n):
        own = slice(1 + i * count + 1, 1 + (i + 1) * count)
        steps = points[i, own] - point[i]
        slope[:, i] = _settled(steps, values[:, own] - values[:, :1], reach, abs(units[i]))
    return slope, reach


def _settled(steps: Values, rises: Values, reach: Values, span: float) -> Values:
    """Return the slope at 0 of each row of `rises` over `steps` where it settles best.

    A slope's error is how far apart three are, and what the rounding of values
    makes of it: values so near that they are hardly a last bit apart can agree by chance.
    """
    t1, t2, t3 = steps[:-2], steps[1:-1], steps[2:]
    f1, f2, f3 = rises[:, :-2], rises[:, 1:-1], rises[:, 2:]
    first = f1 / t1
    second = ((f2 - f1) / (t2 - t1) - first) / t2
    beyond = ((f3 - f2) / (t3 - t2) - (f2 - f1) / (t2 - t1)) / (t3 - t1)
    third = (beyond - second) / t3
    found = first - t1 * second + t1 * t2 * third
    three = np.stack([found[:, :-2], found[:, 1:-1], found[:, 2:]])
    rounded = np.finfo(float).eps * reach[:, None] / np.abs(steps[4:])
    error = np.nan_to_num(np.ptp(three, axis=0), nan=np.inf) + rounded
    rows, best = np.arange(len(rises)), np.argmin(error, axis=1)
    slope = three[1, rows, best]
    unsettled = error[rows, best] > SETTLED * np.abs(slope) + ALIKE * reach / span
    return np.where(unsettled, np.nan, slope)


def _couples(law: Law, point: Values, units: Values, sides: tuple[Values, Values], alike: Values) -> bool:
    """Return whether changing two inputs at once differs from the sum of changing each by itself."""
    n = point.size
    moves = []
    for pair in combinations(range(n), 2):
        for signs in product((-1.0, 1.0), repeat=2):
            moves.append(np.zeros(n))
            moves[-1][[*pair]] = signs
    if not moves:
        return False
    steps = NEARBY * units * np.array(moves)
    values = law(np.column_stack([point, *(point + step for step in steps)]))
    below, above = sides
    steeper = np.abs(below) + np.abs(above)
    for step, value in zip(steps, values.T[1:], strict=True):
        expected = np.where(step > 0, above, below) @ step
        room = (COUPLED * alike + SETTLED * steeper) @ np.abs(step)
        if np.any(np.abs(value - values[:, 0] - expected) > room):
            return True
    return False

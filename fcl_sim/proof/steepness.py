"""Bounds of the slope of a smooth term from one place to another.

A slope is largest and least at the ends of a stretch, or where the curve bends neither
way: its inflections.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import NDArray

from fcl_sim.model import Curve, CurveKind

Values = NDArray[np.float64]
Slope = Callable[[Values], Values]


@dataclass(frozen=True, slots=True)
class Steepness:
    """The slope of a curve of height 1, and the places between which it only rises or falls."""

    slope: Slope
    inflections: tuple[float, ...]


def slopes_of(curve: Curve, low: Values, high: Values) -> tuple[Values, Values]:
    """Return the least and largest slope from `low` to `high` (n,); infinite where it is not followed."""
    kind = KINDS.get(curve.kind)
    found = kind(*(float(each) for each in curve.parameters)) if kind else None
    if found is None:
        return np.full_like(low, -np.inf), np.full_like(high, np.inf)
    ends = [found.slope(low), found.slope(high)]
    least, most = np.minimum(*ends), np.maximum(*ends)
    for place in found.inflections:
        inside = (low <= place) & (place <= high)
        own = found.slope(np.array([place]))[0]
        least = np.where(inside, np.minimum(least, own), least)
        most = np.where(inside, np.maximum(most, own), most)
    return curve.height * least, curve.height * most


def _gaussian(mean: float, deviation: float) -> Steepness | None:
    def slope(x: Values) -> Values:
        part = (x - mean) / deviation
        return np.asarray(-part / deviation * np.exp(-0.5 * part * part))

    return Steepness(slope, (mean - deviation, mean + deviation)) if deviation else None


def _sigmoid(gain: float, inflection: float) -> Steepness:
    def slope(x: Values) -> Values:
        part = np.exp(-np.abs(gain * (x - inflection)))
        return np.asarray(gain * part / (1.0 + part) ** 2)

    return Steepness(slope, (inflection,))


def _bell(half: float, slope_of_it: float, centre: float) -> Steepness | None:
    power = 2.0 * slope_of_it
    if power <= 1.0 or half <= 0.0:  # it has a cusp, or is no bell
        return None

    def slope(x: Values) -> Values:
        part = (x - centre) / half
        with np.errstate(over="ignore", invalid="ignore"):
            raised = np.abs(part) ** (power - 1.0)
            own = -np.sign(part) * power * raised / (half * (1.0 + raised * np.abs(part)) ** 2)
        return np.nan_to_num(own)

    turn = half * ((power - 1.0) / (power + 1.0)) ** (1.0 / power)
    return Steepness(slope, (centre - turn, centre + turn))


def _cosine(half: float, centre: float) -> Steepness | None:
    def slope(x: Values) -> Values:
        part = np.clip((x - centre) / half, -1.0, 1.0)
        return np.asarray(-pi / (2.0 * half) * np.sin(pi * part))

    return Steepness(slope, (centre - 0.5 * half, centre + 0.5 * half)) if half > 0.0 else None


def _z_shape(start: float, end: float) -> Steepness | None:
    def slope(x: Values) -> Values:
        part = np.clip((x - start) / (end - start), 0.0, 1.0)
        return np.asarray(-4.0 / (end - start) * np.minimum(part, 1.0 - part))

    return Steepness(slope, (0.5 * start + 0.5 * end,)) if start < end else None


def _s_shape(start: float, end: float) -> Steepness | None:
    falling = _z_shape(start, end)
    if falling is None:
        return None
    return Steepness(lambda x: -falling.slope(x), falling.inflections)


def _pi_shape(first: float, second: float, third: float, last: float) -> Steepness | None:
    rising, falling = _s_shape(first, second), _z_shape(third, last)
    if rising is None or falling is None or second > third:  # where both change they are multiplied
        return None
    return Steepness(
        lambda x: np.asarray(rising.slope(x) + falling.slope(x)), (*rising.inflections, *falling.inflections)
    )


KINDS: dict[CurveKind, Callable[..., Steepness | None]] = {
    CurveKind.GAUSSIAN: _gaussian,
    CurveKind.SIGMOID: _sigmoid,
    CurveKind.BELL: _bell,
    CurveKind.COSINE: _cosine,
    CurveKind.Z_SHAPE: _z_shape,
    CurveKind.S_SHAPE: _s_shape,
    CurveKind.PI_SHAPE: _pi_shape,
}
"""Curves whose slopes are followed."""

"""A sampled signal → a line through as few of its samples as a tolerance allows."""

import math

import numpy as np
from numpy.typing import NDArray

from fcl_sim.loop.trace import Values

ROUNDING = 0.1
"""The part of the tolerance that the rounding of the kept samples may take."""


def thin(ticks: NDArray[np.int64], values: Values, tolerance: float) -> tuple[NDArray[np.int64], Values]:
    """Return the samples (m,) that are kept of a signal (n,), with values rounded to what matters.

    The line through them is within `tolerance` of every sample; the first and
    the last are kept. From each kept sample on, the swinging door (Bristol
    1990, with lines that end in samples) goes on to the last that can be reached
    within the tolerance of all between. `ticks` rise; `values` are finite.
    """
    slack = tolerance * (1.0 - ROUNDING)
    kept = [0] if len(ticks) else []
    while kept and kept[-1] < len(ticks) - 1:
        kept.append(_reach(ticks, values, kept[-1], slack))
    chosen = np.array(kept, dtype=np.int64)
    return ticks[chosen], rounded(values[chosen], tolerance * ROUNDING)


def _reach(ticks: NDArray[np.int64], values: Values, start: int, slack: float) -> int:
    """Return the last sample in a row whose line from `start` passes all between it within `slack`."""
    begun, level = int(ticks[start]), float(values[start])
    low, high = -math.inf, math.inf
    reached = start + 1
    for index in range(start + 1, len(ticks)):
        run, rise = int(ticks[index]) - begun, float(values[index]) - level
        slope = rise / run
        if low <= slope <= high:
            reached = index
        low, high = max(low, (rise - slack) / run), min(high, (rise + slack) / run)
        if low > high:
            break
    return reached


def rounded(values: Values, error: float) -> Values:
    """Return values with as few decimals as keep each within `error`; as they are where that is 0."""
    if not error > 0.0:
        return values
    decimals = math.ceil(-math.log10(2.0 * error))
    if not abs(decimals) < 300:
        return values
    near = np.array([round(float(each), decimals) for each in values]) + 0.0  # no -0
    return np.where(np.abs(near - values) <= error, near, values)


def line_at(ticks: NDArray[np.int64], values: Values, at: NDArray[np.int64]) -> Values:
    """Return the line through samples at times `at` (k,); constant before the first and behind the last."""
    return np.interp(at.astype(np.float64), ticks.astype(np.float64), values)

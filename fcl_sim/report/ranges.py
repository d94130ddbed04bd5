"""From where to where an axis goes that shows some numbers: whatever they are, a range that can be drawn."""

from collections.abc import Iterable

import numpy as np

from fcl_sim.loop.trace import Values

LARGEST = 1e300
"""What lies further out is drawn at the edge: beyond it differences overflow."""

SMALLEST = 1e-290
"""Numbers that span less are one and the same: below it quotients lose their digits."""

ROUNDING = 1e-12
"""So are those that differ by less than this part of themselves: what another order of sums makes."""

NOISE = 1e-6
"""A signal that moves by less than this part of its value is at rest: binary32 has no finer steps."""


def finite(values: Iterable[Values]) -> Values:
    """Return all finite numbers of arrays in one (n,), within what can be drawn."""
    parts = [each[np.isfinite(each)] for each in values]
    return np.clip(np.concatenate(parts) if parts else np.zeros(0), -LARGEST, LARGEST)


def moves(low: float, high: float, noise: float = ROUNDING) -> bool:
    """Return whether two numbers differ by more than noise, a part of the larger one."""
    return high - low > max(noise * max(abs(low), abs(high)), SMALLEST)


def widened(low: float, high: float, part: float, noise: float = ROUNDING) -> tuple[float, float]:
    """Return a range with a `part` of it as room at either end; about one number a tenth of it, or 1."""
    low, high = max(low, -LARGEST), min(high, LARGEST)
    if moves(low, high, noise):
        margin = part * (high - low)
    else:
        margin = max(0.1 * max(abs(low), abs(high)), SMALLEST) if low or high else 1.0
    return low - margin, high + margin


def width(values: Values) -> float:
    """Return from the least to the largest of finite numbers (n,): 0 of none, inf where it overflows."""
    with np.errstate(over="ignore"):  # a run that grew without bounds
        return float(np.ptp(values)) if values.size else 0.0


def drawable(values: Values) -> Values:
    """Return values (n,), those that are too large at the edge of what can be drawn, NaN where infinite."""
    return np.where(np.isfinite(values), np.clip(values, -LARGEST, LARGEST), np.nan)

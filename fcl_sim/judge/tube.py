"""The tube around a reference: what a signal may be at each scan, early, late and beside it."""

import numpy as np
from numpy.typing import NDArray

from fcl_sim.judge.baseline import SignalReference
from fcl_sim.judge.thin import line_at
from fcl_sim.loop.trace import Values


def tube(reference: SignalReference, ticks: NDArray[np.int64]) -> tuple[Values, Values]:
    """Return the least and the largest value (n,) that a reference allows at times `ticks` (n,).

    At a time t it allows what lies between the extremes of its line from
    t - lagging to t + leading, and beyond them what `thinned`, `absolute` and
    `relative` of the extreme add up to. Both are exact: the extremes of a line
    through samples are at its ends or at the samples within.
    """
    early, late = ticks - reference.lagging, ticks + reference.leading
    ends = [line_at(reference.ticks, reference.values, each) for each in (early, late)]
    first = np.searchsorted(reference.ticks, early, side="left")
    last = np.searchsorted(reference.ticks, late, side="right")
    low = np.minimum(np.minimum(*ends), _extremes(reference.values, first, last, np.minimum, np.inf))
    high = np.maximum(np.maximum(*ends), _extremes(reference.values, first, last, np.maximum, -np.inf))
    beside = reference.thinned + reference.absolute
    return (
        low - beside - reference.relative * np.abs(low),
        high + beside + reference.relative * np.abs(high),
    )


def _extremes(
    values: Values, first: NDArray[np.int64], last: NDArray[np.int64], of: np.ufunc, nothing: float
) -> Values:
    """Return the extreme of values[first:last] for each pair, `nothing` where there are none."""
    padded = np.append(values, nothing)
    pairs = np.stack([first, last], axis=1).ravel()
    found: Values = of.reduceat(padded, pairs)[::2]
    return np.where(first < last, found, nothing)

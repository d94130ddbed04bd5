"""What requirements on one signal allow together: at any time what all of them do."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from fcl_sim.judge.verdict import Band


def allowed(bands: Sequence[Band]) -> list[Band]:
    """Return what lies within all bands of a run, stretch by stretch; bands of one instant come last.

    Where they exclude one another there is nothing.
    """
    instants = [each for each in bands if each.start == each.end]
    lasting = [each for each in bands if each.start < each.end]
    found: list[Band] = []
    for start, end in pairwise(sorted({time for each in lasting for time in (each.start, each.end)})):
        both = _both([each for each in lasting if each.start <= start and end <= each.end], start, end)
        if both is None:
            continue
        if found and found[-1] == replace(both, start=found[-1].start, end=start):
            found[-1] = replace(both, start=found[-1].start)
        else:
            found.append(both)
    for at in dict.fromkeys(each.start for each in instants):
        both = _both([each for each in bands if each.start <= at <= each.end], at, at)
        if both is not None:
            found.append(both)
    return found


def _both(bands: Sequence[Band], start: float, end: float) -> Band | None:
    lows = [each.low for each in bands if each.low is not None]
    highs = [each.high for each in bands if each.high is not None]
    low, high = max(lows, default=None), min(highs, default=None)
    if not bands or (low is not None and high is not None and low > high):
        return None
    return Band(signal=bands[0].signal, low=low, high=high, start=start, end=end)


def of_runs(runs: Sequence[Sequence[Band]]) -> list[Band]:
    """Return what is allowed in any of several runs, each stretch once."""
    return list(dict.fromkeys(each for bands in runs for each in allowed(bands)))

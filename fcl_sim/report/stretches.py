"""Runs of true flags."""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray


def stretches(flags: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Return of each run of true flags (n,) the first index and the index after its last."""
    padded = np.concatenate(([False], flags, [False]))
    edges = np.flatnonzero(padded[1:] != padded[:-1]).tolist()
    return list(pairwise(edges))[::2]

"""The arithmetics of floats: LREAL is binary64, REAL binary32 (S36)."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from fcl_sim.engine.program import LARGEST


@dataclass(frozen=True, slots=True)
class Precision:
    """An arithmetic by the name of its data type.

    `limit` bounds the magnitudes in a rule base, so that sums and products of
    degrees with them stay finite; degrees whose ratio lies between `tie` and 1
    are equal. `whole` is from where on not every whole number can be told.
    """

    name: str
    dtype: Any
    limit: float
    tie: float
    whole: int

    @property
    def largest(self) -> float:
        """The largest number."""
        return float(np.finfo(self.dtype).max)


LREAL = Precision("LREAL", np.float64, LARGEST, 1.0 - 2.0**-44, 2**53)
REAL = Precision("REAL", np.float32, 1e30, 1.0 - 2.0**-17, 2**24)
PRECISIONS = {each.name: each for each in (LREAL, REAL)}

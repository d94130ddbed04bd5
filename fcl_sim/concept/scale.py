"""Scaling of a channel: what a count of it means (S36)."""

from dataclasses import dataclass
from fractions import Fraction
from math import floor

import numpy as np
from numpy.typing import NDArray

MOST_SURE = 2.0**31
"""Quotients up to which the distance from the middle between two counts is exact in binary64."""
DOUBT = 4 * 2.0**-53
"""Relative error of a quotient, at most: of one subtraction and one division, and as much again."""


@dataclass(frozen=True, slots=True)
class Scale:
    """A channel's scaling: value = counts times `factor` plus `offset`."""

    factor: float = 1
    offset: float = 0

    def counts(self, value: float) -> int:
        """Return the nearest count, of two that are as near the even one."""
        if isinstance(value, float):
            quotient = float((float(value) - self.offset) / self.factor)
            if abs(quotient) < MOST_SURE and abs(quotient - floor(quotient) - 0.5) > DOUBT * abs(quotient):
                return round(quotient)
        return round((Fraction(value) - Fraction(self.offset)) / Fraction(self.factor))

    def sure_counts(self, values: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
        """Return the nearest counts (n,), and where they are: elsewhere rounding may have decided."""
        with np.errstate(over="ignore", invalid="ignore"):
            quotients = (values - self.offset) / self.factor
            away = np.abs(quotients - np.floor(quotients) - 0.5)
            sure = (np.abs(quotients) < MOST_SURE) & (away > DOUBT * np.abs(quotients))
        return np.rint(quotients), sure

    def value(self, counts: int) -> float:
        """Return what counts mean."""
        return counts * self.factor + self.offset

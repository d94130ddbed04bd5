"""Integration schemes as tables; a new scheme is a new table, no new loop."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, kw_only=True)
class Scheme:
    """An explicit Runge-Kutta scheme.

    `nodes` c (s + 1 numbers, the last is 1) and `rows` a: row i gives the
    point at which derivative i is taken; the last row is the solution itself,
    of order `order`. `error` (s + 1 numbers) weighs the derivatives, the one at
    the solution included, to an estimate of the local error whose own order is
    `order` - 1; empty for a scheme without step control.
    """

    name: str
    source: str
    order: int
    nodes: tuple[float, ...]
    rows: tuple[tuple[float, ...], ...]
    error: tuple[float, ...] = ()

    @property
    def stages(self) -> int:
        """Number of rows: the points computed in a step, the solution included."""
        return len(self.rows)

    def table(self) -> NDArray[np.float64]:
        """Return the scheme as the integrator reads it: nodes, rows one after the other, error."""
        error = self.error or (0.0,) * len(self.nodes)
        return np.array([*self.nodes, *(each for row in self.rows for each in row), *error])


DORMAND_PRINCE = Scheme(
    name="dormand_prince",
    source="Dormand & Prince 1980, RK5(4)7M",
    order=5,
    nodes=(0.0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0, 1.0),
    rows=(
        (1 / 5,),
        (3 / 40, 9 / 40),
        (44 / 45, -56 / 15, 32 / 9),
        (19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729),
        (9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656),
        (35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84),
    ),
    error=(71 / 57600, 0.0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40),
)

RK4 = Scheme(
    name="rk4",
    source="Kutta 1901, the classical scheme",
    order=4,
    nodes=(0.0, 1 / 2, 1 / 2, 1.0, 1.0),
    rows=((1 / 2,), (0.0, 1 / 2), (0.0, 0.0, 1.0), (1 / 6, 1 / 3, 1 / 3, 1 / 6)),
)

SCHEMES: Mapping[str, Scheme] = MappingProxyType({each.name: each for each in (DORMAND_PRINCE, RK4)})
"""Schemes by the name that a scenario writes."""

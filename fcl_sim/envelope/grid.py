"""Axes → points: their order, their values, their names."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import prod
from typing import Any

import numpy as np

from fcl_sim.scenario.model import Axis
from fcl_sim.scenario.vary import labels
from fcl_sim.toml.tree import Entry


@dataclass(frozen=True, slots=True)
class Grid:
    """Every combination of the values of its axes; the first axis varies slowest, as in nested loops."""

    axes: tuple[Axis, ...]

    def __len__(self) -> int:
        return prod(self.shape)

    @property
    def shape(self) -> tuple[int, ...]:
        """How many values each axis has."""
        return tuple(len(each.values) for each in self.axes)

    @property
    def labels(self) -> tuple[str, ...]:
        """What each axis is called: the end of its key, as long as tells it from the others."""
        return labels(self.axes)

    def steps(self, index: int) -> tuple[int, ...]:
        """Return which value each axis has at the point number `index`; IndexError where there is none."""
        if not 0 <= index < len(self):
            raise IndexError(f"there are {len(self)} points, and none has the number {index}")
        return tuple(int(each) for each in np.unravel_index(index, self.shape))

    def entries(self, index: int) -> dict[str, Entry]:
        """Return what a point sets, by dotted key."""
        return {axis.key: axis.values[step] for axis, step in zip(self.axes, self.steps(index), strict=True)}

    def values(self, index: int) -> dict[str, Any]:
        """Return what a point sets as it is written, by dotted key: the overrides of a run of it alone."""
        return {key: entry.plain() for key, entry in self.entries(index).items()}

    def told(self, index: int) -> str:
        """Return where a point lies, `load_mass = 40 t, cable_length = 15 m`.

        An axis of one value is left out, unless all are of one.
        """
        several = any(length > 1 for length in self.shape)
        told = zip(self.labels, self.axes, self.values(index).values(), strict=True)
        return ", ".join(
            f"{label} = {written(value)}"
            for label, axis, value in told
            if not several or len(axis.values) > 1
        )


def written(value: Any) -> str:
    """Return a value of an axis for a reader."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{key} = {written(each)}" for key, each in value.items()) + "}"
    if isinstance(value, Sequence) and not isinstance(value, str):
        return f"[{', '.join(written(each) for each in value)}]"
    return str(value)

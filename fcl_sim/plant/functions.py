"""The functions of a plant, their one compiled signature each, and what stands in for the missing ones."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fcl_sim.jit import Entry, F, f8, i8, signature, void
from fcl_sim.plant.places import PlantFile
from fcl_sim.plant.uncompiled import uncompiled

Array = NDArray[np.float64]

PlantFunction = Callable[..., Any]
"""A plant function, as a kernel takes it."""

_DERIVATIVE = (void, f8, F, F, F, i8, F)
_TRANSITION = (i8, i8, f8, F, F, F, i8)
_SAMPLE = (void, f8, F, F, F)

PARTS: dict[str, tuple[Any, ...]] = {
    "dynamics": _DERIVATIVE,
    "outputs": _DERIVATIVE,
    "events": _DERIVATIVE,
    "transition": _TRANSITION,
    "sample": _SAMPLE,
}
"""Result and arguments of each plant function, in the order in which a run takes them."""

ARGUMENTS: dict[str, tuple[str, ...]] = {
    "dynamics": ("t", "x", "u", "p", "mode", "dx"),
    "outputs": ("t", "x", "u", "p", "mode", "y"),
    "events": ("t", "x", "u", "p", "mode", "g"),
    "transition": ("i", "t", "x", "u", "p", "mode"),
    "sample": ("t", "x", "u", "p"),
}
"""Names of the arguments, as a plant file writes them."""

REQUIRED = ("dynamics", "outputs")


def events(t: float, x: Array, u: Array, p: Array, mode: int, g: Array) -> None:
    """No events."""


def transition(i: int, t: float, x: Array, u: Array, p: Array, mode: int) -> int:  # noqa: ARG001  the contract
    """Stay in the mode; a run begins in mode 0."""
    return max(mode, 0)


def sample(t: float, x: Array, u: Array, p: Array) -> None:
    """Nothing happens at a scan."""


DEFAULTS: dict[str, Callable[..., Any]] = {"events": events, "transition": transition, "sample": sample}


@dataclass(frozen=True, slots=True, kw_only=True)
class PlantFunctions:
    """The five functions of a plant as kernels; called by the loop, in this order."""

    dynamics: Entry
    outputs: Entry
    events: Entry
    transition: Entry
    sample: Entry
    path: Path

    def ready(self) -> tuple[PlantFunction, ...]:
        """Return the five compiled, as first-class functions for a kernel.

        InputFault for code that cannot be compiled.
        """
        return tuple(self.compiled(part) for part in PARTS)

    def compiled(self, part: str) -> PlantFunction:
        """Return one of the five compiled, as `ready` does."""
        entry: Entry = getattr(self, part)
        try:
            return entry.compile()
        except Exception as error:  # numba raises errors of many kinds, not all of them its own
            raise uncompiled(part, entry.function, error, PlantFile(self.path)) from error


def as_entry(part: str, function: Callable[..., Any], salt: str) -> Entry:
    """Return `function` as the plant function `part`, cached under `salt`."""
    return Entry(function, signature(*PARTS[part]), salt)

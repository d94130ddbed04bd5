"""A linearised block and the rest of its loop: the poles, and the margins at each manipulated value."""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import control
import numpy as np
from numpy.typing import NDArray

from fcl_sim.interop.margins import Margins, margins_of

GENERIC = re.compile(r"[uy]\[\d+\]")
"""What python-control calls signals that nobody named."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Loop:
    """A closed loop: `poles` in the z-plane, the largest first; `margins` by the block's outputs.

    Each output is cut open by itself, with the others closed.
    """

    dt: float
    poles: NDArray[np.complex128]
    margins: Mapping[str, Margins]

    @property
    def stable(self) -> bool:
        """Whether every pole lies inside the unit circle."""
        return bool(np.all(np.abs(self.poles) < 1.0))


def close(block: control.StateSpace, plant: control.lti.LTI) -> Loop:
    """Return the loop of a linearised block and `plant`, the rest of it.

    Raises ValueError for a plant that does not fit, and for an algebraic loop
    that has no solution.
    """
    path = block * _fitted(_sampled(plant, block.dt), block)
    every = range(path.ninputs)
    poles = _fed_back(path, every).poles()
    margins = {
        name: margins_of(-_fed_back(path, [other for other in every if other != i])[i, i])
        for i, name in enumerate(block.output_labels)
    }
    return Loop(dt=block.dt, poles=poles[np.lexsort((-poles.imag, -np.abs(poles)))], margins=margins)


def _fed_back(path: control.StateSpace, signals: Iterable[int]) -> control.StateSpace:
    """Return `path` with those of its outputs led back to the inputs of the same number."""
    chosen = np.zeros((path.noutputs, path.noutputs))
    for i in signals:
        chosen[i, i] = 1.0
    return control.feedback(path, control.ss([], [], [], chosen, path.dt), sign=1)


def _sampled(plant: control.lti.LTI, dt: float) -> control.StateSpace:
    """Return a plant in discrete time, sampled exactly under a zero-order hold."""
    if plant.isdtime(strict=True):
        if plant.dt is not True and plant.dt != dt:
            raise ValueError(f"the plant is sampled every {plant.dt} s, the block every {dt} s")
        return control.ss(plant)
    return control.sample_system(control.ss(plant), dt, method="zoh")


def _fitted(plant: control.StateSpace, block: control.StateSpace) -> control.StateSpace:
    """Return a plant with its signals in the order of those of the block."""
    return plant[
        _order(plant.output_labels, block.input_labels, "lead to the inputs"),
        _order(plant.input_labels, block.output_labels, "start from the outputs"),
    ]


def _order(labels: Sequence[str], wanted: Sequence[str], how: str) -> list[int]:
    """Return the places of the wanted signals: by name, or as they stand where they are not named."""
    if sorted(labels) == sorted(wanted):
        return [labels.index(name) for name in wanted]
    unnamed = len(wanted) == 1 or all(map(GENERIC.fullmatch, labels))
    if len(labels) == len(wanted) and unnamed:
        return [*range(len(wanted))]
    raise ValueError(f"the plant must {how} of the block, {', '.join(wanted)}; it has {', '.join(labels)}")

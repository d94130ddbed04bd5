"""What of a run's memory is recorded at each scan, in which columns, and what a trace says of them."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate, groupby

import numpy as np
from numpy.typing import NDArray

from fcl_sim.loop.diagram import FuzzyNode, Wire
from fcl_sim.loop.wiring import Wiring
from fcl_sim.units import parse_unit

Stretch = tuple[int, int]
"""First slot and length."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Recorded:
    """The columns of a record: all that has a name, what each fuzzy block has, signals without a name.

    `segments` are the stretches of memory that make them, `width` is their
    number. `names`, in the order of their columns, have `units`, and `signs`
    (names,) where one is not 1; `blocks` are the columns at which what a fuzzy
    block has begins, `block_units` the units of its variables.
    """

    segments: tuple[Stretch, ...]
    width: int
    names: tuple[str, ...]
    units: Mapping[str, str]
    signs: NDArray[np.float64] | None
    blocks: Mapping[str, int]
    block_units: Mapping[str, Mapping[str, str]]

    def column(self, slot: int) -> int:
        """Return the column that holds memory slot `slot`; ValueError if none does."""
        column = 0
        for first, length in self.segments:
            if first <= slot < first + length:
                return column + slot - first
            column += length
        raise ValueError(f"slot {slot} is not recorded")


def recorded(
    wiring: Wiring, slots: Mapping[str, int], instances: Mapping[str, int], signals: int
) -> Recorded:
    """Return what is recorded of a memory whose first `signals` slots are signals."""
    wires = [wiring.sources.get(name, Wire(name)) for name in wiring.units]
    named = [slots[wire.source] for wire in wires]
    signs = np.array([wire.sign for wire in wires])
    nodes = {node.name: node for node in wiring.order if isinstance(node, FuzzyNode)}
    fuzzy = [(at, nodes[name].block.program.recorded) for name, at in instances.items()]
    columns = accumulate((length for _, length in fuzzy), initial=len(named))
    nameless = sorted({*range(signals)} - {*named})
    segments = (*_stretches(named), *fuzzy, *_stretches(nameless))
    return Recorded(
        segments=segments,
        width=sum(length for _, length in segments),
        names=tuple(wiring.units),
        units={name: unit.symbol for name, unit in wiring.units.items()},
        signs=signs if (signs != 1.0).any() else None,
        blocks=dict(zip(instances, columns, strict=False)),
        block_units={
            name: {variable: parse_unit(unit).symbol for variable, unit in nodes[name].units.items()}
            for name in instances
        },
    )


def _stretches(slots: Sequence[int]) -> Iterator[Stretch]:
    """Yield the stretches of slots that follow one another."""
    for _, run in groupby(enumerate(slots), key=lambda pair: pair[1] - pair[0]):
        own = [slot for _, slot in run]
        yield own[0], len(own)

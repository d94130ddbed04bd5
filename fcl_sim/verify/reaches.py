"""How far the signals of a loop go at most, by what its blocks bound: the universe of its rule bases.

What follows from a block's equation alone is told: constants and sources go between
their values, limiters, controllers and sensors with a range between their bounds,
sums and gains as far as what they take allows. A plant's output goes anywhere.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import inf
from typing import Any

import numpy as np

from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.loop.diagram import FuzzyNode, Node, Wire
from fcl_sim.loop.settings import signals_of
from fcl_sim.loop.wiring import Wiring
from fcl_sim.units import Quantity

Ends = tuple[float, float]
ANYWHERE: Ends = (-inf, inf)


@dataclass(frozen=True, slots=True)
class Seen:
    """A block, its parameters as in its setting, and the ends of what its ports carry."""

    node: Node
    values: Mapping[str, Any]
    given: Mapping[str, Ends]


Follow = Callable[[Seen], Ends]
"""The ends of what a block gives."""


@dataclass(frozen=True, slots=True)
class Reaches:
    """The ends of every signal of which one is known, by name."""

    ends: Mapping[str, Ends] = field(default_factory=dict)

    def of(self, wire: Wire) -> Ends:
        """Return the ends of what a wire carries."""
        low, high = self.ends.get(wire.source, ANYWHERE)
        return (low, high) if wire.sign > 0.0 else (-high, -low)


def reaches(wiring: Wiring) -> Reaches:
    """Return how far the signals of a loop go at most, each in its unit."""
    found: dict[str, Ends] = {}
    known = Reaches(found)
    for node in wiring.order:
        if isinstance(node, FuzzyNode):
            continue
        wires = {port: wiring.resolve(each) for port, each in node.inputs.items()}
        own = _ends(node, wiring.settings[node.name], {port: known.of(each) for port, each in wires.items()})
        if own != ANYWHERE:
            found |= dict.fromkeys(signals_of(node), own)
    return known


def _ends(node: Node, setting: Setting, given: Mapping[str, Ends]) -> Ends:
    follow = FOLLOWED.get(node.type)
    return follow(Seen(node, setting.values, given)) if follow else ANYWHERE


def _factor(node: Node, port: str) -> float:
    factor = node.parameters[port]
    return factor.value if isinstance(factor, Quantity) else float(factor)


def _between(*names: str) -> Follow:
    """Return how a source goes: from the least to the largest of its parameters."""

    def ends(seen: Seen) -> Ends:
        own = [float(seen.values[each]) for each in names]
        return min(own), max(own)

    return ends


def _swinging(seen: Seen) -> Ends:
    offset, swing = float(seen.values["offset"]), abs(float(seen.values["amplitude"]))
    return offset - swing, offset + swing


def _stepping(seen: Seen) -> Ends:
    steps = np.asarray(seen.values["steps"])[:, 1]
    return float(steps.min()), float(steps.max())


def _summed(seen: Seen) -> Ends:
    parts = [_scaled(ends, _factor(seen.node, port)) for port, ends in seen.given.items()]
    return sum(low for low, _ in parts), sum(high for _, high in parts)


def _held(seen: Seen) -> Ends:
    """Return the ends of min(max(u, low), high), in which `high` wins; only a limiter's u is known."""
    least, most = seen.given["input"] if seen.node.type == "limiter" else ANYWHERE
    low, high = (
        seen.given[each] if each in seen.given else (seen.values.get(each, end), seen.values.get(each, end))
        for each, end in zip(("low", "high"), ANYWHERE, strict=True)
    )
    return min(max(least, low[0]), high[0]), min(max(most, low[1]), high[1])


def _scaled(ends: Ends, factor: float) -> Ends:
    if factor == 0.0:
        return 0.0, 0.0
    low, high = (factor * each for each in ends)
    return (low, high) if factor > 0.0 else (high, low)


FOLLOWED: Mapping[str, Follow] = {
    "constant": _between("value"),
    "step": _between("before", "after"),
    "ramp": _between("before", "after"),
    "pulse": _between("low", "high"),
    "sine": _swinging,
    "chirp": _swinging,
    "staircase": _stepping,
    "sum": _summed,
    "gain": lambda seen: _scaled(seen.given["input"], float(seen.values["gain"])),
    "classifier": lambda _: (0.0, 1.0),
    "limiter": _held,
    "integrator": _held,
    "pid": _held,
    "pid_velocity": _held,
    "sensor": _held,
}
"""How blocks go, by type; the others go anywhere."""

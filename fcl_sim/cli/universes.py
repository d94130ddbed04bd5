"""The universe of rule bases as scenarios have it: declared ranges, and what their blocks bound."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import isfinite
from pathlib import Path

from fcl_sim.diagnostics import Diagnostic, InputFault
from fcl_sim.loop.diagram import Diagram, FuzzyNode
from fcl_sim.loop.wiring import wire
from fcl_sim.proof.universe import Stretch
from fcl_sim.scenario.binder import bind
from fcl_sim.scenario.model import Scenario
from fcl_sim.scenario.ranges import ranges_of
from fcl_sim.scenario.reader import read
from fcl_sim.units import exact
from fcl_sim.verify.reaches import reaches

Ends = tuple[float, float]
Key = tuple[Path, str]
"""The file of a rule base, and its function block in lower case."""


@dataclass(frozen=True, slots=True)
class Use:
    """How scenarios use a rule base: the ends of its inputs by name in lower case, None without; units."""

    ends: Mapping[str, Ends | None] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)

    @property
    def stretches(self) -> dict[str, Stretch]:
        """From where to where each input goes that has two ends."""
        return {
            name: (exact(ends[0]), exact(ends[1]))
            for name, ends in self.ends.items()
            if ends is not None and all(map(isfinite, ends)) and ends[0] < ends[1]
        }


def uses_of(paths: Sequence[Path]) -> Mapping[Key, Use]:
    """Return how scenarios use rule bases, an input as wide as in the variant where it goes widest.

    Raises InputFault with everything that keeps a scenario from being bound.
    """
    found: dict[Key, Use] = {}
    faults: list[Diagnostic] = []
    for path in paths:
        try:
            for key, use in _uses(read(path)):
                found[key] = _wider(found[key], use) if key in found else use
        except InputFault as fault:
            faults += fault.diagnostics
    if faults:
        raise InputFault(faults)
    return found


def _uses(scenario: Scenario) -> Iterator[tuple[Key, Use]]:
    for variant, setup in scenario.variants.items():
        diagram = bind(scenario, variant)
        for node, ends in _ends(diagram):
            declared = ranges_of(node, setup.blocks[node.name], [])
            own = {name.casefold(): declared.get(name, ends[name]) for name in node.block.inputs}
            units = {name.casefold(): unit for name, unit in node.units.items()}
            key = (setup.rule_bases[node.name].resolve(), node.block.name.casefold())
            yield key, Use(own, units)


def _ends(diagram: Diagram) -> Iterator[tuple[FuzzyNode, Mapping[str, Ends | None]]]:
    """Yield every fuzzy block, and how far what its inputs read goes; None where that has no ends."""
    wiring = wire(diagram)
    known = reaches(wiring)
    for node in diagram.nodes:
        if isinstance(node, FuzzyNode):
            wires = {name.casefold(): wiring.resolve(each) for name, each in node.inputs.items()}
            yield (
                node,
                {
                    name: known.of(wires[name.casefold()]) if name.casefold() in wires else None
                    for name in node.block.inputs
                },
            )


def _wider(one: Use, other: Use) -> Use:
    ends = {}
    for name, own in one.ends.items():
        theirs = other.ends.get(name)
        ends[name] = (
            None if own is None or theirs is None else (min(own[0], theirs[0]), max(own[1], theirs[1]))
        )
    return Use(ends, {**one.units, **other.units})

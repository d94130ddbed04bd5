"""Diagram → the circumstances of a run, a line for each fact, so that a change in one is a changed line."""

import hashlib
from collections.abc import Iterator, Mapping
from typing import Any

from fcl_sim.loop.diagram import Diagram, FuzzyNode, Node, PlantNode, Timing, Wire
from fcl_sim.units import Quantity, short

LONGEST = 120
"""Characters of a value; of a longer one its digest is told."""


def setting_of(diagram: Diagram) -> Iterator[str]:
    """Yield plant, timing, and every block with its wires and parameters; no rule base."""
    plant = diagram.plant
    yield f"plant {plant.model.declaration.name}{_wired(plant.inputs)}"
    yield from _values(plant)
    yield from _timing(diagram.timing)
    if not diagram.exact and diagram.integration.scheme != "dormand_prince":
        yield f"integration {diagram.integration.scheme}"
    for node in diagram.nodes:
        yield _block(node)


def _values(plant: PlantNode) -> Iterator[str]:
    declared = plant.model.declaration
    for word, values, known in (
        ("parameter", plant.parameters, declared.parameters),
        ("start", plant.start, declared.states),
    ):
        units = {each.name: each.unit for each in known}
        for name, value in values.items():
            yield f"{word} {name} {short(value)} {units.get(name, '')}".rstrip()


def _timing(timing: Timing) -> Iterator[str]:
    yield f"duration {_seconds(timing.duration)}"
    yield f"scan {_seconds(timing.scan)}"
    for word in ("latency", "jitter"):
        if getattr(timing, word):
            yield f"{word} {_seconds(getattr(timing, word))}"
    if timing.seed:
        yield f"seed {timing.seed}"
    if timing.measured:
        yield "cycle time measured"
    for restart in timing.restarts:
        yield f"restart {restart.kind} at {_seconds(restart.at)}"


def _block(node: Node | FuzzyNode) -> str:
    if isinstance(node, FuzzyNode):
        return f"block {node.name} fuzzy in {node.arithmetic}{_wired(node.inputs)}"
    given = "".join(f", {name} {_told(value)}" for name, value in node.parameters.items())
    return f"block {node.name} {node.type}{_wired(node.inputs)}{given}"


def _wired(inputs: Mapping[str, Wire]) -> str:
    wires = (f", {port} from {'-' if wire.sign < 0 else ''}{wire.source}" for port, wire in inputs.items())
    return "".join(wires)


def _told(value: Any) -> str:
    text = _plain(value)
    if len(text) <= LONGEST:
        return text
    return f"with the digest {hashlib.sha256(text.encode()).hexdigest()[:16]}"


def _plain(value: Any) -> str:
    if isinstance(value, tuple | list):
        return f"[{', '.join(map(_plain, value))}]"
    if isinstance(value, Mapping):
        return f"{{{', '.join(f'{key} {_plain(each)}' for key, each in value.items())}}}"
    if isinstance(value, Quantity):
        return str(value)
    return short(value) if isinstance(value, float) else str(value)


def _seconds(ticks: int) -> str:
    return f"{short(ticks / 1e9)} s"

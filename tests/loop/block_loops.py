"""Loops made of blocks alone, for laws that are known in closed form."""

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from fcl_sim.loop.blocks import BLOCKS
from fcl_sim.loop.diagram import Node, Wire
from fcl_sim.units import parse_quantity
from tests.loop.block_bench import Alone, diagram

CYCLE = 0.02
"""Cycle time of `block_bench.diagram`."""


def node(name: str, kind: str, inputs: dict[str, str] | None = None, /, **parameters: Any) -> Node:
    """Return a block; parameters that are quantities as text or number, wires by signal, minus and all."""
    quantities = {each.name for each in BLOCKS[kind].parameters if each.kind == "quantity"}
    group = BLOCKS[kind].group
    quantities |= set(inputs or {}) if group and group.form == "gains" else set()
    return Node(
        name=name,
        type=kind,
        inputs={
            port: Wire(source.removeprefix("-"), -1.0 if source.startswith("-") else 1.0)
            for port, source in (inputs or {}).items()
        },
        parameters={
            key: parse_quantity(each) if key in quantities else each for key, each in parameters.items()
        },
    )


def fopdt(lag: float, gain: float, delay: float, source: str, unit: str = "") -> tuple[Node, Node, Node]:
    """Return first order plus dead time behind a hold: `process` follows `source`; times in seconds."""
    return (
        node("on_its_way", "dead_time", {"input": source}, time=f"{delay!r} s"),
        node("gained", "gain", {"input": "on_its_way"}, gain=gain),
        node(
            "process",
            "first_order_lag",
            {"input": "gained"},
            time_constant=f"{lag!r} s",
            initial=f"0 {unit}",
        ),
    )


def outputs_of(folder: Path, block: Node, rows: Iterable[Sequence[float]]) -> list[float]:
    """Return what a block with one output gives alone, fed raw inputs in the order of its wires."""
    alone = Alone(diagram(folder, block))
    return [float(alone.step(row, CYCLE, CYCLE * n, n)[0]) for n, row in enumerate(rows)]

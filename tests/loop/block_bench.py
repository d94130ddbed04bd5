"""What every block is held to: an independent reference, alone and through the tape.

A file of tests/loop/references has CASES for one family of blocks: cases, each
a block as a scenario would have it, and its law once more in plain Python.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from fcl_sim.loop import layout
from fcl_sim.loop.blocks import BLOCKS, OPCODES
from fcl_sim.loop.diagram import Diagram, Node, PlantNode, Wire
from fcl_sim.loop.execute import keep_late
from fcl_sim.loop.node_layout import lay_out
from fcl_sim.loop.row import Row
from fcl_sim.loop.wiring import wire
from fcl_sim.plant.catalog import PlantModel
from fcl_sim.units import parse_quantity
from tests.loop.diagrams import plant_of, timing

SIGNALS = """
PLANT = Plant(
    name="signals",
    title="Signals to try blocks with",
    states=(State("nothing", "1", 0.0, "stays"),),
    inputs=(),
    outputs=(
        Output("wave", "m", "a sine about 0.3"),
        Output("stairs", "m", "-2, -1, 0, 1, 2 in turns"),
        Output("ramp", "m", "through 0 at 1 s"),
        Output("ratio", "1", "a sine of its own, never 0"),
        Output("flag", "1", "1 for a tenth of a second in each"),
        Output("other_flag", "1", "1 in the middle third of each second"),
        Output("moment", "s", "a sine of its own, never 0"),
    ),
    parameters=(),
)


def dynamics(t, x, u, p, mode, dx):
    dx[0] = 0.0


def outputs(t, x, u, p, mode, y):
    y[0] = 2.0 * sin(7.0 * t) + 0.3
    y[1] = floor(t * 3.0) % 5.0 - 2.0
    y[2] = t - 1.0
    y[3] = 1.5 + sin(3.0 * t + 1.0)
    y[4] = 1.0 if t % 1.0 >= 0.9 else 0.0
    y[5] = 1.0 if 0.33 <= t % 1.0 < 0.66 else 0.0
    y[6] = 0.4 + 0.3 * sin(2.0 * t)
"""

Samples = Mapping[str, Sequence[float]]


@dataclass(frozen=True, kw_only=True)
class Case:
    """A block, what it reads, and what it must give.

    `inputs` by port: outputs of the plant SIGNALS, behind a minus for the
    negative. `parameters` as text ("2 m"), or as a Node has them. `law` gets
    the samples that the block reads by port (signs included), the times of the scans in
    seconds and the scan time, and returns the samples of each output, or
    of the only one. `tolerance` is 0 unless the maths library is involved.
    """

    block: str
    law: Callable[[Samples, Sequence[float], float], Any]
    inputs: Mapping[str, str] = field(default_factory=dict)
    parameters: Mapping[str, Any] = field(default_factory=dict)
    tolerance: float = 0.0

    def node(self) -> Node:
        """Return the block as a node called `block`."""
        inputs = {
            port: Wire(f"signals.{name.removeprefix('-')}", -1.0 if name.startswith("-") else 1.0)
            for port, name in self.inputs.items()
        }
        kinds = {each.name: each.kind for each in BLOCKS[self.block].parameters}
        parameters = {
            name: parse_quantity(each)
            if isinstance(each, str | float) and kinds.get(name, "quantity") == "quantity"
            else each
            for name, each in self.parameters.items()
        }
        return Node(name="block", type=self.block, inputs=inputs, parameters=parameters)

    def read(self, trace: Mapping[str, Sequence[float]]) -> dict[str, list[float]]:
        """Return what the block reads of a trace, by port."""
        return {
            port: [
                (-1.0 if name.startswith("-") else 1.0) * each
                for each in trace[f"signals.{name.removeprefix('-')}"]
            ]
            for port, name in self.inputs.items()
        }

    def expected(self, samples: Samples, times: Sequence[float], cycle: float) -> np.ndarray:
        """Return what the law gives, (scans, outputs)."""
        given = self.law(samples, times, cycle)
        columns = list(given.values()) if isinstance(given, Mapping) else [given]
        return np.array(columns, dtype=np.float64).T


@cache
def signals(folder: Path) -> PlantModel:
    """Return the plant SIGNALS, its file in `folder`."""
    return plant_of(folder, SIGNALS, "signals")


def diagram(folder: Path, *nodes: Node, **further: Any) -> Diagram:
    """Return nodes beside the plant SIGNALS."""
    plant = PlantNode(name="signals", model=signals(folder))
    return Diagram(plant=plant, nodes=nodes, timing=timing(20.0, 5.0, **further))


class Alone:
    """One block over hand-made buffers: its inputs at slots 0.., then its outputs and its own words."""

    def __init__(self, loop: Diagram) -> None:
        wiring = wire(loop)
        (node,) = loop.nodes
        laid = lay_out(wiring, node, 0)
        self.kernel = BLOCKS[node.type].kernel
        self.ports = tuple(node.inputs)
        self.outputs = max(1, len(BLOCKS[node.type].outputs_of(node.parameters)))
        count, own = len(self.ports), len(self.ports) + self.outputs
        wires = [wiring.resolve(node.inputs[port]).source for port in self.ports]
        slots = {name: wires.index(name) for name in wires}
        self.sources = [slots[name] for name in wires]
        inputs = [each.slot(slots, own) for each in laid.inputs]
        row = [OPCODES[node.type], 0, count, own, 0, len(inputs), *inputs, *laid.words]
        row[layout.ROW_LENGTH] = len(row)
        numbers = [*(each.sign for each in laid.inputs), *laid.numbers]
        keeps, signs = [], []
        for each in laid.late:
            keeps += [slots[each.source], len(numbers) + len(signs), own + each.at]
            signs.append(each.sign)
        head = np.zeros(layout.HEAD, dtype=np.int64)
        head[layout.KEEPS], head[layout.KEEPS_AT] = len(laid.late), layout.HEAD + len(row)
        self.ints = np.array([*head, *row, *keeps], dtype=np.int64)
        self.floats = np.array([*numbers, *signs], dtype=np.float64)
        self.memory = np.array([0.0] * own + [*laid.initial], dtype=np.float64)

    def step(self, inputs: Sequence[float], cycle: float, time: float, scan: int) -> np.ndarray:
        """Execute it once on raw inputs, in the order of the node's wires; return its outputs."""
        for slot, value in zip(self.sources, inputs, strict=True):
            self.memory[slot] = value
        self.kernel(Row(self.ints, self.floats, self.memory, layout.HEAD, cycle, time, scan))
        keep_late(self.ints, self.floats, self.memory)
        count = len(self.ports)
        return self.memory[count : count + self.outputs].copy()

"""What blocks have to say of a run: the events they reported, the value that one of them refused."""

from collections.abc import Iterator

import numpy as np

from fcl_sim.loop.diagram import Node
from fcl_sim.loop.settings import signals_of, type_of
from fcl_sim.loop.tape import Tape
from fcl_sim.loop.trace import BlockEvent, Fault, Values


def events_of(tape: Tape, record: Values) -> tuple[BlockEvent, ...]:
    """Return what blocks reported in a run that is recorded (n, columns), in the order of time."""
    found = [
        each for node in tape.wiring.order if isinstance(node, Node) for each in _events(tape, node, record)
    ]
    return tuple(sorted(found, key=lambda each: each.tick))


def _events(tape: Tape, node: Node, record: Values) -> Iterator[BlockEvent]:
    names = type_of(node).events
    if not names:
        return
    numbers = record[:, tape.recorded.column(tape.slots[f"{node.name}.event"])].astype(np.int64)
    before = np.concatenate(([0], numbers[:-1]))
    for scan in np.flatnonzero((numbers != before) & (numbers != 0)):
        number = int(numbers[scan])
        yield BlockEvent(int(tape.starts[scan]), node.name, names[abs(number) - 1], number < 0)


def refused(tape: Tape, name: str, memory: Values, tick: int) -> Fault | None:
    """Return the fault of the block that made the signal `name` NaN because of what it read, if one did."""
    for node in tape.wiring.order:
        refusal = type_of(node).refusal
        if not isinstance(node, Node) or refusal is None or name not in signals_of(node):
            continue
        wires = {port: tape.wiring.resolve(each) for port, each in node.inputs.items()}
        values = {port: float(each.sign * memory[tape.slots[each.source]]) for port, each in wires.items()}
        told = refusal(values)
        if told is not None:
            port, takes = told
            source, value = wires[port].source, values[port]
            reason = f"`{source}` gives {value:.9g} to `{port}` of `{node.name}`, which is {takes}"
            return Fault(tick, source, reason)
    return None

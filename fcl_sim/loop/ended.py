"""Why a run ended early: which signal, state or event is to blame, and what is wrong with it."""

import numpy as np

from fcl_sim.loop import layout
from fcl_sim.loop.diagram import FuzzyNode
from fcl_sim.loop.reported import refused
from fcl_sim.loop.settings import signals_of
from fcl_sim.loop.state import RunState
from fcl_sim.loop.tape import Tape
from fcl_sim.loop.trace import Fault, Values
from fcl_sim.loop.work import INDEX, SAMPLES, STATUS

REASONS = {
    layout.NOT_FINITE: "is NaN or infinite",
    layout.BLEW_UP: "is NaN or infinite, or grows faster than the integrator can follow",
    layout.STEP_TOO_SMALL: "needs steps too small for the clock to meet the tolerance",
    layout.CHATTERS: "happens over and over without time passing",
    layout.BUDGET_SPENT: "needs more than a million steps between two writes",
    layout.RUN_BUDGET_SPENT: "has needed a thousand million steps, and the run is not at its end",
}
"""How a run can end early, in words that follow the name of a signal, state or event."""


def fault_of(tape: Tape, state: RunState) -> Fault | None:
    """Return why a run ended before its end; None where it did not."""
    status, samples, index = (int(state.progress[word]) for word in (STATUS, SAMPLES, INDEX))
    if status == layout.FINISHED:
        return None
    if status == layout.NOT_FINITE:
        return _not_finite(tape, state, index, int(tape.starts[samples]))
    declaration = tape.wiring.diagram.plant.model.declaration
    prefix = tape.wiring.diagram.plant.name
    tick = int(tape.starts[max(0, samples - 1)])
    if status == layout.CHATTERS:
        name = declaration.events[index].name
        return Fault(tick, f"{prefix}.{name}", f"the event `{name}` of `{prefix}` {REASONS[status]}")
    name = declaration.states[index].name
    return Fault(tick, f"{prefix}.{name}", f"the state `{name}` of `{prefix}` {REASONS[status]}")


def _not_finite(tape: Tape, state: RunState, index: int, tick: int) -> Fault:
    """Return the fault of the block that made numbers of what is none, else of the signal in slot `index`."""
    name = _culprit(tape, state.memory) or next(name for name, slot in tape.slots.items() if slot == index)
    if name in tape.instances and name in tape.outside:
        in_int: Fault = state.own[name]["fault"]
        return in_int
    if name in tape.instances:
        return _beyond_real(tape, name, state.memory, tick)
    words = f"`{name}` {REASONS[layout.NOT_FINITE]}"
    return refused(tape, name, state.memory, tick) or Fault(tick, name, words)


def _culprit(tape: Tape, memory: Values) -> str | None:
    """Return the first block, in their order, that gives what is not finite though all that it reads is."""

    def is_finite(name: str) -> bool:
        return name not in tape.slots or bool(np.isfinite(memory[tape.slots[name]]))

    for node in tape.wiring.order:
        given = (node.name,) if isinstance(node, FuzzyNode) else signals_of(node)
        broken = next((name for name in given if not is_finite(name)), None)
        sources = [tape.wiring.resolve(each).source for each in node.inputs.values()]
        if broken is not None and all(map(is_finite, sources)):
            return broken
    return None


def _beyond_real(tape: Tape, name: str, memory: Values, tick: int) -> Fault:
    """Return the fault of a fuzzy block in REAL with an input that binary32 cannot hold."""
    node = next(each for each in tape.wiring.order if each.name == name and isinstance(each, FuzzyNode))
    inputs = node.block.program.input_names
    values = memory[tape.instances[name] :]
    port = next(port for port, value in zip(inputs, values, strict=False) if not np.isfinite(value))
    source = tape.wiring.resolve(node.inputs[port]).source
    return Fault(tick, source, f"`{source}` exceeds what `{name}.{port}` can hold: it is REAL")

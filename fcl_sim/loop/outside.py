"""Execute a block in Python, or a fuzzy one in INT, between two calls of `simulate`."""

from fcl_sim.diagnostics import Diagnostic, InputFault, Place
from fcl_sim.loop.blocks.user_function import UserFault, call
from fcl_sim.loop.integer import IntegerBlock
from fcl_sim.loop.layout import FIRST_INPUT, INPUTS, OUTPUT, PARAMETERS
from fcl_sim.loop.settings import signals_of
from fcl_sim.loop.state import RunState
from fcl_sim.loop.tape import Tape
from fcl_sim.loop.trace import Fault
from fcl_sim.loop.work import INDEX, SCAN


def execute_outside(tape: Tape, state: RunState) -> None:
    """Execute the block that `state` asks for; InputFault where its function fails."""
    at = int(state.progress[INDEX])
    name, outside = next((name, each) for name, each in tape.outside.items() if each.row == at)
    count, first = int(tape.ints[at + INPUTS]), at + FIRST_INPUT
    signs = tape.floats[tape.ints[at + PARAMETERS] :]
    inputs = {
        port: float(signs[i] * state.memory[tape.ints[first + i]])
        for i, port in enumerate(outside.ports[:count])
    }
    if isinstance(outside, IntegerBlock):
        failed = outside.evaluate(inputs, state.memory)
        if failed is not None:
            tick = int(tape.starts[state.progress[SCAN]])
            state.own[name]["fault"] = _fault(tape, outside, *failed, tick)
        return
    t = float(tape.starts[state.progress[SCAN]] / 1e9)
    try:
        values = call(outside.step, outside.file, inputs, state.own[name], t, outside.outputs)
    except UserFault as fault:
        places = (Place(span=outside.span),) if outside.span else ()
        message = f"`{name}` at {t:.9g} s: {fault}"
        raise InputFault(
            [Diagnostic(code="RUN301", message=message, places=places, hint=fault.hint)]
        ) from fault
    output = int(tape.ints[at + OUTPUT])
    state.memory[output : output + len(values)] = values


def _fault(tape: Tape, block: IntegerBlock, port: str, reason: str, tick: int) -> Fault:
    """Return why a fuzzy block in INT failed: an input beyond INT, or a result beyond its width."""
    name = block.node.name
    if not port:
        return Fault(tick, signals_of(block.node)[0], f"`{name}` in INT: {reason}")
    source = tape.wiring.resolve(block.node.inputs[port]).source
    return Fault(tick, source, f"`{source}` exceeds what `{name}.{port}` can hold: it is INT; {reason}")

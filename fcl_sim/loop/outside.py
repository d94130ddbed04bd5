"""Execute a block in Python, between two calls of `simulate`."""

from fcl_sim.diagnostics import Diagnostic, InputFault, Place
from fcl_sim.loop.blocks.user_function import UserFault, call
from fcl_sim.loop.layout import FIRST_INPUT, INPUTS, OUTPUT, PARAMETERS
from fcl_sim.loop.state import RunState
from fcl_sim.loop.tape import Tape
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

"""A cold restart of the PLC: its blocks begin anew, and everything else goes on."""

from fcl_sim.loop.diagram import Diagram, FuzzyNode, Node
from fcl_sim.loop.settings import type_of
from fcl_sim.loop.state import RunState
from fcl_sim.loop.tape import Tape


def restarted_nodes(diagram: Diagram) -> tuple[Node | FuzzyNode, ...]:
    """Return the blocks that a restart of the PLC reaches: all in it that stand for no device beside it."""
    return tuple(
        node for node in diagram.nodes if node.name.startswith(diagram.plc) and not type_of(node).device
    )


def restart_cold(tape: Tape, state: RunState) -> None:
    """Give the memory of the PLC's blocks its initial values."""
    for node in restarted_nodes(tape.wiring.diagram):
        first, length = tape.own[node.name]
        state.memory[first : first + length] = tape.memory[first : first + length]
        if node.name in state.own:
            state.own[node.name].clear()

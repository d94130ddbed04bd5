"""Execute the blocks of a tape once, in wiring order."""

from fcl_sim.jit import inlined, u
from fcl_sim.loop.blocks.differentiator import differentiate
from fcl_sim.loop.blocks.fuzzy import evaluate
from fcl_sim.loop.blocks.linear import gain, weighted_sum
from fcl_sim.loop.layout import OPCODE, ROW_LENGTH, ROWS, ROWS_AT
from fcl_sim.loop.work import Floats, Ints


@inlined
def execute(ints: Ints, floats: Floats, memory: Floats, cycle: float) -> None:
    """Execute every block row, `cycle` being the cycle time in seconds."""
    at = ints[u(ROWS_AT)]
    for _ in range(ints[u(ROWS)]):
        opcode = ints[u(at + OPCODE)]
        if opcode == 0:
            weighted_sum(ints, floats, memory, at)
        elif opcode == 1:
            gain(ints, floats, memory, at)
        elif opcode == 2:
            differentiate(ints, floats, memory, at, cycle)
        elif opcode == 3:
            evaluate(ints, floats, memory, at)
        at += ints[u(at + ROW_LENGTH)]

"""`differentiator`: first-order filtered difference."""

from fcl_sim.jit import inlined, u
from fcl_sim.loop.blocks.declaration import BlockParameter, BlockType
from fcl_sim.loop.layout import FIRST_INPUT, OUTPUT, PARAMETERS, STATE
from fcl_sim.loop.work import Floats, Ints
from fcl_sim.units import parse_unit

DIFFERENTIATOR = BlockType(
    name="differentiator",
    summary="rate of change of a signal, filtered by a first-order lag",
    equation="y_k = y_{k-1} + T/(Tf + T) * ((u_k - u_{k-1})/T - y_{k-1}); y_0 = 0",
    source="IEC 61131-7 A.3, differentiating element; backward difference of s/(1 + s Tf)",
    ports=("input",),
    parameters=(
        BlockParameter(name="filter", unit="s", meaning="Tf, time constant of the lag", default="0 s"),
    ),
    states=2,
    unit=lambda inputs, _: inputs["input"] / parse_unit("s"),
)

PREVIOUS, BEGUN = 0, 1


@inlined
def differentiate(ints: Ints, floats: Floats, memory: Floats, at: int, cycle: float) -> None:
    """Kernel of `differentiator`, `cycle` T in seconds; parameters: the input's sign, Tf."""
    parameters = ints[u(at + PARAMETERS)]
    state = ints[u(at + STATE)]
    now = floats[u(parameters)] * memory[u(ints[u(at + FIRST_INPUT)])]
    if memory[u(state + BEGUN)] == 0.0:
        memory[u(state + BEGUN)] = 1.0
        memory[u(ints[u(at + OUTPUT)])] = 0.0
    else:
        before = memory[u(ints[u(at + OUTPUT)])]
        rate = (now - memory[u(state + PREVIOUS)]) / cycle
        memory[u(ints[u(at + OUTPUT)])] = before + cycle / (floats[u(parameters + 1)] + cycle) * (
            rate - before
        )
    memory[u(state + PREVIOUS)] = now

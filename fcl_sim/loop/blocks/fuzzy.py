"""`fuzzy`: a fuzzy function block, called once per scan."""

from fcl_sim.engine.infer import infer
from fcl_sim.jit import inlined, u
from fcl_sim.loop.blocks.declaration import BlockType
from fcl_sim.loop.layout import FIRST_INPUT, INPUTS, PARAMETERS, STATE
from fcl_sim.loop.work import Floats, Ints

FUZZY = BlockType(
    name="fuzzy",
    summary="a fuzzy function block in FCL",
    equation="fuzzify, aggregate, activate, accumulate, defuzzify; outputs begin at their initial values",
    source="IEC 61131-7 clause 5 and A.2.3",
    kernel=None,  # `execute` calls it with the buffers that it needs
)


@inlined
def evaluate(ints: Ints, floats: Floats, memory: Floats, at: int) -> None:
    """Kernel of `fuzzy`; the word after the inputs is where its program stands in `ints`."""
    inputs = ints[u(at + INPUTS)]
    signs = ints[u(at + PARAMETERS)]
    instance = ints[u(at + STATE)]
    for i in range(inputs):
        memory[u(instance + i)] = floats[u(signs + i)] * memory[u(ints[u(at + FIRST_INPUT + i)])]
    infer(ints, floats, ints[u(at + FIRST_INPUT + inputs)], memory, instance)

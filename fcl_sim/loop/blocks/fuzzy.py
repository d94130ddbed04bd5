"""`fuzzy`: a fuzzy function block, called once per scan."""

from collections.abc import Mapping

from fcl_sim.engine.infer import infer
from fcl_sim.jit import inlined, u
from fcl_sim.loop.blocks.declaration import BlockType
from fcl_sim.loop.layout import FIRST_INPUT, INPUTS, PARAMETERS, STATE
from fcl_sim.units import Quantity, Unit


def _no_single_unit(inputs: Mapping[str, Unit], parameters: Mapping[str, Quantity]) -> Unit:
    raise AssertionError("the outputs of a fuzzy block have the units that its declaration gives them")


FUZZY = BlockType(
    name="fuzzy",
    summary="a fuzzy function block in FCL",
    equation="fuzzify, aggregate, activate, accumulate, defuzzify; outputs begin at their initial values",
    source="IEC 61131-7 clause 5 and A.2.3",
    unit=_no_single_unit,
)


@inlined
def evaluate(ints, floats, memory, at):
    """Kernel of `fuzzy`; the word after the inputs is where its program stands in `ints`."""
    inputs = ints[u(at + INPUTS)]
    signs = ints[u(at + PARAMETERS)]
    instance = ints[u(at + STATE)]
    for i in range(inputs):
        memory[u(instance + i)] = floats[u(signs + i)] * memory[u(ints[u(at + FIRST_INPUT + i)])]
    infer(ints, floats, ints[u(at + FIRST_INPUT + inputs)], memory, instance)

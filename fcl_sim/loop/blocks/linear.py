"""`sum` and `gain`: weighted signals."""

from collections.abc import Mapping

from fcl_sim.jit import inlined, u
from fcl_sim.loop.blocks.declaration import BlockParameter, BlockType
from fcl_sim.loop.layout import FIRST_INPUT, INPUTS, OUTPUT, PARAMETERS
from fcl_sim.loop.work import Floats, Ints
from fcl_sim.units import Quantity, Unit, UnitError


def _sum_unit(inputs: Mapping[str, Unit], parameters: Mapping[str, Quantity]) -> Unit:
    units = {port: unit * parameters[port].unit for port, unit in inputs.items()}
    first, *others = units.items()
    for port, unit in others:
        if not unit.same_as(first[1]):
            raise UnitError(
                f"the terms do not add up: `{first[0]}` gives {first[1]} and `{port}` gives {unit}",
                f"choose the gain of `{port}` so that it gives {first[1]}",
            )
    return first[1]


SUM = BlockType(
    name="sum",
    summary="weighted sum of signals",
    equation="y = sum of gain_i * u_i; no memory",
    source="IEC 61131-7 A.3, preparation of the inputs",
    terms="terms",
    unit=_sum_unit,
)

GAIN = BlockType(
    name="gain",
    summary="a signal times a constant",
    equation="y = gain * u; no memory",
    source="IEC 61131-7 A.3",
    ports=("input",),
    parameters=(BlockParameter(name="gain", unit=None, meaning="factor, with its unit"),),
    unit=lambda inputs, parameters: inputs["input"] * parameters["gain"].unit,
)


@inlined
def weighted_sum(ints: Ints, floats: Floats, memory: Floats, at: int) -> None:
    """Kernel of `sum`; the parameters are the gains, signs included."""
    total = 0.0
    gains = ints[u(at + PARAMETERS)]
    for i in range(ints[u(at + INPUTS)]):
        total += floats[u(gains + i)] * memory[u(ints[u(at + FIRST_INPUT + i)])]
    memory[u(ints[u(at + OUTPUT)])] = total


@inlined
def gain(ints: Ints, floats: Floats, memory: Floats, at: int) -> None:
    """Kernel of `gain`; parameters: the input's sign, the gain."""
    parameters = ints[u(at + PARAMETERS)]
    memory[u(ints[u(at + OUTPUT)])] = floats[u(parameters + 1)] * (
        floats[u(parameters)] * memory[u(ints[u(at + FIRST_INPUT)])]
    )

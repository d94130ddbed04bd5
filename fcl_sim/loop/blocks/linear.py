"""`sum` and `gain`: weighted signals."""

from collections.abc import Mapping

from fcl_sim.jit import inlined
from fcl_sim.loop.blocks.declaration import BlockInput, BlockInputs, BlockOutput, BlockParameter, BlockType
from fcl_sim.loop.row import Row, inputs, number, read, write
from fcl_sim.units import Quantity, Unit, UnitError, exact


@inlined
def weighted_sum(row: Row) -> None:
    """Kernel of `sum`."""
    total = 0.0
    for i in range(inputs(row)):
        total += read(row, i)
    write(row, 0, total)


def _sum_unit(inputs: Mapping[str, Unit], parameters: Mapping[str, Quantity]) -> Unit:
    """Return the unit of a sum: degC where the gains of temperatures in degC add up to 1, K where to 0."""
    units = {port: unit * parameters[port].unit for port, unit in inputs.items()}
    scales = {port for port, unit in units.items() if not unit.same_as(unit.difference)}
    if not scales:
        return _common(units)
    common = _common({port: unit.difference for port, unit in units.items()})
    weight = sum(exact(parameters[port].value) for port in scales)
    if weight == 0:
        return common
    if weight != 1:
        raise UnitError(
            f"the gains of the temperatures in degC add up to {float(weight):g}",
            "to 0 they give a difference in K, to 1 a temperature in degC, to anything else neither",
        )
    return units[min(scales)]


def _common(units: Mapping[str, Unit]) -> Unit:
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
    equation="y = sum of gain_i * u_i; no memory. Gains of temperatures in degC add up to 1, or to 0 for K",
    source="IEC 61131-7 A.3, preparation of the inputs",
    kernel=weighted_sum,
    group=BlockInputs(name="terms", meaning="signals, each with its gain", form="gains"),
    outputs=(BlockOutput(unit=_sum_unit),),
)


@inlined
def gain(row: Row) -> None:
    """Kernel of `gain`."""
    write(row, 0, number(row, 0) * read(row, 0))


def _gain_unit(inputs: Mapping[str, Unit], parameters: Mapping[str, Quantity]) -> Unit:
    return inputs["input"] * parameters["gain"].unit


GAIN = BlockType(
    name="gain",
    summary="a signal times a constant",
    equation="y = gain * u; no memory",
    source="IEC 61131-7 A.3",
    kernel=gain,
    inputs=(BlockInput(name="input", meaning="u"),),
    parameters=(BlockParameter(name="gain", unit=None, meaning="factor, with its unit"),),
    outputs=(BlockOutput(unit=_gain_unit),),
)

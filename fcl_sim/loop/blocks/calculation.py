"""`product` and `division`."""

from collections.abc import Mapping
from math import fabs, prod

from fcl_sim.jit import flat, inlined
from fcl_sim.loop.blocks.declaration import (
    BlockInput,
    BlockInputs,
    BlockOutput,
    BlockParameter,
    BlockType,
    Like,
)
from fcl_sim.loop.row import Row, inputs, number, read, write
from fcl_sim.units import ONE, Quantity, Unit


@inlined
def multiply(row: Row) -> None:
    """Kernel of `product`."""
    product = 1.0
    for i in range(inputs(row)):
        product *= read(row, i)
    write(row, 0, product)


def _product_unit(inputs: Mapping[str, Unit], _: Mapping[str, Quantity]) -> Unit:
    return prod(inputs.values(), start=ONE)


PRODUCT = BlockType(
    name="product",
    summary="product of signals",
    equation="y = product of u_i; no memory",
    source="IEC 61131-3 6.6.2.5.4, MUL",
    kernel=multiply,
    group=BlockInputs(name="inputs", meaning="u, the factors", least=2),
    outputs=(BlockOutput(unit=_product_unit),),
)


@inlined
def divide(row: Row) -> None:
    """Kernel of `division`."""
    above, below = read(row, 0), read(row, 1)
    write(row, 0, above / below if fabs(below) > number(row, 0) else number(row, 1))


def _quotient_unit(inputs: Mapping[str, Unit], _: Mapping[str, Quantity]) -> Unit:
    return inputs["input"] / inputs["by"]


DIVISION = BlockType(
    name="division",
    summary="quotient of two signals, guarded against a divisor of 0",
    equation="y = u / v where |v| > least, else otherwise; no memory",
    source="IEC 61131-3 6.6.2.5.4, DIV; the guard is ours",
    kernel=divide,
    inputs=(
        BlockInput(name="input", meaning="u, the dividend"),
        BlockInput(name="by", meaning="v, the divisor"),
    ),
    parameters=(
        BlockParameter(
            name="least",
            unit=Like("by"),
            default=0.0,
            minimum=0.0,
            meaning="magnitude of the divisor up to which the quotient is not taken",
        ),
        BlockParameter(
            name="otherwise", unit=_quotient_unit, default=0.0, meaning="what is given in its place"
        ),
    ),
    outputs=(BlockOutput(unit=_quotient_unit),),
)

TABLE = (PRODUCT, DIVISION)


@flat
def execute(code: int, row: Row) -> None:
    """Execute a block of this family by its row in TABLE."""
    if code == 0:
        multiply(row)
    elif code == 1:
        divide(row)

"""`dead_band`, and the family of nonlinear elements."""

from math import copysign, fabs

from fcl_sim.jit import flat, inlined
from fcl_sim.loop.blocks.characteristic import CHARACTERISTIC, characteristic
from fcl_sim.loop.blocks.declaration import BlockInput, BlockOutput, BlockParameter, BlockType, Like
from fcl_sim.loop.blocks.relays import (
    HYSTERESIS_RELAY,
    QUANTISER,
    RATE_LIMITER,
    hysteresis_relay,
    quantiser,
    rate_limiter,
)
from fcl_sim.loop.row import Row, number, read, write


@inlined
def dead_band(row: Row) -> None:
    """Kernel of `dead_band`."""
    value, width = read(row, 0), number(row, 0)
    write(row, 0, copysign(fabs(value) - width, value) if fabs(value) > width else 0.0)


DEAD_BAND = BlockType(
    name="dead_band",
    summary="nothing near 0, beyond it the signal less the width",
    equation="y = 0 where |u| <= width, else sign(u) (|u| - width); no memory",
    source="Atherton: Nonlinear Control Engineering, 1975, 2.2; continuous at the edges",
    kernel=dead_band,
    inputs=(BlockInput(name="input", meaning="u"),),
    parameters=(
        BlockParameter(
            name="width", unit=Like("input", apart=True), minimum=0.0, meaning="half the width of the band"
        ),
    ),
    outputs=(BlockOutput(unit=Like("input")),),
)

TABLE = (DEAD_BAND, RATE_LIMITER, HYSTERESIS_RELAY, QUANTISER, CHARACTERISTIC)


@flat
def execute(code: int, row: Row) -> None:
    """Execute a block of this family by its row in TABLE."""
    if code == 0:
        dead_band(row)
    elif code == 1:
        rate_limiter(row)
    elif code == 2:
        hysteresis_relay(row)
    elif code == 3:
        quantiser(row)
    elif code == 4:
        characteristic(row)

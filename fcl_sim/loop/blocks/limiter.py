"""`limiter`: a signal held between two bounds."""

from collections.abc import Iterator
from math import inf

from fcl_sim.jit import inlined
from fcl_sim.loop.blocks.declaration import (
    BlockInput,
    BlockOutput,
    BlockParameter,
    BlockType,
    Like,
    Misfit,
)
from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.loop.row import Row, read, write


@inlined
def limit(row: Row) -> None:
    """Kernel of `limiter`; the bounds are inputs 1 and 2."""
    write(row, 0, min(max(read(row, 0), read(row, 1)), read(row, 2)))


def limits_in_order(setting: Setting) -> Iterator[Misfit]:
    """Yield what is wrong where `low` lies above `high`; bounds that are signals are not known yet."""
    low, high = setting.values.get("low"), setting.values.get("high")
    if low is not None and high is not None and low > high:
        yield Misfit(parameter="low", message="`low` lies above `high`", hint="exchange the two")


LIMITS = (
    BlockParameter(name="low", unit=Like("input"), meaning="lower bound", default=-inf, port=True),
    BlockParameter(name="high", unit=Like("input"), meaning="upper bound", default=inf, port=True),
)

LIMITER = BlockType(
    name="limiter",
    summary="a signal held between two bounds",
    equation="y = min(max(u, low), high), so high wins where the bounds cross; no memory",
    source="IEC 61131-3 6.6.2.5.7, LIMIT",
    kernel=limit,
    inputs=(BlockInput(name="input", meaning="u"),),
    parameters=LIMITS,
    outputs=(BlockOutput(unit=Like("input")),),
    check=limits_in_order,
)

"""`unit_delay`, and the family of blocks that look back."""

from fcl_sim.jit import flat, inlined
from fcl_sim.loop.blocks.dead_time import DEAD_TIME, dead_time
from fcl_sim.loop.blocks.declaration import (
    BlockInput,
    BlockOutput,
    BlockParameter,
    BlockType,
    Like,
    Prepared,
)
from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.loop.blocks.windows import MOVING_AVERAGE, SAMPLE_HOLD, moving_average, sample_hold
from fcl_sim.loop.row import Row, read, write


@inlined
def unit_delay(row: Row) -> None:
    """Kernel of `unit_delay`: its input is late already."""
    write(row, 0, read(row, 0))


def _initial(setting: Setting) -> Prepared:
    return Prepared(late={"input": setting.values["initial"]})


UNIT_DELAY = BlockType(
    name="unit_delay",
    summary="a signal as it was at the last scan",
    equation="y_k = u_{k-1}; y_0 = initial",
    source="z-transform, 1/z",
    kernel=unit_delay,
    inputs=(BlockInput(name="input", meaning="u"),),
    parameters=(
        BlockParameter(name="initial", unit=Like("input"), default=0.0, meaning="value at the first scan"),
    ),
    outputs=(BlockOutput(unit=Like("input"), told_by="initial"),),
    prepare=_initial,
    late=("input",),
)

TABLE = (UNIT_DELAY, DEAD_TIME, MOVING_AVERAGE, SAMPLE_HOLD)


@flat
def execute(code: int, row: Row) -> None:
    """Execute a block of this family by its row in TABLE."""
    if code == 0:
        unit_delay(row)
    elif code == 1:
        dead_time(row)
    elif code == 2:
        moving_average(row)
    elif code == 3:
        sample_hold(row)

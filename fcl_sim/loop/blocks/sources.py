"""Sources, blocks without inputs: `constant`, `step` and the table of all."""

from fcl_sim.jit import flat, inlined
from fcl_sim.loop.blocks.declaration import BlockOutput, BlockParameter, BlockType, Like
from fcl_sim.loop.blocks.noise import NOISE, noise
from fcl_sim.loop.blocks.recorded import STAIRCASE, TIME_TABLE, staircase, time_table
from fcl_sim.loop.blocks.waveforms import CHIRP, PULSE, RAMP, SINE, chirp, pulse, ramp, sine
from fcl_sim.loop.row import Row, number, write


@inlined
def constant(row: Row) -> None:
    """Kernel of `constant`."""
    write(row, 0, number(row, 0))


CONSTANT = BlockType(
    name="constant",
    summary="a constant",
    equation="y = value; no memory",
    source="of its own",
    kernel=constant,
    parameters=(BlockParameter(name="value", unit=None, meaning="the constant, with its unit"),),
    outputs=(BlockOutput(unit=Like("value")),),
)


@inlined
def step(row: Row) -> None:
    """Kernel of `step`; numbers: before, after, at."""
    write(row, 0, number(row, 1) if row.time >= number(row, 2) else number(row, 0))


STEP = BlockType(
    name="step",
    summary="one value, and from a time on another",
    equation="y = before where t < at, else after; t is the start of the scan; no memory",
    source="Heaviside's step, closed on the right",
    kernel=step,
    parameters=(
        BlockParameter(name="before", unit=Like("after"), default=0.0, meaning="value before the step"),
        BlockParameter(name="after", unit=None, meaning="value from the step on, with its unit"),
        BlockParameter(name="at", unit="s", default="0 s", meaning="time of the step"),
    ),
    outputs=(BlockOutput(unit=Like("after")),),
)

TABLE = (CONSTANT, STEP, STAIRCASE, RAMP, PULSE, SINE, CHIRP, TIME_TABLE, NOISE)


@flat
def execute(code: int, row: Row) -> None:
    """Execute a block of this family by its row in TABLE."""
    if code == 0:
        constant(row)
    elif code == 1:
        step(row)
    elif code == 2:
        staircase(row)
    elif code == 3:
        ramp(row)
    elif code == 4:
        pulse(row)
    elif code == 5:
        sine(row)
    elif code == 6:
        chirp(row)
    elif code == 7:
        time_table(row)
    elif code == 8:
        noise(row)

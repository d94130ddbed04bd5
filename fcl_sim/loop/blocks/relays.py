"""`rate_limiter`, `hysteresis_relay` and `quantiser`."""

from collections.abc import Iterator
from math import inf

from numpy import floor

from fcl_sim.jit import inlined
from fcl_sim.loop.blocks.declaration import (
    BlockInput,
    BlockOutput,
    BlockParameter,
    BlockType,
    Like,
    Misfit,
    Prepared,
)
from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.loop.row import Row, keep, number, read, recall, word, write

VALUE, STANDS = 0, 0
RISING, FALLING = 0, 1
LOWER, UPPER, OFF, ON = range(4)
STEP, OFFSET = 0, 1

INPUT = (BlockInput(name="input", meaning="u"),)


@inlined
def rate_limiter(row: Row) -> None:
    """Kernel of `rate_limiter`."""
    value, before = read(row, 0), recall(row, VALUE)
    value = min(value, before + number(row, RISING) * row.cycle)
    value = max(value, before - number(row, FALLING) * row.cycle)
    keep(row, VALUE, value)
    write(row, 0, value)


def _initial(setting: Setting) -> Prepared:
    return Prepared(states=(setting.values["initial"],))


RATE_LIMITER = BlockType(
    name="rate_limiter",
    summary="a signal that changes only so fast",
    equation=("y_k = max(min(u_k, y_{k-1} + rising T), y_{k-1} - falling T); y_{-1} = initial"),
    source="Astrom, Hagglund: Advanced PID Control, 2006, 3.4, rate limitation of set-points",
    kernel=rate_limiter,
    inputs=INPUT,
    parameters=(
        BlockParameter(
            name="rising",
            unit=Like("input", "1/s"),
            default=inf,
            minimum=0.0,
            meaning="fastest upwards",
        ),
        BlockParameter(
            name="falling",
            unit=Like("input", "1/s"),
            default=inf,
            minimum=0.0,
            meaning="fastest downwards, without a sign",
        ),
        BlockParameter(name="initial", unit=Like("input"), default=0.0, meaning="output before the start"),
    ),
    outputs=(BlockOutput(unit=Like("input"), told_by="initial"),),
    prepare=_initial,
)


@inlined
def hysteresis_relay(row: Row) -> None:
    """Kernel of `hysteresis_relay`."""
    value = read(row, 0)
    if value >= number(row, UPPER):
        keep(row, STANDS, 1.0)
    elif value <= number(row, LOWER):
        keep(row, STANDS, 0.0)
    write(row, 0, number(row, ON) if recall(row, STANDS) > 0.5 else number(row, OFF))


def _stands(setting: Setting) -> Prepared:
    return Prepared(states=(float(setting.values["initial"]),))


def _levels_in_order(setting: Setting) -> Iterator[Misfit]:
    if setting.values["lower"] > setting.values["upper"]:
        yield Misfit(parameter="lower", message="`lower` lies above `upper`", hint="exchange the two")


HYSTERESIS_RELAY = BlockType(
    name="hysteresis_relay",
    summary="one of two values, switched over at two levels",
    equation=(
        "y_k = on where u_k >= upper, off where u_k <= lower, in between as it was; at first `initial`"
    ),
    source="Atherton: Nonlinear Control Engineering, 1975, 2.2; two-position controller",
    kernel=hysteresis_relay,
    inputs=INPUT,
    parameters=(
        BlockParameter(name="lower", unit=Like("input"), meaning="level at which it switches off"),
        BlockParameter(name="upper", unit=Like("input"), meaning="level at which it switches on"),
        BlockParameter(name="off", unit=Like("on"), default=0.0, meaning="value while it is off"),
        BlockParameter(name="on", unit=None, default=1.0, meaning="value while it is on, with its unit"),
        BlockParameter(name="initial", kind="truth", default=False, meaning="whether it is on at first"),
    ),
    outputs=(BlockOutput(unit=Like("on"), told_by="on"),),
    prepare=_stands,
    check=_levels_in_order,
)


@inlined
def quantiser(row: Row) -> None:
    """Kernel of `quantiser`."""
    step, offset = number(row, STEP), number(row, OFFSET)
    steps = (read(row, 0) - offset) / step
    write(row, 0, offset + step * floor(steps if word(row, 0) == 1 else steps + 0.5))


QUANTISER = BlockType(
    name="quantiser",
    summary="a signal in whole steps",
    equation=(
        "nearest: y = offset + step floor((u - offset)/step + 1/2), so half a step goes up; "
        "down: y = offset + step floor((u - offset)/step); no memory"
    ),
    source="Widrow, Kollar: Quantization Noise, 2008, 1.1",
    kernel=quantiser,
    inputs=INPUT,
    parameters=(
        BlockParameter(
            name="step", unit=Like("input", apart=True), above=0.0, meaning="what a step is worth"
        ),
        BlockParameter(name="offset", unit=Like("input"), default=0.0, meaning="a value that is met exactly"),
        BlockParameter(
            name="rounding",
            kind="choice",
            choices=("nearest", "down"),
            default="nearest",
            meaning="which step is taken",
        ),
    ),
    outputs=(BlockOutput(unit=Like("input")),),
)

"""`integrator`: forward and backward Euler and the trapezoidal rule, with limits, reset and hold."""

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
    Prepared,
)
from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.loop.row import Row, keep, number, read, recall, word, write

FORWARD, BACKWARD, TRAPEZOIDAL = "forward", "backward", "trapezoidal"
METHODS = (FORWARD, BACKWARD, TRAPEZOIDAL)

INPUT, RESET, HOLD, LOW, HIGH = range(5)
INITIAL = 0
VALUE, PREVIOUS = 0, 1


@inlined
def integrate(row: Row) -> None:
    """Kernel of `integrator`; a late input makes forward Euler of the same line as backward Euler."""
    now = read(row, INPUT)
    if read(row, RESET) != 0.0:
        value = number(row, INITIAL)
    elif read(row, HOLD) != 0.0:
        value = recall(row, VALUE)
    else:
        area = 0.5 * (now + recall(row, PREVIOUS)) if word(row, 0) == 2 else now
        value = recall(row, VALUE) + row.cycle * area
    value = min(max(value, read(row, LOW)), read(row, HIGH))
    keep(row, VALUE, value)
    keep(row, PREVIOUS, now)
    write(row, 0, value)


def _late(setting: Setting) -> tuple[str, ...]:
    return ("input",) if setting.values["method"] == FORWARD else ()


def _prepare(setting: Setting) -> Prepared:
    return Prepared(states=(setting.values["initial"], 0.0))


def _check(setting: Setting) -> Iterator[Misfit]:
    values = setting.values
    low, high = values.get("low", -inf), values.get("high", inf)
    if low > high:
        yield Misfit(parameter="low", message="`low` lies above `high`", hint="exchange the two")
    elif not low <= values["initial"] <= high:
        yield Misfit(parameter="initial", message="`initial` lies beyond the limits")


INTEGRATOR = BlockType(
    name="integrator",
    summary="integral of a signal over time, with limits, reset and hold",
    equation=(
        "forward: y_k = y_{k-1} + T u_{k-1}, y_0 = initial; backward: y_k = y_{k-1} + T u_k; "
        "trapezoidal: y_k = y_{k-1} + T (u_k + u_{k-1}) / 2, u_{-1} = 0; y_{-1} = initial. "
        "y is held between low and high, and stops there at once (anti-windup by clamping); "
        "reset other than 0: y_k = initial; hold other than 0: y_k = y_{k-1}"
    ),
    source="IEC 61131-7 A.3, integrating element; Astrom, Wittenmark: Computer-Controlled Systems, 8.2",
    kernel=integrate,
    inputs=(
        BlockInput(name="input", meaning="u, the rate"),
        BlockInput(name="reset", meaning="other than 0: back to `initial`", unit="", default=0.0),
        BlockInput(name="hold", meaning="other than 0: stay", unit="", default=0.0),
    ),
    parameters=(
        BlockParameter(
            name="method", kind="choice", choices=METHODS, default=BACKWARD, meaning="rule of integration"
        ),
        BlockParameter(name="initial", unit=Like("input", "s"), default=0.0, meaning="value at the start"),
        BlockParameter(name="low", unit=Like("input", "s"), default=-inf, port=True, meaning="lower limit"),
        BlockParameter(name="high", unit=Like("input", "s"), default=inf, port=True, meaning="upper limit"),
    ),
    outputs=(BlockOutput(unit=Like("input", "s"), told_by="initial"),),
    prepare=_prepare,
    late=_late,
    check=_check,
)

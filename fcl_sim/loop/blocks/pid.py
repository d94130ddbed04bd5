"""`pid`: the ISA form with weights, filter, limits, anti-windup and manual operation."""

from collections.abc import Iterator, Mapping
from math import inf, sqrt

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
from fcl_sim.loop.blocks.limiter import limits_in_order
from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.loop.row import Row, keep, last, number, read, recall, word, write
from fcl_sim.units import Quantity, Unit

CLAMPING, TRACKING = "clamping", "back_calculation"

SETPOINT, MEASUREMENT, FEEDFORWARD, MANUAL, AUTOMATIC, RESET = range(6)
B, C, N = range(3)

TRACKED, GAIN, INTEGRAL_TIME, DERIVATIVE_TIME, LOW, HIGH = range(6, 12)
TRACKING_TIME, INITIAL = 3, 4
ANTI_WINDUP, HAS_MANUAL, HAS_TRACKED = range(3)
INTEGRAL, RATE, WEIGHTED, LAST_GAIN, UNLIMITED, BEGUN = range(6)


@inlined
def limited(value: float, low: float, high: float) -> float:
    """Return a value held between bounds, as `limiter` does it."""
    held: float = min(max(value, low), high)
    return held


@inlined
def rate_of(row: Row, before: float, change: float, derivative_time: float) -> float:
    """Return the rate of change behind its filter, of time constant Td/N."""
    cycle = row.cycle
    rate: float = before + cycle / (derivative_time / number(row, N) + cycle) * (change / cycle - before)
    return rate


@inlined
def time_or_never(time: float) -> float:
    """Return an integral time, infinite where it is not above 0: no integral action."""
    return time if time > 0.0 else inf


@inlined
def tracking_share(row: Row, integral_time: float, derivative_time: float) -> float:
    """Return T/Tt, at most 1; the rule where no Tt is told is that of the declaration."""
    time = number(row, TRACKING_TIME)
    if time == 0.0:
        time = sqrt(integral_time * derivative_time) if derivative_time > 0.0 else integral_time
    return row.cycle / time if time > row.cycle else 1.0


@inlined
def pid(row: Row) -> None:
    """Kernel of `pid`."""
    setpoint, measurement = read(row, SETPOINT), read(row, MEASUREMENT)
    gain, low, high = read(row, GAIN), read(row, LOW), read(row, HIGH)
    integral_time, derivative_time = (
        time_or_never(read(row, INTEGRAL_TIME)),
        max(read(row, DERIVATIVE_TIME), 0.0),
    )
    weighted = number(row, C) * setpoint - measurement
    before = recall(row, WEIGHTED)
    begins = recall(row, BEGUN) == 0.0
    anew = begins or read(row, RESET) != 0.0
    if anew:
        rate, integral = 0.0, number(row, INITIAL)
    else:
        rate = rate_of(row, recall(row, RATE), weighted - before, derivative_time)
        integral = recall(row, INTEGRAL) + (recall(row, LAST_GAIN) - gain) * (number(row, B) - 1.0) * setpoint
    others = gain * (number(row, B) * setpoint - measurement) + gain * derivative_time * rate
    others += read(row, FEEDFORWARD)
    if read(row, AUTOMATIC) != 0.0:
        step = row.cycle * gain / integral_time * (setpoint - measurement)
        if word(row, ANTI_WINDUP) == 1:
            if not anew:
                given = read(row, TRACKED) if word(row, HAS_TRACKED) == 1 else last(row, 0)
                excess = recall(row, UNLIMITED) - given
                integral -= tracking_share(row, integral_time, derivative_time) * excess
            integral += step
        else:
            free = others + integral
            integral += min(step, max(high - free, 0.0)) if step > 0.0 else max(step, min(low - free, 0.0))
        wanted = others + integral
        output = limited(wanted, low, high)
    else:
        held = number(row, INITIAL) if begins else last(row, 0)
        output = limited(read(row, MANUAL) if word(row, HAS_MANUAL) == 1 else held, low, high)
        wanted, integral = output, output - others
    keep(row, INTEGRAL, integral)
    keep(row, RATE, rate)
    keep(row, WEIGHTED, weighted)
    keep(row, LAST_GAIN, gain)
    keep(row, UNLIMITED, wanted)
    keep(row, BEGUN, 1.0)
    write(row, 0, output)


def output_unit(inputs: Mapping[str, Unit], parameters: Mapping[str, Quantity]) -> Unit:
    """Return the unit of the output, of the measurement times Kc."""
    return inputs["measurement"] * Like("Kc")(inputs, parameters)


INPUTS = (
    BlockInput(name="setpoint", unit=Like("measurement"), meaning="r"),
    BlockInput(name="measurement", meaning="y"),
    BlockInput(name="feedforward", unit=output_unit, default=0.0, meaning="f, added before the limits"),
    BlockInput(
        name="manual", unit=output_unit, default=0.0, meaning="what is given in manual; without it, no change"
    ),
    BlockInput(name="automatic", unit="", default=1.0, meaning="0: manual"),
    BlockInput(name="reset", unit="", default=0.0, meaning="other than 0: as at the start"),
)
"""Inputs of both forms."""

TUNING = (
    BlockParameter(name="Kc", unit=None, port=True, meaning="gain, negative where more output lowers y"),
    BlockParameter(
        name="Ti",
        unit="s",
        default=inf,
        above=0.0,
        port=True,
        meaning="integral time; a signal up to 0: none",
    ),
    BlockParameter(name="Td", unit="s", default=0.0, minimum=0.0, port=True, meaning="derivative time"),
    BlockParameter(name="b", default=1.0, minimum=0.0, meaning="weight of r in the proportional part"),
    BlockParameter(
        name="c", default=0.0, minimum=0.0, meaning="weight of r in the derivative; 0: of the measurement"
    ),
    BlockParameter(name="N", default=10.0, above=0.0, meaning="Td over the time constant of its filter"),
    BlockParameter(name="low", unit=output_unit, default=-inf, port=True, meaning="lower limit"),
    BlockParameter(name="high", unit=output_unit, default=inf, port=True, meaning="upper limit"),
)
"""Parameters of both forms."""


def _prepare(setting: Setting) -> Prepared:
    wired = [int(name in setting.connected) for name in ("manual", "tracked")]
    return Prepared(words=wired, states=(0.0,) * (BEGUN + 1))


def _check(setting: Setting) -> Iterator[Misfit]:
    yield from limits_in_order(setting)
    if setting.values["anti_windup"] == CLAMPING:
        unused = [
            *(["tracked"] if "tracked" in setting.connected else []),
            *(["Tt"] if setting.values["Tt"] else []),
        ]
        for name in unused:
            yield Misfit(
                parameter="anti_windup",
                message=f"`{name}` is for back calculation, and the anti-windup is by clamping",
                hint=f'set anti_windup = "{TRACKING}", or leave `{name}` out',
            )


PID = BlockType(
    name="pid",
    summary="PID controller, ISA form, with limits, anti-windup and manual operation",
    equation=(
        "v_k = P + I_k + D + f, y_k = min(max(v_k, low), high); e = r - y. P = Kc (b r - y); "
        "D = Kc Td d_k, d_k = d_{k-1} + T/(Td/N + T) ((w_k - w_{k-1})/T - d_{k-1}), w = c r - y, d_0 = 0; "
        "I_k = I_{k-1} + T Kc/Ti e_k, I_{-1} = initial, so that a change of Ti moves nothing, and one of Kc "
        "only Kc (e + Td d): where b is not 1, I takes (Kc_{k-1} - Kc_k) (b - 1) r. "
        "clamping: e moves I only as far as v meets a limit, and not beyond; back_calculation: "
        "I_k further less T/Tt (v_{k-1} - y_{k-1}), T/Tt at most 1, with `tracked` in place of y. "
        "Manual: y = manual, held by the limits, and I = y - P - D - f, so that automatic goes on from there"
    ),
    source="Astrom, Hagglund: Advanced PID Control, 2006, 3 and 13; IEC 61131-7 B.1, B.2",
    kernel=pid,
    inputs=(
        *INPUTS,
        BlockInput(
            name="tracked", unit=output_unit, default=0.0, meaning="what the actuator made of the output"
        ),
    ),
    parameters=(
        *TUNING,
        BlockParameter(
            name="anti_windup",
            kind="choice",
            choices=(CLAMPING, TRACKING),
            default=CLAMPING,
            meaning="what keeps I from growing at a limit",
        ),
        BlockParameter(
            name="Tt",
            unit="s",
            default=0.0,
            minimum=0.0,
            meaning="tracking time; 0: sqrt(Ti Td), without Td Ti",
        ),
        BlockParameter(name="initial", unit=output_unit, default=0.0, meaning="I before the start"),
    ),
    outputs=(BlockOutput(unit=output_unit, told_by="initial"),),
    prepare=_prepare,
    late=("tracked",),
    check=_check,
)

"""`sensor`: what a measuring device makes of a quantity before the PLC reads it."""

from collections.abc import Iterator
from dataclasses import replace
from math import exp, expm1, inf, isinf

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
from fcl_sim.loop.blocks.noise import drawn
from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.loop.row import Row, keep, number, read, recall, word, write

LAG, BIAS, DRIFT, LOW, HIGH = 0, 1, 2, 5, 6
STEP, ORIGIN, TOP, SAMPLES = 8, 9, 10, 11
LENGTH = 1
VALUE, PREVIOUS, TIME = 0, 1, 2

MOST_BITS = 32
CLOSE = 1e-9
"""A range this near to a whole number of steps, in steps, is one."""


@inlined
def lagged(row: Row, now: float) -> float:
    """Return an input behind the lag, whose input went straight from the last scan's value to `now`."""
    if row.scan == 0:
        return now
    passed = (row.time - recall(row, TIME)) / number(row, LAG)
    kept = exp(-passed)
    mean = -expm1(-passed) / passed
    return kept * recall(row, VALUE) + (mean - kept) * recall(row, PREVIOUS) + (1.0 - mean) * now


@inlined
def sensor(row: Row) -> None:
    """Kernel of `sensor`; a sample of noise for each scan stands behind its numbers."""
    value = read(row, 0)
    if number(row, LAG) > 0.0:
        now = value
        value = lagged(row, now)
        keep(row, VALUE, value)
        keep(row, PREVIOUS, now)
        keep(row, TIME, row.time)
    value += number(row, BIAS) + number(row, DRIFT) * row.time
    value += number(row, SAMPLES + min(row.scan, word(row, LENGTH) - 1))
    if value < number(row, LOW):
        value = number(row, LOW)
    elif value > number(row, HIGH):
        value = number(row, HIGH)
    step, origin = number(row, STEP), number(row, ORIGIN)
    if step > 0.0:
        steps = floor((value - origin) / step + 0.5)
        steps = min(steps, number(row, TOP))
        value = origin + step * steps
    write(row, 0, value)


def _prepare(setting: Setting) -> Prepared:
    values = setting.values
    noise = {"mean": 0.0, "sigma": values["noise"], "correlation_time": values["correlation_time"]}
    samples = drawn(replace(setting, values=noise)) if values["noise"] else [0.0]
    return Prepared(numbers=(*_steps(setting), *samples), words=(len(samples),), states=(0.0, 0.0, 0.0))


def _steps(setting: Setting) -> tuple[float, float, float]:
    """Return what a step is worth, 0 where there are none, the value that has number 0, the last number."""
    values = setting.values
    low, high, bits = values["low"], values["high"], values["bits"]
    if bits:
        return (high - low) / 2**bits, low, 2.0**bits - 1.0
    step, origin = values["resolution"], 0.0 if isinf(low) else low
    top = inf if isinf(high) or not step else float(floor((high - origin) / step + CLOSE))
    return step, origin, top


def _check(setting: Setting) -> Iterator[Misfit]:
    values = setting.values
    low, high = values["low"], values["high"]
    if low >= high:
        yield Misfit(parameter="low", message="`low` does not lie below `high`", hint="exchange the two")
    elif values["bits"] and values["resolution"]:
        yield Misfit(
            parameter="bits", message="both `bits` and `resolution` are given", hint="leave one of them out"
        )
    elif values["bits"] and (isinf(low) or isinf(high)):
        yield Misfit(
            parameter="bits",
            message="`bits` divide a range that is not given",
            hint="give `low` and `high`, or `resolution` in place of `bits`",
        )
    elif values["bits"] > MOST_BITS:
        yield Misfit(parameter="bits", message=f"no converter has more than {MOST_BITS} bits")
    elif values["correlation_time"] and not values["noise"]:
        yield Misfit(
            parameter="correlation_time", message="there is no noise to correlate", hint="give `noise`"
        )


SENSOR = BlockType(
    name="sensor",
    summary="a measuring device: lag, bias, drift, noise, range and resolution, in this order",
    equation=(
        "lag: x' = (u - x)/tau, exact for a u that goes straight from scan to scan: "
        "x_k = a x_{k-1} + (m - a) u_{k-1} + (1 - m) u_k, a = exp(-h), m = (1 - a)/h, "
        "h = (t_k - t_{k-1})/tau, x_0 = u_0; v = x + bias + drift t + noise n_k, n_k as those of `noise`; "
        "range: w = min(max(v, low), high); "
        "resolution: y = o + q min(floor((w - o)/q + 1/2), c), with bits q = (high - low)/2^bits, o = low, "
        "c = 2^bits - 1, so that the greatest value is high - q; "
        "else q = resolution, o = low if there is one, else 0, c = floor((high - o)/q). "
        "t is the time at which a scan reads, whatever cycle time the blocks take; what is not given has "
        "no effect"
    ),
    source=(
        "Franklin, Powell, Workman: Digital Control of Dynamic Systems, 6.3.2, triangle-hold equivalent; "
        "Kester: The Data Conversion Handbook, 2005, 2.1"
    ),
    kernel=sensor,
    inputs=(BlockInput(name="input", meaning="u, the quantity that is measured"),),
    parameters=(
        BlockParameter(name="lag", unit="s", default=0.0, minimum=0.0, meaning="tau, time constant"),
        BlockParameter(
            name="bias", unit=Like("input", apart=True), default=0.0, meaning="error that stays the same"
        ),
        BlockParameter(
            name="drift", unit=Like("input", "1/s"), default=0.0, meaning="growth of the error in time"
        ),
        BlockParameter(
            name="noise",
            unit=Like("input"),
            default=0.0,
            minimum=0.0,
            meaning="standard deviation of the noise",
        ),
        BlockParameter(
            name="correlation_time",
            unit="s",
            default=0.0,
            minimum=0.0,
            meaning="of the noise; 0: white",
        ),
        BlockParameter(name="low", unit=Like("input"), default=-inf, meaning="beginning of the range"),
        BlockParameter(name="high", unit=Like("input"), default=inf, meaning="end of the range"),
        BlockParameter(
            name="resolution",
            unit=Like("input", apart=True),
            default=0.0,
            minimum=0.0,
            meaning="what a step is worth",
        ),
        BlockParameter(
            name="bits", kind="count", default=0, meaning="of the converter, in place of `resolution`"
        ),
    ),
    outputs=(BlockOutput(unit=Like("input")),),
    prepare=_prepare,
    check=_check,
    device=True,
)

"""`ramp`, `pulse`, `sine` and `chirp`: sources that follow a formula of time."""

from collections.abc import Iterator
from math import exp, log, pi, sin

from numpy import floor

from fcl_sim.jit import inlined
from fcl_sim.loop.blocks.declaration import (
    BlockOutput,
    BlockParameter,
    BlockType,
    Like,
    Misfit,
    Prepared,
)
from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.loop.row import Row, number, write

CLOSE = 1e-9
"""A time this near to an edge, in periods, is at it: 0.3 s is three periods of 0.1 s."""


@inlined
def ramp(row: Row) -> None:
    """Kernel of `ramp`; numbers: before, after, at, duration."""
    before, after = number(row, 0), number(row, 1)
    part = (row.time - number(row, 2)) / number(row, 3)
    write(row, 0, before if part <= 0.0 else after if part >= 1.0 else before + part * (after - before))


RAMP = BlockType(
    name="ramp",
    summary="one value, then on a straight line to another",
    equation=(
        "y = before + min(max((t - at)/duration, 0), 1) (after - before); "
        "t is the start of the scan; no memory"
    ),
    source="of its own",
    kernel=ramp,
    parameters=(
        BlockParameter(name="before", unit=Like("after"), default=0.0, meaning="value before the ramp"),
        BlockParameter(name="after", unit=None, meaning="value behind it, with its unit"),
        BlockParameter(name="at", unit="s", default="0 s", meaning="time at which it begins"),
        BlockParameter(name="duration", unit="s", above=0.0, meaning="time that it takes"),
    ),
    outputs=(BlockOutput(unit=Like("after")),),
)


@inlined
def pulse(row: Row) -> None:
    """Kernel of `pulse`; numbers: low, high, period, duty, at."""
    periods = (row.time - number(row, 4)) / number(row, 2) + CLOSE
    high = periods >= 0.0 and periods - floor(periods) < number(row, 3)
    write(row, 0, number(row, 1) if high else number(row, 0))


PULSE = BlockType(
    name="pulse",
    summary="two values in turns",
    equation=(
        "y = high where t >= at and (t - at)/period - floor((t - at)/period) < duty, else low; "
        "t is the start of the scan; no memory"
    ),
    source="square wave, closed on the left",
    kernel=pulse,
    parameters=(
        BlockParameter(name="low", unit=Like("high"), default=0.0, meaning="value between pulses"),
        BlockParameter(name="high", unit=None, default=1.0, meaning="value of a pulse, with its unit"),
        BlockParameter(name="period", unit="s", above=0.0, meaning="time from one pulse to the next"),
        BlockParameter(
            name="duty",
            unit="",
            default=0.5,
            minimum=0.0,
            maximum=1.0,
            meaning="part of a period, high",
        ),
        BlockParameter(name="at", unit="s", default="0 s", meaning="time of the first pulse"),
    ),
    outputs=(BlockOutput(unit=Like("high")),),
)

AMPLITUDE = BlockParameter(name="amplitude", unit=None, default=1.0, meaning="half its swing, with its unit")
OFFSET = BlockParameter(name="offset", unit=Like("amplitude"), default=0.0, meaning="what it swings about")
PHASE = BlockParameter(name="phase", unit="rad", default="0 deg", meaning="angle at the start")


@inlined
def sine(row: Row) -> None:
    """Kernel of `sine`; numbers: amplitude, offset, phase, frequency."""
    angle = 2.0 * pi * (number(row, 3) * row.time) + number(row, 2)
    write(row, 0, number(row, 1) + number(row, 0) * sin(angle))


SINE = BlockType(
    name="sine",
    summary="a sine",
    equation="y = offset + amplitude sin(2 pi frequency t + phase); t is the start of the scan; no memory",
    source="of its own",
    kernel=sine,
    parameters=(
        AMPLITUDE,
        OFFSET,
        PHASE,
        BlockParameter(name="frequency", unit="Hz", minimum=0.0, meaning="periods in a second"),
    ),
    outputs=(BlockOutput(unit=Like("amplitude")),),
)

GROWTH = 6


@inlined
def chirp(row: Row) -> None:
    """Kernel of `chirp`; numbers: amplitude, offset, phase, start, end, duration, growth."""
    start, end, duration = number(row, 3), number(row, 4), number(row, 5)
    growth = number(row, GROWTH)
    swept = min(row.time, duration)
    if growth == 0.0:
        turns = swept * (start + 0.5 * (end - start) * (swept / duration))
    else:
        turns = start * duration / growth * (exp(growth * (swept / duration)) - 1.0)
    turns += (row.time - swept) * end
    write(row, 0, number(row, 1) + number(row, 0) * sin(2.0 * pi * turns + number(row, 2)))


def _growth(setting: Setting) -> Prepared:
    values = setting.values
    exponential = values["sweep"] == "exponential" and values["start"] != values["end"]
    return Prepared(numbers=(log(values["end"] / values["start"]) if exponential else 0.0,))


def _check(setting: Setting) -> Iterator[Misfit]:
    values = setting.values
    for name in ("start", "end"):
        if values["sweep"] == "exponential" and not values[name] > 0.0:
            message = f"an exponential sweep has no `{name}` of 0 Hz"
            yield Misfit(parameter=name, message=message, hint="give a frequency above 0, or sweep linearly")


CHIRP = BlockType(
    name="chirp",
    summary="a sine whose frequency goes from one to another",
    equation=(
        "y = offset + amplitude sin(2 pi n(t) + phase), n' = f, n(0) = 0; "
        "linear: f = start + (end - start) t/D; "
        "exponential: f = start (end/start)^(t/D); D the duration, from there on f = end; "
        "t is the start of the scan; no memory"
    ),
    source="Farina: Simultaneous measurement of impulse response and distortion with a swept sine, 2000",
    kernel=chirp,
    parameters=(
        AMPLITUDE,
        OFFSET,
        PHASE,
        BlockParameter(name="start", unit="Hz", minimum=0.0, meaning="frequency at first"),
        BlockParameter(name="end", unit="Hz", minimum=0.0, meaning="frequency at the end"),
        BlockParameter(name="duration", unit="s", above=0.0, meaning="time from one to the other"),
        BlockParameter(
            name="sweep",
            kind="choice",
            choices=("linear", "exponential"),
            default="linear",
            meaning="how the frequency goes",
        ),
    ),
    outputs=(BlockOutput(unit=Like("amplitude")),),
    prepare=_growth,
    check=_check,
)

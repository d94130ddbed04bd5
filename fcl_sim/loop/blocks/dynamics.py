"""`first_order_lag`, `second_order_lag` and `lead_lag`."""

from math import cos, exp, expm1, sin, sqrt

from fcl_sim.jit import flat, inlined
from fcl_sim.loop.blocks.declaration import (
    BlockInput,
    BlockOutput,
    BlockParameter,
    BlockType,
    Like,
    Prepared,
)
from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.loop.row import Row, keep, number, read, recall, word, write

HELD, BACKWARD, TRAPEZOIDAL = "zero_order_hold", "backward", "trapezoidal"
METHODS = (HELD, BACKWARD, TRAPEZOIDAL)

VALUE, PREVIOUS = 0, 1
VELOCITY = 1
FREQUENCY, DAMPING = 0, 1
LEAD, LAG = 0, 1


@inlined
def share(cycle: float, lag: float) -> float:
    """Return how much of a step a first-order lag follows within a cycle; all of it without a lag."""
    followed: float = -expm1(-cycle / lag) if lag > 0.0 else 1.0
    return followed


@inlined
def first_order_lag(row: Row) -> None:
    """Kernel of `first_order_lag`; behind a hold its input is that of the last scan."""
    now, lag, before = read(row, 0), max(read(row, 1), 0.0), recall(row, VALUE)
    method = word(row, 0)
    if method == 0:
        value = before + share(row.cycle, lag) * (now - before)
    elif method == 1:
        value = before + row.cycle / (lag + row.cycle) * (now - before)
    else:
        moves = (now - before) + (recall(row, PREVIOUS) - before)
        value = before + row.cycle / (2.0 * lag + row.cycle) * moves
    keep(row, VALUE, value)
    keep(row, PREVIOUS, now)
    write(row, 0, value)


def _held(setting: Setting) -> tuple[str, ...]:
    return ("input",) if setting.values["method"] == HELD else ()


def _settled(setting: Setting) -> Prepared:
    initial = setting.values["initial"]
    return Prepared(states=(initial, initial), late={"input": initial})


INPUT = (BlockInput(name="input", meaning="u"),)
INITIAL = BlockParameter(
    name="initial", unit=Like("input"), default=0.0, meaning="input and output before the start, settled"
)
OUTPUT = (BlockOutput(unit=Like("input"), told_by="initial"),)

FIRST_ORDER_LAG = BlockType(
    name="first_order_lag",
    summary="a signal that follows another with a time constant",
    equation=(
        "1/(1 + s Tc). zero_order_hold, exact where u is held between scans: "
        "y_k = y_{k-1} + (1 - exp(-T/Tc)) (u_{k-1} - y_{k-1}), no feedthrough; "
        "backward: y_k = y_{k-1} + T/(Tc + T) (u_k - y_{k-1}); "
        "trapezoidal: y_k = y_{k-1} + T/(2 Tc + T) (u_k + u_{k-1} - 2 y_{k-1}). "
        "u_{-1} = y_{-1} = initial; without a time constant above 0, y is u, behind a hold a scan late"
    ),
    source="Astrom, Wittenmark: Computer-Controlled Systems, table 2.1 and 8.2",
    kernel=first_order_lag,
    inputs=INPUT,
    parameters=(
        BlockParameter(
            name="time_constant", unit="s", minimum=0.0, port=True, meaning="Tc, after which it is 63 % there"
        ),
        BlockParameter(
            name="method", kind="choice", choices=METHODS, default=HELD, meaning="rule of discretisation"
        ),
        INITIAL,
    ),
    outputs=OUTPUT,
    prepare=_settled,
    late=_held,
)


@inlined
def second_order_lag(row: Row) -> None:
    """Kernel of `second_order_lag`; its input is late already.

    `fade` and `swing` are exp(-zeta w t) times the cosine of wd t and times its
    sine over wd, at t = T; beyond zeta = 1 the hyperbolic ones.
    """
    target, cycle = read(row, 0), row.cycle
    w, damping = number(row, FREQUENCY), number(row, DAMPING)
    decay = damping * w
    if damping < 1.0:
        own = w * sqrt((1.0 - damping) * (1.0 + damping))
        size = exp(-decay * cycle)
        fade, swing = size * cos(own * cycle), size * sin(own * cycle) / own
    elif damping == 1.0:
        fade = exp(-decay * cycle)
        swing = fade * cycle
    else:
        apart = w * sqrt((damping - 1.0) * (damping + 1.0))
        half = 0.5 * exp(-w * w / (decay + apart) * cycle)
        fade, swing = half * (1.0 + exp(-2.0 * apart * cycle)), -half * expm1(-2.0 * apart * cycle) / apart
    distance, velocity = recall(row, VALUE) - target, recall(row, VELOCITY)
    value = target + ((fade + decay * swing) * distance + swing * velocity)
    keep(row, VALUE, value)
    keep(row, VELOCITY, (fade - decay * swing) * velocity - w * w * swing * distance)
    write(row, 0, value)


def _at_rest(setting: Setting) -> Prepared:
    initial = setting.values["initial"]
    return Prepared(states=(initial, 0.0), late={"input": initial})


SECOND_ORDER_LAG = BlockType(
    name="second_order_lag",
    summary="a signal that follows another as a damped oscillator",
    equation=(
        "w^2/(s^2 + 2 zeta w s + w^2), exact where u is held between scans: y_k is at t = T the solution of "
        "y'' + 2 zeta w y' + w^2 (y - u_{k-1}) = 0 from y_{k-1} and y'_{k-1}; "
        "u_{-1} = y_{-1} = initial, y'_{-1} = 0"
    ),
    source="Astrom, Wittenmark: Computer-Controlled Systems, table 2.1",
    kernel=second_order_lag,
    inputs=INPUT,
    parameters=(
        BlockParameter(name="natural_frequency", unit="rad/s", above=0.0, meaning="w, of the undamped swing"),
        BlockParameter(name="damping", minimum=0.0, meaning="zeta; from 1 on nothing swings"),
        INITIAL,
    ),
    outputs=OUTPUT,
    prepare=_at_rest,
    late=("input",),
)


@inlined
def lead_lag(row: Row) -> None:
    """Kernel of `lead_lag`; VALUE is what a lag alone gives."""
    now, lagged = read(row, 0), recall(row, VALUE)
    lagged = lagged + share(row.cycle, number(row, LAG)) * (recall(row, PREVIOUS) - lagged)
    keep(row, VALUE, lagged)
    keep(row, PREVIOUS, now)
    write(row, 0, lagged + number(row, LEAD) / number(row, LAG) * (now - lagged))


LEAD_LAG = BlockType(
    name="lead_lag",
    summary="a signal with its changes brought forward and smoothed, of gain 1",
    equation=(
        "(1 + s T1)/(1 + s T2), exact where u is held between scans: y_k = x_k + T1/T2 (u_k - x_k), "
        "x_k = x_{k-1} + (1 - exp(-T/T2)) (u_{k-1} - x_{k-1}); u_{-1} = x_{-1} = initial"
    ),
    source="Astrom, Wittenmark: Computer-Controlled Systems, table 2.1, of 1 - T1/T2 and a lag beside T1/T2",
    kernel=lead_lag,
    inputs=INPUT,
    parameters=(
        BlockParameter(name="lead", unit="s", minimum=0.0, meaning="T1, time constant above"),
        BlockParameter(name="lag", unit="s", above=0.0, meaning="T2, time constant below"),
        INITIAL,
    ),
    outputs=OUTPUT,
    prepare=_settled,
)

TABLE = (FIRST_ORDER_LAG, SECOND_ORDER_LAG, LEAD_LAG)


@flat
def execute(code: int, row: Row) -> None:
    """Execute a block of this family by its row in TABLE."""
    if code == 0:
        first_order_lag(row)
    elif code == 1:
        second_order_lag(row)
    elif code == 2:
        lead_lag(row)

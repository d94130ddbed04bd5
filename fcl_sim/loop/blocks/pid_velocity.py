"""`pid_velocity`: PID in increments, integrated behind the limits or by the actuator."""

from fcl_sim.jit import inlined
from fcl_sim.loop.blocks.declaration import BlockOutput, BlockParameter, BlockType, Prepared
from fcl_sim.loop.blocks.limiter import limits_in_order
from fcl_sim.loop.blocks.pid import (
    AUTOMATIC,
    FEEDFORWARD,
    INPUTS,
    MANUAL,
    MEASUREMENT,
    RESET,
    SETPOINT,
    TUNING,
    B,
    C,
    limited,
    output_unit,
    rate_of,
    time_or_never,
)
from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.loop.row import Row, keep, last, number, read, recall, word, write

POSITION, INCREMENT = "position", "increment"

GAIN, INTEGRAL_TIME, DERIVATIVE_TIME, LOW, HIGH = range(6, 11)
INITIAL = 3
GIVES, HAS_MANUAL = range(2)
PROPORTIONAL, WEIGHTED, RATE, FORWARD, BEGUN = range(5)


@inlined
def pid_velocity(row: Row) -> None:
    """Kernel of `pid_velocity`."""
    setpoint, measurement, forward = read(row, SETPOINT), read(row, MEASUREMENT), read(row, FEEDFORWARD)
    gain, derivative_time = read(row, GAIN), max(read(row, DERIVATIVE_TIME), 0.0)
    proportional = number(row, B) * setpoint - measurement
    weighted = number(row, C) * setpoint - measurement
    stands = last(row, 0) if word(row, GIVES) == 0 else 0.0
    rate = 0.0
    step = row.cycle * gain / time_or_never(read(row, INTEGRAL_TIME)) * (setpoint - measurement)
    if recall(row, BEGUN) == 0.0 or read(row, RESET) != 0.0:
        stands = number(row, INITIAL) if word(row, GIVES) == 0 else 0.0
    else:
        before = recall(row, RATE)
        rate = rate_of(row, before, weighted - recall(row, WEIGHTED), derivative_time)
        step += gain * (proportional - recall(row, PROPORTIONAL)) + gain * derivative_time * (rate - before)
        step += forward - recall(row, FORWARD)
    if read(row, AUTOMATIC) != 0.0:
        wanted = stands + step
    else:
        wanted = read(row, MANUAL) if word(row, HAS_MANUAL) == 1 else stands
    keep(row, PROPORTIONAL, proportional)
    keep(row, WEIGHTED, weighted)
    keep(row, RATE, rate)
    keep(row, FORWARD, forward)
    keep(row, BEGUN, 1.0)
    write(row, 0, limited(wanted, read(row, LOW), read(row, HIGH)))


def _prepare(setting: Setting) -> Prepared:
    return Prepared(words=(int("manual" in setting.connected),), states=(0.0,) * (BEGUN + 1))


PID_VELOCITY = BlockType(
    name="pid_velocity",
    summary="PID controller in increments, which cannot wind up",
    equation=(
        "s_k = Kc (p_k - p_{k-1}) + T Kc/Ti e_k + Kc Td (d_k - d_{k-1}) + f_k - f_{k-1}; e = r - y, "
        "p = b r - y, d as of `pid`; s_0 = T Kc/Ti e_0. "
        "position: y_k = min(max(y_{k-1} + s_k, low), high), y_{-1} = initial; "
        "increment: y_k = min(max(s_k, low), high), for an actuator that integrates. "
        "No change of Kc, Ti or Td alone moves y more than s. Manual: y = manual, held by the limits"
    ),
    source="IEC 61131-7 A.3, figure A.13; Astrom, Hagglund: Advanced PID Control, 2006, 13",
    kernel=pid_velocity,
    inputs=INPUTS,
    parameters=(
        *TUNING,
        BlockParameter(
            name="gives",
            kind="choice",
            choices=(POSITION, INCREMENT),
            default=POSITION,
            meaning="the output itself, or its increment of each scan",
        ),
        BlockParameter(
            name="initial", unit=output_unit, default=0.0, meaning="output before the start, as a position"
        ),
    ),
    outputs=(BlockOutput(unit=output_unit, told_by="initial"),),
    prepare=_prepare,
    check=limits_in_order,
)

"""`actuator`: what a control element makes of its command."""

from collections.abc import Iterator
from math import fabs, inf

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
from fcl_sim.loop.row import Row, keep, number, read, recall, write

DEAD_BAND, LOW, HIGH, STICTION, RATE, BACKLASH = range(6)
MOVER, MOVING, OUTPUT, TIME = range(4)


@inlined
def commanded(row: Row) -> float:
    """Return where the moved part is to go."""
    value, width = read(row, 0), number(row, DEAD_BAND)
    if value > width:
        value -= width
    elif value < -width:
        value += width
    elif width > 0.0:
        value = 0.0
    return min(max(value, number(row, LOW)), number(row, HIGH))


@inlined
def actuator(row: Row) -> None:
    """Kernel of `actuator`."""
    goal, mover = commanded(row), recall(row, MOVER)
    if recall(row, MOVING) > 0.5 or fabs(goal - mover) > number(row, STICTION):
        reach = number(row, RATE) * (row.time - recall(row, TIME))
        if fabs(goal - mover) <= reach:
            mover = goal
        elif goal > mover:
            mover += reach
        else:
            mover -= reach
        keep(row, MOVER, mover)
        keep(row, MOVING, 0.0 if mover == goal else 1.0)
    play = 0.5 * number(row, BACKLASH)
    driven = min(max(recall(row, OUTPUT), mover - play), mover + play)
    keep(row, OUTPUT, driven)
    keep(row, TIME, row.time)
    write(row, 0, driven)


def _prepare(setting: Setting) -> Prepared:
    initial = setting.values["initial"]
    return Prepared(states=(initial, 0.0, initial, -setting.cycle))


def _check(setting: Setting) -> Iterator[Misfit]:
    low, high, initial = (setting.values[each] for each in ("low", "high", "initial"))
    if low > high:
        yield Misfit(parameter="low", message="`low` lies above `high`", hint="exchange the two")
    elif not low <= initial <= high:
        yield Misfit(
            parameter="initial",
            message="it starts at a value beyond `low` and `high`",
            hint="give `initial` within them",
        )


ACTUATOR = BlockType(
    name="actuator",
    summary="a control element: dead band, saturation, stiction, rate and backlash, in this order",
    equation=(
        "dead band: v = 0 where |u| <= w, else sign(u) (|u| - w); saturation: g = min(max(v, low), high); "
        "stiction: what is moved, m, rests until |g_k - m_{k-1}| > stiction, then goes for g until it is "
        "there; rate: |m_k - m_{k-1}| <= rate (t_k - t_{k-1}), t_{-1} = -T; "
        "backlash: y_k = min(max(y_{k-1}, m_k - b/2), m_k + b/2); m_{-1} = y_{-1} = initial. "
        "t is the time at which a scan reads, whatever cycle time the blocks take; what is not given has "
        "no effect"
    ),
    source=(
        "Stenman, Gustafsson, Forsman: A segmentation-based method for detection of stiction in control "
        "valves, 2003, for a rate without limit; Tao, Kokotovic: Adaptive Control of Systems with Actuator "
        "and Sensor Nonlinearities, 1996, 2.2 and 2.3"
    ),
    kernel=actuator,
    inputs=(BlockInput(name="input", meaning="u, the command"),),
    parameters=(
        BlockParameter(
            name="dead_band",
            unit=Like("input"),
            default=0.0,
            minimum=0.0,
            meaning="w, half the width of the commands about 0 that move nothing",
        ),
        BlockParameter(name="low", unit=Like("input"), default=-inf, meaning="lower end of the travel"),
        BlockParameter(name="high", unit=Like("input"), default=inf, meaning="upper end of the travel"),
        BlockParameter(
            name="stiction",
            unit=Like("input"),
            default=0.0,
            minimum=0.0,
            meaning="change of the command that does not yet move it",
        ),
        BlockParameter(
            name="rate", unit=Like("input", "1/s"), default=inf, above=0.0, meaning="speed, both ways"
        ),
        BlockParameter(
            name="backlash",
            unit=Like("input"),
            default=0.0,
            minimum=0.0,
            meaning="b, play from one side to the other",
        ),
        BlockParameter(name="initial", unit=Like("input"), default=0.0, meaning="where it stands at first"),
    ),
    outputs=(BlockOutput(unit=Like("input")),),
    prepare=_prepare,
    check=_check,
    device=True,
)

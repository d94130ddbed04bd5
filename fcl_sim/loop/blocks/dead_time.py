"""`dead_time`: a signal as it was some time ago, fixed or varying."""

from collections.abc import Iterator
from math import fabs, floor, inf, isinf

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
from fcl_sim.loop.blocks.windows import CLOSE
from fcl_sim.loop.row import Row, keep, number, read, recall, word, write

LINEAR, HELD = "linear", "hold"
BETWEEN = (LINEAR, HELD)

AGE_OF_INPUT, LENGTH = 1, 2
SCAN, YOUNGEST, OLDEST = 3, 4, 5
POSITION, RING = 0, 1


@inlined
def whole_where_close(scans: float) -> float:
    """Return a number of scans without the rounding of a division."""
    whole: float = floor(scans + 0.5)
    return whole if fabs(scans - whole) <= CLOSE else scans


@inlined
def dead_time(row: Row) -> None:
    """Kernel of `dead_time`; ages count scans from the newest value in the ring."""
    length, position = word(row, LENGTH), int(recall(row, POSITION))
    keep(row, RING + position, read(row, 0))
    keep(row, POSITION, position + 1 if position + 1 < length else 0)
    age = number(row, YOUNGEST)
    wanted = read(row, 1) / number(row, SCAN) - word(row, AGE_OF_INPUT)
    if wanted > age:  # not so where it is no number, which must reach no index
        age = min(whole_where_close(wanted), number(row, OLDEST))
    scans = int(age)
    part = age - scans
    at = position - scans
    value = recall(row, RING + (at if at >= 0 else at + length))
    if part > 0.0:
        before = recall(row, RING + (at - 1 if at > 0 else at - 1 + length))
        value = before if word(row, 0) == 1 else value + part * (before - value)
    write(row, 0, value)


def _extremes(setting: Setting) -> tuple[float, float]:
    """Return the least and the greatest dead time in scans."""
    values, cycle = setting.values, setting.cycle
    least, most = values["shortest"], values["longest"]
    if "time" not in setting.connected:
        least = most = values["time"]
    return whole_where_close(least / cycle), whole_where_close(most / cycle)


def _late(setting: Setting) -> tuple[str, ...]:
    values = setting.values
    least = values.get("shortest" if "time" in setting.connected else "time", 0.0)
    return ("input",) if whole_where_close(least / setting.cycle) >= 1.0 else ()


def _prepare(setting: Setting) -> Prepared:
    least, most = _extremes(setting)
    age, initial = len(_late(setting)), setting.values["initial"]
    length = int(most) - age + 2
    return Prepared(
        numbers=(setting.cycle, least - age, most - age),
        words=(age, length),
        states=(0.0, *[initial] * length),
        late={"input": initial},
    )


def _check(setting: Setting) -> Iterator[Misfit]:
    shortest, longest = setting.values["shortest"], setting.values["longest"]
    if shortest > longest:
        yield Misfit(parameter="shortest", message="`shortest` lies above `longest`", hint="exchange the two")
    elif "time" in setting.connected and isinf(longest):
        yield Misfit(
            parameter="longest",
            message="a dead time that is a signal needs its `longest`",
            hint="so much of the input is kept; where the signal is greater, this is taken",
        )
    elif "time" not in setting.connected and not shortest <= setting.values["time"] <= longest:
        yield Misfit(parameter="time", message="`time` lies beyond `shortest` and `longest`")


DEAD_TIME = BlockType(
    name="dead_time",
    summary="a signal as it was some time ago, also a varying time",
    equation=(
        "y(t_k) = u(t_k - min(max(theta_k, shortest), longest)), with t_k = k T, T nominal; between scans u "
        "is on the straight line from one to the next, or held, as told; u = initial before the start. "
        "From one scan on (for a signal: `shortest`) there is no feedthrough. "
        "A theta that varies picks an older or newer value; what is on its way in a pipe of varying flow "
        "is a matter of the plant"
    ),
    source="z-transform of exp(-s theta); Laakso et al.: Splitting the unit delay, 1996, of order 1",
    kernel=dead_time,
    inputs=(BlockInput(name="input", meaning="u"),),
    parameters=(
        BlockParameter(
            name="time", unit="s", minimum=0.0, port=True, meaning="theta, whole scans or anything between"
        ),
        BlockParameter(name="between", kind="choice", choices=BETWEEN, default=LINEAR, meaning="u there"),
        BlockParameter(
            name="shortest", unit="s", default=0.0, minimum=0.0, meaning="lower bound of a theta that varies"
        ),
        BlockParameter(
            name="longest", unit="s", default=inf, minimum=0.0, meaning="upper bound of a theta that varies"
        ),
        BlockParameter(name="initial", unit=Like("input"), default=0.0, meaning="the input before the start"),
    ),
    outputs=(BlockOutput(unit=Like("input"), told_by="initial"),),
    prepare=_prepare,
    late=_late,
    check=_check,
)

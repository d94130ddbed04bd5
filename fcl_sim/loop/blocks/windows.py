"""`moving_average` and `sample_hold`: blocks that count scans."""

from collections.abc import Iterator

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
from fcl_sim.loop.row import Row, keep, read, recall, word, write

CLOSE = 1e-9
"""A time this near to a whole number of scans, in scans, is one."""

LENGTH = 1
POSITION, FILLED, RING = 0, 1, 2
LEFT = 0


def _scans(setting: Setting) -> int:
    given: int = setting.values["scans"]
    return given or round(setting.values["duration"] / setting.cycle)


def _check_scans(setting: Setting) -> Iterator[Misfit]:
    """Yield what is wrong, unless it is a number of scans or else a time of so many whole ones."""
    duration, scans = setting.values["duration"], setting.values["scans"]
    exact = duration / setting.cycle
    if duration and scans:
        yield Misfit(
            parameter="scans", message="both `duration` and `scans` are given", hint="leave one of them out"
        )
    elif not duration and not scans:
        yield Misfit(
            parameter="duration", message="it has no length", hint="give its `duration` or its `scans`"
        )
    elif duration and (abs(exact - round(exact)) > CLOSE or round(exact) < 1):
        whole = max(1, round(exact))
        yield Misfit(
            parameter="duration",
            message=f"{duration:.9g} s is not a whole number of scans of {setting.cycle:.9g} s",
            hint=f"{whole * setting.cycle:.9g} s would do",
        )


LENGTHS = (
    BlockParameter(name="duration", unit="s", default=0.0, minimum=0.0, meaning="time in whole scans"),
    BlockParameter(name="scans", kind="count", default=0, meaning="n, in place of `duration`"),
)


@inlined
def moving_average(row: Row) -> None:
    """Kernel of `moving_average`; it adds up all over each time, so that nothing is carried along."""
    length, position = word(row, LENGTH), int(recall(row, POSITION))
    filled = min(int(recall(row, FILLED)) + 1, length)
    keep(row, RING + position, read(row, 0))
    keep(row, POSITION, position + 1 if position + 1 < length else 0)
    keep(row, FILLED, filled)
    total = 0.0
    for i in range(filled):
        total += recall(row, RING + i)
    write(row, 0, total / filled)


def _ring(setting: Setting) -> Prepared:
    scans = _scans(setting)
    return Prepared(words=(scans,), states=(0.0,) * (RING + scans))


MOVING_AVERAGE = BlockType(
    name="moving_average",
    summary="mean of a signal over the last scans",
    equation="y_k = (u_k + ... + u_{k-m+1}) / m, m = min(n, k + 1); y_0 = u_0",
    source="Smith: The Scientist and Engineer's Guide to Digital Signal Processing, 15",
    kernel=moving_average,
    inputs=(BlockInput(name="input", meaning="u"),),
    parameters=LENGTHS,
    outputs=(BlockOutput(unit=Like("input")),),
    prepare=_ring,
    check=_check_scans,
)


@inlined
def sample_hold(row: Row) -> None:
    """Kernel of `sample_hold`; between samples the output is left as it is."""
    left = int(recall(row, LEFT))
    if left == 0:
        write(row, 0, read(row, 0))
        left = word(row, LENGTH)
    keep(row, LEFT, left - 1)


def _countdown(setting: Setting) -> Prepared:
    return Prepared(words=(_scans(setting),), states=(0.0,))


SAMPLE_HOLD = BlockType(
    name="sample_hold",
    summary="a signal sampled every so many scans, and held in between",
    equation="y_k = u_j, j = n floor(k / n); y_0 = u_0",
    source="Astrom, Wittenmark: Computer-Controlled Systems, 1.3; a task of a longer cycle time",
    kernel=sample_hold,
    inputs=(BlockInput(name="input", meaning="u"),),
    parameters=LENGTHS,
    outputs=(BlockOutput(unit=Like("input")),),
    prepare=_countdown,
    check=_check_scans,
)

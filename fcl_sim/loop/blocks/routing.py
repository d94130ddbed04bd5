"""`switch` and `selector`, and the family of blocks that choose among signals and share one out."""

from collections.abc import Iterator

from fcl_sim.jit import flat, inlined
from fcl_sim.loop.blocks.classifier import CLASSIFIER, classifier
from fcl_sim.loop.blocks.declaration import (
    BlockInput,
    BlockInputs,
    BlockOutput,
    BlockParameter,
    BlockType,
    Like,
    Misfit,
)
from fcl_sim.loop.blocks.distribute import DISTRIBUTE, distribute
from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.loop.row import Row, inputs, read, word, write

WHEN, LEVEL, THEN, OTHERWISE = range(4)


@inlined
def switch(row: Row) -> None:
    """Kernel of `switch`."""
    write(row, 0, read(row, THEN) if read(row, WHEN) >= read(row, LEVEL) else read(row, OTHERWISE))


SWITCH = BlockType(
    name="switch",
    summary="one of two signals, as a flag or a level says",
    equation="y = then where when >= level, else otherwise; no memory",
    source="IEC 61131-3 6.6.2.5.7, SEL",
    kernel=switch,
    inputs=(BlockInput(name="when", meaning="the flag, 0 or 1, or the signal that is compared"),),
    parameters=(
        BlockParameter(
            name="level", unit=Like("when"), default=0.5, port=True, meaning="from here on it is `then`"
        ),
        BlockParameter(name="then", unit=None, port=True, meaning="y from the level on"),
        BlockParameter(name="otherwise", unit=Like("then"), port=True, meaning="y below it"),
    ),
    outputs=(BlockOutput(unit=Like("then")),),
)

BY = ("index", "min", "max", "median")
BY_INDEX, BY_MIN, BY_MAX, BY_MEDIAN = range(4)
INDEX, FIRST = 0, 1


@flat
def indexed(row: Row, count: int) -> float:
    """Return the input that the index names, counted from 0, the nearest end where it names none."""
    index = read(row, INDEX) + 0.5
    at = 0
    while at + 1 < count and index >= at + 1.0:
        at += 1
    return read(row, FIRST + at)


@flat
def extreme(row: Row, count: int, sign: float) -> float:
    """Return the greatest input, the least for sign -1; NaN where one is NaN."""
    found = read(row, FIRST)
    for i in range(1, count):
        value = read(row, FIRST + i)
        if sign * value > sign * found or value != value:  # noqa: PLR0124  NaN is not itself
            found = value
    return found


@flat
def ranked(row: Row, count: int, rank: int) -> float:
    """Return the input that has `rank` others before it; NaN where one is NaN, which comes before all."""
    found = read(row, FIRST)
    for i in range(count):
        value, before = read(row, FIRST + i), 0
        if value != value:  # noqa: PLR0124
            return value
        for j in range(count):
            other = read(row, FIRST + j)
            if other < value or (other == value and j < i):
                before += 1
        if before == rank:
            found = value
    return found


@flat
def middle(row: Row, count: int) -> float:
    """Return the median of the inputs."""
    upper = ranked(row, count, count >> 1)
    if count & 1:
        return upper
    below: float = 0.5 * (ranked(row, count, (count >> 1) - 1) + upper)
    return below


@inlined
def selector(row: Row) -> None:
    """Kernel of `selector`."""
    by, count = word(row, 0), inputs(row) - FIRST
    if by == BY_INDEX:
        write(row, 0, indexed(row, count))
    elif by == BY_MEDIAN:
        write(row, 0, middle(row, count))
    else:
        write(row, 0, extreme(row, count, 1.0 if by == BY_MAX else -1.0))


def _index_where_needed(setting: Setting) -> Iterator[Misfit]:
    given, wanted = "index" in setting.connected, setting.values["by"] == "index"
    if wanted and not given:
        yield Misfit(parameter="by", message="its `index` is not connected", hint="name the signal: index")
    elif given and not wanted:
        message = f"`index` has no effect, since it selects by {setting.values['by']}"
        yield Misfit(parameter="by", message=message, hint='leave it out, or write by = "index"')


SELECTOR = BlockType(
    name="selector",
    summary="one of several signals: by index, or the least, the greatest, the median",
    equation=(
        "index: y = u_{k+1}, k the whole number next to `index`, held between 0 and n - 1; "
        "min, max; median: the middle one, of an even number the mean of the two; "
        "but by index, NaN where one of them is NaN; no memory"
    ),
    source="IEC 61131-3 6.6.2.5.7, MUX, MIN, MAX; median select of redundant transmitters",
    kernel=selector,
    inputs=(BlockInput(name="index", meaning="which one, from 0 on", unit="", default=0.0),),
    group=BlockInputs(name="inputs", meaning="u_1, u_2, ...", least=2, unit=Like("1")),
    parameters=(BlockParameter(name="by", kind="choice", choices=BY, meaning="what it selects by"),),
    outputs=(BlockOutput(unit=Like("1")),),
    check=_index_where_needed,
)

TABLE = (SWITCH, SELECTOR, DISTRIBUTE, CLASSIFIER)


@flat
def execute(code: int, row: Row) -> None:
    """Execute a block of this family by its row in TABLE."""
    if code == 0:
        switch(row)
    elif code == 1:
        selector(row)
    elif code == 2:
        distribute(row)
    elif code == 3:
        classifier(row)

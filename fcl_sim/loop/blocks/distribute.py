"""`distribute`: one correcting variable shared out to several control elements."""

from collections.abc import Iterator, Mapping
from typing import Any

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
from fcl_sim.loop.row import Row, number, read, word, write

RANGE = 4
"""Numbers of an element: where its range begins and ends, and its value there."""


@inlined
def distribute(row: Row) -> None:
    """Kernel of `distribute`; where a range ends, its value is met exactly."""
    value = read(row, 0)
    for i in range(word(row, 0)):
        begin, end = number(row, RANGE * i), number(row, RANGE * i + 1)
        first, last = number(row, RANGE * i + 2), number(row, RANGE * i + 3)
        if value <= begin:
            write(row, i, first)
        elif value >= end:
            write(row, i, last)
        else:
            write(row, i, first + (value - begin) / (end - begin) * (last - first))


def _outputs(parameters: Mapping[str, Any]) -> tuple[BlockOutput, ...]:
    return tuple(
        BlockOutput(name=name, unit=str(row[2].unit.symbol))
        for name, row in parameters.get("elements", {}).items()
    )


def _prepare(setting: Setting) -> Prepared:
    rows = setting.values["elements"].values()
    return Prepared(numbers=[each for row in rows for each in row.tolist()], words=(len(rows),))


def _check(setting: Setting) -> Iterator[Misfit]:
    for name, (begin, end, *_) in setting.values["elements"].items():
        if not begin < end:
            yield Misfit(
                parameter="elements",
                message=f"the range of `{name}` ends at {end:.9g}, not beyond {begin:.9g} where it begins",
                hint="to run the other way, exchange the two values of the element, not the ends",
            )


DISTRIBUTE = BlockType(
    name="distribute",
    summary="one correcting variable to several control elements, each with a range of its own (split range)",
    equation="y_i = a_i + min(max((u - from_i)/(to_i - from_i), 0), 1) (b_i - a_i); no memory",
    source="IEC 61131-7 A.3, distribution of a correcting variable to several control elements",
    kernel=distribute,
    inputs=(BlockInput(name="input", meaning="u, the correcting variable"),),
    parameters=(
        BlockParameter(
            name="elements",
            kind="rows",
            columns=(Like("input"), Like("input"), None, None),
            meaning="for each element, an output of that name: from, to, a at `from`, b at `to`",
        ),
    ),
    outputs=_outputs,
    prepare=_prepare,
    check=_check,
)

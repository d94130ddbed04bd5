"""`characteristic`: a table in place of a formula."""

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
from fcl_sim.loop.blocks.interpolation import LINEAR, laid_down, looked_up, on_line, rising
from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.loop.row import Row, number, read, word, write

ENDS = ("hold", "extrapolate")
ENDS_WORD, COUNT = 0, 1


@inlined
def characteristic(row: Row) -> None:
    """Kernel of `characteristic`; to extrapolate, it goes on along the first and the last line."""
    at, count = read(row, 0), word(row, COUNT)
    if word(row, ENDS_WORD) == 1 and at < number(row, 0):
        write(row, 0, on_line(row, 0, count, at, 0))
    elif word(row, ENDS_WORD) == 1 and at > number(row, count - 1):
        write(row, 0, on_line(row, 0, count, at, count - 2))
    else:
        write(row, 0, looked_up(row, 0, count, at, LINEAR))


def _prepare(setting: Setting) -> Prepared:
    return laid_down(setting.values["points"])


def _check(setting: Setting) -> Iterator[Misfit]:
    points = setting.values["points"]
    if len(points) < 2:
        yield Misfit(parameter="points", message="`points` has one point", hint="a line needs two")
    yield from rising("points", points[:, 0].tolist(), "point")


CHARACTERISTIC = BlockType(
    name="characteristic",
    summary="a signal through a table, on straight lines between its points",
    equation=(
        "y = y_i + (u - x_i)/(x_{i+1} - x_i) (y_{i+1} - y_i), x_i <= u < x_{i+1}; beyond the ends y_1 and "
        "y_n, or on along the first and the last line; no memory"
    ),
    source="IEC 61131-7 A.3, processing of the correcting variables; linear interpolation",
    kernel=characteristic,
    inputs=(BlockInput(name="input", meaning="u"),),
    parameters=(
        BlockParameter(
            name="points",
            kind="table",
            columns=(Like("input"), None),
            meaning="x and y of each point, x rising, each with its unit",
        ),
        BlockParameter(
            name="ends", kind="choice", choices=ENDS, default="hold", meaning="y where u is beyond the points"
        ),
    ),
    outputs=(BlockOutput(unit=Like("points.1")),),
    prepare=_prepare,
    check=_check,
)

"""`classifier`: how far a point belongs to each of several prototypes."""

from collections.abc import Iterator, Mapping
from typing import Any

from fcl_sim.arithmetic.functions import power
from fcl_sim.jit import flat
from fcl_sim.loop.blocks.declaration import (
    BlockInputs,
    BlockOutput,
    BlockParameter,
    BlockType,
    Like,
    Misfit,
    Prepared,
)
from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.loop.row import Row, inputs, keep, number, read, recall, word, write

FUZZIFIER, FIRST = 0, 1


@flat
def classifier(row: Row) -> None:
    """Kernel of `classifier`; its states are scratch, a word for each prototype."""
    count, size = word(row, 0), inputs(row)
    nearest = 0.0
    for i in range(count):
        squares = 0.0
        for j in range(size):
            apart = read(row, j) - number(row, FIRST + size * i + j)
            squares += apart * apart
        keep(row, i, squares)
        nearest = squares if i == 0 or squares < nearest else nearest
    exponent, total = 1.0 / (number(row, FUZZIFIER) - 1.0), 0.0
    for i in range(count):
        squares = recall(row, i)
        share = 1.0 if squares == nearest else power(nearest / squares, exponent)
        keep(row, i, share)
        total += share
    for i in range(count):
        write(row, i, recall(row, i) / total)


def _outputs(parameters: Mapping[str, Any]) -> tuple[BlockOutput, ...]:
    return tuple(BlockOutput(name=name) for name in parameters.get("prototypes", {}))


def _prepare(setting: Setting) -> Prepared:
    rows = setting.values["prototypes"].values()
    numbers = [each for row in rows for each in row.tolist()]
    return Prepared(numbers=numbers, words=(len(rows),), states=(0.0,) * len(rows))


def _check(setting: Setting) -> Iterator[Misfit]:
    size = len(setting.connected)
    for name, row in setting.values["prototypes"].items():
        if len(row) != size:
            yield Misfit(
                parameter="prototypes",
                message=f"the prototype `{name}` has {len(row)} numbers, and there are {size} inputs",
                hint="a prototype has a number for each input, in the same order",
            )


CLASSIFIER = BlockType(
    name="classifier",
    summary="memberships of a point to prototypes, as fuzzy c-means has them",
    equation=(
        "mu_i = 1 / sum over j of (D_i/D_j)^(2/(m - 1)), D_i the Euclidean distance of the inputs from "
        "prototype i; at a prototype its mu is 1, shared where several stand in one place; the mu "
        "add up to 1; no memory"
    ),
    source="Bezdek: Pattern Recognition with Fuzzy Objective Function Algorithms, 1981, fuzzy c-means",
    kernel=classifier,
    group=BlockInputs(name="inputs", meaning="the coordinates of the point, in one unit", unit=Like("1")),
    parameters=(
        BlockParameter(
            name="prototypes",
            kind="rows",
            unit=Like("1"),
            meaning="for each class, an output of that name: the coordinates of its prototype",
        ),
        BlockParameter(
            name="fuzzifier",
            unit="",
            default=2.0,
            above=1.0,
            meaning="m; near 1 the nearest class has all",
        ),
    ),
    outputs=_outputs,
    prepare=_prepare,
    check=_check,
)

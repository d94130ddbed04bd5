"""`staircase` and `table`: sources given point by point, in the scenario or in a file."""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from fcl_sim.jit import inlined
from fcl_sim.loop.blocks.declaration import (
    BlockOutput,
    BlockParameter,
    BlockType,
    Like,
    Misfit,
    Prepared,
)
from fcl_sim.loop.blocks.interpolation import BETWEEN, HELD, laid_down, looked_up, rising
from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.loop.blocks.time_series import TableFault, time_series, unit_of
from fcl_sim.loop.row import Row, word, write
from fcl_sim.units import ONE, Quantity, Unit


@inlined
def staircase(row: Row) -> None:
    """Kernel of `staircase`."""
    write(row, 0, looked_up(row, 0, word(row, 0), row.time, HELD))


def _steps(setting: Setting) -> Prepared:
    return laid_down(setting.values["steps"])


def _times_rise(setting: Setting) -> Iterator[Misfit]:
    yield from rising("steps", setting.values["steps"][:, 0].tolist(), "step")


STAIRCASE = BlockType(
    name="staircase",
    summary="one value after another, each from its time on",
    equation="y = y_i where t_i <= t < t_{i+1}; before t_1 y_1; t is the start of the scan; no memory",
    source="of its own",
    kernel=staircase,
    parameters=(
        BlockParameter(
            name="steps",
            kind="table",
            columns=("s", None),
            meaning="time, rising, and value from there on, each with its unit",
        ),
    ),
    outputs=(BlockOutput(unit=Like("steps.1")),),
    prepare=_steps,
    check=_times_rise,
)


@inlined
def time_table(row: Row) -> None:
    """Kernel of `table`."""
    write(row, 0, looked_up(row, 0, word(row, 1), row.time, word(row, 0)))


def _series(setting: Setting) -> Prepared:
    series = time_series(setting.values["file"], setting.values["column"])
    return laid_down(np.array([series.times, series.values]).T)


def _unit(parameters: Mapping[str, Any]) -> Unit:
    return unit_of(parameters["file"], parameters.get("column", ""))


def _legible(parameters: Mapping[str, Any]) -> Iterator[Misfit]:
    try:
        time_series(parameters["file"], parameters.get("column", ""))
    except TableFault as fault:
        yield Misfit(parameter="file", message=str(fault), hint=fault.hint, span=fault.span, code="WIR204")


def _outputs(parameters: Mapping[str, Any]) -> tuple[BlockOutput, ...]:
    def unit(_: Mapping[str, Unit], __: Mapping[str, Quantity]) -> Unit:
        return _unit(parameters) if "file" in parameters else ONE

    return (BlockOutput(unit=unit),)


TIME_TABLE = BlockType(
    name="table",
    summary="a signal from a file, recorded or drawn up",
    equation=(
        "y = y_i + (t - t_i)/(t_{i+1} - t_i) (y_{i+1} - y_i), t_i <= t < t_{i+1}, or held: y_i; "
        "before t_1 y_1, from t_n on y_n; t is the start of the scan; no memory"
    ),
    source="of its own; CSV as RFC 4180 has it, without quoted separators",
    kernel=time_table,
    parameters=(
        BlockParameter(
            name="file",
            kind="file",
            meaning=(
                "CSV, relative to the file that names it: the first line names the columns with their units, "
                "`time [s],speed [m/s]`, the first is the time; separated by commas, semicolons or tabs"
            ),
        ),
        BlockParameter(
            name="column", kind="text", default="", meaning="which column, where there are several"
        ),
        BlockParameter(
            name="between", kind="choice", choices=BETWEEN, default="linear", meaning="y between two lines"
        ),
    ),
    outputs=_outputs,
    prepare=_series,
    legible=_legible,
)

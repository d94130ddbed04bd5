"""`python`: a function of the user's own, called outside the compiled kernel."""

from collections.abc import Iterator, Mapping
from typing import Any

from fcl_sim.loop.blocks.declaration import (
    BlockInputs,
    BlockOutput,
    BlockParameter,
    BlockType,
    Misfit,
)
from fcl_sim.loop.blocks.setting import Setting, Text
from fcl_sim.loop.blocks.user_function import UserFault, load


def _outputs(parameters: Mapping[str, Any]) -> tuple[BlockOutput, ...]:
    return tuple(BlockOutput(name=name, unit=unit) for name, unit in parameters["outputs"].items())


def _late(setting: Setting) -> tuple[str, ...]:
    return tuple(setting.connected) if setting.values["late"] else ()


def _check(setting: Setting) -> Iterator[Misfit]:
    file: Text = setting.values["file"]
    try:
        load(file, setting.values["function"])
    except UserFault as fault:
        yield Misfit(parameter="file", message=str(fault), hint=fault.hint)


PYTHON = BlockType(
    name="python",
    summary="a function of your own, called once a scan outside the compiled loop, which costs time",
    equation="y_k = step(inputs, state, t), inputs and y by name; state is a dict, kept, empty at first",
    source="of your own",
    kernel=None,
    group=BlockInputs(
        name="inputs", meaning="u, each under the name that the function knows", form="named", least=0
    ),
    parameters=(
        BlockParameter(name="file", kind="file", meaning="Python file, relative to the file that names it"),
        BlockParameter(name="function", kind="text", default="step", meaning="which function of the file"),
        BlockParameter(name="outputs", kind="units", meaning="names of what it returns, each with its unit"),
        BlockParameter(
            name="late",
            kind="truth",
            default=False,
            meaning="read the inputs of the last scan: no feedthrough",
        ),
    ),
    outputs=_outputs,
    late=_late,
    check=_check,
)

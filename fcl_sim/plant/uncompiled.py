"""What numba says about code that it cannot compile, told in terms of the plant's file."""

import re
from collections.abc import Callable
from pathlib import Path
from types import FunctionType
from typing import Any

from fcl_sim.diagnostics import InputFault, Span
from fcl_sim.plant.places import PlantFile

_PLACE = re.compile(r'File "(.+?)", line (\d+)|(?:typing of .+? at|Raised from) (.+?) \((\d+)\)')
_GLOBAL = re.compile(r"global name '(\w+)'")
_STEP = "Failed in "
"""So begin the lines with which numba names its own pass."""


def uncompiled(part: str, function: Callable[..., Any], error: Exception, file: PlantFile) -> InputFault:
    """Return the fault of a plant's function `part` that numba refused with `error`."""
    text = str(error)
    named = _GLOBAL.search(text)
    other = function.__globals__.get(named[1]) if named else None
    if (
        named
        and isinstance(other, FunctionType)
        and other.__code__.co_filename == function.__code__.co_filename
    ):
        name = named[1]
        message = f"`{part}` cannot be compiled: `{name}` is called and is not decorated with @kernel"
        hint = f"write @kernel on a line of its own before `def {name}`; it is imported from fcl_sim.plant"
        return file.refusal("PLT302", message, file.call(name), hint)
    message = f"`{part}` cannot be compiled: {_reason(text) or type(error).__name__}"
    hint = "a plant is written in numba's subset of Python: numbers, arrays, math, loops and branches"
    span = _place(text, file) or file.line(function.__code__.co_firstlineno)
    return file.refusal("PLT302", message, span, hint)


def _reason(text: str) -> str:
    """Return the first thing that numba says of the code, on one line."""
    lines = [each.strip().removeprefix(">>> ") for each in text.splitlines()]
    told = [each for each in lines if each and not each.startswith(_STEP)]
    reason = " ".join(told[:2]) if told and told[0].endswith(":") else "".join(told[:1])
    return re.sub(r"\.* Raised from .*", "", reason)


def _place(text: str, file: PlantFile) -> Span | None:
    """Return the innermost line of the plant's file that numba names, which it names first."""
    own = file.path.resolve()
    for match in _PLACE.finditer(text):
        name, line = match[1] or match[3], int(match[2] or match[4])
        if Path(name).resolve() == own:
            return file.line(line)
    return None

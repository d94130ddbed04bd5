"""Hold the functions of a plant file against the contract before they are compiled.

Compiled code checks no bounds, so every function is first run once per mode in
pure Python, on arrays that refuse negative and excess indices and with results
filled beforehand: a mistake becomes an error that names the file and the line.
"""

import inspect
import math
import traceback
from collections.abc import Callable
from pathlib import Path
from types import FunctionType
from typing import Any, NoReturn

import numpy as np

from fcl_sim.diagnostics import InputFault
from fcl_sim.plant.declaration import START, Plant
from fcl_sim.plant.functions import ARGUMENTS
from fcl_sim.plant.places import PlantFile

PROBES = (math.nan, -0.7853981633974483)
"""What results hold before a function is run: the first shows that one is not a number, the second why."""


class GuardedArray(np.ndarray[Any, np.dtype[np.float64]]):
    """An array that refuses what compiled code would silently accept."""

    def __getitem__(self, index: Any) -> Any:
        """Return the element; IndexError for a negative or excess index."""
        self._refuse(index)
        return super().__getitem__(index)

    def __setitem__(self, index: Any, value: Any) -> None:
        """Set the element; IndexError for a negative or excess index."""
        self._refuse(index)
        super().__setitem__(index, value)

    def _refuse(self, index: Any) -> None:
        if isinstance(index, int | np.integer) and not 0 <= index < self.size:
            raise IndexError(f"index {index} is outside 0 to {self.size - 1}")


def _guarded(values: Any) -> GuardedArray:
    return np.array(values, dtype=np.float64).view(GuardedArray)


def check_functions(plant: Plant, functions: dict[str, Callable[..., Any]], path: Path) -> None:
    """Run every function once per mode at the start values; InputFault for the first mistake."""
    plain = _plain(functions, path)
    for part, function in plain.items():
        _check_arguments(part, function, path)
    results = {
        "dynamics": [each.name for each in plant.states],
        "outputs": [each.name for each in plant.outputs],
        "events": [each.name for each in plant.events],
    }
    for mode in range(len(plant.modes)):
        for part, names in results.items():
            if part in plain:
                filled = [_guarded(np.full(len(names), fill)) for fill in PROBES]
                probes = [_call_filling(plain[part], plant, mode, each, path) for each in filled]
                within = f" in the mode `{plant.modes[mode].name}`" if len(plant.modes) > 1 else ""
                _check_filled(part, probes, names, within, path, plain[part])
        if "transition" in plain:
            for event in range(START, len(plant.events)):
                _check_transition(plain["transition"], plant, event, mode, path)
    if "sample" in plain:
        x, u, p = _start(plant)
        _run(path, plain["sample"], 0.0, x, u, p)


def fault_in(path: Path, error: BaseException, message: str) -> InputFault:
    """Return the fault of an exception raised by a plant file's own code, at the guilty line."""
    lines = [
        frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == str(path)
    ]
    line = error.lineno if isinstance(error, SyntaxError) else (lines[-1] if lines else None)
    span = PlantFile(path).line(line) if line else None
    reason = error.msg if isinstance(error, SyntaxError) else f"{type(error).__name__}: {error}"
    return PlantFile(path).refusal("PLT301", f"{message}: {reason}", span)


def _refuse(path: Path, code: str, message: str, *, line: int | None = None, hint: str = "") -> NoReturn:
    file = PlantFile(path)
    raise file.refusal(code, message, file.line(line) if line else None, hint)


def _plain(functions: dict[str, Callable[..., Any]], path: Path) -> dict[str, FunctionType]:
    """Return the functions uncompiled, with their helpers uncompiled too."""
    namespace: dict[str, Any] = {}
    plain: dict[str, FunctionType] = {}
    for part, function in functions.items():
        python = getattr(function, "py_func", function)
        if not isinstance(python, FunctionType):
            _refuse(path, "PLT204", f"`{part}` is not a plain function")
        if not namespace:
            module = python.__globals__
            namespace.update({name: _rebound(value, namespace) for name, value in module.items()})
        plain[part] = _rebound(python, namespace)
    return plain


def _rebound(value: Any, namespace: dict[str, Any]) -> Any:
    python = getattr(value, "py_func", None) or value
    if not isinstance(python, FunctionType):
        return value
    if python is value and not python.__module__.startswith("fcl_sim_plant_"):
        return value
    return FunctionType(python.__code__, namespace, python.__name__, python.__defaults__, python.__closure__)


def _check_arguments(part: str, function: FunctionType, path: Path) -> None:
    given = tuple(inspect.signature(function).parameters)
    if given != ARGUMENTS[part]:
        wanted = f"{part}({', '.join(ARGUMENTS[part])})"
        _refuse(
            path,
            "PLT204",
            f"`{part}` takes ({', '.join(given)})",
            line=function.__code__.co_firstlineno,
            hint=f"the contract is `{wanted}`",
        )


def _start(plant: Plant) -> tuple[GuardedArray, GuardedArray, GuardedArray]:
    return (
        _guarded([each.start for each in plant.states]),
        _guarded([each.start for each in plant.inputs]),
        _guarded([each.default for each in plant.parameters]),
    )


def _run(path: Path, function: FunctionType, *arguments: Any) -> Any:
    try:
        with np.errstate(all="ignore"):
            return function(*arguments)
    except Exception as error:
        raise fault_in(path, error, f"`{function.__name__}` fails at the start values") from error


def _call_filling(
    function: FunctionType, plant: Plant, mode: int, result: GuardedArray, path: Path
) -> GuardedArray:
    x, u, p = _start(plant)
    _run(path, function, 0.0, x, u, p, mode, result)
    return result


def _check_filled(
    part: str, probes: list[GuardedArray], names: list[str], within: str, path: Path, function: FunctionType
) -> None:
    letter = ARGUMENTS[part][-1]
    for index, name in enumerate(names):
        what = f"{letter}[{index}]"
        first, second = (float(each[index]) for each in probes)
        if not math.isfinite(first):
            message, hint = _unfilled(what, name, first, second)
            line = function.__code__.co_firstlineno
            _refuse(path, "PLT205", f"`{part}` {message}{within}", line=line, hint=hint.format(part=part))


def _unfilled(what: str, name: str, first: float, second: float) -> tuple[str, str]:
    """Return what a function does to a result, given what the two probes became, and what would be right."""
    if math.isinf(first):
        return f"makes {what} (`{name}`) infinite", "at the start values every result of `{part}` is finite"
    if math.isnan(second):
        return f"makes {what} (`{name}`) NaN", "at the start values every result of `{part}` is a number"
    if second == PROBES[1]:
        return f"leaves {what} (`{name}`) unset", f"set {what} on every path through `{{part}}`"
    return f"reads {what} (`{name}`) before it sets it", f"set {what} before it is read"


def _check_transition(function: FunctionType, plant: Plant, event: int, mode: int, path: Path) -> None:
    x, u, p = _start(plant)
    result = _run(path, function, event, 0.0, x, u, p, mode)
    if not isinstance(result, int | np.integer) or not 0 <= result < len(plant.modes):
        names = ", ".join(f"{number} ({each.name})" for number, each in enumerate(plant.modes))
        _refuse(
            path,
            "PLT206",
            f"`transition` gives {result!r} for event {event} in mode {mode}",
            line=function.__code__.co_firstlineno,
            hint=f"it must return the number of a mode: {names}",
        )

"""Hold a plant file against the contract before it is compiled.

Compiled code checks no bounds, so every function is first run once per mode in
pure Python, on arrays that refuse negative and excess indices and with results
filled with NaN: a mistake becomes an error that names the file and the line.
"""

import inspect
import math
import traceback
from collections.abc import Callable
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any, NoReturn

import numpy as np

from fcl_sim.diagnostics import Diagnostic, InputFault, Place, Source, Span, nearest
from fcl_sim.plant.declaration import START, Plant
from fcl_sim.plant.functions import ARGUMENTS, PARTS, REQUIRED

MOST_EVENTS = 62
"""The loop keeps a bit per event in one word."""


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


def check_declaration(module: ModuleType, path: Path) -> Plant:
    """Return PLANT of a plant file; InputFault when it or a required function is missing or malformed."""
    plant = getattr(module, "PLANT", None)
    if not isinstance(plant, Plant):
        _refuse(path, "PLT201", "a plant file declares `PLANT = Plant(...)`, and this one does not")
    for part in REQUIRED:
        if not callable(getattr(module, part, None)):
            near = nearest(part, [name for name in vars(module) if callable(getattr(module, name))])
            hint = f"`{near}` looks like it" if near and near not in PARTS else ""
            _refuse(
                path, "PLT202", f"the plant has no function `{part}({', '.join(ARGUMENTS[part])})`", hint=hint
            )
    groups = [[each.name for each in plant.states], [each.name for each in plant.inputs]]
    groups += [[each.name for each in plant.outputs], [each.name for each in plant.parameters]]
    for names in groups:
        for name in {name for name in names if names.count(name) > 1}:
            _refuse(path, "PLT203", f"the plant declares `{name}` twice")
    signals = {each.name for each in plant.outputs} & {each.name for each in plant.inputs}
    for name in sorted(signals):
        _refuse(path, "PLT203", f"`{name}` is an input and an output; signals of a plant have one name each")
    if len(plant.events) > MOST_EVENTS:
        _refuse(path, "PLT203", f"the plant declares {len(plant.events)} events; {MOST_EVENTS} are possible")
    if plant.events and not callable(getattr(module, "events", None)):
        _refuse(
            path,
            "PLT202",
            f"the plant declares events but has no function `events({', '.join(ARGUMENTS['events'])})`",
        )
    return plant


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
                given = _call_filling(plain[part], plant, mode, len(names), path)
                _check_filled(part, given, names, plant.modes[mode].name, path, plain[part])
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
    span = _line_span(path, line) if line else None
    reason = error.msg if isinstance(error, SyntaxError) else f"{type(error).__name__}: {error}"
    place = Place(span=span, file=str(path))
    return InputFault([Diagnostic(code="PLT301", message=f"{message}: {reason}", places=(place,))])


def _refuse(path: Path, code: str, message: str, *, line: int | None = None, hint: str = "") -> NoReturn:
    place = Place(span=_line_span(path, line) if line else None, file=str(path))
    raise InputFault([Diagnostic(code=code, message=message, places=(place,), hint=hint)])


def _line_span(path: Path, line: int) -> Span:
    source = Source(str(path), path.read_text(encoding="utf-8", errors="replace"))
    text = source.line_text(line)
    start = source.line_starts[line - 1] + len(text) - len(text.lstrip())
    return Span(source, start, start + max(1, len(text.strip())))


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


def _call_filling(function: FunctionType, plant: Plant, mode: int, size: int, path: Path) -> GuardedArray:
    x, u, p = _start(plant)
    result = _guarded(np.full(size, math.nan))
    _run(path, function, 0.0, x, u, p, mode, result)
    return result


def _check_filled(
    part: str, given: GuardedArray, names: list[str], mode: str, path: Path, function: FunctionType
) -> None:
    letter = ARGUMENTS[part][-1]
    for index, name in enumerate(names):
        if not math.isfinite(given[index]):
            state = "leaves" if math.isnan(given[index]) else "makes"
            what = "unset or NaN" if math.isnan(given[index]) else "infinite"
            _refuse(
                path,
                "PLT205",
                f"`{part}` {state} {letter}[{index}] (`{name}`) {what} in the mode `{mode}`",
                line=function.__code__.co_firstlineno,
                hint=f"set {letter}[{index}] on every path through `{part}`",
            )


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

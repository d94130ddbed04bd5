"""A function in a user's file: loaded, called, and told about when it fails."""

import traceback
from collections.abc import Callable, Mapping
from typing import Any

from fcl_sim.loop.blocks.setting import Text

Step = Callable[[Mapping[str, float], dict[str, Any], float], Any]


class UserFault(Exception):
    """A function that cannot be loaded, fails or returns what it should not; `hint` says the mend."""

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.hint = hint


def load(file: Text, name: str) -> Step:
    """Return the function `name` of a file; UserFault where the file fails or has none."""
    space: dict[str, Any] = {"__name__": f"fcl_sim_user_{name}", "__file__": file.name}
    try:
        exec(compile(file.text, file.name, "exec"), space)  # noqa: S102  running it is the user's decision
    except SyntaxError as error:
        raise UserFault(f"`{file.name}`, line {error.lineno}, is not Python: {error.msg}") from error
    except Exception as error:
        raise UserFault(f"`{file.name}`{_line(file, error)} fails: {_told(error)}") from error
    function = space.get(name)
    if not callable(function):
        raise UserFault(f"`{file.name}` has no function `{name}`", f"write def {name}(inputs, state, t): ...")
    step: Step = function
    return step


def call(
    step: Step,
    file: Text,
    inputs: Mapping[str, float],
    state: dict[str, Any],
    t: float,
    names: tuple[str, ...],
) -> list[float]:
    """Return the outputs `names` that a function gives; UserFault where it fails or gives something else."""
    try:
        given = step(inputs, state, t)
    except Exception as error:
        raise UserFault(f"`{file.name}`{_line(file, error)} fails: {_told(error)}") from error
    if not isinstance(given, Mapping):
        given = {names[0]: given} if len(names) == 1 else {}
    try:
        return [float(given[name]) for name in names]
    except (KeyError, TypeError, ValueError) as error:
        wanted = ", ".join(f'"{name}": ...' for name in names)
        raise UserFault(
            f"what the function in `{file.name}` returns lacks a number for each output",
            f"return {{{wanted}}}",
        ) from error


def _told(error: Exception) -> str:
    return f"{type(error).__name__}: {error}".rstrip(": ")


def _line(file: Text, error: Exception) -> str:
    lines = [each.lineno for each in traceback.extract_tb(error.__traceback__) if each.filename == file.name]
    return f", line {lines[-1]}," if lines else ""

"""A linear system of python-control → the [plant] of a scenario, as text."""

import re
from collections.abc import Mapping, Sequence

import control
import numpy as np

NAME = re.compile(r"[^\W\d]\w*")
GENERIC = re.compile(r"sys\[\d+\]")


def plant_text(
    system: control.lti.LTI,
    inputs: Mapping[str, str],
    units: Mapping[str, str] | None = None,
    *,
    name: str = "",
    delay: str = "",
) -> str:
    """Return a continuous system as the [plant] table of a scenario, in TOML.

    `inputs` names for each input the signal of the scenario that drives it,
    `units` the unit of each input and output that has one, `delay` the dead
    time of the inputs, as in "2 s". Signals have their labels; `u[0]` becomes
    `u0`. A transfer function with one input and output stays one, everything
    else becomes matrices. Raises ValueError for a discrete system, and for names
    that do not fit.
    """
    if not system.isctime():
        raise ValueError(f"the plant of a scenario moves between scans; this system is sampled ({system.dt})")
    driven, given = (
        [_name(each) for each in labels] for labels in (system.input_labels, system.output_labels)
    )
    if sorted(inputs) != sorted(driven):
        raise ValueError(
            f"the system has the inputs {', '.join(driven)}; {', '.join(inputs) or 'none'} are named"
        )
    for each in units or {}:
        if each not in {*driven, *given}:
            raise ValueError(f"the system has no signal {each}; it has {', '.join((*driven, *given))}")
    called = name or ("plant" if GENERIC.fullmatch(system.name) else _name(system.name))
    single = isinstance(system, control.TransferFunction) and system.issiso()
    rows = [("delay", f'"{delay}"')] if delay else []
    lines = [
        "[plant]",
        f'model = "{"transfer_function" if single else "state_space"}"',
        f'name = "{called}"',
        f"inputs = {_table({each: inputs[each] for each in driven})}",
        f"outputs = [{', '.join(map(_quoted, given))}]",
        *([f"units = {_table(units)}"] if units else []),
        "",
        "[plant.parameters]",
        *(f"{key} = {value}" for key, value in [*(_powers(system) if single else _matrices(system)), *rows]),
    ]
    return "\n".join(lines)


def _name(label: str) -> str:
    """Return a label as a name in a scenario."""
    name = label.replace("[", "").replace("]", "")
    if not NAME.fullmatch(name):
        raise ValueError(f"{label} is no name in a scenario: letters, digits and underscores")
    return name


def _powers(system: control.TransferFunction) -> list[tuple[str, str]]:
    return [("numerator", _row(system.num[0][0])), ("denominator", _row(system.den[0][0]))]


def _matrices(system: control.lti.LTI) -> list[tuple[str, str]]:
    whole = control.ss(system)
    found = [("A", whole.A), ("B", whole.B), ("C", whole.C)]
    if np.any(whole.D):
        found.append(("D", whole.D))
    return [(name, f"[{', '.join(_row(row) for row in matrix)}]") for name, matrix in found]


def _row(numbers: Sequence[float]) -> str:
    return f"[{', '.join(repr(float(each)) for each in numbers)}]"


def _table(entries: Mapping[str, str]) -> str:
    return f"{{ {', '.join(f'{key} = {_quoted(each)}' for key, each in entries.items())} }}"


def _quoted(text: str) -> str:
    return f'"{text}"'

"""Hold what a plant file declares against what a declaration may be; nothing is run."""

import math
from collections.abc import Callable, Iterator
from dataclasses import Field, fields
from pathlib import Path
from types import ModuleType
from typing import Any

from fcl_sim.diagnostics import Diagnostic, InputFault, nearest
from fcl_sim.plant.declaration import Direction, Event, Input, Mode, Output, Parameter, Plant, State
from fcl_sim.plant.functions import ARGUMENTS, PARTS, REQUIRED
from fcl_sim.plant.places import PlantFile
from fcl_sim.units import UnitError, parse_quantity, parse_unit, short

MOST_EVENTS = 62
"""The loop keeps a bit per event in one word."""

KINDS: dict[str, type] = {
    "states": State,
    "inputs": Input,
    "outputs": Output,
    "parameters": Parameter,
    "modes": Mode,
    "events": Event,
}
"""What a plant declares, by its keyword, and what each of it is."""

Declared = State | Input | Output | Parameter | Mode | Event


def check_declaration(module: ModuleType, path: Path) -> Plant:
    """Return PLANT of a plant file.

    InputFault with every fault of the declaration, each at its place, and for
    functions that are missing.
    """
    file = PlantFile(path)
    plant = _plant(module, file)
    faults = [*_unlike_groups(plant, file)]
    if not faults:
        for kind in KINDS:
            for each in getattr(plant, kind):
                faults += _unfit(each, file)
        faults += _names_given_twice(plant, file)
    faults += _missing_functions(module, plant, file)
    if faults:
        raise InputFault(faults)
    return plant


def _plant(module: ModuleType, file: PlantFile) -> Plant:
    plant = getattr(module, "PLANT", None)
    if isinstance(plant, Plant):
        return plant
    others = [name for name, value in vars(module).items() if isinstance(value, Plant)]
    span = file.assignment(others[0] if others else "PLANT")
    hint = f"`{others[0]}` is a Plant: call it PLANT" if others else ""
    message = "a plant file declares `PLANT = Plant(...)`, and this one does not"
    raise file.refusal("PLT201", message, span, hint)


def _unlike_groups(plant: Plant, file: PlantFile) -> Iterator[Diagnostic]:
    call = file.declaration("Plant", plant.name)
    for keyword, kind in KINDS.items():
        given = getattr(plant, keyword)
        span, name = file.argument(call, len(fields(Plant)), keyword), kind.__name__
        if isinstance(given, kind):
            hint = f"behind a single one stands a comma: {keyword}=({name}(...),)"
            yield file.fault("PLT208", f"`{keyword}` is one {name}, and not a tuple of them", span, hint)
        elif not isinstance(given, tuple | list):
            yield file.fault("PLT208", f"`{keyword}` is {given!r}, and not a tuple of {name}(...)", span)
        else:
            for other in given:
                if not isinstance(other, kind):
                    message = f"among `{keyword}` stands {_shown(other)}, which is no {name}"
                    yield file.fault("PLT208", message, span, f"each of them is a {_usage(kind)}")


def _shown(value: object) -> str:
    return f"a {type(value).__name__}" if isinstance(value, tuple(KINDS.values())) else repr(value)


def _usage(kind: type) -> str:
    return f"{kind.__name__}({', '.join(each.name for each in fields(kind))})"


def _unfit(each: Declared, file: PlantFile) -> list[Diagnostic]:
    """Return what is wrong with one declaration: kinds of its values, then its unit, then its limits."""
    kind = type(each).__name__
    call, what = file.declaration(kind, each.name), f"the {kind.lower()} `{each.name}`"
    faults = []
    for position, field in enumerate(fields(each)):
        value = getattr(each, field.name)
        wanted = _wanted(field, value)
        if wanted:
            message = f"`{field.name}` of {what} is {value!r}, and not {wanted}"
            span = file.argument(call, position, field.name)
            faults.append(file.fault("PLT208", message, span, _instead(each, field, value)))
    if isinstance(getattr(each, "unit", None), str):
        try:
            parse_unit(getattr(each, "unit", ""))
        except UnitError as error:
            faults.append(
                file.fault("PLT207", f"{what}: {error}", file.argument(call, 1, "unit"), error.hint)
            )
    if isinstance(each, Parameter) and not faults:
        faults += _beyond_limits(each, file)
    return faults


def _number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def _limit(value: object) -> bool:
    return value is None or value in {math.inf, -math.inf} or _number(value)


_FIT: dict[Any, tuple[Callable[[Any], bool], str]] = {
    str: (lambda value: isinstance(value, str), "a text"),
    bool: (lambda value: isinstance(value, bool), "True or False"),
    float: (_number, "a number"),
    float | None: (_limit, "a number or None"),
    Direction: (lambda value: isinstance(value, Direction), "RISING or FALLING"),
}


def _wanted(field: "Field[Any]", value: object) -> str:
    """Return what the value of a field must be; empty where it is that."""
    fits, wanted = _FIT[field.type]
    if not fits(value):
        return wanted
    return "a number above 0" if field.name == "scale" and not _above_zero(value) else ""


def _above_zero(value: Any) -> bool:
    return bool(value > 0)


def _instead(each: Declared, field: "Field[Any]", value: object) -> str:
    """Return what would be right: of a text with a unit the number, else the order of the arguments."""
    if isinstance(value, str) and field.type is not str:
        try:
            number = parse_quantity(value).to(parse_unit(getattr(each, "unit", "")))
        except UnitError:
            pass
        else:
            return f"write {short(number)}: its unit is declared before it"
    return f"the order is {_usage(type(each))}"


def _beyond_limits(each: Parameter, file: PlantFile) -> Iterator[Diagnostic]:
    call = file.declaration("Parameter", each.name)
    low = -math.inf if each.minimum is None else each.minimum
    high = math.inf if each.maximum is None else each.maximum
    if low > high:
        message = f"the parameter `{each.name}` has a minimum of {short(low)} and a maximum of {short(high)}"
        yield file.fault("PLT203", message, file.argument(call, 5, "minimum"), "are they exchanged?")
    elif not low <= each.default <= high:
        side, bound = ("minimum", low) if each.default < low else ("maximum", high)
        message = (
            f"the default of the parameter `{each.name}` is {short(each.default)} {each.unit}".rstrip()
            + f", and its {side} {short(bound)} {each.unit}".rstrip()
        )
        yield file.fault(
            "PLT203", message, file.argument(call, 2, "default"), f"the order is {_usage(Parameter)}"
        )


def _names_given_twice(plant: Plant, file: PlantFile) -> Iterator[Diagnostic]:
    for keyword, kind in KINDS.items():
        names = [each.name for each in getattr(plant, keyword)]
        for name in dict.fromkeys(each for each in names if names.count(each) > 1):
            span = file.argument(file.declaration(kind.__name__, name, 1), 0, "name")
            yield file.fault("PLT203", f"the plant declares the {kind.__name__.lower()} `{name}` twice", span)
    inputs = {each.name for each in plant.inputs}
    for output in plant.outputs:
        if output.name in inputs:
            span = file.argument(file.declaration("Output", output.name), 0, "name")
            message = f"`{output.name}` is an input and an output; signals of a plant have one name each"
            yield file.fault("PLT203", message, span)
    if len(plant.events) > MOST_EVENTS:
        message = f"the plant declares {len(plant.events)} events; {MOST_EVENTS} are possible"
        yield file.fault("PLT203", message, file.assignment("PLANT"))


def _missing_functions(module: ModuleType, plant: Plant, file: PlantFile) -> Iterator[Diagnostic]:
    for part in REQUIRED:
        if not callable(getattr(module, part, None)):
            near = nearest(part, [name for name in vars(module) if callable(getattr(module, name))])
            like = (
                getattr(module, near).__code__
                if near and near not in PARTS and _has_code(module, near)
                else None
            )
            span = file.line(like.co_firstlineno) if like else None
            hint = f"`{near}` looks like it" if like else ""
            message = f"the plant has no function `{part}({', '.join(ARGUMENTS[part])})`"
            yield file.fault("PLT202", message, span, hint)
    if plant.events and not callable(getattr(module, "events", None)):
        message = f"the plant declares events but has no function `events({', '.join(ARGUMENTS['events'])})`"
        yield file.fault("PLT202", message, file.assignment("PLANT"))


def _has_code(module: ModuleType, name: str) -> bool:
    code = getattr(getattr(module, name), "__code__", None)
    return code is not None and code.co_filename == module.__file__

"""A plant that a scenario gives in numbers, a transfer function for one, → PlantNode."""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any

from fcl_sim.diagnostics import Diagnostic, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.loop.diagram import PlantNode, Wire
from fcl_sim.plant import linear
from fcl_sim.plant.declaration import Input, Output, Parameter, State
from fcl_sim.plant.linear import LinearError, StateSpace
from fcl_sim.scenario.model import PlantSetup
from fcl_sim.scenario.quantities import converted
from fcl_sim.toml.tree import Entry, finding
from fcl_sim.units import Unit, UnitError, nanoseconds, parse_quantity, parse_unit

Faults = list[Diagnostic]
Numbers = Any
"""A number, complex where it is a root, or a tuple of these."""
Values = dict[str, Numbers]

FIRST_ORDER, TRANSFER_FUNCTION, ZERO_POLE_GAIN, STATE_SPACE = (
    "first_order",
    "transfer_function",
    "zero_pole_gain",
    "state_space",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class LinearModel:
    """A kind of linear plant: its title, its parameters and how each is written, what makes its matrices.

    `needed` must be given, the others are 0, or empty. A parameter is a `quantity`
    in a unit told by the signals or in s, a plain `number`, a `list` of
    numbers, of `roots`, or a `matrix`.
    """

    title: str
    parameters: Mapping[str, str]
    needed: tuple[str, ...]
    make: Callable[..., StateSpace]


LINEAR_MODELS: Mapping[str, LinearModel] = MappingProxyType(
    {
        FIRST_ORDER: LinearModel(
            title="gain / (time_constant s + 1), late by delay",
            parameters={"gain": "quantity", "time_constant": "quantity"},
            needed=("gain", "time_constant"),
            make=linear.first_order,
        ),
        TRANSFER_FUNCTION: LinearModel(
            title="numerator / denominator in powers of s, the highest first, late by delay",
            parameters={"numerator": "list", "denominator": "list"},
            needed=("numerator", "denominator"),
            make=linear.transfer_function,
        ),
        ZERO_POLE_GAIN: LinearModel(
            title="gain prod(s - zero) / prod(s - pole), late by delay",
            parameters={"zeros": "roots", "poles": "roots", "gain": "number"},
            needed=("poles", "gain"),
            make=linear.zero_pole_gain,
        ),
        STATE_SPACE: LinearModel(
            title="x' = A x + B u, y = C x + D u, u late by delay",
            parameters={"A": "matrix", "B": "matrix", "C": "matrix", "D": "matrix"},
            needed=("A", "B", "C"),
            make=linear.state_space,
        ),
    }
)
"""Linear plants by the name that a scenario writes as `model`; time is in seconds."""

DELAY = "delay"


def is_linear(plant: PlantSetup) -> bool:
    """Return whether a plant is given in numbers, not by a file."""
    return plant.model.value in LINEAR_MODELS


def linear_node(setup: PlantSetup, wires: Mapping[str, Wire], faults: Faults) -> PlantNode | None:
    """Return the plant of a setup whose model is one of LINEAR_MODELS; None where a fault was found."""
    before = len(faults)
    kind = LINEAR_MODELS[str(setup.model.value)]
    units = _signals(setup, faults)
    values = _values(setup, kind, units, faults)
    delay = _delay(setup, faults)
    if len(faults) > before:
        return None
    try:
        system = kind.make(**{name.lower(): each for name, each in values.items()})
        faults += _miscounted(setup, system)
        if len(faults) > before:
            return None
        node = _node(setup, system, units, delay, faults)
        return replace(node, inputs=wires)
    except LinearError as error:
        started = next(iter(setup.start.values()), None) if error.about == "start" else None
        place = setup.parameters.get(error.about) or started or setup.span
        faults.append(finding("SCN311", str(error), place, error.hint))
        return None


def output_names(setup: PlantSetup) -> tuple[str, ...]:
    """Return the names of the outputs; a single one need not be named."""
    return tuple(str(each.value) for each in setup.outputs) or ("output",)


def _signals(setup: PlantSetup, faults: Faults) -> dict[str, Unit]:
    """Return the inputs, then the outputs, each with its unit."""
    names = [*setup.inputs, *output_names(setup)]
    for name in {each: None for each in names if names.count(each) > 1}:
        message = f"the plant `{setup.name}` has two signals called `{name}`"
        faults.append(finding("SCN311", message, setup.span, "give its `outputs` names of their own"))
    if not setup.inputs:
        hint = 'name one, and the signal that drives it: inputs = { heating = "controller.heating" }'
        faults.append(finding("SCN311", f"the plant `{setup.name}` has no inputs", setup.span, hint))
    for name, entry in setup.units.items():
        if name not in names:
            near = nearest(name, names)
            hint = f"did you mean `{near}`?" if near else f"it has {listed(names)}"
            faults.append(
                finding("SCN309", f"the plant `{setup.name}` has no signal called `{name}`", entry.key, hint)
            )
    return {name: parse_unit(str(setup.units[name].value) if name in setup.units else "") for name in names}


def _values(setup: PlantSetup, model: LinearModel, units: Mapping[str, Unit], faults: Faults) -> Values:
    known = {**model.parameters, DELAY: "quantity"}
    for name, entry in setup.parameters.items():
        if name not in known:
            near = nearest(name, known)
            hint = f"did you mean `{near}`?" if near else f"it has {listed(known)}"
            message = f"the plant `{setup.model.value}` has no parameter called `{name}`"
            faults.append(finding("SCN309", message, entry.key, hint))
    for name in model.needed:
        if name not in setup.parameters:
            message = f"the plant `{setup.name}` has no `{name}` among its `parameters`"
            faults.append(finding("SCN202", message, setup.span, f"it is {model.title}"))
    values: Values = {}
    for name, form in model.parameters.items():
        given = setup.parameters.get(name)
        if given is None:
            values |= {name: ()} if form == "roots" else {}
        elif form == "quantity":
            values[name] = converted(given, _unit_of(name, units), f"`{name}`", faults)
        else:
            values[name] = _plain(name, form, given, faults)
    return values


def _unit_of(name: str, units: Mapping[str, Unit]) -> Unit:
    """Return the unit of a quantity among the parameters."""
    if name != "gain" or len(units) != 2:
        return parse_unit("" if name == "gain" else "s")
    given, result = units.values()
    return result / given


EXAMPLES: Mapping[str, str] = MappingProxyType(
    {
        "number": "2.0",
        "list": "[1.0, 3.0, 2.0]",
        "roots": '[-1.0, "-2+3j", "-2-3j"]',
        "matrix": "[[0.0, 1.0], [-2.0, -3.0]]",
    }
)
DEPTHS: Mapping[str, int] = MappingProxyType({"number": 0, "list": 1, "roots": 1, "matrix": 2})


def _plain(name: str, form: str, entry: Entry, faults: Faults) -> Numbers:
    """Return numbers without units, as deep as the form says."""
    try:
        return _nested(entry, DEPTHS[form], roots=form == "roots")
    except (TypeError, ValueError):
        what = {0: "a plain number", 1: "a list of numbers", 2: "a matrix, a list of rows"}[DEPTHS[form]]
        hint = f"write it as in {name} = {EXAMPLES[form]}"
        faults.append(finding("SCN311", f"`{name}` is {what}", entry, hint))
        return 0.0


def _nested(entry: Entry, depth: int, *, roots: bool) -> Numbers:
    if depth:
        if not isinstance(entry.value, tuple):
            raise TypeError
        return tuple(_nested(each, depth - 1, roots=roots) for each in entry.items)
    value = entry.value
    if roots and isinstance(value, str):
        root = complex(value.replace(" ", "").replace("i", "j"))
        if math.isfinite(abs(root)):
            return root
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise TypeError
    return complex(value) if roots else float(value)


def _delay(setup: PlantSetup, faults: Faults) -> int:
    """Return the dead time in nanoseconds."""
    entry = setup.parameters.get(DELAY)
    if entry is None or converted(entry, parse_unit("s"), f"`{DELAY}`", faults) is None:
        return 0
    try:
        ticks = nanoseconds(parse_quantity(entry.value))
    except UnitError as error:
        faults.append(finding("SCN204", f"`{DELAY}`: {error}", entry, error.hint))
        return 0
    if ticks < 0:
        faults.append(finding("SCN310", f"`{DELAY}` cannot be {entry.value}", entry, "it is at least 0 s"))
    return ticks


def _node(
    setup: PlantSetup, system: StateSpace, units: Mapping[str, Unit], delay: int, faults: Faults
) -> PlantNode:
    """Return the plant, its inputs still without wires."""
    states, start, arriving = _start(setup, system, units, faults)
    parameters = dict(_told(setup, delay, units))
    model = linear.linear_plant(
        system,
        name=str(setup.model.value),
        title=LINEAR_MODELS[str(setup.model.value)].title,
        inputs=[
            Input(name, units[name].symbol, "what drives it", each)
            for name, each in zip(setup.inputs, arriving, strict=True)
        ],
        outputs=[Output(name, units[name].symbol, "what it gives") for name in output_names(setup)],
        states=states,
        parameters=[Parameter(name, unit, value, "", "") for name, (value, unit) in parameters.items()],
        delay=delay,
    )
    values = {name: value for name, (value, _) in parameters.items()}
    return PlantNode(name=setup.name, model=model, parameters=values, start=start, span=setup.span)


def _miscounted(setup: PlantSetup, system: StateSpace) -> Iterator[Diagnostic]:
    """Yield where there are more or fewer names than signals."""
    for what, named, count, example in (
        ("input", len(setup.inputs), system.b.shape[1], 'inputs = { heating = "controller.heating" }'),
        ("output", len(output_names(setup)), len(system.c), 'outputs = ["temperature"]'),
    ):
        if named != count:
            message = f"the plant `{setup.name}` has {count} {what}{'s' * (count > 1)}, and {named} are named"
            yield finding("SCN311", message, setup.span, f"name each of them, as in {example}")


def _start(
    setup: PlantSetup, system: StateSpace, units: Mapping[str, Unit], faults: Faults
) -> tuple[list[State], dict[str, float], list[float]]:
    """Return the states with their start values, those to tell of, and the inputs before the first write.

    States have names of their own in state space; the other kinds start at rest at an output.
    """
    inside = setup.model.value == STATE_SPACE
    output = output_names(setup)[0]
    names = [f"x{i + 1}" for i in range(len(system.a))]
    known = {each: parse_unit("") for each in names} if inside else {output: units[output]}
    given: dict[str, float] = {}
    for name, entry in setup.start.items():
        if name not in known:
            what = "state" if inside else "output"
            near = nearest(name, known)
            hint = f"did you mean `{near}`?" if near else f"it has {listed(known)}"
            message = f"the plant `{setup.name}` has no {what} called `{name}` to start from"
            faults.append(finding("SCN309", message, entry.key, hint))
            continue
        value = converted(entry, known[name], f"`{name}`", faults)
        given |= {} if value is None else {name: value}
    if inside:
        return [State(name, "", given.get(name, 0.0), "") for name in names], given, [0.0] * system.b.shape[1]
    if not given:
        return [State(name, "", 0.0, "") for name in names], {}, [0.0]
    x, arriving = linear.at_rest(system, [given[output]])
    if system.gives_its_state:
        names[0] = output
    starts = zip(names, x.tolist(), strict=True)
    states = [State(name, known[name].symbol if name in known else "", each, "") for name, each in starts]
    return states, given if system.gives_its_state else {}, arriving.tolist()


def _told(
    setup: PlantSetup, delay: int, units: Mapping[str, Unit]
) -> Iterator[tuple[str, tuple[float, str]]]:
    """Yield what a reader is told of the parameters: each number by itself, with its unit."""
    for name, entry in setup.parameters.items():
        if name == DELAY:
            yield name, (delay / 1e9, "s")
        elif LINEAR_MODELS[str(setup.model.value)].parameters[name] == "quantity":
            unit = _unit_of(name, units)
            yield name, (parse_quantity(entry.value).to(unit), unit.symbol)
        else:
            yield from _each(name, entry)


def _each(name: str, entry: Entry) -> Iterator[tuple[str, tuple[float, str]]]:
    if isinstance(entry.value, tuple):
        for number, each in enumerate(entry.items, start=1):
            yield from _each(f"{name}[{number}]", each)
    elif isinstance(entry.value, str):
        root = complex(entry.value.replace(" ", "").replace("i", "j"))
        yield f"{name} real", (root.real, "")
        yield f"{name} imaginary", (root.imag, "")
    else:
        yield name, (float(entry.value), "")


def misplaced(setup: PlantSetup) -> Iterator[Diagnostic]:
    """Yield what a scenario says of a plant with a file that only linear ones are told."""
    for key, given in (("outputs", setup.outputs), ("units", tuple(setup.units.values()))):
        if given:
            hint = f"its file declares them; they are told of {listed(LINEAR_MODELS)}"
            yield finding("SCN201", f"the plant `{setup.model.value}` has no key `{key}`", given[0], hint)

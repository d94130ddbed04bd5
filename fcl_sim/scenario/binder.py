"""Scenario → Diagram: names become paths, texts become numbers, files become plants and blocks."""

import math
from collections.abc import Callable, Container, Iterator, Mapping
from dataclasses import replace
from pathlib import Path

from fcl_sim.block import Block, load
from fcl_sim.diagnostics import Diagnostic, InputFault, Place, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.judge.verdict import Over, Requirement
from fcl_sim.loop.diagram import Diagram, FuzzyNode, Node, PlantNode, Wire
from fcl_sim.loop.wiring import Wiring
from fcl_sim.plant.catalog import PlantModel, find
from fcl_sim.plant.declaration import Parameter, State
from fcl_sim.scenario.arithmetic import in_arithmetic
from fcl_sim.scenario.asked_runs import NOMINAL_RUN
from fcl_sim.scenario.blocks import plain_node
from fcl_sim.scenario.document import shown
from fcl_sim.scenario.linear import LINEAR_MODELS, is_linear, linear_node, misplaced
from fcl_sim.scenario.model import BASE, CONTROLLER, Axis, Entries, PlantSetup, Scenario, Setup
from fcl_sim.scenario.quantities import converted
from fcl_sim.scenario.ranges import ranges_of
from fcl_sim.scenario.requirements import Units, requirements_for
from fcl_sim.scenario.shape import is_fuzzy
from fcl_sim.toml.tree import NOTHING, Entry, finding
from fcl_sim.units import parse_unit

Faults = list[Diagnostic]
LoadBlock = Callable[[Path, str | None], Block]
Scope = Mapping[str, str]
"""Names that a controller file may use, each with its path; a fuzzy block stands for all its outputs."""


def bind(scenario: Scenario, variant: str = BASE, load_block: LoadBlock = load) -> Diagram:
    """Return the closed loop of a variant, with its plant and rule bases loaded.

    `load_block` may remember the rule bases that several variants share.
    InputFault carries every unknown name, misfitting unit and faulty rule base.
    """
    return bind_setup(scenario, setup_called(scenario, variant), load_block)


def bind_setup(scenario: Scenario, setup: Setup, load_block: LoadBlock = load) -> Diagram:
    """Return the closed loop of a variant as `bind` does, set up otherwise than its scenario says."""
    faults: Faults = []
    plant = _plant(scenario, setup.plant, faults)
    nodes = []
    for name, block in setup.blocks.items():
        node = _node(setup, name, block, load_block, faults)
        if node is not None:
            nodes.append(node)
    aliases = _aliases(setup, faults)
    if faults or plant is None:
        raise InputFault(faults)
    return Diagram(
        plant=plant,
        nodes=tuple(nodes),
        aliases=aliases,
        timing=setup.timing,
        integration=setup.integration,
        plc=f"{CONTROLLER}." if setup.controller else "",
    )


def requirements(
    scenario: Scenario, variant: str, units: Units, asked_over: Container[Over] = NOMINAL_RUN
) -> tuple[Requirement, ...]:
    """Return what is required of a variant's run, in the units of its signals.

    Without `asked_over`, of the run itself.

    InputFault carries every signal that does not exist and every unit that does
    not fit, the declared units of the controller's inputs included.
    """
    setup_called(scenario, variant)
    return requirements_for(scenario.requirements, variant, units, asked_over)


def units_of(wiring: Wiring) -> Units:
    """Return the unit of every signal of a loop, and of every constant that formulae may name."""
    signals = {name: unit.symbol for name, unit in wiring.units.items()}
    return Units(signals, wiring.diagram.plant.constant_units)


def plant_of(scenario: Scenario, variant: str) -> PlantNode | None:
    """Return the plant of a variant; None where it cannot be had."""
    return _plant(scenario, setup_called(scenario, variant).plant, [])


def axis_values(plant: PlantNode, axis: Axis, faults: Faults) -> list[float]:
    """Return the numbers of an axis of a plant's parameter or state, in its unit; faults with their place."""
    _, group, name = axis.key.split(".")
    values: list[float] = []
    for entry in axis.values:
        given, declaration = {name: entry}, plant.model.declaration
        if group == "parameters":
            found = _values("parameter", declaration.parameters, given, plant.model, faults)
        else:
            found = _values("state", declaration.states, given, plant.model, faults)
        values += found.values()
    return values


def check_inputs(setup: Setup, units: Units) -> None:
    """Raise InputFault where a signal does not have the unit that the controller's input declares."""
    faults: Faults = []
    for name, declared in setup.controller.inputs.items() if setup.controller else ():
        given, wanted = parse_unit(units.signals[f"{CONTROLLER}.{name}"]), parse_unit(str(declared.value))
        if not given.same_as(wanted):
            wire = setup.controller.wires[name] if setup.controller else declared
            message = f"the controller's input `{name}` is in {wanted}, and `{wire.value}` is in {given}"
            places = (Place(span=wire.span), Place(span=declared.span, label="its unit is declared here"))
            faults.append(Diagnostic(code="SCN308", message=message, places=places))
    if faults:
        raise InputFault(faults)


def setup_called(scenario: Scenario, variant: str) -> Setup:
    """Return the setup of a variant; InputFault with the nearest name where there is none."""
    if variant in scenario.variants:
        return scenario.variants[variant]
    near = nearest(variant, scenario.variants)
    hint = f"did you mean `{near}`?" if near else f"there are {listed(scenario.variants)}"
    message = f"`{scenario.name}` has no variant called `{variant}`"
    raise InputFault.at_file("SCN405", scenario.files[0].name, message, hint)


def _plant(scenario: Scenario, setup: PlantSetup, faults: Faults) -> PlantNode | None:
    if is_linear(setup):
        wires = {name: wire_of(entry) for name, entry in setup.inputs.items()}
        return linear_node(setup, wires, faults)
    faults += misplaced(setup)
    try:
        model = find(str(setup.model.value), scenario.bench, LINEAR_MODELS)
    except InputFault as fault:
        place = (Place(span=setup.model.span),)
        faults += [each if each.places else replace(each, places=place) for each in fault.diagnostics]
        return None
    declaration = model.declaration
    known = {each.name for each in declaration.inputs}
    return PlantNode(
        name=setup.name,
        model=model,
        parameters=_values("parameter", declaration.parameters, setup.parameters, model, faults),
        start=_values("state", declaration.states, setup.start, model, faults),
        inputs={
            name: wire_of(_placed(entry, is_known=name in known)) for name, entry in setup.inputs.items()
        },
        span=setup.span,
    )


def _values(
    what: str,
    declared: tuple[Parameter, ...] | tuple[State, ...],
    given: Entries,
    model: PlantModel,
    faults: Faults,
) -> dict[str, float]:
    units = {each.name: each.unit for each in declared}
    values = {}
    for name, entry in given.items():
        if name not in units:
            near = nearest(name, units)
            hint = f"did you mean `{near}`?" if near else f"it has {listed(units) or 'none'}"
            message = f"the plant `{model.declaration.name}` has no {what} called `{name}`"
            faults.append(finding("SCN309", message, entry.key, hint))
            continue
        value = converted(entry, parse_unit(units[name]), f"`{name}`", faults)
        if value is not None:
            values[name] = value
            faults += _out_of_range(name, value, entry, declared)
    return values


def _out_of_range(
    name: str, value: float, entry: Entry, declared: tuple[Parameter, ...] | tuple[State, ...]
) -> Iterator[Diagnostic]:
    for each in declared:
        if each.name == name and isinstance(each, Parameter):
            low = -math.inf if each.minimum is None else each.minimum
            high = math.inf if each.maximum is None else each.maximum
            if not low <= value <= high:
                bounds = f"at least {low:g}" if math.isinf(high) else f"between {low:g} and {high:g}"
                hint = f"it must be {bounds} {each.unit}: {each.meaning}"
                yield finding("SCN310", f"`{name}` cannot be {entry.value}", entry, hint)


def _node(
    setup: Setup, name: str, block: Entry, load_block: LoadBlock, faults: Faults
) -> Node | FuzzyNode | None:
    scope = local_names(setup) if name.startswith(f"{CONTROLLER}.") else None
    if is_fuzzy(block):
        called = block.get("block")
        try:
            file = Path(shown(setup.rule_bases[name]))  # as messages name it
            loaded = load_block(file, str(called.value) if called else None)
        except InputFault as fault:
            faults += fault.diagnostics
            return None
        return _fuzzy_node(name, block, loaded, scope, faults)
    return plain_node(name, block, setup.block_files, lambda entry: _wired(entry, scope, faults), faults)


def _fuzzy_node(name: str, block: Entry, loaded: Block, scope: Scope | None, faults: Faults) -> FuzzyNode:
    wires = {
        port: _wired(_placed(entry, is_known=port in loaded.inputs), scope, faults)
        for port, entry in block.table["inputs"].table.items()
    }
    units = block.get("units")
    declared = {key: str(entry.value) for key, entry in (units.table if units else NOTHING).items()}
    node = FuzzyNode(name=name, block=loaded, inputs=wires, units=declared, span=block.key)
    ranges_of(node, block, faults)  # for its faults: a run does not need them
    return in_arithmetic(node, block, faults)


def local_names(setup: Setup) -> Scope:
    """Return the names inside the controller file: its inputs and blocks, each with its path."""
    prefix = f"{CONTROLLER}."
    names = {path.removeprefix(prefix): path for path in setup.blocks if path.startswith(prefix)}
    if setup.controller is not None:
        names |= {name: prefix + name for name in setup.controller.inputs}
    return names


def wire_of(entry: Entry) -> Wire:
    """Return the wire that a text names: a signal's path, behind a minus for its negative."""
    text = str(entry.value).replace(" ", "")
    return Wire(text.removeprefix("-"), -1.0 if text.startswith("-") else 1.0, entry.span)


def _placed(entry: Entry, *, is_known: bool) -> Entry:
    """Return a wire that stands where its input is named if there is no such input: that is what is wrong."""
    return entry if is_known else replace(entry, span=entry.key)


def _wired(entry: Entry, scope: Scope | None, faults: Faults) -> Wire:
    """Return the wire of an entry; within a controller its name is one of `scope`."""
    wire = wire_of(entry)
    if scope is None:
        return wire
    first, dot, rest = wire.source.partition(".")
    if first in scope:
        return replace(wire, source=scope[first] + dot + rest)
    near = nearest(wire.source, scope) or nearest(first, scope)
    hint = f"did you mean `{near}`?" if near else f"there are {listed(scope)}"
    if dot:
        hint = f"a controller sees its own inputs and blocks: {listed(scope)}"
    faults.append(finding("SCN306", f"the controller has no signal called `{wire.source}`", entry, hint))
    return wire


def _aliases(setup: Setup, faults: Faults) -> dict[str, Wire]:
    if setup.controller is None:
        return {}
    scope = local_names(setup)
    inputs = {f"{CONTROLLER}.{name}": wire_of(entry) for name, entry in setup.controller.wires.items()}
    outputs = {
        f"{CONTROLLER}.{name}": _wired(entry, scope, faults)
        for name, entry in setup.controller.outputs.items()
    }
    return inputs | outputs

"""Diagram → Wiring: every name is resolved, every unit fits, the order of execution is known."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from fcl_sim.diagnostics import Diagnostic, InputFault, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.loop.diagram import Diagram, FuzzyNode, Node, Wire
from fcl_sim.loop.fit import conversion, fault, settle, unfit_names, unfit_node
from fcl_sim.loop.order import in_order
from fcl_sim.loop.settings import AnyNode, outputs_of, signals_of, waits_for
from fcl_sim.units import Quantity, Unit, parse_unit


@dataclass(frozen=True, slots=True, kw_only=True)
class Wiring:
    """A diagram that fits together.

    `order` is the order of execution. `units` has the unit of every signal and
    alias, in the order in which a trace lists them; `sources` gives for every
    alias the signal it stands for and the sign. `settings` has what each block,
    but for fuzzy ones, is set up with.
    """

    diagram: Diagram
    order: tuple[Node | FuzzyNode, ...]
    units: Mapping[str, Unit]
    sources: Mapping[str, Wire]
    settings: Mapping[str, Setting]

    def resolve(self, wire: Wire) -> Wire:
        """Return the wire from the signal itself, signs multiplied."""
        if wire.source not in self.sources:
            return wire
        source = self.sources[wire.source]
        return Wire(source.source, wire.sign * source.sign, wire.span)


def wire(diagram: Diagram) -> Wiring:
    """Return the wiring of a diagram; InputFault with everything that does not fit."""
    faults: list[Diagnostic] = []
    signals = _declared_signals(diagram, faults)
    sources = _resolve_aliases(diagram, signals, faults)
    faults += _unknown_sources(diagram, signals, sources)
    faults += _unfit_blocks(diagram)
    _raise(faults)
    plain = Wiring(diagram=diagram, order=diagram.nodes, units={}, sources=sources, settings={})
    order = in_order(
        diagram.nodes,
        lambda node: [plain.resolve(each).source for each in waits_for(node, diagram.timing)],
    )
    units, settings = _units(diagram, order, plain, faults)
    _raise(faults)
    return Wiring(diagram=diagram, order=order, units=units, sources=sources, settings=settings)


def _ends_of(diagram: Diagram) -> Iterator[tuple[Wire, str]]:
    """Yield every wire of a diagram with the end that reads it, in words."""
    plant = diagram.plant
    for node in diagram.nodes:
        yield from ((each, f"`{port}` of `{node.name}`") for port, each in node.inputs.items())
    for name, each in plant.inputs.items():
        yield each, f"the plant's input `{plant.name}.{name}`"
    yield from ((each, f"`{name}`") for name, each in diagram.aliases.items())


def _raise(faults: list[Diagnostic]) -> None:
    if faults:
        raise InputFault(faults)


def _declared_signals(diagram: Diagram, faults: list[Diagnostic]) -> tuple[str, ...]:
    owners = dict.fromkeys(diagram.plant.signals, f"the plant `{diagram.plant.name}`")
    owners |= {name: f"the connection from `{each.source}`" for name, each in diagram.aliases.items()}
    for node in diagram.nodes:
        for name in signals_of(node):
            if name in owners:
                message = f"there are two signals called `{name}`: of {owners[name]} and of `{node.name}`"
                hint = "a signal has one source: call one of the two otherwise"
                faults.append(fault("WIR101", message, node.span, hint))
            owners[name] = f"`{node.name}`"
    return tuple(name for name in owners if name not in diagram.aliases)


def _resolve_aliases(diagram: Diagram, signals: tuple[str, ...], faults: list[Diagnostic]) -> dict[str, Wire]:
    sources: dict[str, Wire] = {}
    for name, alias in diagram.aliases.items():
        source, sign, seen = alias.source, alias.sign, {name}
        while source in diagram.aliases and source not in signals:
            if source in seen:
                faults.append(fault("WIR301", f"`{name}` is connected to itself", alias.span))
                break
            seen.add(source)
            sign *= diagram.aliases[source].sign
            source = diagram.aliases[source].source
        sources[name] = Wire(source, sign, alias.span)
    return sources


def _unknown_sources(
    diagram: Diagram, signals: tuple[str, ...], sources: Mapping[str, Wire]
) -> Iterator[Diagnostic]:
    known = {*signals, *sources}
    there_are = f"there are {listed(sorted(known))}"
    for each, reader in _ends_of(diagram):
        if each.source not in known:
            near = nearest(each.source, known) or nearest(each.source.rpartition(".")[2], known)
            hint = f"did you mean `{near}`? {there_are}" if near else there_are
            message = f"there is no signal called `{each.source}`, which {reader} reads"
            yield fault("WIR102", message, each.span, hint)


def _unfit_blocks(diagram: Diagram) -> Iterator[Diagnostic]:
    plant = diagram.plant
    yield from _unfit_plant(diagram)
    for declared in plant.model.declaration.inputs:
        if declared.name not in plant.inputs and not declared.optional:
            message = f"the plant's input `{plant.name}.{declared.name}` is not connected"
            hint = f'it is in {declared.unit or "1"}: "{declared.meaning}"'
            yield fault("WIR103", message, plant.span, hint)
    for node in diagram.nodes:
        yield from unfit_node(node)


def _unfit_plant(diagram: Diagram) -> Iterator[Diagnostic]:
    plant, declaration = diagram.plant, diagram.plant.model.declaration
    owner = f"the plant `{plant.name}`"
    groups = (
        ("parameter", declaration.parameters, plant.parameters),
        ("state", declaration.states, plant.start),
        ("input", declaration.inputs, plant.inputs),
    )
    for what, declared, given in groups:
        yield from unfit_names(owner, what, tuple(each.name for each in declared), given, plant.span)
    for parameter in declaration.parameters:
        value = plant.parameters.get(parameter.name, parameter.default)
        low, high = parameter.minimum, parameter.maximum
        if (low is not None and value < low) or (high is not None and value > high):
            bounds = f"at least {low:g}" if high is None else f"between {low:g} and {high:g}"
            message = f"`{parameter.name}` of {owner} is {value:g} {parameter.unit}"
            yield fault("WIR202", message, plant.span, f"it must be {bounds} {parameter.unit}")


def _units(
    diagram: Diagram, order: tuple[Node | FuzzyNode, ...], plain: Wiring, faults: list[Diagnostic]
) -> tuple[dict[str, Unit], dict[str, Setting]]:
    plant = diagram.plant
    settings: dict[str, Setting] = {}
    declaration = plant.model.declaration
    driven = [each for each in declaration.inputs if each.name in plant.inputs]
    units = {f"{plant.name}.{each.name}": parse_unit(each.unit) for each in declaration.outputs}
    units |= {f"{plant.name}.{each.name}": parse_unit(each.unit) for each in driven}
    left = list(order)
    while left:
        waiting = []
        for node in left:
            if not _sources_in(node, plain) <= units.keys():
                waiting.append(node)
                continue
            given = {port: units[plain.resolve(each).source] for port, each in node.inputs.items()}
            if isinstance(node, FuzzyNode):
                units |= _fuzzy_units(node, given, faults)
            else:
                settings[node.name], own = settle(node, given, diagram.timing, faults)
                faults += _contradicting(node, own, units)
                units |= own
        if len(waiting) == len(left):
            supposed = _supposed(waiting, units)
            units |= supposed
            if not supposed:
                faults += () if faults else _circular(waiting)
                break
        left = waiting
    for declared in driven:
        each = plant.inputs[declared.name]
        unit = units.get(plain.resolve(each).source)
        if unit is not None and not unit.same_as(parse_unit(declared.unit)):
            wanted = parse_unit(declared.unit)
            message = f"`{plant.name}.{declared.name}` takes {wanted}, and `{each.source}` is in {unit}"
            faults.append(fault("WIR201", message, each.span, conversion(unit, wanted)))
    units |= {name: units[source.source] for name, source in plain.sources.items() if source.source in units}
    return units, settings


def _sources_in(node: AnyNode, plain: Wiring) -> set[str]:
    return {plain.resolve(each).source for each in node.inputs.values()}


def _supposed(left: Sequence[AnyNode], units: Mapping[str, Unit]) -> dict[str, Unit]:
    """Return the unit of an output in a circle of blocks that declares it, or whose parameters tell it."""
    for node in left:
        for name, output in outputs_of(node):
            if name not in units and isinstance(output.unit, str):
                return {name: parse_unit(output.unit)}
            given = node.parameters.get(output.told_by) if isinstance(node, Node) else None
            if name not in units and isinstance(given, Quantity):
                return {name: given.unit}
    return {}


def _contradicting(node: Node, own: Mapping[str, Unit], units: Mapping[str, Unit]) -> Iterator[Diagnostic]:
    for name, unit in own.items():
        if name in units and not unit.same_as(units[name]):
            message = f"`{name}` is in {unit}, and its own parameters say {units[name]}"
            yield fault("WIR201", message, node.span, conversion(unit, units[name]))


def _circular(left: Sequence[AnyNode]) -> Iterator[Diagnostic]:
    """Yield the fault of blocks whose units follow from each other."""
    told = [(node, each.told_by) for node in left for _, each in outputs_of(node) if each.told_by]
    node, name = told[0] if told else (left[0], "")
    hint = f"give `{name}` of `{node.name}` with its unit" if name else ""
    yield fault("WIR201", f"the unit of `{node.name}` depends on itself", node.span, hint)


def _fuzzy_units(node: FuzzyNode, given: Mapping[str, Unit], faults: list[Diagnostic]) -> dict[str, Unit]:
    declared = {name: parse_unit(unit) for name, unit in node.units.items()}
    for name, unit in given.items():
        expected = declared.get(name, parse_unit(""))
        if unit.same_as(expected):
            continue
        each = node.inputs[name]
        if name in declared:
            message = f"`{name}` of `{node.name}` is in {expected}, and `{each.source}` is in {unit}"
            hint = conversion(unit, expected)
        else:
            message = f"`{name}` of `{node.name}` has no unit, and `{each.source}` is in {unit}"
            hint = f'FCL variables have no units; declare it: units = {{ {name} = "{unit.symbol}" }}'
        faults.append(fault("WIR201", message, each.span, hint))
    outputs = node.block.program.output_names
    return {f"{node.name}.{name}": declared.get(name, parse_unit("")) for name in outputs}

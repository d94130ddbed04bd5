"""Diagram → Wiring: every name is resolved, every unit fits, the order of execution is known."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from fcl_sim.diagnostics import Diagnostic, InputFault, Place, Span, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.loop.blocks import BLOCKS
from fcl_sim.loop.diagram import Diagram, FuzzyNode, Node, Wire
from fcl_sim.loop.order import in_order, signals_of
from fcl_sim.units import Unit, UnitError, parse_unit


@dataclass(frozen=True, slots=True, kw_only=True)
class Wiring:
    """A diagram that fits together.

    `order` is the order of execution. `units` has the unit of every signal and
    alias, in the order in which a trace lists them; `sources` gives for every
    alias the signal it stands for and the sign.
    """

    diagram: Diagram
    order: tuple[Node | FuzzyNode, ...]
    units: Mapping[str, Unit]
    sources: Mapping[str, Wire]

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
    plain = Wiring(diagram=diagram, order=diagram.nodes, units={}, sources=sources)
    order = in_order(
        diagram.nodes, lambda node: [plain.resolve(each).source for each in node.inputs.values()]
    )
    units = _units(diagram, order, plain, faults)
    _raise(faults)
    return Wiring(diagram=diagram, order=order, units=units, sources=sources)


def wires_of(diagram: Diagram) -> Iterator[Wire]:
    """Yield every wire of a diagram."""
    for node in diagram.nodes:
        yield from node.inputs.values()
    yield from diagram.plant.inputs.values()
    yield from diagram.aliases.values()


def fault(code: str, message: str, span: Span | None = None, hint: str = "") -> Diagnostic:
    """Return a finding about the wiring, at its place in the scenario where that is known."""
    places = (Place(span=span),) if span else ()
    return Diagnostic(code=code, message=message, places=places, hint=hint)


def _raise(faults: list[Diagnostic]) -> None:
    if faults:
        raise InputFault(faults)


def _declared_signals(diagram: Diagram, faults: list[Diagnostic]) -> tuple[str, ...]:
    names = list(diagram.plant.signals)
    for node in diagram.nodes:
        for name in signals_of(node):
            if name in names or name in diagram.aliases:
                faults.append(fault("WIR101", f"there are two signals called `{name}`", node.span))
            names.append(name)
    return tuple(names)


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
    for each in wires_of(diagram):
        if each.source not in known:
            near = nearest(each.source, known) or nearest(each.source.rpartition(".")[2], known)
            hint = f"did you mean `{near}`?" if near else f"there are {listed(sorted(known))}"
            yield fault("WIR102", f"there is no signal called `{each.source}`", each.span, hint)


def _unfit_blocks(diagram: Diagram) -> Iterator[Diagnostic]:
    plant = diagram.plant
    yield from _unfit_plant(diagram)
    for declared in plant.model.declaration.inputs:
        if declared.name not in plant.inputs:
            message = f"the plant's input `{plant.name}.{declared.name}` is not connected"
            yield fault("WIR103", message, plant.span, f"it is {declared.meaning}, in {declared.unit or '1'}")
    for node in diagram.nodes:
        wanted = node.block.program.input_names if isinstance(node, FuzzyNode) else _ports(node)
        yield from _unfit_names(f"`{node.name}`", "input", wanted, node.inputs, node.span)
        for name in wanted:
            if name not in node.inputs:
                yield fault("WIR103", f"the input `{name}` of `{node.name}` is not connected", node.span)
        if isinstance(node, FuzzyNode):
            known = (*node.block.program.input_names, *node.block.program.output_names)
            yield from _unfit_names(f"`{node.name}`", "variable", known, node.units, node.span)
        else:
            yield from _unfit_parameters(node)


def _unfit_names(
    owner: str, what: str, known: tuple[str, ...], given: Mapping[str, object], span: Span | None
) -> Iterator[Diagnostic]:
    for name, value in given.items():
        if name not in known:
            near = nearest(name, known)
            hint = f"did you mean `{near}`?" if near else f"it has {listed(known) or 'none'}"
            place = getattr(value, "span", None) or span
            yield fault("WIR104", f"{owner} has no {what} called `{name}`", place, hint)


def _ports(node: Node) -> tuple[str, ...]:
    block = BLOCKS[node.type]
    return tuple(node.inputs) if block.terms else block.ports


def _unfit_parameters(node: Node) -> Iterator[Diagnostic]:
    block = BLOCKS[node.type]
    declared = {each.name: each for each in block.parameters}
    known = tuple(node.inputs) if block.terms else tuple(declared)
    yield from _unfit_names(f"`{node.name}`", "parameter", known, node.parameters, node.span)
    for name, parameter in declared.items():
        given = node.parameters.get(name)
        if given is None and parameter.default is None:
            message = f"`{node.name}` needs its parameter `{name}`: {parameter.meaning}"
            yield fault("WIR103", message, node.span)
        elif (
            given is not None
            and parameter.unit is not None
            and not given.unit.commensurate(parse_unit(parameter.unit))
        ):
            message = f"`{name}` of `{node.name}` is in {given.unit}"
            yield fault("WIR201", message, node.span, f"it is {parameter.meaning}, in {parameter.unit}")
    if block.terms and not node.inputs:
        yield fault("WIR103", f"`{node.name}` has no terms", node.span)


def _unfit_plant(diagram: Diagram) -> Iterator[Diagnostic]:
    plant, declaration = diagram.plant, diagram.plant.model.declaration
    owner = f"the plant `{plant.name}`"
    groups = (
        ("parameter", declaration.parameters, plant.parameters),
        ("state", declaration.states, plant.start),
        ("input", declaration.inputs, plant.inputs),
    )
    for what, declared, given in groups:
        yield from _unfit_names(owner, what, tuple(each.name for each in declared), given, plant.span)
    for parameter in declaration.parameters:
        value = plant.parameters.get(parameter.name, parameter.default)
        low, high = parameter.minimum, parameter.maximum
        if (low is not None and value < low) or (high is not None and value > high):
            bounds = f"at least {low:g}" if high is None else f"between {low:g} and {high:g}"
            message = f"`{parameter.name}` of {owner} is {value:g} {parameter.unit}"
            yield fault("WIR202", message, plant.span, f"it must be {bounds} {parameter.unit}")


def _units(
    diagram: Diagram, order: tuple[Node | FuzzyNode, ...], plain: Wiring, faults: list[Diagnostic]
) -> dict[str, Unit]:
    plant = diagram.plant
    declaration = plant.model.declaration
    units = {f"{plant.name}.{each.name}": parse_unit(each.unit) for each in declaration.outputs}
    units |= {f"{plant.name}.{each.name}": parse_unit(each.unit) for each in declaration.inputs}
    for node in order:
        given = {port: units.get(plain.resolve(each).source) for port, each in node.inputs.items()}
        known = {port: unit for port, unit in given.items() if unit is not None}
        if len(known) < len(given):
            continue  # a fault before it in the order was reported there
        if isinstance(node, FuzzyNode):
            units |= _fuzzy_units(node, known, faults)
        elif (rule := BLOCKS[node.type].unit) is not None:
            try:
                units[node.name] = rule(known, node.parameters)
            except UnitError as error:
                faults.append(fault("WIR201", f"`{node.name}`: {error}", node.span, error.hint))
    for declared in declaration.inputs:
        each = plant.inputs[declared.name]
        unit = units.get(plain.resolve(each).source)
        if unit is not None and not unit.same_as(parse_unit(declared.unit)):
            wanted = parse_unit(declared.unit)
            message = f"`{plant.name}.{declared.name}` takes {wanted}, and `{each.source}` is in {unit}"
            faults.append(fault("WIR201", message, each.span, _conversion(unit, wanted)))
    units |= {name: units[source.source] for name, source in plain.sources.items() if source.source in units}
    return units


def _fuzzy_units(node: FuzzyNode, given: Mapping[str, Unit], faults: list[Diagnostic]) -> dict[str, Unit]:
    declared = {name: parse_unit(unit) for name, unit in node.units.items()}
    for name, unit in given.items():
        expected = declared.get(name, parse_unit(""))
        if unit.same_as(expected):
            continue
        each = node.inputs[name]
        if name in declared:
            message = f"`{name}` of `{node.name}` is in {expected}, and `{each.source}` is in {unit}"
            hint = _conversion(unit, expected)
        else:
            message = f"`{name}` of `{node.name}` has no unit, and `{each.source}` is in {unit}"
            hint = f'FCL variables have no units; declare it: units = {{ {name} = "{unit.symbol}" }}'
        faults.append(fault("WIR201", message, each.span, hint))
    outputs = node.block.program.output_names
    return {f"{node.name}.{name}": declared.get(name, parse_unit("")) for name in outputs}


def _conversion(given: Unit, wanted: Unit) -> str:
    if given.commensurate(wanted):
        return f"put a `gain` between them that converts {given} to {wanted}"
    return "the two are different kinds of quantity: is this the signal you mean?"

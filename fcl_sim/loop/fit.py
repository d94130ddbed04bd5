"""Does a block fit what its type declares? Names first, then units, then what its parameters may be."""

from collections.abc import Iterable, Iterator, Mapping

from fcl_sim.diagnostics import Diagnostic, Place, Span, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.loop.blocks.declaration import BlockParameter, Like, Misfit, ToldElsewhere, UnitRule
from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.loop.diagram import FuzzyNode, Node, Timing
from fcl_sim.loop.settings import members_of, outputs_of, quantities_of, resolved, setting_of, type_of
from fcl_sim.units import Quantity, Unit, UnitError, parse_unit, short

Faults = list[Diagnostic]


def fault(code: str, message: str, span: Span | None = None, hint: str = "") -> Diagnostic:
    """Return a finding about the wiring, at its place in the scenario where that is known."""
    places = (Place(span=span),) if span else ()
    return Diagnostic(code=code, message=message, places=places, hint=hint)


def unfit_names(
    owner: str, what: str, known: tuple[str, ...], given: Mapping[str, object], span: Span | None
) -> Iterator[Diagnostic]:
    """Yield a fault for each given name that is not known."""
    for name, value in given.items():
        if name not in known:
            near = nearest(name, known)
            hint = f"did you mean `{near}`?" if near else f"it has {listed(known) or 'none'}"
            place = getattr(value, "span", None) or span
            yield fault("WIR104", f"{owner} has no {what} called `{name}`", place, hint)


def unfit_node(node: Node | FuzzyNode) -> Iterator[Diagnostic]:
    """Yield the inputs and parameters of a block that are unknown or missing."""
    if isinstance(node, FuzzyNode):
        program = node.block.program
        yield from _unfit_inputs(node, program.input_names, program.input_names)
        known = (*program.input_names, *program.output_names)
        for given in (node.units, node.scale):
            yield from unfit_names(f"`{node.name}`", "variable", known, given, node.span)
        return
    kind, members = type_of(node), members_of(node)
    needed = tuple(each.name for each in kind.inputs if each.default is None)
    known = (*(each.name for each in kind.named_inputs), *members)
    yield from _unfit_inputs(node, known, needed)
    if kind.group and len(members) < kind.group.least:
        least = kind.group.least
        short_of = f"no {kind.group.name}" if not members else f"fewer than {least} {kind.group.name}"
        yield fault("WIR103", f"`{node.name}` has {short_of}", node.span, kind.group.meaning)
    yield from _unfit_parameters(node)


def _unfit_inputs(
    node: Node | FuzzyNode, known: tuple[str, ...], needed: tuple[str, ...]
) -> Iterator[Diagnostic]:
    yield from unfit_names(f"`{node.name}`", "input", known, node.inputs, node.span)
    for name in needed:
        if name not in node.inputs:
            yield fault("WIR103", f"the input `{name}` of `{node.name}` is not connected", node.span)


def _unfit_parameters(node: Node) -> Iterator[Diagnostic]:
    kind = type_of(node)
    known = tuple(each.name for each in kind.parameters)
    if kind.group and kind.group.form == "gains":
        known += members_of(node)
    yield from unfit_names(f"`{node.name}`", "parameter", known, node.parameters, node.span)
    for parameter in kind.parameters:
        name = parameter.name
        given = node.parameters.get(name)
        if given is None and parameter.default is None and name not in node.inputs:
            message = f"`{node.name}` needs its parameter `{name}`: {parameter.meaning}"
            yield fault("WIR103", message, node.span)
        elif parameter.kind in {"list", "table", "rows", "units"} and not given and parameter.default is None:
            message = f"`{name}` of `{node.name}` is empty"
            yield fault("WIR202", message, _place(node, name), f"it is {parameter.meaning}")
        if given is not None and parameter.choices and given not in parameter.choices:
            hint = f"it is {listed(parameter.choices)}"
            message = f"`{name}` of `{node.name}` cannot be `{given}`"
            yield fault("WIR202", message, _place(node, name), hint)
    if kind.legible and all(each.name in node.parameters for each in kind.parameters if each.default is None):
        yield from _told(node, kind.legible(node.parameters))


def _told(node: Node, misfits: Iterable[Misfit]) -> Iterator[Diagnostic]:
    for each in misfits:
        place = each.span or _place(node, each.parameter)
        yield fault(each.code, f"`{node.name}`: {each.message}", place, each.hint)


def settle(
    node: Node, given: Mapping[str, Unit], timing: Timing, faults: Faults
) -> tuple[Setting, dict[str, Unit]]:
    """Return a block's setting and the units of its signals; note what does not fit.

    `given` has the unit of every connected port.
    """
    setting, misfits = setting_of(node, given, timing)
    for name, error in misfits:
        parameter = next(each for each in type_of(node).parameters if each.name == name)
        bare = _bare_partner(node, parameter)
        if bare is not None:
            faults.append(bare)
            continue
        message = f"`{name}` of `{node.name}`: {error}"
        hint = f"it is {parameter.meaning}; {error.hint}" if error.hint else f"it is {parameter.meaning}"
        faults.append(fault("WIR201", message, _place(node, name), hint))
    faults += _unfit_units(node, given)
    if not misfits:
        faults += _out_of_bounds(node, setting)
    return setting, _output_units(node, given, faults)


def _bare_partner(node: Node, parameter: BlockParameter) -> Diagnostic | None:
    """Return the fault of a number without a unit, where it is to have that of `parameter`, which has one."""
    rule, given = parameter.unit, node.parameters.get(parameter.name)
    if not isinstance(rule, Like) or rule.times or not isinstance(given, Quantity):
        return None
    partner, unit = node.parameters.get(rule.name), given.unit.symbol
    if not isinstance(partner, Quantity) or partner.unit.symbol or not unit:
        return None
    message = f"`{rule.name}` of `{node.name}` has no unit, and `{parameter.name}` is {given}"
    written = Quantity(partner.value, given.unit)
    return fault("WIR201", message, _place(node, rule.name), f'write it with its unit: "{written}"')


def _unfit_units(node: Node, given: Mapping[str, Unit]) -> Iterator[Diagnostic]:
    kind, quantities = type_of(node), quantities_of(node)
    declared: dict[str, str | UnitRule | None] = {each.name: each.unit for each in kind.named_inputs}
    if kind.group:
        declared |= dict.fromkeys(members_of(node), kind.group.unit)
    for port, unit in given.items():
        try:
            wanted = resolved(declared[port], given, quantities)
        except (KeyError, UnitError):
            continue  # told where the rule's own unit is
        if wanted is not None and not unit.same_as(wanted):
            each = node.inputs[port]
            message = f"`{port}` of `{node.name}` is in {wanted}, and `{each.source}` is in {unit}"
            yield fault("WIR201", message, each.span, conversion(unit, wanted))


def _output_units(node: Node, given: Mapping[str, Unit], faults: Faults) -> dict[str, Unit]:
    units, quantities = {}, quantities_of(node)
    for name, output in outputs_of(node):
        try:
            units[name] = resolved(output.unit, given, quantities) or parse_unit("")
        except ToldElsewhere:
            continue
        except UnitError as error:
            faults.append(fault("WIR201", f"`{node.name}`: {error}", node.span, error.hint))
    return units


def _out_of_bounds(node: Node, setting: Setting) -> Iterator[Diagnostic]:
    kind = type_of(node)
    found = False
    for parameter in kind.parameters:
        if parameter.kind in {"quantity", "count"} and parameter.name in setting.values:
            value = setting.values[parameter.name]
            if not _within(parameter, value):
                found = True
                message = f"`{parameter.name}` of `{node.name}` is {_given(node, parameter, value)}"
                yield fault("WIR202", message, _place(node, parameter.name), _bounds(parameter))
    if kind.check and not found:
        yield from _told(node, kind.check(setting))


def _within(parameter: BlockParameter, value: float) -> bool:
    low, high, above = parameter.minimum, parameter.maximum, parameter.above
    return (
        (low is None or value >= low) and (high is None or value <= high) and (above is None or value > above)
    )


def _bounds(parameter: BlockParameter) -> str:
    parts = []
    if parameter.above is not None:
        parts.append(f"greater than {parameter.above:g}")
    if parameter.minimum is not None:
        parts.append(f"at least {parameter.minimum:g}")
    if parameter.maximum is not None:
        parts.append(f"at most {parameter.maximum:g}")
    return f"it must be {' and '.join(parts)}: {parameter.meaning}"


def _given(node: Node, parameter: BlockParameter, value: float) -> str:
    return str(node.parameters.get(parameter.name, short(value)))


def _place(node: Node, name: str) -> Span | None:
    return node.places.get(name, node.span)


def conversion(given: Unit, wanted: Unit) -> str:
    """Return what to do about a signal in one unit where another is wanted."""
    if given.commensurate(wanted):
        return f"put a `gain` between them that converts {given} to {wanted}"
    return "the two are different kinds of quantity: is this the signal you mean?"

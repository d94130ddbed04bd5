"""Tree + units of the signals → tree in which all numbers fit each other, or what is wrong with it."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from fcl_sim.diagnostics import Diagnostic, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.formula.functions import FUNCTIONS, Kind
from fcl_sim.formula.text import finding
from fcl_sim.formula.tree import Arithmetic, Expression, Number, Scaled, Signal
from fcl_sim.formula.write import written
from fcl_sim.units import ONE, Quantity, Unit, parse_unit

Sized = tuple[Expression, Unit]
SUMS = frozenset({"+", "-"})
"""Operators whose numbers must have one unit."""
RADIAN = parse_unit("rad")
LARGEST_POWER = 9


def root(unit: Unit) -> Unit | None:
    """Return the unit whose square is this one; None where a power is odd."""
    if any(power % 2 for _, power in unit.powers):
        return None
    halved = " ".join(f"{name}^{power // 2}" for name, power in unit.powers)
    return parse_unit(halved)


class Resolver:
    """Units of signals, and the faults found so far. `show` writes a part as messages have it."""

    def __init__(self, units: Mapping[str, Unit], show: Callable[[Expression], str] = written) -> None:
        self.units = units
        self.show = show
        self.faults: list[Diagnostic] = []

    def number(self, node: Expression) -> Sized | None:
        """Return a number and its unit; None where a fault was found."""
        match node:
            case Number():
                return node, node.quantity.unit
            case Signal():
                return self._signal(node)
            case Arithmetic():
                return self._arithmetic(node)
            case Scaled():
                return self.number(node.operand)

    def alike(self, given: Sequence[Sized | None]) -> tuple[tuple[Expression, ...], Unit] | None:
        """Return numbers in one unit, that of the first which is more than a written number."""
        known = [each for each in given if each is not None]
        if not known:
            return None
        leader, unit = next((each for each in known if not isinstance(each[0], Number)), known[0])
        misfits = [each for each in known if not each[1].commensurate(unit)]
        for node, own in misfits:
            self.faults.append(self._misfit((leader, unit), (node, own)))
        if misfits or len(known) < len(given):
            return None
        return tuple(_converted(node, own, unit) for node, own in known), unit

    def _signal(self, node: Signal) -> Sized | None:
        if node.name in self.units:
            return node, self.units[node.name]
        near = nearest(node.name, self.units) or nearest(node.name.rpartition(".")[2], self.units)
        hint = f"did you mean `{near}`?" if near else f"there are {listed(sorted(self.units))}"
        self.faults.append(finding("JDG202", f"there is no signal called `{node.name}`", node.span, hint))
        return None

    def _arithmetic(self, node: Arithmetic) -> Sized | None:
        given = [self.number(each) for each in node.operands]
        kind = FUNCTIONS[node.operator].kind if node.operator in FUNCTIONS else None
        shifted = _on_a_scale(node.operator, given)
        if shifted is not None:
            return node, shifted
        if node.operator in SUMS or kind in {Kind.ALIKE, Kind.DIRECTION}:
            alike = self.alike(given)
            if alike is None:
                return None
            operands, unit = alike
            return replace(node, operands=operands), RADIAN if kind is Kind.DIRECTION else unit
        known = [each for each in given if each is not None]
        if len(known) < len(given):
            return None
        if kind is None or kind is Kind.KEEPS:
            made = replace(node, operands=tuple(each for each, _ in known))
            return made, self._named(_product(node.operator, known))
        fitting = self._fitting(node, kind, known)
        return None if fitting is None else (replace(node, operands=fitting[0]), fitting[1])

    def _named(self, unit: Unit) -> Unit:
        """Return a unit by the name that a signal has for it, where that is shorter: `m` for `kg m/s2 N`."""
        alike = (each for each in self.units.values() if each.same_as(unit))
        return next((each for each in alike if len(each.powers) < len(unit.powers)), unit)

    def _fitting(
        self, node: Arithmetic, kind: Kind, known: Sequence[Sized]
    ) -> tuple[tuple[Expression, ...], Unit] | None:
        """Return the numbers that a function takes in the units it wants, and the unit of its result."""
        (operand, unit), exponent = known[0], known[-1][0]
        if kind is Kind.ROOT:
            halved = root(unit)
            if halved is not None:
                return (operand,), halved
            hint = "the root of m2/s2 is m/s; divide it by what it is measured by"
            self._refuse(operand, f"the root of {unit} is no unit", hint)
            return None
        if kind is Kind.POWER and unit.symbol:
            whole = _whole(exponent)
            if whole is not None:
                return (operand, exponent), unit**whole
            message = f"`{self.show(operand)}` is in {unit}, so its exponent is a whole number"
            self._refuse(exponent, message, f"write one from -{LARGEST_POWER} to {LARGEST_POWER}")
            return None
        wanted = RADIAN if kind is Kind.OF_ANGLE else ONE
        misfits = [each for each in known if not each[1].commensurate(wanted)]
        for each, own in misfits:
            what = "an angle" if kind is Kind.OF_ANGLE else "a plain number"
            hint = "in rad or deg" if kind is Kind.OF_ANGLE else "divide it by what it is measured by"
            self._refuse(each, f"`{node.operator}` takes {what}, and `{self.show(each)}` is in {own}", hint)
        if misfits:
            return None
        operands = tuple(_converted(each, own, wanted) for each, own in known)
        return operands, RADIAN if kind is Kind.ANGLE else ONE

    def _refuse(self, at: Expression, message: str, hint: str) -> None:
        self.faults.append(finding("JDG203", message, at.span, hint))

    def _misfit(self, leader: Sized, other: Sized) -> Diagnostic:
        (first, unit), (node, own) = leader, other
        message = f"`{self.show(first)}` is in {unit}, and `{self.show(node)}` is in {own}"
        hint = f"write it in {unit}, or in a unit that converts to it"
        if own.symbol == "":
            message = f"`{self.show(first)}` is in {unit}, and `{self.show(node)}` has no unit"
            if isinstance(node, Number):
                hint = f"write `{self.show(node)} {unit}`"
        elif unit.symbol == "":
            message = f"`{self.show(first)}` has no unit, and `{self.show(node)}` is in {own}"
            hint = "write the number alone" if isinstance(node, Number) else ""
        return finding("JDG203", message, node.span, hint)


def _on_a_scale(operator: str, given: Sequence[Sized | None]) -> Unit | None:
    """Return the unit of a difference of temperatures in degC, or of one that K are added to; else None."""
    units = [each[1] for each in given if each is not None]
    if operator not in SUMS or len(given) != 2 or len(units) != 2:
        return None
    scales = [not each.same_as(each.difference) for each in units]
    if not any(scales) or not units[0].difference.same_as(units[1].difference):
        return None
    if operator == "-":
        return units[1].difference if all(scales) else units[0] if scales[0] else None
    return None if all(scales) else units[scales.index(True)]


def _product(operator: str, known: Sequence[Sized]) -> Unit:
    """Return the unit of a product or quotient; else that of the only number."""
    unit = known[0][1]
    if operator == "*":
        return unit * known[1][1]
    return unit / known[1][1] if operator == "/" else unit


def _whole(node: Expression) -> int | None:
    """Return a whole number that is written as one, not too large for the exponent of a unit."""
    if not isinstance(node, Number) or node.quantity.unit.symbol:
        return None
    value = node.quantity.value
    return int(value) if value.is_integer() and abs(value) <= LARGEST_POWER else None


def _converted(node: Expression, own: Unit, unit: Unit) -> Expression:
    if own.same_as(unit):
        return node
    if isinstance(node, Number):
        return Number(Quantity(node.quantity.to(unit), unit), node.span)
    return Scaled(Quantity(1.0, own).to(unit), node, node.span)

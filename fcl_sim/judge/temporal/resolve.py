"""Tree + units of the signals → tree in which every comparison has one unit, or what is wrong with it."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from fcl_sim.diagnostics import Diagnostic, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.judge.temporal.text import finding
from fcl_sim.judge.temporal.tree import (
    Arithmetic,
    Comparison,
    Edge,
    Expression,
    Formula,
    Junction,
    Not,
    Number,
    Scaled,
    Signal,
    Truth,
    Until,
    Window,
)
from fcl_sim.judge.temporal.write import written
from fcl_sim.units import Quantity, Unit, parse_unit

Sized = tuple[Expression, Unit]
ALIKE = frozenset({"+", "-", "min", "max"})
"""Operators whose numbers must have one unit."""


def resolve(tree: Formula, units: Mapping[str, str]) -> tuple[Formula, list[Diagnostic]]:
    """Return the tree with its numbers in the units of the signals, and every fault of names and units.

    `units` has the unit of each signal.
    """
    resolver = _Resolver(units)
    return resolver.truth(tree), resolver.faults


class _Resolver:
    def __init__(self, units: Mapping[str, str]) -> None:
        self.units = units
        self.faults: list[Diagnostic] = []

    def truth(self, node: Formula) -> Formula:
        match node:
            case Truth():
                return node
            case Comparison():
                return self.comparison(node)
            case Not() | Edge() | Window():
                return replace(node, operand=self.truth(node.operand))
            case Junction() | Until():
                return replace(node, left=self.truth(node.left), right=self.truth(node.right))
        raise TypeError(node)

    def comparison(self, node: Comparison) -> Comparison:
        sides = (self.number(node.left), self.number(node.right))
        alike = self.alike(sides)
        if alike is None:
            return node
        (left, right), unit = alike
        return replace(node, left=left, right=right, unit=unit.symbol)

    def number(self, node: Expression) -> Sized | None:
        """Return a number and its unit; None where a fault was found."""
        match node:
            case Number():
                return node, node.quantity.unit
            case Signal():
                return self.signal(node)
            case Arithmetic():
                return self.arithmetic(node)
            case Scaled():
                return self.number(node.operand)

    def signal(self, node: Signal) -> Sized | None:
        if node.name in self.units:
            return node, parse_unit(self.units[node.name])
        near = nearest(node.name, self.units) or nearest(node.name.rpartition(".")[2], self.units)
        hint = f"did you mean `{near}`?" if near else f"there are {listed(sorted(self.units))}"
        self.faults.append(finding("JDG202", f"there is no signal called `{node.name}`", node.span, hint))
        return None

    def arithmetic(self, node: Arithmetic) -> Sized | None:
        given = [self.number(each) for each in node.operands]
        if node.operator in ALIKE:
            alike = self.alike(given)
            return None if alike is None else (replace(node, operands=alike[0]), alike[1])
        known = [each for each in given if each is not None]
        if len(known) < len(given):
            return None
        unit = known[0][1]
        if node.operator in {"*", "/"}:
            unit = unit * known[1][1] if node.operator == "*" else unit / known[1][1]
        return replace(node, operands=tuple(each for each, _ in known)), unit

    def alike(self, given: Sequence[Sized | None]) -> tuple[tuple[Expression, ...], Unit] | None:
        """Return numbers in one unit, that of the first which is more than a written number."""
        known = [each for each in given if each is not None]
        if not known:
            return None
        leader, unit = next((each for each in known if not isinstance(each[0], Number)), known[0])
        misfits = [each for each in known if not each[1].commensurate(unit)]
        for node, own in misfits:
            self.faults.append(_misfit((leader, unit), (node, own)))
        if misfits or len(known) < len(given):
            return None
        return tuple(_converted(node, own, unit) for node, own in known), unit


def _converted(node: Expression, own: Unit, unit: Unit) -> Expression:
    if own.same_as(unit):
        return node
    if isinstance(node, Number):
        return Number(Quantity(node.quantity.to(unit), unit), node.span)
    return Scaled(Quantity(1.0, own).to(unit), node, node.span)


def _misfit(leader: Sized, other: Sized) -> Diagnostic:
    (first, unit), (node, own) = leader, other
    message = f"`{written(first)}` is in {unit}, and `{written(node)}` is in {own}"
    hint = f"write it in {unit}, or in a unit that converts to it"
    if own.symbol == "":
        message = f"`{written(first)}` is in {unit}, and `{written(node)}` has no unit"
        if isinstance(node, Number):
            hint = f"write `{written(node)} {unit}`"
    elif unit.symbol == "":
        message = f"`{written(first)}` has no unit, and `{written(node)}` is in {own}"
        hint = "write the number alone" if isinstance(node, Number) else ""
    return finding("JDG203", message, node.span, hint)

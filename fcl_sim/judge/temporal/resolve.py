"""Tree + units of the signals → tree in which every comparison has one unit, or what is wrong with it."""

from collections.abc import Mapping
from dataclasses import replace

from fcl_sim.diagnostics import Diagnostic
from fcl_sim.formula.resolve import Resolver
from fcl_sim.judge.temporal.tree import Comparison, Edge, Formula, Junction, Not, Truth, Until, Window
from fcl_sim.judge.temporal.write import written
from fcl_sim.units import parse_unit


def resolve(tree: Formula, units: Mapping[str, str]) -> tuple[Formula, list[Diagnostic]]:
    """Return the tree with its numbers in the units of the signals, and every fault of names and units.

    `units` has the unit of each signal.
    """
    resolver = _Resolver({name: parse_unit(unit) for name, unit in units.items()}, written)
    return resolver.truth(tree), resolver.faults


class _Resolver(Resolver):
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

"""What rules have concluded on a variable, told from their degrees of firing (S27a to S29)."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce

from fcl_sim.engine.conditions import NORM_CODE, OPERATORS
from fcl_sim.engine.hedged import hedged_degree
from fcl_sim.engine.plan_areas import algorithms, conclusions, grouped
from fcl_sim.model import Accumulation, FunctionBlock

Weight = Callable[[float | str], float]


@dataclass(frozen=True, slots=True)
class Concluded:
    """A conclusion: its accumulation by the number of the group, its term, and its weighted degree."""

    group: int
    term: str | None
    degree: float


def degree_so_far(
    block: FunctionBlock, variable: str, term: str | None, degrees: Sequence[float], weight_of: Weight
) -> float:
    """Return the degree accumulated for a term by the rules whose `degrees` are given, the first ones.

    `term` is None for a variable without terms.
    """
    kinds, group_of = grouped(algorithms(block, variable.casefold()))
    firsts = _first_rules(block)
    found = [
        Concluded(
            group_of[number],
            each.term and each.term.casefold(),
            weight_of(each.weight) * hedged_degree(each.hedges, degrees[firsts[number] + place]),
        )
        for (number, place, _), _, each in conclusions(block)
        if each.variable.casefold() == variable.casefold() and firsts[number] + place < len(degrees)
    ]
    wanted = term and term.casefold()
    return max(
        (
            _accumulated(kind, wanted, [each for each in found if each.group == group])
            for group, kind in enumerate(kinds)
        ),
        default=0.0,
    )


def _first_rules(block: FunctionBlock) -> list[int]:
    """Return the number of the first rule of each rule block."""
    firsts = [0]
    for rule_block in block.rule_blocks:
        firsts.append(firsts[-1] + len(rule_block.rules))
    return firsts


def _accumulated(kind: Accumulation, term: str | None, members: Sequence[Concluded]) -> float:
    own = [each.degree for each in members if each.term == term]
    if kind is Accumulation.MAX:
        return max(own, default=0.0)
    if kind is Accumulation.SUM:
        return sum(own)
    if kind in NORM_CODE:
        return float(reduce(OPERATORS[NORM_CODE[kind]], map(Fraction, own), Fraction(0)))
    if kind is Accumulation.BSUM:
        return min(1.0, sum(own))
    sums: dict[str | None, float] = {}
    for each in members:
        sums[each.term] = sums.get(each.term, 0.0) + each.degree
    return sum(own) / max(1.0, *sums.values()) if own else 0.0

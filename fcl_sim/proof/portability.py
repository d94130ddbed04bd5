"""What other engines make of the same text: where, by how much, and why.

Each habit of another engine that the model can say is said in it, and the two
laws are compared (proof.apart).
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import product
from math import ceil, floor, log10

from fcl_sim.block import Block
from fcl_sim.diagnostics import Span
from fcl_sim.engine.assemble import assemble
from fcl_sim.model import (
    Accumulation,
    And,
    AndOperator,
    Condition,
    FunctionBlock,
    Or,
    OrOperator,
    Rule,
    RuleBlock,
)
from fcl_sim.proof.apart import Apart, apart
from fcl_sim.proof.universe import Stretch, Universe

PAIRS = {
    OrOperator.MAX: AndOperator.MIN,
    OrOperator.ASUM: AndOperator.PROD,
    OrOperator.BSUM: AndOperator.BDIF,
}
"""The AND that belongs to each OR (Table 3)."""

DIGITS = 7
"""Significant digits of a witness at which one is told as it was found."""
MOST = 0.95
"""The part of the largest difference that a witness of fewer digits shows."""


@dataclass(frozen=True, slots=True)
class Habit:
    """What some engines do: `who`, `what` they do, where, and the block as they understand it."""

    who: str
    what: str
    span: Span | None
    block: FunctionBlock
    hint: str


@dataclass(frozen=True, slots=True)
class Otherwise:
    """A habit that changes an output: it is `ours` at a point `at`, and by the habit `theirs`."""

    habit: Habit
    output: str
    at: Mapping[str, float]
    ours: float
    theirs: float


def otherwise(block: FunctionBlock, universe: Universe) -> Iterator[Otherwise]:
    """Yield for each habit the output that it changes most."""
    habits = list(_habits(block))
    if not habits:
        return
    ours = Block(block, assemble(block))
    for habit in habits:
        theirs = Block(habit.block, assemble(habit.block))
        differences = apart(ours, theirs, universe, coarse=True)
        found = [(each, each.largest.reached) for each in differences if each.largest]
        worst, most = max(found, key=lambda each: each[1], default=(None, 0.0))
        if worst is not None and worst.largest is not None and most > worst.threshold:
            yield _shown(habit, (ours, theirs), worst, _near(worst.largest.at, universe))


def _shown(
    habit: Habit, blocks: tuple[Block, Block], worst: Apart, points: Iterable[Mapping[str, float]]
) -> Otherwise:
    """Return a habit with the first point that shows most of the difference."""
    found = Otherwise(habit, worst.output, {}, worst.old, worst.new)
    for at in points:
        ours, theirs = (float(each.evaluate(at)[worst.output]) for each in blocks)
        found = Otherwise(habit, worst.output, at, ours, theirs)
        if abs(theirs - ours) >= MOST * abs(worst.new - worst.old):
            break
    return found


def _near(at: Mapping[str, float], universe: Universe) -> Iterator[Mapping[str, float]]:
    """Yield points of few digits around one, those of the fewest first, and at last the point itself."""
    for digits in range(1, DIGITS):
        for values in product(*(_rounded(each, digits) for each in at.values())):
            point = dict(zip(at, values, strict=True))
            if all(_is_within(value, universe.of(name)) for name, value in point.items()):
                yield point
    yield at


def _is_within(value: float, stretch: Stretch | None) -> bool:
    return stretch is None or stretch[0] <= value <= stretch[1]


def _rounded(value: float, digits: int) -> Iterable[float]:
    """Return a number with so many significant digits, downwards and upwards."""
    step = 10.0 ** (floor(log10(abs(value))) + 1 - digits) if value else 1.0
    return dict.fromkeys(float(f"{end(value / step) * step:.{digits + 1}g}") for end in (floor, ceil))


def _habits(block: FunctionBlock) -> Iterator[Habit]:
    mixed = [rule for each in block.rule_blocks for rule in each.rules if _is_mixed(rule)]
    if mixed:
        yield Habit(
            "jFuzzyLogic",
            f"reads rule {mixed[0].label} from left to right, where Table 6 has AND before OR",
            mixed[0].span,
            replace(block, rule_blocks=tuple(_read_leftwards(each) for each in block.rule_blocks)),
            "write the parentheses",
        )
    sums = [each for each in block.rule_blocks if each.accumulation is Accumulation.NSUM]
    if sums:
        yield Habit(
            "jFuzzyLogic and fuzzylite",
            "take NSUM pair by pair, which is BSUM, where Table 5 divides by the largest sum",
            sums[0].span,
            replace(block, rule_blocks=tuple(_bounded(each) for each in block.rule_blocks)),
            "take BSUM or MAX, which mean the same everywhere",
        )
    unpaired = [each for each in block.rule_blocks if _is_unpaired(each)]
    if unpaired:
        first = unpaired[0]
        yield Habit(
            "jFuzzyLogic",
            f"takes AND: {PAIRS[first.or_operator]} with OR: {first.or_operator}, whatever AND says",
            first.span,
            replace(block, rule_blocks=tuple(_paired(each) for each in block.rule_blocks)),
            "take a pair of Table 3",
        )


def _is_mixed(rule: Rule) -> bool:
    """Return whether a condition has AND behind OR, and no parentheses."""
    condition = rule.condition
    return (
        rule.nesting == 0
        and isinstance(condition, Or)
        and any(isinstance(each, And) for each in condition.arguments[1:])
    )


def _read_leftwards(rule_block: RuleBlock) -> RuleBlock:
    rules = tuple(_leftwards(each) if _is_mixed(each) else each for each in rule_block.rules)
    return replace(rule_block, rules=rules)


def _bounded(rule_block: RuleBlock) -> RuleBlock:
    is_sum = rule_block.accumulation is Accumulation.NSUM
    return replace(rule_block, accumulation=Accumulation.BSUM) if is_sum else rule_block


def _leftwards(rule: Rule) -> Rule:
    """Return a rule with AND and OR taken as they come."""
    condition = rule.condition
    if not isinstance(condition, Or):
        raise TypeError(condition)
    found: Condition | None = None
    for argument in condition.arguments:
        first, *others = argument.arguments if isinstance(argument, And) else (argument,)
        found = first if found is None else Or((found, first))
        for each in others:
            found = And((found, each))
    return replace(rule, condition=found or condition)


def _is_unpaired(rule_block: RuleBlock) -> bool:
    wanted = PAIRS.get(rule_block.or_operator)
    return wanted is not None and rule_block.and_operator is not wanted


def _paired(rule_block: RuleBlock) -> RuleBlock:
    if not _is_unpaired(rule_block):
        return rule_block
    return replace(rule_block, and_operator=PAIRS[rule_block.or_operator])

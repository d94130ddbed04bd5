"""Habits of other engines: what each makes of a text, said in the model, so that it can be evaluated."""

from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

from fcl_sim.diagnostics import Span
from fcl_sim.engine.refuse import has_area
from fcl_sim.model import (
    Accumulation,
    Activation,
    And,
    AndOperator,
    Conclusion,
    Condition,
    DataType,
    Degree,
    FunctionBlock,
    Fuzzification,
    Is,
    Or,
    OrOperator,
    Point,
    Points,
    Rule,
    RuleBlock,
    Term,
    Variable,
)

PAIRS = {
    OrOperator.MAX: AndOperator.MIN,
    OrOperator.ASUM: AndOperator.PROD,
    OrOperator.BSUM: AndOperator.BDIF,
}
"""The AND that belongs to each OR (Table 3)."""

FLOATS = frozenset((DataType.REAL, DataType.LREAL))
BESIDE = 1e-6
"""How far an edge is moved to have the degree on one side of it."""


@dataclass(frozen=True, slots=True)
class Habit:
    """What some engines do: `who`, `what` they do, where, and the block as they may understand it."""

    who: str
    what: str
    span: Span | None
    readings: tuple[FunctionBlock, ...]
    hint: str


def habits_of(block: FunctionBlock) -> Iterator[Habit]:
    """Yield what other engines may understand otherwise in a text."""
    yield from _of_conditions(block)
    yield from _of_accumulation(block)
    yield from _of_weights(block)
    yield from _of_rule_blocks(block)
    yield from _of_edges(block)


def _of_conditions(block: FunctionBlock) -> Iterator[Habit]:
    mixed = [rule for each in block.rule_blocks for rule in each.rules if _is_mixed(rule)]
    if mixed:
        yield Habit(
            "jFuzzyLogic",
            f"reads rule {mixed[0].label} from left to right, where Table 6 has AND before OR",
            mixed[0].span,
            (replace(block, rule_blocks=tuple(_read_leftwards(each) for each in block.rule_blocks)),),
            "write the parentheses",
        )
    unpaired = [each for each in block.rule_blocks if _is_unpaired(each)]
    if unpaired:
        first = unpaired[0]
        yield Habit(
            "jFuzzyLogic",
            f"takes AND: {PAIRS[first.or_operator]} with OR: {first.or_operator}, whatever AND says",
            first.span,
            (replace(block, rule_blocks=tuple(_paired(each) for each in block.rule_blocks)),),
            "take a pair of Table 3",
        )


def _of_accumulation(block: FunctionBlock) -> Iterator[Habit]:
    sums = [each for each in block.rule_blocks if each.accumulation is Accumulation.NSUM]
    if sums:
        yield Habit(
            "jFuzzyLogic and fuzzylite",
            "take NSUM pair by pair, which is BSUM, where Table 5 divides by the largest sum",
            sums[0].span,
            (replace(block, rule_blocks=tuple(_bounded(each) for each in block.rule_blocks)),),
            "take BSUM or MAX, which mean the same everywhere",
        )
    spans = [each.span for each in block.notes if each.code == "FCL341"]
    if spans:
        summed = tuple(
            replace(each, accumulation=Accumulation.SUM) if each.span in spans else each
            for each in block.rule_blocks
        )
        yield Habit(
            "jFuzzyLogic",
            "adds without a bound where ACCU is missing",
            spans[0],
            (replace(block, rule_blocks=summed),),
            "write ACCU: MAX",
        )


def _of_weights(block: FunctionBlock) -> Iterator[Habit]:
    areas = {each.variable.casefold() for each in block.defuzzifications if has_area(each)}
    weighted = [
        each
        for rule_block in block.rule_blocks
        if rule_block.activation is not Activation.PROD
        for rule in rule_block.rules
        for each in rule.conclusions
        if each.variable.casefold() in areas and each.weight not in {0.0, 1.0}
    ]
    inputs = [each for each in block.fuzzifications if each.terms]
    if weighted and inputs:
        yield Habit(
            "jFuzzyLogic and fuzzylite",
            "weight a rule before activation, where A.15 multiplies the activated result",
            weighted[0].span,
            (_weighted_before(block, areas),),
            "take ACT: PROD, under which both are the same",
        )


def _weighted_before(block: FunctionBlock, areas: Collection[str]) -> FunctionBlock:
    """Return a block in which the degrees of rules on areas are weighted before activation.

    The degree of such a rule becomes a local variable, which is multiplied by the weight.
    """
    weights = _Weights(next(each for each in block.fuzzifications if each.terms))
    rule_blocks = tuple(
        each for rule_block in block.rule_blocks for each in weights.apart(rule_block, areas) if each.rules
    )
    carrier = weights.carrier
    return replace(
        block,
        variables=(*block.variables, *(Variable(each) for each in weights.degrees)),
        fuzzifications=tuple(
            replace(each, terms=(*each.terms, *weights.terms)) if each is carrier else each
            for each in block.fuzzifications
        ),
        rule_blocks=rule_blocks,
    )


class _Weights:
    """Weights as subconditions: each constant one a term of `carrier` that is the same everywhere."""

    def __init__(self, carrier: Fuzzification) -> None:
        self.carrier = carrier
        self.degrees: list[str] = []
        self.terms: list[Term] = []

    def apart(self, rule_block: RuleBlock, areas: Collection[str]) -> Iterator[RuleBlock]:
        """Yield a rule block in three: degrees of weighted rules, all others, degrees times weights."""
        kept, degrees, products = [], [], []
        for rule in rule_block.rules:
            own = [
                each
                for each in rule.conclusions
                if each.variable.casefold() in areas and each.weight not in {0.0, 1.0}
            ]
            rest = tuple(each for each in rule.conclusions if each not in own)
            if rest:
                kept.append(replace(rule, conclusions=rest))
            for each in own:
                name = f"degree_{len(self.degrees)}"
                self.degrees.append(name)
                degrees.append(replace(rule, conclusions=(Conclusion(name, None),)))
                product = And((Degree(name), self._factor(name, each.weight)))
                products.append(replace(rule, condition=product, conclusions=(replace(each, weight=1.0),)))
        name = rule_block.name
        yield replace(rule_block, name=f"{name} degrees", rules=tuple(degrees))
        yield replace(rule_block, rules=tuple(kept))
        yield replace(
            rule_block, name=f"{name} products", and_operator=AndOperator.PROD, rules=tuple(products)
        )

    def _factor(self, name: str, weight: float | str) -> Condition:
        if isinstance(weight, str):
            return Degree(weight)
        self.terms.append(Term(name, Points((Point(0.0, weight),))))
        return Is(self.carrier.variable, name)


def _of_rule_blocks(block: FunctionBlock) -> Iterator[Habit]:
    for output in block.defuzzifications:
        name = output.variable.casefold()
        own = [
            number for number, each in enumerate(block.rule_blocks) if each.enabled and _concludes(each, name)
        ]
        if len(own) > 1:
            yield Habit(
                "jFuzzyLogic",
                f"lets one of the rule blocks on `{output.variable}` replace what the others gave",
                block.rule_blocks[own[1]].span,
                tuple(_alone(block, number, name) for number in own),
                "put the rules on an output into one rule block",
            )


def _concludes(rule_block: RuleBlock, name: str) -> bool:
    return any(each.variable.casefold() == name for rule in rule_block.rules for each in rule.conclusions)


def _alone(block: FunctionBlock, number: int, name: str) -> FunctionBlock:
    """Return a block in which only one rule block concludes on an output."""
    found = []
    for place, rule_block in enumerate(block.rule_blocks):
        rules = rule_block.rules
        if place != number:
            less = [_without(each, name) for each in rules]
            rules = tuple(each for each in less if each.conclusions)
        if rules:
            found.append(replace(rule_block, rules=rules))
    return replace(block, rule_blocks=tuple(found))


def _without(rule: Rule, name: str) -> Rule:
    return replace(
        rule, conclusions=tuple(each for each in rule.conclusions if each.variable.casefold() != name)
    )


def _of_edges(block: FunctionBlock) -> Iterator[Habit]:
    """Yield what differs at the vertical edges of inputs in whole numbers, which lie on them."""
    whole = {
        each.name.casefold() for each in block.inputs if each.type not in {DataType.REAL, DataType.LREAL}
    }
    found = [
        term
        for each in block.fuzzifications
        if each.variable.casefold() in whole
        for term in each.terms
        if _edges(term)
    ]
    if found:
        yield Habit(
            "jFuzzyLogic and fuzzylite",
            f"take another degree at a vertical edge, such as that of `{found[0].name}`, than the larger one",
            found[0].span,
            tuple(_beside(block, whole, side) for side in (-BESIDE, BESIDE)),
            "let the term begin or end between two whole numbers",
        )


def _edges(term: Term) -> bool:
    if not isinstance(term.shape, Points):
        return False
    return any(
        one.x == other.x and not isinstance(one.x, str) and one.degree != other.degree
        for one, other in pairwise(term.shape.points)
    )


def _beside(block: FunctionBlock, whole: Collection[str], side: float) -> FunctionBlock:
    """Return a block with the vertical edges of some inputs moved a little to one side."""

    def term(each: Term) -> Term:
        if not _edges(each) or not isinstance(each.shape, Points):
            return each
        points = [
            replace(point, x=float(point.x) + side) if not isinstance(point.x, str) else point
            for point in each.shape.points
        ]
        return replace(each, shape=Points(tuple(points)))

    return replace(
        block,
        fuzzifications=tuple(
            replace(each, terms=tuple(map(term, each.terms))) if each.variable.casefold() in whole else each
            for each in block.fuzzifications
        ),
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

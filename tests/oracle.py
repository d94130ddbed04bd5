"""The second opinion: IEC 61131-7 evaluated slowly and literally, in fractions.

Imports nothing of the engine, only the model's nouns. Every number is exact:
a float stands for the binary fraction that it is. Rules cited as in SEMANTICS.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from fcl_sim.model import (
    Accumulation,
    And,
    AndOperator,
    Condition,
    Degree,
    FunctionBlock,
    Is,
    Not,
    Or,
    OrOperator,
    Points,
    RuleBlock,
    Singleton,
)

ZERO, ONE = Fraction(0), Fraction(1)


@dataclass(frozen=True)
class Opinion:
    """What one evaluation gives: degrees by (variable, term), rules in the order of the text, outputs."""

    terms: Mapping[tuple[str, str], Fraction]
    rules: tuple[Fraction, ...]
    accumulated: Mapping[tuple[str, str], Fraction]
    outputs: Mapping[str, Fraction]
    active: Mapping[str, bool]


def evaluate(
    block: FunctionBlock, values: Mapping[str, float], previous: Mapping[str, float] | None = None
) -> Opinion:
    """Evaluate a block whose outputs have singletons; NC gives `previous`, else the initial value."""
    inputs = {each.name: Fraction(values.get(each.name, each.initial or 0)) for each in block.inputs}
    terms = {
        (fuzzification.variable, term.name): membership(term.shape, inputs[fuzzification.variable])
        for fuzzification in block.fuzzifications
        for term in fuzzification.terms
    }
    rules = tuple(
        aggregate(rule.condition, rule_block, terms, inputs)
        for rule_block in block.rule_blocks
        for rule in rule_block.rules
    )
    results = weighted_results(block, rules, inputs)
    accumulated, outputs, active = {}, {}, {}
    for output in block.defuzzifications:
        names = [term.name for term in output.terms]
        degrees = accumulate(block, output.variable, names, results)
        accumulated.update({(output.variable, name): degrees[name] for name in names})
        active[output.variable] = any(degrees.values())
        if active[output.variable]:
            outputs[output.variable] = centre(output.terms, degrees)
        elif output.default is not None:
            outputs[output.variable] = Fraction(output.default)
        else:
            initial = next(each.initial for each in block.outputs if each.name == output.variable)
            outputs[output.variable] = Fraction((previous or {}).get(output.variable, initial or 0))
    return Opinion(terms, rules, accumulated, outputs, active)


def membership(shape: Points, x: Fraction) -> Fraction:
    """Return the degree of `x` (5.2.2)."""
    points = [(Fraction(point.x), Fraction(point.degree)) for point in shape.points]
    here = [degree for at, degree in points if at == x]
    if here:
        return max(here)  # S21
    if x < points[0][0]:
        return points[0][1]  # S20
    if x > points[-1][0]:
        return points[-1][1]
    (left, low), (right, high) = next((a, b) for a, b in pairwise(points) if a[0] < x < b[0])
    return low + (high - low) * (x - left) / (right - left)


def clamp(degree: Fraction) -> Fraction:
    return min(ONE, max(ZERO, degree))  # S27


def aggregate(
    condition: Condition,
    operators: RuleBlock,
    terms: Mapping[tuple[str, str], Fraction],
    inputs: Mapping[str, Fraction],
) -> Fraction:
    """Return the degree of accomplishment of a condition (Table 3)."""
    if isinstance(condition, Is):
        return terms[condition.variable, condition.term]
    if isinstance(condition, Degree):
        return clamp(inputs[condition.variable])
    if isinstance(condition, Not):
        return 1 - aggregate(condition.argument, operators, terms, inputs)
    first, *others = (aggregate(each, operators, terms, inputs) for each in condition.arguments)
    for other in others:
        if isinstance(condition, And):
            first = conjunction(operators.and_operator, first, other)
        elif isinstance(condition, Or):
            first = disjunction(operators.or_operator, first, other)
    return first


def conjunction(operator: AndOperator, a: Fraction, b: Fraction) -> Fraction:
    if operator is AndOperator.MIN:
        return min(a, b)
    if operator is AndOperator.PROD:
        return a * b
    return max(ZERO, a + b - 1)


def disjunction(operator: OrOperator, a: Fraction, b: Fraction) -> Fraction:
    if operator is OrOperator.MAX:
        return max(a, b)
    if operator is OrOperator.ASUM:
        return a + b - a * b
    return min(ONE, a + b)


def weighted_results(
    block: FunctionBlock, rules: tuple[Fraction, ...], inputs: Mapping[str, Fraction]
) -> list[tuple[int, str, str, Fraction]]:
    """Return (rule block, output, term, weight times degree) of every conclusion (A.15, S24)."""
    results = []
    degrees = iter(rules)
    for number, rule_block in enumerate(block.rule_blocks):
        for rule in rule_block.rules:
            degree = next(degrees)
            for each in rule.conclusions:
                text = isinstance(each.weight, str)
                weight = clamp(inputs[each.weight]) if text else Fraction(each.weight)
                results.append((number, each.variable, each.term, weight * degree))
    return results


def accumulate(
    block: FunctionBlock, variable: str, terms: list[str], results: list[tuple[int, str, str, Fraction]]
) -> dict[str, Fraction]:
    """Return the degree of each term: together where the rule blocks agree on ACCU, else per block (S26)."""
    own = [each for each in results if each[1] == variable]
    numbers = sorted({number for number, *_ in own})
    algorithms = [block.rule_blocks[number].accumulation for number in numbers]
    if len(set(algorithms)) <= 1:
        groups = [(algorithms[0], own)] if own else []
    else:
        groups = [
            (algorithm, [each for each in own if each[0] == number])
            for number, algorithm in zip(numbers, algorithms, strict=True)
        ]
    degrees = dict.fromkeys(terms, ZERO)
    for algorithm, group in groups:
        for term, degree in combine(algorithm, terms, group).items():
            degrees[term] = max(degrees[term], degree)
    return degrees


def combine(
    algorithm: Accumulation, terms: list[str], group: list[tuple[int, str, str, Fraction]]
) -> dict[str, Fraction]:
    """Return the degree of each term by one algorithm (Table 5)."""
    by_term = {term: [degree for _, _, name, degree in group if name == term] for term in terms}
    if algorithm is Accumulation.MAX:
        return {term: max(degrees, default=ZERO) for term, degrees in by_term.items()}
    sums = {term: sum(degrees, ZERO) for term, degrees in by_term.items()}
    if algorithm is Accumulation.BSUM:
        return {term: min(ONE, degree) for term, degree in sums.items()}
    largest = max(ONE, *sums.values())  # S25
    return {term: degree / largest for term, degree in sums.items()}


def centre(terms: tuple, degrees: Mapping[str, Fraction]) -> Fraction:
    """Return CoGS (Table 2)."""
    assert all(isinstance(term.shape, Singleton) for term in terms)
    moment = sum(Fraction(term.shape.value) * degrees[term.name] for term in terms)
    return moment / sum(degrees.values())

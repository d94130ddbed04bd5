"""The second opinion: IEC 61131-7 evaluated slowly and literally, in fractions.

Imports nothing of the engine, only the model's nouns. Every number is exact:
a float stands for the binary fraction that it is. Rules cited as in SEMANTICS.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import partial, reduce

from fcl_sim.model import (
    Accumulation,
    And,
    AndOperator,
    Condition,
    Defuzzification,
    Degree,
    FunctionBlock,
    Is,
    Method,
    Not,
    Or,
    OrOperator,
    Points,
    RuleBlock,
    Singleton,
)
from tests.oracle_areas import Area, Contribution, accumulated_area, defuzzified, degree_at

ZERO, ONE = Fraction(0), Fraction(1)
NORMS = {
    Accumulation.ASUM: OrOperator.ASUM,
    Accumulation.HSUM: OrOperator.HSUM,
    Accumulation.ESUM: OrOperator.ESUM,
}
"""Accumulations of the Open Level that are S-norms, by the OR of the same formula."""


@dataclass(frozen=True)
class Result:
    """A conclusion of a rule, in the order of the text."""

    block: int
    variable: str
    term: str | None
    degree: Fraction
    weight: Fraction


@dataclass(frozen=True)
class Opinion:
    """What one evaluation gives: degrees by (variable, term), rules in the order of the text, outputs.

    `areas` are the accumulated membership functions of outputs with areas on which a rule fired.
    """

    terms: Mapping[tuple[str, str], Fraction]
    rules: tuple[Fraction, ...]
    accumulated: Mapping[tuple[str, str | None], Fraction]
    outputs: Mapping[str, Fraction]
    active: Mapping[str, bool]
    areas: Mapping[str, Area]
    places: Mapping[str, tuple[Fraction, ...]]


def evaluate(
    block: FunctionBlock, values: Mapping[str, float], previous: Mapping[str, float] | None = None
) -> Opinion:
    """Evaluate a block; NC gives `previous`, else the initial value."""
    inputs = {each.name: Fraction(values.get(each.name, each.initial or 0)) for each in block.inputs}
    terms = {
        (fuzzification.variable, term.name): degree_at(
            ordered(term.shape, inputs), inputs[fuzzification.variable]
        )
        for fuzzification in block.fuzzifications
        for term in fuzzification.terms
    }
    rules: list[Fraction] = []
    results: list[Result] = []
    for number, rule_block in enumerate(block.rule_blocks):
        for rule in rule_block.rules:

            def degree_of(leaf: Is | Degree) -> Fraction:
                return subcondition(block, leaf, terms, inputs, results)

            degree = aggregate(rule.condition, rule_block, degree_of)
            rules.append(degree)
            for each in rule.conclusions:
                text = isinstance(each.weight, str)
                weight = clamp(inputs[each.weight]) if text else Fraction(each.weight)
                results.append(Result(number, each.variable, each.term, degree, weight))
    accumulated, outputs, active, areas, places = {}, {}, {}, {}, {}
    by_name = {each.variable: each for each in block.defuzzifications}
    for variable in block.outputs:
        name = variable.name
        degrees = accumulate(block, name, results)
        accumulated.update({(name, term): degree for term, degree in degrees.items()})
        active[name] = any(degrees.values())
        if name not in by_name:
            if degrees:
                outputs[name] = degrees[None]  # S28
            continue
        output = by_name[name]
        singletons = all(isinstance(term.shape, Singleton) for term in output.terms)
        if active[name] and singletons:
            places[name] = tuple(number_of(term.shape.value, inputs) for term in output.terms)
            outputs[name] = of_singletons(output.method, places[name], [*degrees.values()])
        elif active[name]:
            areas[name] = area_of(block, output, results, inputs)
            active[name] = areas[name].content > 0  # S31
            if active[name]:
                outputs[name] = defuzzified(output.method, areas[name])
        if not active[name]:
            before = Fraction((previous or {}).get(name, variable.initial or 0))
            outputs[name] = before if output.default is None else Fraction(output.default)
    return Opinion(terms, tuple(rules), accumulated, outputs, active, areas, places)


def number_of(value: float | str, inputs: Mapping[str, Fraction]) -> Fraction:
    return inputs[value] if isinstance(value, str) else Fraction(value)


def ordered(shape: Points, inputs: Mapping[str, Fraction]) -> tuple[tuple[Fraction, Fraction], ...]:
    """Return the base points with each abscissa taken as the largest so far (S22)."""
    points: list[tuple[Fraction, Fraction]] = []
    for point in shape.points:
        x = number_of(point.x, inputs)
        points.append((max([x, *(before for before, _ in points)]), Fraction(point.degree)))
    return tuple(points)


def area_of(
    block: FunctionBlock, output: Defuzzification, results: list[Result], inputs: Mapping[str, Fraction]
) -> Area:
    shapes = {term.name: ordered(term.shape, inputs) for term in output.terms}
    if output.range is None:  # S32
        abscissae = [x for points in shapes.values() for x, _ in points]
        limits = min(abscissae), max(abscissae)
    else:
        limits = Fraction(output.range[0]), Fraction(output.range[1])
    own = [each for each in results if each.variable == output.variable]
    contributions = [
        Contribution(
            each.block, block.rule_blocks[each.block].activation, each.degree, each.weight, shapes[each.term]
        )
        for each in own
        if each.degree * each.weight > 0
    ]
    algorithms = {each.block: accumulation_of(block, each.block, output.variable) for each in own}
    return accumulated_area(contributions, algorithms, limits)


def clamp(degree: Fraction) -> Fraction:
    return min(ONE, max(ZERO, degree))  # S27


def subcondition(
    block: FunctionBlock,
    leaf: Is | Degree,
    terms: Mapping[tuple[str, str], Fraction],
    inputs: Mapping[str, Fraction],
    results: list[Result],
) -> Fraction:
    """Return the degree of a subcondition; of what rules conclude, what those before have accumulated.

    A sum without a bound (Open Level) is a degree of at most 1 here.
    """
    term = leaf.term if isinstance(leaf, Is) else None
    if (leaf.variable, term) in terms:
        return terms[leaf.variable, term]
    if leaf.variable in inputs:
        return clamp(inputs[leaf.variable])
    return clamp(accumulate(block, leaf.variable, results)[term])  # S27a, S29


def aggregate(
    condition: Condition, operators: RuleBlock, degree_of: Callable[[Is | Degree], Fraction]
) -> Fraction:
    """Return the degree of accomplishment of a condition (Table 3)."""
    if isinstance(condition, Is | Degree):
        return degree_of(condition)
    if isinstance(condition, Not):
        return 1 - aggregate(condition.argument, operators, degree_of)
    first, *others = (aggregate(each, operators, degree_of) for each in condition.arguments)
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
    if operator is AndOperator.BDIF:
        return max(ZERO, a + b - 1)
    if operator is AndOperator.HPROD:
        return a * b / (a + b - a * b) if a + b else ZERO
    assert operator is AndOperator.EPROD
    return a * b / (2 - (a + b - a * b))


def disjunction(operator: OrOperator, a: Fraction, b: Fraction) -> Fraction:
    if operator is OrOperator.MAX:
        return max(a, b)
    if operator is OrOperator.ASUM:
        return a + b - a * b
    if operator is OrOperator.BSUM:
        return min(ONE, a + b)
    if operator is OrOperator.HSUM:
        return (a + b - 2 * a * b) / (1 - a * b) if a * b != 1 else ONE
    assert operator is OrOperator.ESUM
    return (a + b) / (1 + a * b)


def accumulate(block: FunctionBlock, variable: str, results: list[Result]) -> dict[str | None, Fraction]:
    """Return the degree of each term: together where the rule blocks agree on ACCU, else per block (S26).

    A variable without terms has the one term None. What the rule blocks agree
    on is asked of all rules, also of those still to come.
    """
    own = [each for each in results if each.variable == variable]
    concluding = [
        (number, accumulation_of(block, number, variable))
        for number, each in enumerate(block.rule_blocks)
        if any(then.variable == variable for rule in each.rules for then in rule.conclusions)
    ]
    if len({algorithm for _, algorithm in concluding}) <= 1:
        groups = [(algorithm, own) for _, algorithm in concluding[:1]]
    else:
        groups = [
            (algorithm, [each for each in own if each.block == number]) for number, algorithm in concluding
        ]
    defined = [each.terms for each in block.defuzzifications if each.variable == variable]
    terms = [term.name for term in defined[0]] if defined else [None] if concluding else []
    degrees = dict.fromkeys(terms, ZERO)
    for algorithm, group in groups:
        for term, degree in combine(algorithm, terms, group).items():
            degrees[term] = max(degrees[term], degree)
    return degrees


def accumulation_of(block: FunctionBlock, number: int, variable: str) -> Accumulation:
    """Return by what a rule block accumulates a variable: the output's own ACCU goes before (S8)."""
    chosen = [each.accumulation for each in block.defuzzifications if each.variable == variable]
    return chosen[0] if chosen and chosen[0] else block.rule_blocks[number].accumulation


def combine(
    algorithm: Accumulation, terms: list[str | None], group: list[Result]
) -> dict[str | None, Fraction]:
    """Return the degree of each term by one algorithm (Table 5), of singletons or as if of singletons."""
    by_term = {term: [each.weight * each.degree for each in group if each.term == term] for term in terms}
    if algorithm in NORMS:
        norm = partial(disjunction, NORMS[algorithm])
        return {term: reduce(norm, degrees, ZERO) for term, degrees in by_term.items()}
    if algorithm is Accumulation.MAX:
        return {term: max(degrees, default=ZERO) for term, degrees in by_term.items()}
    sums = {term: sum(degrees, ZERO) for term, degrees in by_term.items()}
    if algorithm is Accumulation.SUM:
        return sums
    if algorithm is Accumulation.BSUM:
        return {term: min(ONE, degree) for term, degree in sums.items()}
    largest = max(ONE, *sums.values())  # S25
    return {term: degree / largest for term, degree in sums.items()}


def of_singletons(method: Method, places: tuple[Fraction, ...], degrees: list[Fraction]) -> Fraction:
    """Return CoGS, or the place of the largest degree that lies farthest left or right (Table 2)."""
    if method in {Method.COG, Method.COGS}:
        return sum(place * degree for place, degree in zip(places, degrees, strict=True)) / sum(degrees)
    highest = [place for place, degree in zip(places, degrees, strict=True) if degree == max(degrees)]
    if method is Method.LM:
        return min(highest)
    if method is Method.RM:
        return max(highest)
    assert method is Method.MM
    return (min(highest) + max(highest)) / 2

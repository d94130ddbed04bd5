"""Model → the same law in the Basic Level (Table 8), or the places where that cannot say it."""

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace

from fcl_sim.diagnostics import Diagnostic, InputFault, Place, Span
from fcl_sim.fcl.basic_conditions import Refuse, alternatives, letters, uses
from fcl_sim.fcl.findings import in_order
from fcl_sim.model import (
    Accumulation,
    Activation,
    And,
    AndOperator,
    Defuzzification,
    FunctionBlock,
    Fuzzification,
    Method,
    Or,
    OrOperator,
    Point,
    Points,
    Rule,
    RuleBlock,
    Singleton,
    Term,
)

MOST_POINTS = 3


class _Refusals:
    """What the Basic Level cannot say, and where: one message may have many places."""

    def __init__(self) -> None:
        self._places: dict[str, list[Place]] = {}

    def add(self, message: str, span: Span | None) -> None:
        places = self._places.setdefault(message, [])
        if span is not None:
            places.append(Place(span))

    def raise_if_any(self) -> None:
        if self._places:
            raise InputFault(
                in_order(
                    Diagnostic(code="FCL501", message=message, places=tuple(places))
                    for message, places in self._places.items()
                )
            )


def to_basic_level(block: FunctionBlock) -> FunctionBlock:
    """Return a function block of the Basic Level that computes the same, to the last bit.

    - OR becomes rules (5.2.4), where OR is MAX and AND is MIN: MIN distributes
      over MAX, and so does what ACCU: MAX joins again;
    - several subconclusions become several rules, several rule blocks one;
    - ACCU becomes MAX where no term is concluded twice, so that there is nothing
      to accumulate (S24: singletons accumulate per term, NSUM then never divides);
    - AND and OR where no rule has them, ACT and RANGE, which singletons ignore,
      are left out, and points in a level stretch before the first or behind the
      last (5.2.2) where there are more than three.

    Raises InputFault with every place where the law would change.
    """
    refusals = _Refusals()
    _check_interface(block, refusals.add)
    fuzzifications = tuple(_fuzzification(each, refusals.add) for each in block.fuzzifications)
    defuzzifications = tuple(_defuzzification(each, refusals.add) for each in block.defuzzifications)
    _check_accumulation(block, refusals.add)
    rules = [list(_rules(block, each, refusals.add)) for each in block.rule_blocks]
    refusals.raise_if_any()
    return replace(
        block,
        inputs=tuple(replace(each, range=None) for each in block.inputs),
        fuzzifications=fuzzifications,
        defuzzifications=defuzzifications,
        rule_blocks=_joined(block.rule_blocks, rules),
    )


# -- the interface


def _check_interface(block: FunctionBlock, refuse: Refuse) -> None:
    for structure in block.structures:
        refuse("the Basic Level has no structure types (Annex D)", structure.span)
    for variable in (*block.inputs, *block.outputs):
        if variable.structure is not None:
            refuse("the Basic Level has no structure types (Annex D)", variable.span)
    for variable in block.variables:
        refuse("the Basic Level has no local variables: VAR belongs to Table 9", variable.span)
    if block.options:
        message = "the Basic Level has no OPTIONS: what they say belongs to the Open Level (5.2.5)"
        refuse(message, block.span)
    if not re.fullmatch(r"[^\W\d]\w*", block.name):
        refuse(f"the Basic Level has no such name: `{block.name}` is not an identifier", block.span)


def _fuzzification(section: Fuzzification, refuse: Refuse) -> Fuzzification:
    if section.clamped or not section.enabled:
        refuse("the Basic Level has no LOCK and no ENABLED", section.span)
    return replace(section, terms=tuple(_input_term(each, refuse) for each in section.terms))


def _input_term(term: Term, refuse: Refuse) -> Term:
    shape = term.shape
    if not isinstance(shape, Points):
        refuse("a term of the Basic Level is written as points (Table 8)", term.span)
        return term
    if any(isinstance(each.x, str) for each in shape.points):
        refuse("a point of the Basic Level is constant: variable ones belong to Table 9", term.span)
    if any(each.degree not in {0.0, 1.0} for each in shape.points):
        refuse("a point of the Basic Level has the degree 0 or 1 (Table 8)", term.span)
    points = _without_level_ends(shape.points)
    if len(points) > MOST_POINTS:
        refuse("a term of the Basic Level has three points at most (Table 8)", term.span)
    return replace(term, shape=Points(points))


def _without_level_ends(points: tuple[Point, ...]) -> tuple[Point, ...]:
    """Return points; where they are too many, without those that repeat what holds outside of the others."""
    if len(points) <= MOST_POINTS:
        return points
    start, end = 0, len(points)
    while end - start > 1 and points[start].degree == points[start + 1].degree:
        start += 1
    while end - start > 1 and points[end - 1].degree == points[end - 2].degree:
        end -= 1
    return points[start:end]


def _defuzzification(section: Defuzzification, refuse: Refuse) -> Defuzzification:
    for term in section.terms:
        if not isinstance(term.shape, Singleton):
            refuse("a term of an output is a singleton in the Basic Level (Table 8)", term.span)
        elif isinstance(term.shape.value, str):
            refuse("a singleton of the Basic Level is constant (Table 8)", term.span)
    if section.method is not Method.COGS:
        refuse(f"the Basic Level defuzzifies by CoGS, not by {section.method} (Table 8)", section.span)
    if section.held or section.clamped or not section.enabled:
        refuse("the Basic Level has no LOCK and no ENABLED", section.span)
    if section.default is not None and section.default != section.default:
        refuse("a default value of the Basic Level is a number or NC (Table 8)", section.span)
    return replace(section, range=None, accumulation=None)


# -- rules


def _check_accumulation(block: FunctionBlock, refuse: Refuse) -> None:
    """Refuse to put MAX in the place of another ACCU where rules meet in one term."""
    own = {each.variable: each.accumulation for each in block.defuzzifications}
    counts = Counter(
        (each.variable, each.term)
        for section in block.rule_blocks
        for rule in section.rules
        for each in rule.conclusions
    )
    for section in block.rule_blocks:
        for rule in section.rules:
            for each in rule.conclusions:
                chosen = own.get(each.variable) or section.accumulation
                if chosen is not Accumulation.MAX and counts[each.variable, each.term] > 1:
                    message = f"the Basic Level accumulates by MAX: {chosen} of several rules is another sum"
                    refuse(message, each.span or rule.span)


def _rules(block: FunctionBlock, section: RuleBlock, refuse: Refuse) -> Iterator[Rule]:
    """Yield the rules of a rule block, each with AND alone and one subconclusion."""
    if not section.enabled:
        refuse("the Basic Level has no LOCK and no ENABLED", section.span)
    conditions = [each.condition for each in section.rules]
    if section.and_operator is not AndOperator.MIN and any(uses(each, And) for each in conditions):
        message = f"AND is MIN in the Basic Level, not {section.and_operator} (Table 8)"
        refuse(message, section.span)
    if section.or_operator is not OrOperator.MAX and any(uses(each, Or) for each in conditions):
        message = f"OR by {section.or_operator} cannot be written as two rules: ACCU: MAX joins rules (5.2.4)"
        refuse(message, section.span)
    inputs = {each.name for each in block.inputs}
    labels = {each.label.upper() for each in section.rules}
    for rule in section.rules:
        for each in rule.conclusions:
            if each.term is None:
                refuse("a conclusion of the Basic Level has a term: variable IS term", each.span or rule.span)
            if each.weight != 1.0:
                refuse("the Basic Level has no weights: WITH belongs to Table 9", each.span or rule.span)
            if each.hedges:
                refuse("the Basic Level has no hedges", each.span or rule.span)
        conditions = alternatives(rule, inputs, refuse)
        parts = [(condition, each) for condition in conditions for each in rule.conclusions]
        if len(parts) == 1:
            yield replace(rule, condition=parts[0][0])
            continue
        for letter, (condition, each) in zip(letters(rule.label, labels), parts, strict=False):
            yield replace(rule, label=rule.label + letter, condition=condition, conclusions=(each,))


def _joined(sections: Sequence[RuleBlock], rules: Sequence[Sequence[Rule]]) -> tuple[RuleBlock, ...]:
    """Return one rule block with the rules of all (S26); a label given again gets its block's name."""
    if not sections:
        return ()
    seen = {each.label.upper() for each in rules[0]}
    joined = list(rules[0])
    for section, others in zip(sections[1:], rules[1:], strict=True):
        for rule in others:
            label = rule.label
            if label.upper() in seen:
                label = f"{re.sub(r'[^0-9A-Za-z_]', '_', section.name)}_{label}"
            joined.append(replace(rule, label=label))
        seen |= {each.label.upper() for each in joined}
    return (
        replace(
            sections[0],
            and_operator=AndOperator.MIN,
            or_operator=OrOperator.MAX,
            activation=Activation.MIN,
            accumulation=Accumulation.MAX,
            rules=tuple(joined),
        ),
    )

"""Mutants of rules: conditions, conclusions, weights, and the rule as a whole."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from fcl_sim.diagnostics import Span
from fcl_sim.fcl.write_numbers import number
from fcl_sim.fcl.write_rules import condition_text
from fcl_sim.model import (
    And,
    Conclusion,
    Condition,
    Degree,
    FunctionBlock,
    Is,
    Not,
    Or,
    Rule,
)
from fcl_sim.model.labels import unique_labels
from fcl_sim.verify.mutant import Kind, Mutant
from fcl_sim.verify.places import in_order
from fcl_sim.verify.settled import settled

Orders = Mapping[str, Sequence[str]]
"""The terms of each variable, by its name in lower case, as they lie along its axis."""


@dataclass(frozen=True, slots=True)
class _Change:
    """One change within a rule, in words, and where in the text."""

    kind: Kind
    what: str
    span: Span | None


@dataclass(frozen=True, slots=True)
class _OfCondition(_Change):
    condition: Condition


@dataclass(frozen=True, slots=True)
class _OfConclusion(_Change):
    conclusion: Conclusion


def mutants_of_rules(block: FunctionBlock) -> Iterator[Mutant]:
    """Yield the mutants of each rule, in the order of the text."""
    orders = {each.variable.casefold(): in_order(each.terms) for each in block.fuzzifications}
    orders |= {each.variable.casefold(): in_order(each.terms) for each in block.defuzzifications}
    labels = iter(unique_labels(block))
    for number_of_block, rule_block in enumerate(block.rule_blocks):
        for place, rule in enumerate(rule_block.rules):
            label = next(labels)
            for change, rules in _of_rule(rule, orders):
                changed = _with_rules(block, number_of_block, place, rules)
                if changed is not None:
                    yield Mutant(
                        kind=change.kind,
                        where=f"rule {label}",
                        what=change.what,
                        rule=label,
                        function_block=changed,
                        span=change.span or rule.span,
                    )


def _of_rule(rule: Rule, orders: Orders) -> Iterator[tuple[_Change, tuple[Rule, ...]]]:
    """Yield the changes of a rule, each with what then stands in its place."""
    for place, conclusion in enumerate(rule.conclusions):
        for change in _of_conclusion(conclusion, orders):
            others = rule.conclusions[:place], rule.conclusions[place + 1 :]
            conclusions = (*others[0], change.conclusion, *others[1])
            yield change, (replace(rule, conclusions=conclusions),)
    for each in _of_condition(rule.condition, orders):
        yield each, (replace(rule, condition=each.condition),)
    yield _Change(Kind.RULE_DELETED, "left out", rule.span), ()


def _of_conclusion(conclusion: Conclusion, orders: Orders) -> Iterator[_OfConclusion]:
    variable, term, weight, span = conclusion.variable, conclusion.term, conclusion.weight, conclusion.span
    for other in _neighbours(variable, term, orders):
        what = f"{variable} IS {term} → {other}"
        yield _OfConclusion(Kind.CONSEQUENT_MOVED, what, span, replace(conclusion, term=other))
    subject = variable if term is None else f"{variable} IS {term}"
    for other_weight in _other_weights(weight):
        what = f"{subject} WITH {number(weight)} → {number(other_weight)}"
        yield _OfConclusion(Kind.WEIGHT_CHANGED, what, span, replace(conclusion, weight=other_weight))


def _other_weights(weight: float | str) -> tuple[float, ...]:
    if isinstance(weight, str):
        return 0.5, 1.0
    return tuple(each for each in (weight / 2, 1.0) if each != weight)


def _neighbours(variable: str, term: str | None, orders: Orders) -> Iterator[str]:
    """Yield the terms next to one along the axis of its variable: one, two, or none."""
    names = orders.get(variable.casefold(), ())
    folded = [each.casefold() for each in names]
    if term is None or term.casefold() not in folded:
        return
    at = folded.index(term.casefold())
    yield from names[max(0, at - 1) : at]
    yield from names[at + 1 : at + 2]


def _of_condition(condition: Condition, orders: Orders) -> Iterator[_OfCondition]:
    """Yield the changes at each place of a condition, which its reader bounds in depth."""
    match condition:
        case Is() | Degree():
            yield from _of_leaf(condition, orders)
        case Not(argument):
            what = f"{condition_text(condition)} → {condition_text(argument)}"
            yield _OfCondition(Kind.CONDITION_NEGATED, what, _span(argument), argument)
            for each in _of_condition(argument, orders):
                if not (each.kind is Kind.CONDITION_NEGATED and each.condition == Not(argument)):
                    yield replace(each, condition=Not(each.condition))
        case And(arguments) | Or(arguments):
            kind, names = (Or, "AND → OR") if isinstance(condition, And) else (And, "OR → AND")
            what = f"{names} in {condition_text(condition)}"
            yield _OfCondition(Kind.AND_OR_EXCHANGED, what, _span(condition), kind(arguments))
            for place, argument in enumerate(arguments):
                for each in _of_condition(argument, orders):
                    parts = (*arguments[:place], each.condition, *arguments[place + 1 :])
                    yield replace(each, condition=type(condition)(parts))


def _of_leaf(leaf: Is | Degree, orders: Orders) -> Iterator[_OfCondition]:
    text = condition_text(leaf)
    if isinstance(leaf, Is):
        for other in _neighbours(leaf.variable, leaf.term, orders):
            yield _OfCondition(
                Kind.CONDITION_MOVED, f"{text} → {other}", leaf.span, replace(leaf, term=other)
            )
    what = f"{text} → {condition_text(Not(leaf))}"
    yield _OfCondition(Kind.CONDITION_NEGATED, what, leaf.span, Not(leaf))


def _span(condition: Condition) -> Span | None:
    """Return the place of the first subcondition in a condition."""
    match condition:
        case Is() | Degree():
            return condition.span
        case Not(argument):
            return _span(argument)
        case And(arguments) | Or(arguments):
            return _span(arguments[0])


def _with_rules(
    block: FunctionBlock, number_of_block: int, place: int, rules: tuple[Rule, ...]
) -> FunctionBlock | None:
    """Return a block with `rules` in place of one rule, None where that is not legal."""
    rule_blocks = list(block.rule_blocks)
    own = rule_blocks[number_of_block]
    changed = (*own.rules[:place], *rules, *own.rules[place + 1 :])
    rule_blocks[number_of_block] = replace(own, rules=changed)
    mutant = settled(replace(block, rule_blocks=tuple(rule_blocks)))
    return mutant if rules or _concludes_before_use(mutant) else None


def _concludes_before_use(block: FunctionBlock) -> bool:
    """Return whether outputs and local variables are used after a conclusion on them only (S27a, S29)."""
    waiting = {each.name.casefold() for each in (*block.outputs, *block.variables)}
    for rule_block in block.rule_blocks:
        for rule in rule_block.rules:
            if not waiting.isdisjoint(_used(rule.condition)):
                return False
            waiting.difference_update(each.variable.casefold() for each in rule.conclusions)
    return True


def _used(condition: Condition) -> Iterator[str]:
    match condition:
        case Is() | Degree():
            yield condition.variable.casefold()
        case Not(argument):
            yield from _used(argument)
        case And(arguments) | Or(arguments):
            for each in arguments:
                yield from _used(each)

"""What the conditions and conclusions of a rule use."""

from collections.abc import Container, Iterator
from dataclasses import dataclass

from fcl_sim.diagnostics import Span
from fcl_sim.fcl.conformance_elements import YES
from fcl_sim.model import And, Condition, Degree, Is, Not, Or, Rule, RuleBlock


@dataclass(frozen=True, slots=True)
class Use:
    """One use of an element `key` with its `value`, or of a `row` in other words."""

    key: str = ""
    value: str = ""
    span: Span | None = None
    row: str = ""
    words: str = ""


def used_in_rule(rule: Rule, block: RuleBlock, inputs: Container[str]) -> Iterator[Use]:
    """Yield what a rule uses; `inputs` are the variables with terms that are inputs."""
    if rule.nesting:
        yield Use("parentheses", YES, rule.span)
    yield from _in_condition(rule.condition, rule, block, inputs)
    if len(rule.conclusions) > 1:
        yield Use(span=rule.span, row="subconclusions", words="several subconclusions in a rule")
    for each in rule.conclusions:
        yield Use("conclusions", "variable" if each.term is None else "IS", each.span)
        yield from (Use("hedges", str(hedge), each.span) for hedge in each.hedges)
        if each.weight != 1.0:
            yield Use("WITH", "variable" if isinstance(each.weight, str) else "constant", each.span)


def subconditions(condition: Condition) -> Iterator[Is | Degree]:
    """Yield the subconditions, in the order of the text; as deep as the reader lets parentheses be."""
    match condition:
        case Is() | Degree():
            yield condition
        case Not():
            yield from subconditions(condition.argument)
        case And() | Or():
            for each in condition.arguments:
                yield from subconditions(each)


def _in_condition(
    condition: Condition, rule: Rule, block: RuleBlock, inputs: Container[str]
) -> Iterator[Use]:
    match condition:
        case Is():
            known = condition.variable in inputs
            yield Use("conditions", "IS" if known else "concluded", condition.span)
            yield from (Use("hedges", str(each), condition.span) for each in condition.hedges)
        case Degree():
            yield Use("conditions", "variable", condition.span)
        case Not():
            single = isinstance(condition.argument, Is | Degree)
            yield Use("NOT", "subcondition" if single else "parentheses", rule.span)
            yield from _in_condition(condition.argument, rule, block, inputs)
        case And() | Or():
            if isinstance(condition, And):
                yield Use("AND", str(block.and_operator), rule.span)
            else:
                yield Use("OR", str(block.or_operator), rule.span)
            for each in condition.arguments:
                yield from _in_condition(each, rule, block, inputs)

"""Alternative text of the figure of an inference, written from the data that it shows."""

from collections.abc import Iterator

from fcl_sim.engine.explain import Accumulated
from fcl_sim.engine.explain_text import (
    accumulation_words,
    activation_formula,
    defuzzification_formula,
    subject,
)
from fcl_sim.report.inference_view import Fired, Output, View
from fcl_sim.report.words import counted, joined, number, one_line, printed, with_unit

TOLD = 12
"""So many rules are told one by one; of more, those of the largest degrees."""


def of_inference(view: View) -> str:
    """Return each step of an inference in sentences."""
    return " ".join([*_inputs(view), *_rules(view), *_results(view)])


def _inputs(view: View) -> Iterator[str]:
    for each in view.inputs:
        degrees = [
            f"{one_line(term.name)} {number(degree)}"
            for term, degree in zip(each.terms, each.degrees, strict=True)
            if degree > 0.0
        ]
        told = ", ".join(degrees) or "every degree is 0"
        yield f"Input {one_line(each.name)} = {with_unit(each.value, each.unit)}: {told}."
    for brought in view.brought:
        yield f"{one_line(brought.variable)} = {number(brought.value)} counts as {number(brought.degree)}."


def _rules(view: View) -> Iterator[str]:
    total = len(view.rules) + len(view.quiet)
    yield f"{len(view.rules)} of {counted(total, 'rule')} fired."
    order = sorted(range(len(view.rules)), key=lambda index: (-view.rules[index].degree, index))[:TOLD]
    if len(view.rules) > TOLD:
        yield f"The {TOLD} of the largest degrees:"
    yield from (_rule(view.rules[index]) for index in sorted(order))


def _rule(rule: Fired) -> str:
    degree = number(rule.degree)
    formula = printed(rule.formula)
    how = degree if formula == degree else f"{formula} = {degree}"
    then = [f"{one_line(subject(each))}: {printed(activation_formula(each))}" for each in rule.activated]
    return f"Rule {one_line(rule.label)}: {how}; {'; '.join(then)}."


def _results(view: View) -> Iterator[str]:
    for other in view.others:
        yield f"{one_line(other.variable)}: {_degrees(other)}."
    for each in view.outputs:
        name, algorithm = one_line(each.name), accumulation_words(each.accumulated)
        yield f"Output {name}, accumulated by {algorithm}: {_shape(each)}."
        yield f"{name} = {printed(defuzzification_formula(each.defuzzified, each.accumulated))}."


def _degrees(accumulated: Accumulated) -> str:
    return joined([f"{one_line(each.term)} {number(each.degree)}".strip() for each in accumulated.degrees])


def _shape(each: Output) -> str:
    area = each.accumulated.area
    if area:
        top = max(degree for _, degree in area)
        ends = f"{number(area[0][0])} to {with_unit(area[-1][0], each.unit)}"
        return f"an area from {ends}, at most {number(top)} high"
    active = [told for told in each.accumulated.degrees if told.degree > 0.0]
    return joined([f"{one_line(told.term)} {number(told.degree)}" for told in active]) or "nothing"

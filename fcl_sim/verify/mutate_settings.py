"""Mutants of settings: operators, ACT, ACCU, METHOD, DEFAULT."""

from collections.abc import Iterator
from dataclasses import replace

from fcl_sim.fcl.resolve_settings import PAIRS
from fcl_sim.fcl.write_numbers import number
from fcl_sim.model import (
    Accumulation,
    Activation,
    And,
    AndOperator,
    Condition,
    Curve,
    Defuzzification,
    FunctionBlock,
    Method,
    Not,
    Or,
    Points,
    RuleBlock,
)
from fcl_sim.verify.mutant import Kind, Mutant
from fcl_sim.verify.places import all_places
from fcl_sim.verify.settled import concluded, settled

AND_OPERATORS = (AndOperator.MIN, AndOperator.PROD, AndOperator.BDIF)
ACTIVATIONS = (Activation.MIN, Activation.PROD)
ACCUMULATIONS = (Accumulation.MAX, Accumulation.BSUM, Accumulation.NSUM)
OF_SINGLETONS = (Method.COGS, Method.LM, Method.RM)
OF_AREAS = (Method.COG, Method.COA, Method.LM, Method.RM)
"""The standard's own choices (Tables 1, 3, 4 and 5)."""


def mutants_of_settings(block: FunctionBlock) -> Iterator[Mutant]:
    """Yield the mutants of rule blocks, then those of outputs."""
    for rule_block in block.rule_blocks:
        for kind, what, changed in _of_rule_block(block, rule_block):
            rule_blocks = tuple(changed if each is rule_block else each for each in block.rule_blocks)
            yield Mutant(
                kind=kind,
                where=f"rule block {rule_block.name}",
                what=what,
                function_block=settled(replace(block, rule_blocks=rule_blocks)),
                span=rule_block.span,
            )
    for output in block.defuzzifications:
        for kind, what, changed_output in _of_output(output):
            outputs = tuple(changed_output if each is output else each for each in block.defuzzifications)
            yield Mutant(
                kind=kind,
                where=f"output {output.variable}",
                what=what,
                function_block=settled(replace(block, defuzzifications=outputs)),
                span=output.span,
            )


def _of_rule_block(block: FunctionBlock, own: RuleBlock) -> Iterator[tuple[Kind, str, RuleBlock]]:
    if any(_joins(rule.condition) for rule in own.rules):
        pair = f"{own.and_operator}, {own.or_operator}"
        for each in AND_OPERATORS:
            if each is not own.and_operator:
                what = f"{pair} → {each}, {PAIRS[each]}"
                changed = replace(own, and_operator=each, or_operator=PAIRS[each])
                yield Kind.OPERATORS_CHANGED, what, changed
    names = concluded(own)
    outputs = [each for each in block.defuzzifications if each.variable.casefold() in names]
    if any(isinstance(term.shape, Points | Curve) for each in outputs for term in each.terms):
        for activation in ACTIVATIONS:
            if activation is not own.activation:
                what = f"ACT {own.activation} → {activation}"
                yield Kind.ACTIVATION_CHANGED, what, replace(own, activation=activation)
    elsewhere = {each.variable.casefold() for each in outputs if each.accumulation is not None}
    if names - elsewhere:
        for accumulation in ACCUMULATIONS:
            if accumulation is not own.accumulation:
                what = f"ACCU {own.accumulation} → {accumulation}"
                yield Kind.ACCUMULATION_CHANGED, what, replace(own, accumulation=accumulation)


def _joins(condition: Condition) -> bool:
    return isinstance(condition, And | Or) or (isinstance(condition, Not) and _joins(condition.argument))


def _of_output(output: Defuzzification) -> Iterator[tuple[Kind, str, Defuzzification]]:
    has_areas = any(isinstance(each.shape, Points | Curve) for each in output.terms)
    for method in (OF_AREAS if has_areas else OF_SINGLETONS) if output.terms else ():
        if method is not output.method:
            what = f"METHOD {output.method} → {method}"
            yield Kind.METHOD_CHANGED, what, replace(output, method=method)
    if output.accumulation is not None:
        for accumulation in ACCUMULATIONS:
            if accumulation is not output.accumulation:
                what = f"ACCU {output.accumulation} → {accumulation}"
                yield Kind.ACCUMULATION_CHANGED, what, replace(output, accumulation=accumulation)
    keeps = output.default is None
    for default in _other_defaults(output):
        if default != output.default and not (keeps and default is None):
            what = f"DEFAULT {_default(output.default)} → {_default(default)}"
            yield Kind.DEFAULT_CHANGED, what, replace(output, default=default, held=False)


def _other_defaults(output: Defuzzification) -> Iterator[float | None]:
    yield None
    ends = output.range or all_places(output.terms)
    if ends:
        yield from dict.fromkeys((ends[0], ends[-1]))


def _default(value: float | None) -> str:
    return "NC" if value is None else number(value)

"""What a rule base makes use of, for counting that random ones use everything."""

from collections.abc import Iterator
from itertools import pairwise

from fcl_sim.model import (
    Condition,
    Defuzzification,
    Degree,
    FunctionBlock,
    Is,
    Not,
    Or,
    Points,
    Shape,
    Singleton,
)


def features(base: FunctionBlock) -> Iterator[str]:
    """Yield the features of a rule base, some of them more than once."""
    for each in base.rule_blocks:
        yield f"AND {each.and_operator} OR {each.or_operator}"
        yield f"ACT {each.activation}"
        yield f"ACCU {each.accumulation}"
    if all(each.rules for each in base.rule_blocks):
        yield "several rule blocks"
        if len({each.accumulation for each in base.rule_blocks}) > 1:
            yield "several rule blocks that disagree on ACCU"
    names = {each.name: each for each in (*base.inputs, *base.outputs, *base.variables)}
    own = {each.variable for each in base.fuzzifications}
    for rule_block in base.rule_blocks:
        for rule in rule_block.rules:
            yield from _of_condition(rule.condition, own, within="")
            yield "several conclusions" if len(rule.conclusions) > 1 else "one conclusion"
            for then in rule.conclusions:
                yield _of_weight(then.weight)
                if then.term is None:
                    yield "degree out" if names[then.variable] in base.outputs else "local variable concluded"
    for fuzzification in base.fuzzifications:
        for term in fuzzification.terms:
            yield from _of_shape(term.shape, "input")
    for output in base.defuzzifications:
        yield from _of_output(output)


def _of_weight(weight: float | str) -> str:
    if isinstance(weight, str):
        return "weight by a variable"
    return "weight between 0 and 1" if 0.0 < weight < 1.0 else f"weight {weight:g}"


def _of_condition(condition: Condition, own: set[str], within: str) -> Iterator[str]:
    if isinstance(condition, Is):
        yield "IS" if condition.variable in own else "what rules before concluded, IS"
    elif isinstance(condition, Degree):
        yield "member of a structure" if "." in condition.variable else "degree in"
    elif isinstance(condition, Not):
        yield f"NOT {type(condition.argument).__name__}"
        yield from _of_condition(condition.argument, own, "Not")
    else:
        kind = "OR" if isinstance(condition, Or) else "AND"
        yield f"{kind} within {within}" if within else kind
        for each in condition.arguments:
            yield from _of_condition(each, own, kind)


def _of_output(output: Defuzzification) -> Iterator[str]:
    singletons = all(isinstance(term.shape, Singleton) for term in output.terms)
    yield f"METHOD {output.method} of {'singletons' if singletons else 'areas'}"
    yield "DEFAULT NC" if output.default is None else "DEFAULT number"
    if not singletons:
        yield "RANGE missing" if output.range is None else "RANGE given"
    yield f"ACCU of the output {output.accumulation}" if output.accumulation else "ACCU of the rule blocks"
    for term in output.terms:
        yield from _of_shape(term.shape, "output")


def _of_shape(shape: Shape, whose: str) -> Iterator[str]:
    if isinstance(shape, Singleton):
        yield "singleton moved" if isinstance(shape.value, str) else "singleton"
        return
    assert isinstance(shape, Points)
    xs = [point.x for point in shape.points]
    yield f"{whose}: {len(xs)} points"
    if any(isinstance(x, str) for x in xs):
        yield f"{whose}: points moved"
    if any(a == b for a, b in pairwise(xs)):
        yield f"{whose}: vertical edge"

"""Rule bases built by hand, so that the engine's tests need no reader."""

from collections.abc import Callable
from itertools import product

from fcl_sim.model import (
    Accumulation,
    And,
    AndOperator,
    Conclusion,
    Condition,
    Defuzzification,
    FunctionBlock,
    Fuzzification,
    Is,
    Method,
    Point,
    Points,
    Rule,
    RuleBlock,
    Singleton,
    Term,
    Variable,
)


def points(name: str, *pairs: tuple[float, float]) -> Term:
    return Term(name, Points(tuple(Point(x, degree) for x, degree in pairs)))


def singleton(name: str, value: float) -> Term:
    return Term(name, Singleton(value))


def every(*pairs: tuple[str, str]) -> Condition:
    conditions = tuple(Is(variable, term) for variable, term in pairs)
    return And(conditions) if len(conditions) > 1 else conditions[0]


def rule(label: str, when: Condition, *then: tuple[str, str] | tuple[str, str, float | str]) -> Rule:
    return Rule(label, when, tuple(Conclusion(*each) for each in then))


def output(
    name: str, *terms: Term, default: float | None = 0.0, method: Method = Method.COGS
) -> Defuzzification:
    return Defuzzification(variable=name, terms=terms, method=method, default=default)


def block(
    inputs: dict[str, tuple[Term, ...]],
    outputs: tuple[Defuzzification, ...],
    *rule_blocks: RuleBlock,
    name: str = "block",
    more_inputs: tuple[Variable, ...] = (),
    initial: dict[str, float] | None = None,
) -> FunctionBlock:
    start = initial or {}
    return FunctionBlock(
        name=name,
        inputs=(*(Variable(each, initial=start.get(each)) for each in inputs), *more_inputs),
        outputs=tuple(Variable(each.variable, initial=start.get(each.variable)) for each in outputs),
        fuzzifications=tuple(Fuzzification(each, terms) for each, terms in inputs.items() if terms),
        defuzzifications=outputs,
        rule_blocks=rule_blocks,
    )


DISTANCE = (
    points("too_far", (-5, 1), (0, 0)),
    points("zero", (-5, 0), (0, 1), (5, 0)),
    points("close", (0, 0), (5, 1), (10, 0)),
    points("medium", (5, 0), (10, 1), (22, 0)),
    points("far", (10, 0), (22, 1)),
)
ANGLE = (
    points("neg_big", (-50, 1), (-5, 0)),
    points("neg_small", (-50, 0), (-5, 1), (0, 0)),
    points("zero", (-5, 0), (0, 1), (5, 0)),
    points("pos_small", (0, 0), (5, 1), (50, 0)),
    points("pos_big", (5, 0), (50, 1)),
)
POWER = (
    singleton("neg_high", -27),
    singleton("neg_medium", -9),
    singleton("zero", 0),
    singleton("pos_medium", 9),
    singleton("pos_high", 27),
)


def crane(*rules: tuple[str, str, str], default: float | None = 0.0) -> FunctionBlock:
    """Return Annex C's crane with rules (distance, angle, power)."""
    made = [
        rule(str(n), every(("distance", d), ("angle", a)), ("power", p))
        for n, (d, a, p) in enumerate(rules, 1)
    ]
    return block(
        {"distance": DISTANCE, "angle": ANGLE},
        (output("power", *POWER, default=default),),
        RuleBlock(name="No1", rules=tuple(made)),
        name="container_crane",
    )


CRANE = crane(
    ("far", "zero", "pos_medium"),
    ("far", "neg_small", "pos_high"),
    ("far", "neg_big", "pos_medium"),
    ("medium", "neg_small", "neg_medium"),
    ("close", "pos_small", "pos_medium"),
    ("zero", "zero", "zero"),
)
"""Figure C.16, with pos_high in rule 2."""

CRANE_THREE = crane(
    ("medium", "pos_small", "pos_medium"),
    ("medium", "zero", "zero"),
    ("far", "zero", "pos_medium"),
)
"""The three rules of figure C.8."""


def tabulated(
    peaks: dict[str, tuple[float, ...]],
    law: Callable[..., float],
    and_operator: AndOperator = AndOperator.PROD,
    accumulation: Accumulation = Accumulation.MAX,
    shared: bool = False,
) -> FunctionBlock:
    """Return a base with a rule at each node of the grid of `peaks` that concludes on the law's value there.

    With `shared`, nodes of one value conclude on one term; else every rule has
    its own.
    """
    names: dict[float, str] = {}
    rules, terms = [], []
    for number, node in enumerate(product(*(range(len(each)) for each in peaks.values())), 1):
        value = law(*(each[i] for each, i in zip(peaks.values(), node, strict=True)))
        if not shared or value not in names:
            names[value] = f"s{len(terms)}"
            terms.append(singleton(names[value], value))
        path = [(variable, f"t{i}") for variable, i in zip(peaks, node, strict=True)]
        rules.append(rule(str(number), every(*path), ("y", names[value])))
    return block(
        {variable: _partition(each) for variable, each in peaks.items()},
        (output("y", *terms),),
        RuleBlock(name="No1", and_operator=and_operator, accumulation=accumulation, rules=tuple(rules)),
    )


def _partition(peaks: tuple[float, ...]) -> tuple[Term, ...]:
    terms = []
    for i, peak in enumerate(peaks):
        shape = [(peaks[i - 1], 0.0)] if i else []
        shape.append((peak, 1.0))
        shape += [(peaks[i + 1], 0.0)] if i + 1 < len(peaks) else []
        terms.append(points(f"t{i}", *shape))
    return tuple(terms)

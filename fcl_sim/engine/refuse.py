"""What the model can say and this engine cannot evaluate: FCL4xx."""

from collections.abc import Iterator
from itertools import pairwise

from fcl_sim.diagnostics import Diagnostic, InputFault, Place, Span
from fcl_sim.engine.conditions import leaves
from fcl_sim.model import (
    Accumulation,
    Activation,
    And,
    AndOperator,
    Conclusion,
    Condition,
    Defuzzification,
    FunctionBlock,
    Fuzzification,
    Is,
    Method,
    Not,
    Or,
    OrOperator,
    Point,
    Points,
    Rule,
    RuleBlock,
    Singleton,
    Term,
)

LARGEST = 1e300
"""Bound of the magnitudes in a rule base: sums and products of degrees with them stay finite."""
FLATTEST = 1e308
"""Bound of the distance over which a degree would rise by 1."""

HINTS = {
    "FCL401": "this version defuzzifies singletons: TERM name := number; METHOD : CoGS;",
    "FCL402": "this version defuzzifies singletons by METHOD : CoGS;",
    "FCL403": "give the abscissa as a number",
    "FCL404": "give the singleton as a number",
    "FCL405": "conclude on a term: variable IS term",
    "FCL406": "use terms and degrees of input variables",
    "FCL407": "keep magnitudes below 1e300, and terms from rising less than 1 in 1e308",
    "FCL408": "give base points, or for outputs single values",
    "FCL409": "give the term that is meant its own base points",
    "FCL410": "take the algorithms of Tables 3, 4 and 5",
    "FCL411": "leave the setting out",
}

EVALUATED: frozenset[AndOperator | OrOperator | Activation | Accumulation] = frozenset(
    (
        *(AndOperator.MIN, AndOperator.PROD, AndOperator.BDIF),
        *(OrOperator.MAX, OrOperator.ASUM, OrOperator.BSUM),
        *(Activation.MIN, Activation.PROD),
        *(Accumulation.MAX, Accumulation.BSUM, Accumulation.NSUM),
    )
)

Finding = tuple[str, str, Span | None]
"""Code, message and place; those with one message become one diagnostic."""


def refuse(block: FunctionBlock) -> None:
    """Raise InputFault with everything in `block` that cannot be evaluated."""
    found: dict[tuple[str, str], list[Place]] = {}
    for code, message, span in _findings(block):
        places = found.setdefault((code, message), [])
        if span is not None:
            places.append(Place(span))
    if found:
        raise InputFault(
            Diagnostic(code=code, message=message, places=tuple(places), hint=HINTS[code])
            for (code, message), places in found.items()
        )


def _findings(block: FunctionBlock) -> Iterator[Finding]:
    for fuzzification in block.fuzzifications:
        if fuzzification.clamped or not fuzzification.enabled:
            message = f"LOCK or ENABLED of `{fuzzification.variable}` is not evaluated yet"
            yield "FCL411", message, fuzzification.span
        for term in fuzzification.terms:
            yield from _input_term(fuzzification, term)
    for defuzzification in block.defuzzifications:
        yield from _output(defuzzification)
    inputs = {variable.name.casefold() for variable in block.inputs}
    outputs = {defuzzification.variable.casefold() for defuzzification in block.defuzzifications}
    for rule_block in block.rule_blocks:
        yield from _rule_block(rule_block)
        for rule in rule_block.rules:
            yield from _condition(rule, inputs)
            for conclusion in rule.conclusions:
                yield from _conclusion(conclusion, outputs)


def _input_term(fuzzification: Fuzzification, term: Term) -> Iterator[Finding]:
    name = fuzzification.variable
    if not isinstance(term.shape, Points):
        yield "FCL408", f"`{term.name}` of `{name}` has a shape that is not evaluated yet", term.span
        return
    points = term.shape.points
    if any(isinstance(point.x, str) for point in points):
        yield "FCL403", f"base points of `{name}` are moved by a variable; not evaluated yet", term.span
    elif not all(_holds(left, right) for left, right in pairwise((points[0], *points))):
        yield "FCL407", f"base points of `{name}` exceed what binary64 can carry", term.span


def _holds(left: Point, right: Point) -> bool:
    """Return whether a stretch between two points, and its run, are safely finite."""
    start, end = float(left.x), float(right.x)
    rise = abs(right.degree - left.degree)
    return max(abs(start), abs(end)) < LARGEST and (rise == 0.0 or end - start < FLATTEST * rise)


def _output(output: Defuzzification) -> Iterator[Finding]:
    name = output.variable
    for term in output.terms:
        if not isinstance(term.shape, Singleton | Points):
            yield "FCL408", f"`{term.name}` of `{name}` has a shape that is not evaluated yet", term.span
        elif isinstance(term.shape, Points):
            yield "FCL401", f"terms of `{name}` have areas; not evaluated yet", term.span
        elif isinstance(term.shape.value, str):
            yield "FCL404", f"singletons of `{name}` are moved by a variable; not evaluated yet", term.span
        elif not abs(term.shape.value) < LARGEST:
            yield "FCL407", f"singletons of `{name}` exceed what binary64 can carry", term.span
    singletons = all(isinstance(term.shape, Singleton) for term in output.terms)
    if singletons and output.method not in {Method.COGS, Method.COG}:
        message = f"METHOD {output.method} of `{name}`, whose terms are singletons, is not evaluated yet"
        yield "FCL402", message, output.span
    if output.held or output.clamped or output.accumulation or not output.enabled:
        yield "FCL411", f"LOCK, ENABLED or ACCU of `{name}` alone is not evaluated yet", output.span


def _rule_block(block: RuleBlock) -> Iterator[Finding]:
    for chosen in (block.and_operator, block.or_operator, block.activation, block.accumulation):
        if chosen not in EVALUATED:
            yield "FCL410", f"{chosen} is not evaluated yet", block.span
    if not block.enabled:
        yield "FCL411", f"ENABLED of the rule block `{block.name}` is not evaluated yet", block.span


def _condition(rule: Rule, inputs: set[str]) -> Iterator[Finding]:
    if any(each.hedges for each in _subconditions(rule.condition)):
        yield "FCL409", "hedges are not evaluated yet", rule.span
    for leaf in leaves(rule.condition):
        if leaf.variable not in inputs:
            message = f"`{leaf.variable}` in a condition is not an input; not evaluated yet"
            yield "FCL406", message, leaf.span or rule.span


def _subconditions(condition: Condition) -> Iterator[Is]:
    if isinstance(condition, Is):
        yield condition
    elif isinstance(condition, Not):
        yield from _subconditions(condition.argument)
    elif isinstance(condition, And | Or):
        for argument in condition.arguments:
            yield from _subconditions(argument)


def _conclusion(conclusion: Conclusion, outputs: set[str]) -> Iterator[Finding]:
    if conclusion.term is None:
        yield (
            "FCL405",
            f"`{conclusion.variable}` is given out as a degree; not evaluated yet",
            conclusion.span,
        )
    elif conclusion.variable.casefold() not in outputs:
        message = f"the local variable `{conclusion.variable}` is concluded on; not evaluated yet"
        yield "FCL405", message, conclusion.span

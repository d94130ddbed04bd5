"""What the model can say and this engine cannot evaluate: FCL4xx."""

from collections.abc import Iterator, Sequence
from itertools import pairwise

from fcl_sim.diagnostics import Diagnostic, InputFault, Place, Span
from fcl_sim.engine.program import LARGEST
from fcl_sim.model import (
    Accumulation,
    Activation,
    Defuzzification,
    FunctionBlock,
    Fuzzification,
    Method,
    Point,
    Points,
    RuleBlock,
    Singleton,
    Term,
)

FLATTEST = 1e308
"""Bound of the distance over which a degree would rise by 1."""

HINTS = {
    "FCL407": "keep magnitudes below 1e300, and terms from rising less than 1 in 1e308",
    "FCL408": "give base points, or for outputs single values",
    "FCL410": "take the algorithms of Tables 3, 4 and 5",
    "FCL411": "leave the setting out",
}

EVALUATED: frozenset[Activation | Accumulation] = frozenset(
    (
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
    for rule_block in block.rule_blocks:
        yield from _rule_block(rule_block)


def _input_term(fuzzification: Fuzzification, term: Term) -> Iterator[Finding]:
    name = fuzzification.variable
    if not isinstance(term.shape, Points):
        yield "FCL408", f"`{term.name}` of `{name}` has a shape that is not evaluated yet", term.span
        return
    if not _all_hold(term.shape.points):
        yield "FCL407", f"base points of `{name}` exceed what binary64 can carry", term.span


def _all_hold(points: Sequence[Point]) -> bool:
    """Return whether all stretches between points, and their runs, are safely finite."""
    return all(_holds(left, right) for left, right in pairwise((points[0], *points)))


def _holds(left: Point, right: Point) -> bool:
    ends = [float(x) for x in (left.x, right.x) if not isinstance(x, str)]
    if not all(abs(x) < LARGEST for x in ends):
        return False
    rise = abs(right.degree - left.degree)
    return rise == 0.0 or len(ends) < 2 or ends[1] - ends[0] < FLATTEST * rise


def _output(output: Defuzzification) -> Iterator[Finding]:
    name = output.variable
    for term in output.terms:
        shape = term.shape
        if isinstance(shape, Points):
            if not _all_hold(shape.points):
                yield "FCL407", f"base points of `{name}` exceed what binary64 can carry", term.span
        elif not isinstance(shape, Singleton):
            yield "FCL408", f"`{term.name}` of `{name}` has a shape that is not evaluated yet", term.span
        elif not isinstance(shape.value, str) and not abs(shape.value) < LARGEST:
            yield "FCL407", f"singletons of `{name}` exceed what binary64 can carry", term.span
    if output.range is not None and not max(map(abs, output.range)) < LARGEST:
        yield "FCL407", f"RANGE of `{name}` exceeds what binary64 can carry", output.span
    if output.accumulation is not None and output.accumulation not in EVALUATED:
        yield "FCL410", f"{output.accumulation} is not evaluated yet", output.span
    if output.method is Method.SUM:
        yield "FCL410", f"METHOD {output.method} is not evaluated yet", output.span
    if output.held or output.clamped or not output.enabled:
        yield "FCL411", f"LOCK or ENABLED of `{name}` is not evaluated yet", output.span


def _rule_block(block: RuleBlock) -> Iterator[Finding]:
    for chosen in (block.activation, block.accumulation):
        if chosen not in EVALUATED:
            yield "FCL410", f"{chosen} is not evaluated yet", block.span
    if not block.enabled:
        yield "FCL411", f"ENABLED of the rule block `{block.name}` is not evaluated yet", block.span

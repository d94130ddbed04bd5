"""What the model can say and this engine cannot evaluate: FCL4xx."""

from collections.abc import Iterator, Sequence
from itertools import pairwise

from fcl_sim.diagnostics import Diagnostic, InputFault, Place, Span
from fcl_sim.engine.program import LARGEST
from fcl_sim.model import (
    Accumulation,
    Activation,
    Curve,
    Defuzzification,
    Formula,
    FunctionBlock,
    Fuzzification,
    Method,
    Point,
    Points,
    RuleBlock,
    Singleton,
    Singletons,
    Term,
)

FLATTEST = 1e308
"""Bound of the distance over which a degree would rise by 1."""

HINTS = {
    "FCL407": "keep magnitudes below 1e300, and terms from rising less than 1 in 1e308",
    "FCL408": "give base points, which variables may move, or numbers for what they move here",
    "FCL410": "take ACT MIN or PROD, or ACCU MAX",
    "FCL331": "CoG, CoA, LM and RM are for areas",
    "FCL412": "give the output a RANGE, such as RANGE := (0 .. 100);",
}

BENDING = frozenset((Activation.HPROD, Activation.EPROD))
"""What makes curves of straight terms."""

Finding = tuple[str, str, Span | None]
"""Code, message and place; those with one message become one diagnostic."""


def refuse(block: FunctionBlock) -> None:
    """Raise InputFault with everything in `block` that cannot be evaluated."""
    found: dict[tuple[str, str], list[Place]] = {}
    for code, message, span in _findings(block):
        places = found.setdefault((code, message), [])
        if span is not None and Place(span) not in places:
            places.append(Place(span))
    if found:
        raise InputFault(
            Diagnostic(code=code, message=message, places=tuple(places), hint=HINTS[code])
            for (code, message), places in found.items()
        )


def _findings(block: FunctionBlock) -> Iterator[Finding]:
    for fuzzification in block.fuzzifications:
        for term in fuzzification.terms:
            yield from _input_term(fuzzification, term)
    for defuzzification in block.defuzzifications:
        yield from _output(defuzzification)
    for rule_block in block.rule_blocks:
        yield from _rule_block(block, rule_block)


def _input_term(fuzzification: Fuzzification, term: Term) -> Iterator[Finding]:
    name = fuzzification.variable
    shape = term.shape
    if isinstance(shape, Curve):
        if not _curve_holds(shape):
            yield "FCL407", f"parameters of `{name}` exceed what LREAL can hold", term.span
    elif isinstance(shape, Singletons):
        if len(shape.points) > 1 and any(isinstance(point.x, str) for point in shape.points):
            message = f"`{term.name}` of `{name}` has several single values that variables move"
            yield "FCL408", f"{message}, which is not evaluated yet", term.span
    elif not isinstance(shape, Points):
        yield "FCL408", f"`{term.name}` of `{name}` has a shape that is not evaluated yet", term.span
    elif not _all_hold(shape.points):
        yield "FCL407", f"base points of `{name}` exceed what LREAL can hold", term.span


def _curve_holds(curve: Curve) -> bool:
    return all(isinstance(each, str) or abs(each) < LARGEST for each in curve.parameters)


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
        if isinstance(shape, Curve):
            yield from _output_curve(output, term, shape)
        elif isinstance(shape, Points):
            if not _all_hold(shape.points):
                yield "FCL407", f"base points of `{name}` exceed what LREAL can hold", term.span
        elif isinstance(shape, Formula):
            if has_area(output):
                yield "FCL408", f"`{name}` has areas and formulae, which is not evaluated", term.span
        elif not isinstance(shape, Singleton):
            yield "FCL408", f"`{term.name}` of `{name}` has a shape that is not evaluated yet", term.span
        elif not isinstance(shape.value, str) and not abs(shape.value) < LARGEST:
            yield "FCL407", f"singletons of `{name}` exceed what LREAL can hold", term.span
    if output.range is not None and not max(map(abs, output.range)) < LARGEST:
        yield "FCL407", f"RANGE of `{name}` exceeds what LREAL can hold", output.span
    if output.method is Method.SUM and has_area(output):
        yield (
            "FCL331",
            f"{output.method} is a method for singletons, and these terms have an area",
            output.span,
        )


def _output_curve(output: Defuzzification, term: Term, curve: Curve) -> Iterator[Finding]:
    """Yield what keeps a curve from being a polyline over a finite range."""
    subject = f"`{term.name}` of `{output.variable}`"
    if output.range is None:
        yield "FCL412", f"{subject} is a smooth shape, and `{output.variable}` has no RANGE", term.span
    if any(isinstance(each, str) for each in curve.parameters):
        yield "FCL408", f"{subject} is a smooth shape that variables move, not evaluated yet", term.span
    elif not _curve_holds(curve):
        yield "FCL407", f"parameters of `{output.variable}` exceed what LREAL can hold", term.span


def _rule_block(block: FunctionBlock, rule_block: RuleBlock) -> Iterator[Finding]:
    """Yield where NMAX jumps at places that are not searched for."""
    concluded = {each.variable.casefold() for rule in rule_block.rules for each in rule.conclusions}
    for output in block.defuzzifications:
        kind, activation = output.accumulation or rule_block.accumulation, rule_block.activation
        if (
            (kind is Accumulation.NMAX and activation in BENDING)
            and has_area(output)
            and output.variable.casefold() in concluded
        ):
            message = f"ACCU NMAX of areas under ACT {activation} is not evaluated"
            yield "FCL410", message, rule_block.span


def has_area(output: Defuzzification) -> bool:
    """Return whether an output has terms with areas, smooth ones among them."""
    return any(isinstance(each.shape, Points | Curve) for each in output.terms)

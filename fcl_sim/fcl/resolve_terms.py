"""Terms → shapes of the model (5.2.2, 5.2.3, S22)."""

from collections.abc import Sequence

from fcl_sim.fcl.scope import Scope, Terms
from fcl_sim.fcl.tokens import Token
from fcl_sim.fcl.tree import Number, Pair, Term, Value
from fcl_sim.model import Point, Points, Shape, Singleton
from fcl_sim.model import Term as ModelTerm


def resolve_terms(
    scope: Scope, names: Terms, terms: Sequence[Term], *, output: bool
) -> tuple[ModelTerm, ...]:
    """Return the terms that can be used and enter the names of all; singletons stand in outputs only."""
    resolved = []
    for term in terms:
        first = names.names.setdefault(term.name.key, term.name)
        if first is not term.name:
            scope.report_twice("FCL314", f"the term `{first.text}` is defined twice", term.name, first)
        if term.shape is None:
            continue
        shape = _shape(scope, term.shape, output=output)
        if shape is not None:
            resolved.append(ModelTerm(term.name.text, shape, scope.findings.span(term.name)))
    return tuple(resolved)


def _shape(scope: Scope, shape: tuple[Pair, ...] | Value, *, output: bool) -> Shape | None:
    if isinstance(shape, tuple):
        return _points(scope, shape)
    if not output:
        scope.findings.error(
            "FCL316",
            "a single value cannot be the term of an input: singletons stand in DEFUZZIFY",
            shape,
            hint="write points: `(x, degree) (x, degree) …`",
        )
        return None
    value = _abscissa(scope, shape, "a singleton")
    return None if value is None else Singleton(value)


def _points(scope: Scope, pairs: Sequence[Pair]) -> Points | None:
    points = []
    highest: Number | None = None
    for pair in pairs:
        x = _abscissa(scope, pair.x, "the abscissa of a point")
        degree = _degree(scope, pair.degree)
        if isinstance(pair.x, Number):
            if highest is not None and pair.x.value < highest.value:
                _report_fall(scope, pair.x, highest)
                return None
            highest = pair.x
        if x is not None and degree is not None:
            points.append(Point(x, degree))
    if len(pairs) == 1:
        message = "a term with one point has the same degree everywhere: 5.2.2 asks for at least two"
        scope.findings.warning("FCL319", message, pairs[0])
    return Points(tuple(points)) if len(points) == len(pairs) else None


def _abscissa(scope: Scope, value: Value, use: str) -> float | str | None:
    return scope.find_input(value, use) if isinstance(value, Token) else value.value


def _degree(scope: Scope, value: Value) -> float | None:
    if isinstance(value, Token):
        message = "a degree of membership that is a variable is not read by this version"
        scope.findings.error("FCL290", message, value, hint="variables may stand for the abscissa (5.2.2)")
        return None
    if not 0.0 <= value.value <= 1.0:
        message = f"the degree of membership `{scope.findings.span(value).text}` is not between 0 and 1"
        scope.findings.error("FCL317", message, value, hint="a point is `(abscissa, degree)`")
        return None
    return value.value


def _report_fall(scope: Scope, x: Number, before: Number) -> None:
    spans = scope.findings.span(before), scope.findings.span(x)
    message = (
        f"the points fall from {spans[0].text} to {spans[1].text}: they are given in ascending order (5.2.2)"
    )
    scope.findings.error("FCL318", message, x)

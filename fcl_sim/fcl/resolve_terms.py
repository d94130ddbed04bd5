"""Terms → shapes of the model (5.2.2, 5.2.3, S15, S22)."""

from collections.abc import Sequence

from fcl_sim.fcl.resolve_formulas import resolve_formula, resolve_linear
from fcl_sim.fcl.resolve_shapes import report_bare, resolve_named
from fcl_sim.fcl.scope import Scope, Terms
from fcl_sim.fcl.tokens import Token
from fcl_sim.fcl.tree import Formula, Named, Number, Pair, Term, Value
from fcl_sim.fcl.tree import Shape as TreeShape
from fcl_sim.model import Point, Points, Shape, Singleton, Singletons
from fcl_sim.model import Term as ModelTerm

MOST_POINTS = 4
"""Of the Extension Level (Table 9)."""


def resolve_terms(
    scope: Scope, names: Terms, terms: Sequence[Term], *, output: bool
) -> tuple[ModelTerm, ...]:
    """Return the terms that can be used and enter the names of all."""
    resolved = []
    for term in terms:
        first = names.names.setdefault(term.name.key, term.name)
        if first is not term.name:
            scope.report_twice("FCL314", f"the term `{first.text}` is defined twice", term.name, first)
        if term.shape is None:
            continue
        if not output and (formula := _as_formula(term.shape)):
            message = "a formula cannot be the term of an input"
            hint = "write points: `(x, degree) (x, degree) …`"
            scope.findings.error("FCL316", message, formula, hint)
            continue
        shape = _shape(scope, term.shape)
        if shape is not None and not output:
            shape = _of_input(scope, term.shape, shape)
        if shape is not None:
            resolved.append(ModelTerm(term.name.text, shape, scope.findings.span(term.name)))
    return tuple(resolved)


def _as_formula(shape: TreeShape) -> Formula | Named | None:
    """Return a shape if it is a formula, else None."""
    if isinstance(shape, Named) and shape.name.key != "LINEAR":
        return None
    return shape if isinstance(shape, Formula | Named) else None


def _shape(scope: Scope, shape: TreeShape) -> Shape | None:
    if isinstance(shape, tuple):
        return _points(scope, shape)
    if isinstance(shape, Formula):
        return resolve_formula(scope, shape)
    if isinstance(shape, Named):
        return resolve_linear(scope, shape) if _as_formula(shape) else resolve_named(scope, shape)
    if isinstance(shape, Token) and report_bare(scope, shape):
        return None
    value = _abscissa(scope, shape, "a singleton")
    return None if value is None else Singleton(value)


def _of_input(scope: Scope, written: TreeShape, shape: Shape) -> Shape | None:
    """Return the shape of an input's term: a single value is one at which the degree is 1 (S15)."""
    at = written[0] if isinstance(written, tuple) else written
    if isinstance(shape, Singleton):
        message = "a single value is the term of an input: its degree is 1 there and 0 everywhere else"
        scope.findings.warning("FCL316", message, at, hint="write points: `(x, degree) (x, degree) …`")
        scope.findings.feature("singletons", "a single value in an input", at)
        return Singletons((Point(shape.value, 1.0),))
    return shape


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
    if len(pairs) > MOST_POINTS:
        scope.findings.feature("points", f"{len(pairs)} points", pairs[MOST_POINTS])
    if any(each.degree not in {0.0, 1.0} for each in points):
        scope.findings.feature("degree", "a degree other than 0 and 1", pairs[0])
    return Points(tuple(points)) if len(points) == len(pairs) else None


def _abscissa(scope: Scope, value: Value, use: str) -> float | str | None:
    return scope.find_input(value, use) if isinstance(value, Token) else value.value


def _degree(scope: Scope, value: Value) -> float | None:
    if isinstance(value, Token):
        message = "a degree of membership is a number, not a variable"
        scope.findings.error("FCL317", message, value, hint="variables may stand for the abscissa (5.2.2)")
        return None
    if not 0.0 <= value.value <= 1.0:
        message = "this degree of membership is not between 0 and 1"
        scope.findings.error("FCL317", message, value, hint="a point is `(abscissa, degree)`")
        return None
    return value.value


def _report_fall(scope: Scope, x: Number, before: Number) -> None:
    spans = scope.findings.span(before), scope.findings.span(x)
    message = (
        f"the points fall from {spans[0].text} to {spans[1].text}: they are given in ascending order (5.2.2)"
    )
    scope.findings.error("FCL318", message, x)

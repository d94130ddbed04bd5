"""Membership functions by name → shapes of the model, in one convention (S15)."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

from fcl_sim.diagnostics.spelling import listed
from fcl_sim.fcl.parse_values import EXTREMES
from fcl_sim.fcl.scope import Scope
from fcl_sim.fcl.tokens import Token
from fcl_sim.fcl.tree import Named, Number, Value
from fcl_sim.model import Curve, CurveKind, Point, Points, Shape, Singleton, Singletons

Parameter = float | str
"""A number, or the name of the input that holds it."""

Maker = Callable[[Sequence[Parameter], float], Shape | str]
"""Makes a shape of parameters and height, or says what is wrong with them."""

_VARIABLE_LENGTH = frozenset(("SINGLETONS", "DISCRETE"))


@dataclass(frozen=True, slots=True)
class _Function:
    """The parameters of a membership function, and what makes a shape of them."""

    parameters: str
    make: Maker


# -- piecewise linear


def _corners(*degrees: float) -> Maker:
    """Return what makes points with these degrees; infinite ends fall away: points are constant outside."""

    def make(parameters: Sequence[Parameter], height: float) -> Points:
        pairs = zip(parameters, degrees, strict=True)
        return Points(tuple(Point(x, degree * height) for x, degree in pairs if not _is_infinite(x)))

    return make


def _rectangle(parameters: Sequence[Parameter], height: float) -> Points:
    degrees = (0.0, height, height, 0.0)
    points = (Point(parameters[place // 2], degree) for place, degree in enumerate(degrees))
    return Points(tuple(each for each in points if not _is_infinite(each.x)))


def _ramp(parameters: Sequence[Parameter], height: float) -> Points | str:
    start, end = parameters
    if _is_infinite(start) or _is_infinite(end):
        return "they must be finite"
    if isinstance(start, float) and isinstance(end, float):
        if start == end:
            return "its start and its end are the same"
        if end < start:
            return Points((Point(end, height), Point(start, 0.0)))
    return Points((Point(start, 0.0), Point(end, height)))


def _binary(parameters: Sequence[Parameter], height: float) -> Points | str:
    start, direction = parameters
    if _is_infinite(start):
        return "its start must be finite"
    rises = not isinstance(start, float) or not isinstance(direction, float) or direction > start
    degrees = (0.0, height) if rises else (height, 0.0)
    return Points(tuple(Point(start, each) for each in degrees))


# -- smooth


def _curve(kind: CurveKind, order: str, *positive: int, scale: float = 1.0) -> Maker:
    """Return what makes a curve: `order` names the places of its parameters in the text.

    Those at the places `positive` of the curve are widths: their sign means
    nothing, and they are not 0. The first of them is multiplied by `scale`.
    """

    def make(written: Sequence[Parameter], height: float) -> Curve | str:
        parameters = [written[int(each)] for each in order]
        if any(_is_infinite(each) for each in parameters):
            return "they must be finite"
        for place in positive:
            width = parameters[place]
            if isinstance(width, float):
                if width == 0.0:
                    return "its width must not be 0"
                parameters[place] = abs(width) * scale
            elif scale != 1.0:
                return "its width must be a number, not a variable"
        return Curve(kind, tuple(parameters), height)

    return make


def _rising(kind: CurveKind, *pairs: tuple[int, int]) -> Maker:
    """Return what makes a curve whose parameters rise at these pairs of places."""

    def make(parameters: Sequence[Parameter], height: float) -> Shape | str:
        for first, second in pairs:
            low, high = parameters[first], parameters[second]
            if isinstance(low, float) and isinstance(high, float) and not low < high:
                return f"{low:g} is not below {high:g}"
        return _curve(kind, "0123"[: len(parameters)])(parameters, height)

    return make


def _gaussian_product(parameters: Sequence[Parameter], height: float) -> Shape | str:
    return _curve(CurveKind.GAUSSIAN_PRODUCT, "0123", 1, 3)(parameters, height)


def _concave(parameters: Sequence[Parameter], height: float) -> Shape | str:
    if parameters[0] == parameters[1]:
        return "its inflection and its end are the same"
    return _curve(CurveKind.CONCAVE, "01")(parameters, height)


# -- single values


def _constant(parameters: Sequence[Parameter], _: float) -> Shape | str:
    return "its value must be finite" if _is_infinite(parameters[0]) else Singleton(parameters[0])


def _is_infinite(value: Parameter) -> bool:
    return isinstance(value, float) and not math.isfinite(value)


_JFUZZYLOGIC = {
    "TRIAN": _Function("left peak right", _corners(0.0, 1.0, 0.0)),
    "TRAPE": _Function("left top-left top-right right", _corners(0.0, 1.0, 1.0, 0.0)),
    "GAUSS": _Function("mean deviation", _curve(CurveKind.GAUSSIAN, "01", 1)),
    "GAUSS2": _Function("mean deviation mean deviation", _gaussian_product),
    "GBELL": _Function("half-width slope mean", _curve(CurveKind.BELL, "012", 0)),
    "SIGM": _Function("gain inflection", _curve(CurveKind.SIGMOID, "01")),
    "DSIGM": _Function("gain inflection gain inflection", _curve(CurveKind.SIGMOID_DIFFERENCE, "0123")),
    "COSINE": _Function("half-width centre", _curve(CurveKind.COSINE, "01", 0)),
}
_FUZZYLITE = {
    "TRIANGLE": _Function("left peak right", _corners(0.0, 1.0, 0.0)),
    "TRAPEZOID": _Function("left top-left top-right right", _corners(0.0, 1.0, 1.0, 0.0)),
    "RECTANGLE": _Function("start end", _rectangle),
    "RAMP": _Function("start end", _ramp),
    "BINARY": _Function("start direction", _binary),
    "GAUSSIAN": _Function("mean deviation", _curve(CurveKind.GAUSSIAN, "01", 1)),
    "GAUSSIANPRODUCT": _Function("mean deviation mean deviation", _gaussian_product),
    "BELL": _Function("centre half-width slope", _curve(CurveKind.BELL, "120", 0)),
    "SIGMOID": _Function("inflection gain", _curve(CurveKind.SIGMOID, "10")),
    "SIGMOIDDIFFERENCE": _Function("left rising falling right", _curve(CurveKind.SIGMOID_DISTANCE, "1023")),
    "SIGMOIDPRODUCT": _Function("left rising falling right", _curve(CurveKind.SIGMOID_PRODUCT, "1023")),
    "ZSHAPE": _Function("start end", _rising(CurveKind.Z_SHAPE, (0, 1))),
    "SSHAPE": _Function("start end", _rising(CurveKind.S_SHAPE, (0, 1))),
    "PISHAPE": _Function("left top-left top-right right", _rising(CurveKind.PI_SHAPE, (0, 1), (2, 3))),
    "SPIKE": _Function("centre width", _curve(CurveKind.SPIKE, "01", 1)),
    "CONCAVE": _Function("inflection end", _concave),
    "CONSTANT": _Function("value", _constant),
}
_COSINE = _Function("centre width", _curve(CurveKind.COSINE, "10", 0, scale=0.5))
"""fuzzylite's, which differs from the other family's by its spelling alone."""


def resolve_named(scope: Scope, shape: Named) -> Shape | None:
    """Return a shape of the Open Level; None, once reported, where there is no such one."""
    key = shape.name.key
    function = _COSINE if shape.name.text == "Cosine" else _FUNCTIONS.get(key)
    if function is None and key not in _VARIABLE_LENGTH:
        _report_unknown(scope, shape.name)
        return None
    values = [_parameter(scope, each) for each in shape.arguments]
    parameters = [each for each in values if each is not None]
    if len(parameters) < len(values):
        return None
    scope.findings.feature("singletons" if key == "SINGLETONS" else "shape", shape.name.text, shape)
    if function is None:
        return _listed(scope, shape, parameters)
    return _made(scope, shape, function, parameters)


def _made(scope: Scope, shape: Named, function: _Function, parameters: Sequence[Parameter]) -> Shape | None:
    """Return what a function makes of its parameters; fuzzylite may write a height behind them."""
    name = shape.name.text
    count = len(function.parameters.split())
    if not count <= len(parameters) <= count + (shape.name.key in _FUZZYLITE):
        message = f"{name} takes {count} parameter{'' if count == 1 else 's'}, not {len(parameters)}"
        scope.findings.error("FCL322", message, shape, hint=f"write {name} {function.parameters}")
        return None
    height = _height(scope, shape, parameters[count:])
    if height is None:
        return None
    made = function.make(parameters[:count], height)
    if isinstance(made, str):
        scope.findings.error(
            "FCL323", f"these parameters of {name} make no membership function: {made}", shape
        )
        return None
    return _checked(scope, shape, made)


_FUNCTIONS = _JFUZZYLOGIC | _FUZZYLITE


def _parameter(scope: Scope, value: Value) -> Parameter | None:
    number = value.value if isinstance(value, Number) else None
    if isinstance(value, Token):
        if value.key in scope.variables or value.key not in EXTREMES:
            return scope.find_input(value, "a parameter")
        number = EXTREMES[value.key]
    if number is not None and math.isnan(number):
        scope.findings.error("FCL323", "NaN is not a parameter of a membership function", value)
        return None
    return number


def _height(scope: Scope, shape: Named, given: Sequence[Parameter]) -> float | None:
    """Return the height that fuzzylite writes behind the parameters, 1 where there is none."""
    height = given[0] if given else 1.0
    if isinstance(height, float) and 0.0 < height <= 1.0:
        return height
    message = (
        f"the last parameter of {shape.name.text} is its height, which must lie above 0 and at most at 1"
    )
    scope.findings.error("FCL317", message, shape.arguments[-1])
    return None


def _listed(scope: Scope, shape: Named, parameters: Sequence[Parameter]) -> Shape | None:
    """Return the shape of a list of abscissae and degrees; fuzzylite may write a height behind it."""
    odd = len(parameters) % 2
    if len(parameters) < 2 or (odd and shape.name.key == "SINGLETONS"):
        message = f"{shape.name.text} takes pairs of an abscissa and a degree"
        scope.findings.error(
            "FCL322", message, shape, hint=f"write {shape.name.text} (x, degree) (x, degree) …"
        )
        return None
    height = _height(scope, shape, parameters[-1:] if odd else ())
    if height is None:
        return None
    points = []
    for place, (x, degree) in enumerate(zip(parameters[::2], parameters[1::2], strict=False)):
        if _is_infinite(x):
            message = f"the abscissae of {shape.name.text} must be finite"
            scope.findings.error("FCL323", message, shape.arguments[2 * place])
            return None
        if not isinstance(degree, float) or not 0.0 <= degree <= 1.0:
            message = f"this degree of membership in {shape.name.text} is not a number between 0 and 1"
            scope.findings.error("FCL317", message, shape.arguments[2 * place + 1])
            return None
        points.append(Point(x, degree * height))
    made = Points(tuple(points))
    checked = _checked(scope, shape, made)
    return Singletons(made.points) if checked and shape.name.key == "SINGLETONS" else checked


def _checked(scope: Scope, shape: Named, made: Shape) -> Shape | None:
    """Return a shape; None, once reported, where it has points that fall or none at all."""
    if not isinstance(made, Points):
        return made
    numbers = [each.x for each in made.points if isinstance(each.x, float)]
    for before, after in pairwise(numbers):
        if after < before:
            message = f"the points of {shape.name.text} fall from {before:g} to {after:g}"
            scope.findings.error("FCL318", message, shape, hint="give them in ascending order (5.2.2)")
            return None
    if not made.points:
        message = f"these parameters of {shape.name.text} make no membership function: none of them is finite"
        scope.findings.error("FCL323", message, shape)
        return None
    return made


def report_bare(scope: Scope, name: Token) -> bool:
    """Report a membership function without its parameters; return whether it is that, and no variable."""
    function = _FUNCTIONS.get(name.key)
    is_shape = function is not None or name.key in {*_VARIABLE_LENGTH, "FUNCTION", "LINEAR"}
    if name.key in scope.variables or not is_shape:
        return False
    if function is not None:
        what, hint = "no parameters", f"write {name.text} {function.parameters}"
    elif name.key == "FUNCTION":
        what, hint = "no formula", f"write {name.text} and a formula of numbers and variables"
    else:
        what, hint = "no numbers", f"write {name.text} and its numbers"
    scope.findings.error("FCL322", f"{name.text} has {what}", name, hint)
    return True


def _report_unknown(scope: Scope, name: Token) -> None:
    known = [*_FUNCTIONS, *_VARIABLE_LENGTH, "FUNCTION", "LINEAR", "COSINE"]

    def hint() -> str:
        near = scope.findings.near(name.key, known)
        return f"did you mean {near}?" if near else f"write points, or one of {listed(_JFUZZYLOGIC)}"

    scope.findings.error("FCL321", f"{name.shown} is not a membership function", name, hint)

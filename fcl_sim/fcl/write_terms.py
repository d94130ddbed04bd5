"""Terms → text: points without commas (S2), and the shapes of the Open Level."""

from collections.abc import Sequence

from fcl_sim.fcl.write_expressions import expression
from fcl_sim.fcl.write_numbers import number
from fcl_sim.model import Curve, CurveKind, Formula, Point, Points, Shape, Singleton, Singletons, Term

_SPELLINGS = {
    CurveKind.SIGMOID_DISTANCE: ("SigmoidDifference", "1023"),
    CurveKind.SIGMOID_PRODUCT: ("SigmoidProduct", "1023"),
}
"""Names in the text, and which parameter of the curve stands in each place, where that is not plain."""
_WITH_HEIGHT = _SPELLINGS | {
    CurveKind.GAUSSIAN: ("Gaussian", "01"),
    CurveKind.GAUSSIAN_PRODUCT: ("GaussianProduct", "0123"),
    CurveKind.BELL: ("Bell", "201"),
    CurveKind.SIGMOID: ("Sigmoid", "10"),
    CurveKind.Z_SHAPE: ("ZShape", "01"),
    CurveKind.S_SHAPE: ("SShape", "01"),
    CurveKind.PI_SHAPE: ("PiShape", "0123"),
    CurveKind.SPIKE: ("Spike", "01"),
    CurveKind.CONCAVE: ("Concave", "01"),
}
"""The same where a height follows."""


def term_lines(term: Term, name_width: int, width: int) -> list[str]:
    """Return a term; its `:=` stands behind a name of `name_width` characters.

    Words that do not fit into `width` characters go on below the first.
    """
    lead = f"TERM {term.name:<{name_width}} := "
    lines: list[str] = []
    line = ""
    for word in _words(term.shape):
        if line and len(lead) + len(line) + 1 + len(word) >= width:
            lines.append(line)
            line = word
        else:
            line = f"{line} {word}".lstrip()
    first, *others = [*lines, f"{line};"]
    return [lead + first, *(" " * len(lead) + each for each in others)]


def _words(shape: Shape) -> list[str]:
    """Return what must stay on one line."""
    match shape:
        case Points():
            return _points(shape.points)
        case Singletons():
            return ["SINGLETONS", *_points(shape.points)]
        case Singleton():
            return [number(shape.value)]
        case Curve():
            return _curve(shape)
        case Formula():
            return ["FUNCTION", expression(shape.expression)]


def _points(points: Sequence[Point]) -> list[str]:
    return [f"({number(each.x)}, {number(each.degree)})" for each in points]


def _curve(curve: Curve) -> list[str]:
    """Return a curve as jFuzzyLogic writes it; one with a height, or of another kind, as fuzzylite does."""
    name, order = _SPELLINGS.get(curve.kind, (curve.kind.value, ""))
    height = []
    if curve.height != 1.0:
        if curve.kind not in _WITH_HEIGHT:
            raise ValueError(f"{curve.kind} has no height in FCL")
        name, order = _WITH_HEIGHT[curve.kind]
        height = [number(curve.height)]
    parameters = [curve.parameters[int(each)] for each in order] or curve.parameters
    return [name, *(number(each) for each in parameters), *height]

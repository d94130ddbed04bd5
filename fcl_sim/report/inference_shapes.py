"""Membership functions of an inference as lines: taken, negated, activated."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
from numpy import float64
from numpy.typing import NDArray

from fcl_sim.engine.conditions import AND_CODE, OPERATORS
from fcl_sim.engine.explain import Activated
from fcl_sim.engine.switches import degree_at
from fcl_sim.model import AndOperator, Point, Singleton, Term
from fcl_sim.report import style
from fcl_sim.report.canvas import Axes, Dot, Figure, Line, between, upright
from fcl_sim.report.inference_view import Input, Output, Variable
from fcl_sim.report.terms import points_of

Polyline = tuple[NDArray[float64], NDArray[float64]]
"""Abscissae and degrees of a polyline."""

DOTTED: style.Dashes = (1, 1.6)
TOP = 1.06
"""Upper end of the axis of degrees."""
BENT = 24
"""Pieces of a straight stretch that activation bends."""


def line_over(term: Term, low: float, high: float) -> Polyline:
    """Return the membership function of a drawn term from `low` to `high`, constant outside (S20)."""
    points = points_of(term)
    inside = [(float(point.x), point.degree) for point in points if low <= float(point.x) <= high]
    line = [(low, _degree(points, low)), *inside, (high, _degree(points, high))]
    if inside and inside[0][0] == low:
        del line[0]
    if inside and inside[-1][0] == high:
        del line[-1]
    xs, degrees = zip(*line, strict=True)
    return np.array(xs), np.array(degrees)


def above_zero(line: Polyline) -> Polyline:
    """Return a polyline without the zeros at its ends."""
    xs, degrees = line
    (places,) = np.nonzero(degrees)
    if not len(places):
        return xs[:0], degrees[:0]
    kept = slice(max(int(places[0]) - 1, 0), int(places[-1]) + 2)
    return xs[kept], degrees[kept]


def _degree(points: tuple[Point, ...], x: float) -> float:
    return float(degree_at(points, Fraction(x)))


def activated_line(line: Polyline, each: Activated) -> Polyline:
    """Return a conclusion's membership function after activation by its algorithm, and its weight."""
    xs, degrees = line
    if each.algorithm == "PROD":
        return xs, each.weight * (each.activated * degrees)
    xs, degrees = _divided(xs, degrees, each.activated, bent=each.algorithm != "MIN")
    if each.algorithm == "MIN":
        return xs, each.weight * np.minimum(degrees, each.activated)
    norm = OPERATORS[AND_CODE[AndOperator(each.algorithm)]]
    level = Fraction(each.activated)
    return xs, np.array([each.weight * float(norm(level, Fraction(degree))) for degree in degrees.tolist()])


def _divided(xs: NDArray[float64], degrees: NDArray[float64], level: float, *, bent: bool) -> Polyline:
    """Return a polyline with more vertices: where it passes `level`, and all along where activation bends."""
    line = [(xs[0], degrees[0])]
    for (left, low), (right, high) in pairwise(zip(xs.tolist(), degrees.tolist(), strict=True)):
        parts = [each / BENT for each in range(1, BENT)] if bent and left < right and low != high else []
        if min(low, high) < level < max(low, high):
            parts = sorted([*parts, (level - low) / (high - low)])
        line += [(left + part * (right - left), low + part * (high - low)) for part in parts]
        line.append((right, high))
    made = np.array(line)
    return made[:, 0], made[:, 1]


def sketch(
    figure: Figure, corner: tuple[float, float], size: tuple[float, float], shown: Variable, label: str
) -> Axes:
    """Return axes without numbers for a variable, framed; `corner` is the upper left one, all in mm."""
    axes = figure.place(*corner, *size, label)
    axes.x, axes.y = (shown.low, shown.high), (0.0, TOP)
    axes.add(Line([0.0, 0.0, 1.0], [1.0, 0.0, 0.0], style.FAINT, 0.5, z=2.5, parts=True, free=True))
    return axes


def draw_taken(axes: Axes, shown: Input, term: int, degree: float, *, negated: bool) -> None:
    """Draw one term of an input, or NOT it, with the value and the degree that a rule takes."""
    colour, dashes = style.stroke(term)
    xs, degrees = line_over(shown.terms[term], shown.low, shown.high)
    line = (xs, 1.0 - degrees) if negated else (xs, degrees)
    below, heights = _divided(*line, degree, bent=False)
    axes.add(between(below, 0.0, np.minimum(heights, degree), style.BAND, z=1))
    axes.add(Line(*above_zero(line), colour, 1.1, dashes, z=3, label="term"))
    draw_value(axes, shown)
    if shown.low <= shown.at <= shown.high:
        axes.add(Dot(shown.at, degree, "circle", style.INK, 3.8, z=5, label="degree"))
    axes.add(Line([shown.low, shown.high], [degree] * 2, style.INK, 0.6, DOTTED, z=4))


def draw_value(axes: Axes, shown: Input) -> None:
    """Draw the value of an input as a line, or as an arrow at the end beyond which it lies."""
    draw_crisp(axes, shown, shown.value, "value")
    if shown.at != shown.value:
        axes.add(upright(axes, shown.at, style.INK, width=0.6, dashes=(4, 2), z=4, label="clamped"))


def draw_crisp(axes: Axes, shown: Variable, value: float, label: str, width: float = 0.9) -> None:
    """Draw a number on the axis of a variable as a line behind stems, or as an arrow if it lies beyond."""
    if shown.low <= value <= shown.high:
        axes.add(upright(axes, value, style.INK, width=width, z=2.8, label=label))
    elif value < shown.low:
        axes.add(Dot(0.0, 0.5, "left", style.INK, 6.0, z=4, parts=True))
    elif value > shown.high:
        axes.add(Dot(1.0, 0.5, "right", style.INK, 6.0, z=4, parts=True))


def draw_activated(axes: Axes, shown: Output, each: Activated) -> None:
    """Draw an activated conclusion: its term thin, the others faint, what is left as an area or a stem."""
    index = shown.index(each.term)
    for place, term in enumerate(shown.terms):
        colour, dashes = style.stroke(place) if place == index else (style.GRID, ())
        if isinstance(term.shape, Singleton):
            draw_stem(axes, shown, float(term.shape.value), 1.0, colour, faint=True)
        else:
            line = line_over(term, shown.low, shown.high)
            axes.add(Line(*above_zero(line), colour, 0.7, dashes))
    term = shown.terms[index]
    colour, _ = style.stroke(index)
    if isinstance(term.shape, Singleton):
        draw_stem(axes, shown, float(term.shape.value), each.degree, colour)
    else:
        line = activated_line(line_over(term, *shown.limits), each)
        draw_area(axes, *above_zero(line), colour)


def draw_stem(
    axes: Axes, shown: Variable, x: float, degree: float, colour: str, *, faint: bool = False
) -> None:
    """Draw a singleton at `x` up to its degree; `faint` where it only shows where there is one."""
    if not shown.low <= x <= shown.high:
        return
    if faint:
        axes.add(Line([x, x], [0.0, degree], colour, 0.7, (1.5, 1.5)))
    else:
        axes.add(Line([x, x], [0.0, degree], colour, 2.2, flat=True, z=3))
        axes.add(Dot(x, degree, "circle", colour, 4.6, z=4, label="degree"))


def draw_area(axes: Axes, xs: NDArray[float64], degrees: NDArray[float64], colour: str) -> None:
    """Fill an area below its polyline."""
    axes.add(between(xs, 0.0, degrees, style.BAND, z=1))
    axes.add(Line(xs, degrees, colour, 1.5, z=3, label="area"))

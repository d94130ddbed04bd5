"""Fuzzification of the inputs, and accumulation and defuzzification of the outputs."""

from collections.abc import Sequence
from math import isfinite

import numpy as np

from fcl_sim.engine.explain import Accumulated, Brought, Origin
from fcl_sim.engine.explain_text import accumulation_words, defuzzification_formula
from fcl_sim.model import Singleton, Term
from fcl_sim.report import lettering, style
from fcl_sim.report.canvas import Across, Axes, Dot, Figure, Line, Text
from fcl_sim.report.frame import Tick, draw_frame, room_below, ticks
from fcl_sim.report.inference_shapes import (
    DOTTED,
    TOP,
    above_zero,
    draw_area,
    draw_crisp,
    draw_stem,
    draw_value,
    line_over,
)
from fcl_sim.report.inference_view import Input, Output, Variable, View
from fcl_sim.report.naming import Name, Placed, arranged, draw_names, height_of
from fcl_sim.report.strips import COLUMN, EDGE, LINE, Strip, draw_bar, headline, text_height, write
from fcl_sim.report.terms import anchor
from fcl_sim.report.words import number, one_line, printed, with_unit

LEFT = 11.0
"""Room for the degrees left of an axis, in mm."""
BETWEEN = 4.0
RIGHT = 1.5
HALF = (style.WIDTH - BETWEEN) / 2.0
HIGH, HIGHER = 15.0, 20.0
"""Height of the axes of inputs and of outputs in mm."""
AFTER = 2.0
HEIGHTS, CLEAR = (0.5, 0.7, 0.88), 0.13
"""Where the result may be written, and what lies between it and the stems below it, in parts of the axes."""
DEGREES = (Tick(0.0, "0"), Tick(0.5, "0.5"), Tick(1.0, "1"))
BAR = 40.0
TINY = 2.0
"""Height of the bar of a degree in mm."""


def input_strips(view: View) -> list[Strip]:
    """Return the heading, the fuzzified inputs, two to a row, and what is brought in as a degree."""
    rows = [view.inputs[start : start + 2] for start in range(0, len(view.inputs), 2)]
    wide = style.WIDTH if len(view.inputs) == 1 else HALF
    return [
        headline("Fuzzification"),
        *(_inputs(row, wide) for row in rows),
        *(_brought(each) for each in view.brought),
    ]


def _inputs(row: Sequence[Input], wide: float) -> Strip:
    width = wide - LEFT - RIGHT
    named = [arranged(_names(each, each.degrees), width) for each in row]
    names = max(map(height_of, named))
    above = LINE[style.NORMAL] + 0.4 + names

    def paint(figure: Figure, page: Axes, top: float) -> None:
        for index, (each, placed) in enumerate(zip(row, named, strict=True)):
            left = index * (wide + BETWEEN)
            write(page, (left, top), _valued(each.name, _taken(each), wide - BETWEEN))
            axes = figure.place(left + LEFT, top + above, width, HIGH, f"input {each.name}")
            _draw_input(axes, each, placed)

    return Strip(above + HIGH + room_below() + AFTER, paint)


def _valued(name: str, value: str, width: float) -> str:
    """Return `name = value`, the name cut so that the value is whole."""
    room = max(width / style.HINTED - lettering.text_width(f" = {value}"), 10.0)
    return f"{lettering.cut(one_line(name), room)} = {value}"


def _taken(each: Input) -> str:
    value = with_unit(each.value, each.unit)
    return value if each.at == each.value else f"{value}, taken as {with_unit(each.at, each.unit)}"


def _names(shown: Variable, degrees: Sequence[float]) -> list[Name]:
    """Return the names of terms over their axis, with the degrees that are not 0."""
    names = []
    for index, (term, degree) in enumerate(zip(shown.terms, degrees, strict=True)):
        at = (anchor(term, shown.low, shown.high) - shown.low) / (shown.high - shown.low)
        if isfinite(at):
            text = f"{one_line(term.name)} {number(degree)}" if degree > 0.0 else one_line(term.name)
            colour = style.stroke(index)[0] if degree > 0.0 else style.FAINT
            names.append(Name(text, min(max(at, 0.0), 1.0), colour))
    return names


def _draw_input(axes: Axes, each: Input, placed: Sequence[Placed]) -> None:
    axes.x, axes.y = (each.low, each.high), (0.0, TOP)
    draw_frame(axes, ticks(each.low, each.high, int(axes.width / 10.0)), DEGREES, ("", "degree [1]"))
    for index, (term, degree) in enumerate(zip(each.terms, each.degrees, strict=True)):
        _outline(axes, each, index, term, 1.1 if degree > 0.0 else 0.7)
        if degree > 0.0 and each.low <= each.at <= each.high:
            colour, _ = style.stroke(index)
            ends = [each.low, each.at]
            axes.add(Line(ends, [degree] * 2, colour, 0.6, DOTTED, z=3.5))
            axes.add(Dot(each.at, degree, "circle", colour, 4.2, z=5, label="degree"))
    draw_value(axes, each)
    draw_names(axes, placed, 1.0 / TOP)


def _outline(axes: Axes, shown: Variable, index: int, term: Term, width: float) -> None:
    colour, dashes = style.stroke(index)
    line = above_zero(line_over(term, shown.low, shown.high))
    axes.add(Line(*line, colour, width, dashes, z=3, free=True, label="term"))


def _brought(each: Brought) -> Strip:
    clamped = f", taken as {number(each.degree)}" if each.degree != each.value else ""
    return _bar_strip(each.variable, number(each.value) + clamped, each.degree)


def _bar_strip(name: str, value: str, degree: float) -> Strip:
    """Return a line with a degree as a bar."""

    def paint(_: Figure, page: Axes, top: float) -> None:
        write(page, (0.0, top), _valued(name, value, COLUMN - BAR - 4.0))
        draw_bar(page, (style.WIDTH - BAR - EDGE, top + 0.6), (BAR, TINY), degree)

    return Strip(LINE[style.NORMAL] + 1.0, paint)


def output_strips(view: View) -> list[Strip]:
    """Return the heading, every output with what was accumulated and what it gets, and the other results."""
    others = [strip for each in view.others for strip in _other(each)]
    outputs = [_output(each) for each in view.outputs]
    return [headline("Accumulation and defuzzification"), *others, *outputs]


def _other(each: Accumulated) -> list[Strip]:
    """Return the degrees of what is not defuzzified: given out, or of a local variable."""
    return [
        _bar_strip(
            f"{each.variable} IS {told.term}" if told.term else each.variable,
            number(told.degree),
            told.degree,
        )
        for told in each.degrees
    ]


def _output(each: Output) -> Strip:
    degrees = [told.degree for told in each.accumulated.degrees]
    placed = arranged(_names(each, degrees) if degrees else _plain_names(each), style.WIDTH - LEFT - RIGHT)
    head = lettering.cut(one_line(each.name), style.WIDTH / 2.0)
    head = lettering.wrapped(f"{head}: accumulated by {accumulation_words(each.accumulated)}", COLUMN)
    result, more = lettering.wrapped(_result(each), COLUMN), _remarks(each)
    above = text_height(head) + 0.4 + height_of(placed)
    below = above + HIGHER + room_below() + 0.8

    def paint(figure: Figure, page: Axes, top: float) -> None:
        write(page, (0.0, top), head)
        size = (style.WIDTH - LEFT - RIGHT, HIGHER)
        axes = figure.place(LEFT, top + above, *size, f"output {each.name}")
        _draw_output(axes, each, placed)
        write(page, (0.0, top + below), result)
        at = (0.0, top + below + text_height(result))
        write(page, at, more, size=style.SMALL, colour=style.FAINT)

    return Strip(below + text_height(result) + text_height(more, style.SMALL) + AFTER, paint)


def _remarks(each: Output) -> str:
    """Return the formulae of an output, and its RANGE."""
    what = "Calculated" if each.defuzzified.origin is Origin.RULES else "Not calculated, as no rule is active"
    remarks = [f"{what}: {'; '.join(each.calculated)}."] if each.calculated else []
    if each.ranged:
        remarks.append(f"RANGE {number(each.limits[0])} to {with_unit(each.limits[1], each.unit)}.")
    return lettering.wrapped(" ".join(remarks), COLUMN, style.SMALL)


def _plain_names(each: Output) -> list[Name]:
    names = _names(each, [0.0] * len(each.terms))
    return [Name(name.text, name.anchor, style.stroke(index)[0]) for index, name in enumerate(names)]


def _result(each: Output) -> str:
    """Return how the output gets its value."""
    formula = printed(defuzzification_formula(each.defuzzified, each.accumulated))
    return f"{lettering.cut(one_line(each.name), style.WIDTH / 2.0)} = {formula}"


def _draw_output(axes: Axes, each: Output, placed: Sequence[Placed]) -> None:
    area, degrees = each.accumulated.area, [told.degree for told in each.accumulated.degrees]
    highest = max([1.0, *(degree for _, degree in area), *degrees])
    axes.x, axes.y = (each.low, each.high), (0.0, highest * TOP)
    up = DEGREES if highest == 1.0 else ticks(0.0, highest, 4)
    draw_frame(axes, ticks(each.low, each.high, int(axes.width / 10.0)), up, ("", "degree [1]"))
    for index, term in enumerate(each.terms):
        colour, _ = style.stroke(index)
        if isinstance(term.shape, Singleton):
            place = float(term.shape.value)
            draw_stem(axes, each, place, 1.0, colour, faint=True)
            if degrees and degrees[index] > 0.0:
                draw_stem(axes, each, place, degrees[index], colour)
        else:
            _outline(axes, each, index, term, 0.6)
    if area:
        xs, heights = np.array(area).T
        draw_area(axes, xs, heights, style.BOUND)
    _draw_result(axes, each)
    draw_names(axes, placed, 1.0 / TOP)


def _draw_result(axes: Axes, each: Output) -> None:
    result = each.defuzzified
    draw_crisp(axes, each, result.value, "result", 1.6)
    if not isfinite(result.value):
        return
    origin = "" if result.origin is Origin.RULES else f" ({result.origin})"
    text = f"{with_unit(result.value, each.unit)}{origin}"
    at, align = _beside(axes, each, text)
    up = _above_stems(axes, each, text, (at, align))
    axes.add(Text(at, up, text, across=align, up="center", backed=0.2, z=6, parts=True))


def _above_stems(axes: Axes, each: Output, text: str, spot: tuple[float, Across]) -> float:
    """Return how high the result is written, in parts of the axes: above the stems that it would hide."""
    at, align = spot
    width = lettering.text_width(text) / axes.width
    left = at if align == "left" else at - width
    degrees = [told.degree for told in each.accumulated.degrees]
    hidden = [
        degree / axes.y[1]
        for term, degree in zip(each.terms, degrees, strict=False)
        if isinstance(term.shape, Singleton)
        and left <= (float(term.shape.value) - each.low) / (each.high - each.low) <= left + width
    ]
    return next((up for up in HEIGHTS if all(top < up - CLEAR for top in hidden)), HEIGHTS[0])


def _beside(axes: Axes, each: Output, text: str) -> tuple[float, Across]:
    """Return where the result is written, in parts of the axes: beside its line, on the emptier side."""
    width = axes.width
    span = each.high - each.low
    at = min(max((each.defuzzified.value - each.low) / span, 0.0), 1.0)
    needed = (lettering.text_width(text) + 2.4) / width
    places = [float(term.shape.value) for term in each.terms if isinstance(term.shape, Singleton)]
    stems = [(place - each.low) / span for place in places]
    right = sum(at < stem < at + needed for stem in stems) + 100 * (at + needed > 1.0)
    left = sum(at - needed < stem < at for stem in stems) + 100 * (at < needed)
    return (at + 1.2 / width, "left") if right <= left else (at - 1.2 / width, "right")

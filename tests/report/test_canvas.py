"""Marks → SVG: each in its place, in its order, cut at the edge unless it is free."""

import itertools
import re
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.report.canvas import Dot, Figure, Image, Line, Text, joined, rectangle, span
from fcl_sim.report.lettering import text_width
from fcl_sim.report.vector import extent, svg

SVG = "{http://www.w3.org/2000/svg}"


def axes():
    """Return a figure of 100 × 50 mm with axes from 10 mm to 90 mm, 5 mm to 45 mm."""
    figure = Figure(50.0, 100.0)
    made = figure.place(10.0, 5.0, 80.0, 40.0)
    made.x, made.y = (0.0, 8.0), (-1.0, 1.0)
    return figure, made


def elements(figure: Figure, kind: str) -> list[ET.Element]:
    return ET.fromstring(svg(figure)).findall(f".//{SVG}{kind}")  # noqa: S314  our own drawing


def paths(figure: Figure) -> list[str]:
    """Return the outlines, those of the paper and of what cuts left out."""
    inside = [each for each in elements(figure, "path") if each.get("fill") != "#ffffff"]
    cutting = {id(path) for clip in elements(figure, "clipPath") for path in clip}
    return [
        each.get("d", "") for each in inside if id(each) not in cutting and "stroke" in "".join(each.keys())
    ]


def test_values_are_whole_hundredths_of_a_millimetre_on_the_page():
    figure, made = axes()
    made.add(Line([0.0, 8.0, 4.0], [-1.0, 1.0, 0.0], "#000000"))
    assert paths(figure) == ["M1000 4500 9000 500 5000 2500"]


def test_parts_of_the_axes_are_counted_from_their_lower_left_corner():
    figure, made = axes()
    made.add(Line([0.0, 0.5], [0.0, 1.0], "#000000", parts=True))
    assert paths(figure) == ["M1000 4500 5000 500"]


def test_a_line_is_interrupted_where_there_is_no_number():
    figure, made = axes()
    made.add(Line([0.0, 1.0, 2.0, 3.0, 4.0], [0.0, 0.0, np.nan, 0.0, 0.0], "#000000"))
    assert paths(figure) == ["M1000 2500 2000 2500M4000 2500 5000 2500"]
    assert joined([np.zeros((2, 2)), np.ones((1, 2))])[0] == pytest.approx(
        [0.0, 0.0, np.nan, 1.0], nan_ok=True
    )


@given(st.lists(st.tuples(st.integers(0, 8), st.integers(-1, 1)), min_size=2, max_size=40))
def test_points_on_a_straight_way_are_left_out_and_nothing_is_missed(points):
    figure, made = axes()
    x, y = np.array(points, dtype=float).T
    made.add(Line(x, y, "#000000"))
    (path,) = paths(figure)
    kept = [(float(a) / 1000.0 - 1.0, 1.0 - (float(b) - 500.0) / 2000.0) for a, b in places(path)]
    assert (kept[0], kept[-1]) == (points[0], points[-1])
    assert way(kept) == way(points)


def places(path):
    """Return the points of one outline: those behind `l` are told as steps."""
    first, _, steps = path.partition("l")
    told = [np.array(re.findall(r"-?\d+", each), dtype=int).reshape(-1, 2) for each in (first, steps)]
    return [*told[0].tolist(), *(told[0][-1] + np.cumsum(told[1], axis=0)).tolist()]


def test_a_long_line_is_told_in_steps():
    figure, made = axes()
    made.add(Line(np.tile([0.0, 1.0], 10), np.linspace(-1.0, 1.0, 20), "#000000"))
    (path,) = paths(figure)
    assert path.startswith("M1000 4500l1000 -211 -1000 -")
    assert places(path)[-1] == [2000, 500]


def way(points):
    """Return the steps of a polyline, those in one direction added up."""
    steps: list[tuple[float, float]] = []
    for (x, y), (to_x, to_y) in itertools.pairwise(points):
        step = (to_x - x, to_y - y)
        if step == (0.0, 0.0):
            continue
        last = steps[-1] if steps else (0.0, 0.0)
        if last[0] * step[1] == last[1] * step[0] and last[0] * step[0] + last[1] * step[1] > 0.0:
            steps.pop()
            step = (last[0] + step[0], last[1] + step[1])
        steps.append(step)
    return steps


def test_points_that_fall_upon_each_other_are_one():
    figure, made = axes()
    made.add(Line(np.linspace(0.0, 1e-6, 500), np.zeros(500), "#000000"))
    made.add(Line([1.0, 1.0 + 1e-9, 2.0], [0.0, 0.0, 0.0], "#000000"))
    assert paths(figure) == ["M1000 2500 1000 2500", "M2000 2500 3000 2500"]


@pytest.mark.parametrize(
    ("y", "free", "is_cut"), [(0.5, False, False), (3.0, False, True), (3.0, True, False)]
)
def test_only_what_reaches_over_the_edge_is_cut_there_unless_it_is_free(y, free, is_cut):
    figure, made = axes()
    made.add(Line([0.0, 1.0], [0.0, y], "#000000", free=free))
    assert (len(elements(figure, "clipPath")) == 1) == is_cut


def test_what_is_far_beyond_the_page_has_a_place_all_the_same():
    figure, made = axes()
    made.add(Line([0.0, 1.0], [0.0, 1e300], "#000000"))
    made.add(Dot(1.0, -1e300, "circle", "#000000", 3.0))
    numbers = re.findall(r"-?\d+", " ".join(paths(figure)))
    assert all(abs(int(each)) <= 2_000_000 for each in numbers)


def test_what_has_a_larger_z_is_drawn_later_and_equals_in_their_order():
    figure, made = axes()
    for colour, z in (("#000003", 3.0), ("#000001", 1.0), ("#000002", 1.0)):
        made.add(rectangle((0.0, 1.0), (0.0, 1.0), colour, z=z))
    fills = [each.get("fill") for each in elements(figure, "path")]
    assert fills == ["#ffffff", "#000001", "#000002", "#000003"]


def test_a_span_takes_parts_of_the_height():
    _, made = axes()
    assert (min(span(made, (1.0, 2.0), "", (0.5, 1.0)).y), made.part(1.0)) == (0.0, 1.0)


def test_an_image_stands_between_its_ends():
    figure, made = axes()
    made.add(Image((0.0, 8.0), (0.0, 1.0), b"png"))
    (image,) = elements(figure, "image")
    assert [image.get(each) for each in ("x", "y", "width", "height")] == ["1000", "500", "8000", "2000"]


@pytest.mark.parametrize("up", ["top", "center", "middle", "bottom", "baseline"])
def test_lines_of_a_text_stand_below_one_another_around_their_place(up):
    text = Text(0.0, 0.0, "one\ntwo", up=up)
    left, upper, right, lower = extent(text)
    assert (left, right) == (0.0, max(text_width("one"), text_width("two")))
    assert upper < lower
    bounds = {"top": upper, "bottom": lower, "center": upper + lower}
    assert bounds.get(up, 0.0) == pytest.approx(0.0)


def test_a_text_is_as_wide_as_its_letters_and_grows_with_its_size():
    assert text_width("ab") == pytest.approx(text_width("a") + text_width("b"))
    assert text_width("ab", 14.4) == pytest.approx(2.0 * text_width("ab", 7.2))
    assert text_width("ab", bold=True) > text_width("ab")
    assert text_width("漢") > 0.0

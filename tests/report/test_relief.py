"""A surface in space: every tile is there, nearer ones over farther ones, in the colours of a map."""

import numpy as np
import pytest

from fcl_sim.report.canvas import Figure, Line, Shape, Text
from fcl_sim.report.relief import Relief, draw_relief
from fcl_sim.report.style import HEAT
from tests.report.legible import SLACK, box, clashes, cut


def drawn(values, names=("e", "de", "u"), spans=((0.0, 4.0), (0.0, 3.0), (-100.0, 100.0))):
    figure = Figure(44.0, 52.0)
    axes = figure.place(0.0, 0.0, 52.0, 44.0)
    y, x = (np.linspace(*span, count) for span, count in zip(spans[1::-1], values.shape, strict=True))
    draw_relief(axes, Relief(x=x, y=y, values=values, names=names), spans[2])
    return figure, axes


PLANE = np.add.outer(np.linspace(-50.0, 50.0, 4), np.linspace(-50.0, 50.0, 5))


def test_there_is_a_tile_for_each_cell_but_where_a_corner_has_no_number():
    assert len(drawn(PLANE)[1].of(Shape)) == 12
    holed = PLANE.copy()
    holed[0, 0] = np.nan
    assert len(drawn(holed)[1].of(Shape)) == 11


def test_tiles_are_drawn_from_the_back_corner_to_the_front():
    tiles = drawn(np.zeros((4, 5)))[1].of(Shape)
    heights = [float(np.mean(each.y)) for each in tiles]
    assert heights[0] == max(heights)
    assert heights[-1] == min(heights)
    assert [each.z for each in tiles] == [tiles[0].z] * len(tiles)


def test_the_lowest_tile_has_the_lowest_colour_and_the_highest_the_highest():
    tiles = drawn(np.repeat([[-100.0], [-100.0], [100.0], [100.0]], 5, axis=1))[1].of(Shape)
    colours = {each.face for each in tiles}
    assert {HEAT[0], HEAT[-1]} < colours


def test_every_axis_has_its_name_and_numbers_and_they_can_be_read():
    figure, axes = drawn(PLANE, ("e [K]", "de [K/s]", "u [%]"))
    told = [each.text for each in axes.of(Text)]
    assert told[:5] == ["0", "1", "2", "3", "4"]
    assert told[5:7] == ["0", "2"]
    assert told[7:-3] == ["\N{MINUS SIGN}100", "\N{MINUS SIGN}50", "0", "50", "100"]
    assert told[-3:] == ["e [K]", "de [K/s]", "u [%]"]
    assert cut(figure) == []
    assert clashes(figure) == []


SPANS = [(0.0, 1.0), (-3.0, 8.9), (1e-6, 2e-6), (-123456.0, 654321.0), (12345.6, 12345.7), (3900.0, 4100.0)]
LONG = "a_name_that_takes_more_than_its_place_in_the_drawing of a surface [kg/(m s2)]"


@pytest.mark.parametrize("name", ["u [%]", "outlet_temperature [degC]", LONG, "W" * 60])
@pytest.mark.parametrize("spans", [(a, b, c) for a in SPANS for b in SPANS[:4:2] for c in SPANS[2:4]])
@pytest.mark.parametrize("turned", [False, True])
def test_no_number_and_no_name_meets_another_or_the_surface(name, spans, turned):
    low, high = spans[2]
    values = low + (high - low) * np.ones((4, 5))
    values[0, 0] = low
    figure, axes = drawn(values[::-1, ::-1] if turned else values, (name, name, name), spans)
    assert cut(figure) == []
    assert clashes(figure) == []
    for text in axes.of(Text):
        for mark in (*axes.of(Line), *axes.of(Shape)):
            assert not runs_through(axes, mark, box(axes, text)), text.text
    told = [each.text for each in axes.of(Text)][-3:]
    assert all(each.replace("\n", "").endswith(name[-3:]) for each in told)


def runs_through(axes, mark, place):
    """Return whether an edge of a mark runs through a box."""
    left, upper, right, lower = place
    x = axes.left + np.array(mark.x, float)
    y = axes.top + axes.height - np.array(mark.y, float)
    if isinstance(mark, Shape):
        x, y = np.append(x, x[0]), np.append(y, y[0])
    steps = np.linspace(0.0, 1.0, 60)[:, None]
    across, down = (each[:-1] + steps * np.diff(each) for each in (x, y))
    inside = (
        (left + SLACK < across) & (across < right - SLACK) & (upper + SLACK < down) & (down < lower - SLACK)
    )
    return bool(inside.any())


def covered(axes):
    """Return how much of the drawing the tiles cover, each for itself."""
    found = 0.0
    for tile in axes.of(Shape):
        x, y = np.array(tile.x), np.array(tile.y)
        found += abs(np.dot(x, np.roll(y, 1)) - np.dot(y, np.roll(x, 1))) / 2.0
    return found


def test_a_surface_that_falls_away_from_the_viewer_is_turned_so_that_it_is_seen():
    rising, falling = drawn(PLANE)[1], drawn(-PLANE)[1]
    assert (numbers(rising), numbers(falling)) == (list("01234"), list("43210"))
    assert covered(falling) == pytest.approx(covered(rising))
    assert sorted(each.face for each in falling.of(Shape)) == sorted(each.face for each in rising.of(Shape))


def test_a_level_surface_is_not_turned():
    assert numbers(drawn(np.zeros((4, 5)))[1]) == list("01234")


def numbers(axes):
    """Return the numbers along the first axis, from the front corner on."""
    return [each.text for each in sorted(axes.of(Text)[:5], key=lambda each: each.x)]

"""A surface in space: every tile is there, nearer ones over farther ones, in the colours of a map."""

import numpy as np
import pytest

from fcl_sim.report.canvas import Figure, Shape, Text
from fcl_sim.report.relief import Relief, draw_relief
from fcl_sim.report.style import HEAT
from tests.report.legible import clashes, cut


def drawn(values):
    figure = Figure(44.0, 52.0)
    axes = figure.place(0.0, 0.0, 52.0, 44.0)
    y, x = (np.arange(count, dtype=float) for count in values.shape)
    draw_relief(axes, Relief(x=x, y=y, values=values, names=("e", "de", "u")), (-100.0, 100.0))
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


def test_the_ends_of_the_output_and_the_names_are_written_and_can_be_read():
    figure, axes = drawn(PLANE)
    assert {each.text for each in axes.of(Text)} == {"\N{MINUS SIGN}100", "100", "u", "e →", "← de"}
    assert cut(figure) == []
    assert clashes(figure) == []


def covered(axes):
    """Return how much of the drawing the tiles cover, each for itself."""
    found = 0.0
    for tile in axes.of(Shape):
        x, y = np.array(tile.x), np.array(tile.y)
        found += abs(np.dot(x, np.roll(y, 1)) - np.dot(y, np.roll(x, 1))) / 2.0
    return found


def test_a_surface_that_falls_away_from_the_viewer_is_turned_so_that_it_is_seen():
    rising, falling = drawn(PLANE)[1], drawn(-PLANE)[1]
    assert {each.text for each in falling.of(Text)} >= {"← e", "de →"}
    assert covered(falling) == pytest.approx(covered(rising))
    assert sorted(each.face for each in falling.of(Shape)) == sorted(each.face for each in rising.of(Shape))


def test_a_level_surface_is_not_turned():
    assert {each.text for each in drawn(np.zeros((4, 5)))[1].of(Text)} >= {"e →"}

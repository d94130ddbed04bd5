"""The times on a way: none meets another, none stands on a dot, all are within the map."""

import numpy as np
import pytest

from fcl_sim.report.canvas import Dot, Figure, Text
from fcl_sim.report.sampling import Track
from fcl_sim.report.style import LEAST
from fcl_sim.report.track_times import RIM, draw_times
from tests.report.legible import box, clashes


def drawn(x, y):
    figure = Figure(60.0, 60.0)
    axes = figure.place(5.0, 5.0, 50.0, 50.0)
    axes.x, axes.y = (-1.0, 1.0), (-2.0, 2.0)
    time = np.linspace(0.0, 18_000.0, len(x))
    draw_times(axes, Track(x=x, y=2.0 * y, active=np.ones(len(x), bool), time=time))
    return figure, axes


TURNS = np.linspace(0.0, 1.0, 400)
WAYS = {
    "spiral": (TURNS * np.cos(20.0 * TURNS), TURNS * np.sin(20.0 * TURNS)),
    "circle": (0.7 * np.cos(6.2 * TURNS), 0.7 * np.sin(6.2 * TURNS)),
    "falling": (0.9 - 1.8 * TURNS, 0.9 - 1.8 * TURNS),
    "rising": (0.9 - 1.8 * TURNS, 1.8 * TURNS - 0.9),
    "along an edge": (0.9 - 1.8 * TURNS, np.full(400, 0.99)),
    "there and back": (0.9 * np.cos(12.0 * TURNS), 0.05 * TURNS),
    "still": (np.zeros(400), np.zeros(400)),
}


@pytest.mark.parametrize("way", WAYS)
def test_a_time_meets_nothing_and_is_within_the_map(way):
    figure, axes = drawn(*WAYS[way])
    assert clashes(figure) == []
    for text in axes.of(Text):
        left, upper, right, lower = box(axes, text)
        assert min(left, upper) >= 5.0 + RIM - 1e-9
        assert max(right, lower) <= 55.0 - RIM + 1e-9
        assert text.size >= LEAST
        for dot in axes.of(Dot):
            x, y = 5.0 + 25.0 * (dot.x + 1.0), 55.0 - 12.5 * (dot.y + 2.0)
            assert not (left < x < right and upper < y < lower)
    assert len(axes.of(Text)) == len(axes.of(Dot))


@pytest.mark.parametrize(("way", "count"), [("spiral", 6), ("circle", 7), ("falling", 8), ("still", 0)])
def test_most_times_find_a_place(way, count):
    assert len(drawn(*WAYS[way])[1].of(Text)) >= count


@pytest.mark.parametrize("way", ["falling", "rising"])
def test_a_time_stands_beside_the_way_and_not_on_it(way):
    axes = drawn(*WAYS[way])[1]
    x, y = (5.0 + 25.0 * (WAYS[way][0] + 1.0)), 55.0 - 25.0 * (WAYS[way][1] + 1.0)
    for left, upper, right, lower in (box(axes, each) for each in axes.of(Text)):
        assert not ((x > left) & (x < right) & (y > upper) & (y < lower)).any()

"""Where a way goes out of a map the page has an arrow head, where the paper has one."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.report.exits import exits
from tests.report.html.scripts import Script

SCRIPT = Script("numbers.js", "elements.js", "data.js", "maps.js")
LIMITS = (-10.0, 30.0, -5.0, 5.0)
SIDES = {(1.0, 0.0): "right", (-1.0, 0.0): "left", (0.0, 1.0): "up", (0.0, -1.0): "down"}


def on_page(points):
    """Return place and side of the heads on the page, the places in the units of the map."""
    left, right, low, high = LIMITS
    return [
        (left + each["place"][0] * (right - left), high - each["place"][1] * (high - low), each["side"])
        for each in SCRIPT.call("exitsOf", points, LIMITS)
    ]


def on_paper(points):
    x, y = np.array(points).T
    return [(each.x, each.y, SIDES[each.out]) for each in exits(x, y, LIMITS[:2], LIMITS[2:])]


@given(st.lists(st.tuples(st.floats(-50.0, 70.0), st.floats(-20.0, 20.0)), min_size=2, max_size=12))
def test_a_way_goes_out_where_it_does_on_paper(points):
    found, expected = on_page(points), on_paper(points)
    assert bool(found) == bool(expected)
    for x, y, side in found:
        near = [(u, v) for u, v, other in expected if other == side]
        assert any((x, y) == pytest.approx(each, abs=1e-6) for each in near)


def test_heads_keep_apart_and_holes_are_no_way_out():
    assert len(on_page([(29.0, 0.0), (31.0, 0.0)] * 5)) == 1
    assert len(on_page([(29.0, 0.0), (31.0, 0.0), (0.0, 4.0), (0.0, 6.0)])) == 2
    assert SCRIPT.call("() => exitsOf([[29, 0], [NaN, NaN], [31, 0]], [-10, 30, -5, 5])") == []

"""Sketches: to scale, at the places that the signals say, and none where a plant is another one."""

from math import cos, radians, sin

import numpy as np
import pytest

from fcl_sim.report.plant_sketches import sketches_of
from fcl_sim.report.sketch import Group, Motion, Piece
from tests.report.html.pages import driven
from tests.report.synthetic import run

LENGTH = 8.0


def moved(part, at):
    """Yield the pieces of a part with the places of their points, when signals are `at` their values."""
    if isinstance(part, Piece):
        yield part, np.array(part.points)
        return

    def value(motion: Motion | None, default):
        return default if motion is None else at[motion.signal] * motion.factor

    angle = radians(value(part.turn, 0.0))
    turn = np.array([[cos(angle), sin(angle)], [-sin(angle), cos(angle)]])
    for inner in part.parts:
        for piece, points in moved(inner, at):
            yield piece, value(part.grow, 1.0) * points @ turn + [value(part.across, 0.0), 0.0]


@pytest.fixture
def crane(tmp_path):
    (sketch,) = sketches_of([driven(run(tmp_path))])
    return sketch


def test_the_container_hangs_on_its_rope_ahead_of_the_trolley_where_the_angle_is_positive(crane):
    at = {"crane.position": -12.0, "crane.angle": 30.0}
    places = {piece.role: points.mean(axis=0) for piece, points in moved(crane.group, at)}
    assert places["load"] == pytest.approx([-12.0 + LENGTH * 0.5, -LENGTH * cos(radians(30.0))])
    assert places["body"][0] < places["load"][0]


def test_a_container_is_as_large_as_the_standard_says(crane):
    (box,) = (
        points
        for piece, points in moved(crane.group, {"crane.position": 0.0, "crane.angle": 0.0})
        if piece.role == "load"
    )
    assert np.ptp(box, axis=0) == pytest.approx([2.44, 2.59])


def test_all_of_the_way_is_shown_and_all_runs_show_the_same(tmp_path):
    near, far = driven(run(tmp_path)), driven(run(tmp_path))
    far.trace.values[:, 0] -= 15.0
    sketches = sketches_of([near, far, run(tmp_path)])
    assert sketches[2] is None
    assert sketches[0].low == sketches[1].low
    assert sketches[0].high == sketches[1].high
    assert sketches[0].low[0] < -40.0
    assert sketches[0].high[0] > 0.0


def test_a_plant_of_the_same_name_without_what_is_drawn_has_no_sketch(tmp_path):
    assert sketches_of([run(tmp_path)]) == [None]


def test_groups_are_grown_turned_and_then_moved():
    group = Group(
        parts=(Piece(((1.0, 0.0),), "mark"),), across=Motion("x"), turn=Motion("a"), grow=Motion("g", 2.0)
    )
    ((_, points),) = moved(group, {"x": 5.0, "a": 90.0, "g": 3.0})
    assert points[0] == pytest.approx([5.0, 6.0])

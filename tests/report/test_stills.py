"""Stills: pieces stand where the signals put them, to scale, until everything rests."""

from dataclasses import replace

import numpy as np
import pytest

from fcl_sim.report.canvas import Shape
from fcl_sim.report.sketch import Group, Motion, Piece, Sketch
from fcl_sim.report.stills import draw, placed, stills_of
from tests.report.synthetic import run, trace

BOX = Piece(((-1.0, -10.0), (1.0, -10.0), (1.0, -9.0), (-1.0, -9.0)), "load")


@pytest.fixture
def moving():
    found = trace(names=("p.across", "p.turn", "p.size", "p.rest"))
    values = np.zeros_like(found.values)
    values[:, 0], values[:, 1], values[:, 2] = np.linspace(-20.0, 0.0, len(values)), 90.0, 2.0
    return replace(found, values=values)


def corners(group, moving, sample):
    ((_, points),) = placed(group, moving, sample)
    return np.array(points)


def test_a_group_is_grown_turned_and_moved_in_this_order(moving):
    group = Group(parts=(BOX,), across=Motion("p.across"), turn=Motion("p.turn"), grow=Motion("p.size"))
    first = corners(group, moving, 0)
    assert first[0] == pytest.approx([20.0 - 20.0, -2.0])
    assert first[2] == pytest.approx([18.0 - 20.0, 2.0])


def test_what_hangs_moves_with_what_it_hangs_from(moving):
    hanging = Group(parts=(BOX,), turn=Motion("p.turn", 0.0))
    group = Group(parts=(hanging,), across=Motion("p.across"))
    assert corners(group, moving, 0)[:, 0] == pytest.approx([-21.0, -19.0, -19.0, -21.0])
    assert corners(group, moving, len(moving.ticks) - 1)[:, 0] == pytest.approx([-1.0, 1.0, 1.0, -1.0])


def test_all_stills_have_one_scale_and_lengths_are_true(moving):
    group = Group(parts=(BOX,), across=Motion("p.across"))
    sketch = Sketch(group=group, low=(-25.0, -12.0), high=(5.0, 0.0), about="A box.")
    stills = draw(sketch, moving, [0, 60, 120]).axes
    assert len(stills) == 3
    for axes in stills:
        across = axes.width / (axes.x[1] - axes.x[0])
        assert across == pytest.approx(axes.height / (axes.y[1] - axes.y[0]))
        (box,) = axes.of(Shape)
        assert np.ptp(box.x) == pytest.approx(2.0)


def test_a_plant_without_a_sketch_has_none(tmp_path):
    assert stills_of(run(tmp_path)) == []

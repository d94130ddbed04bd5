"""What a figure shows as violated: every stretch outside of bounds, and of formulae the signals to blame."""

from dataclasses import replace

import numpy as np
import pytest

from fcl_sim.judge.verdict import Corridor, Status
from fcl_sim.report.violations import all_violations, violations
from tests.report.synthetic import of_formula, requirement, trace, verdict

NAMES = ("crane.distance",)


def run(distance):
    """Return a trace with the distance as given, a number a second, and nothing else of note."""
    made = trace()
    values = np.zeros((len(distance), made.values.shape[1]))
    values[:, 0] = distance
    ticks = np.arange(len(distance), dtype=np.int64) * 1_000_000_000
    return replace(made, ticks=ticks, values=values, fuzzy={})


def missed(**band):
    found = verdict(Status.FAIL, None)
    return replace(found, band=replace(found.band, **band), violation=(1.0, 2.0))


def test_every_stretch_outside_of_the_bounds_is_violated_not_only_the_first():
    values = [0, 2, 2, 0, 0, -2, 0, 2]
    assert violations(run(values), missed(start=0.0, end=7.0), NAMES) == [(1, 2), (5, 5), (7, 7)]


def test_outside_of_the_time_that_is_judged_nothing_is():
    values = [9, 2, 2, 0, 0, -2, 9, 9]
    assert violations(run(values), missed(start=1.0, end=5.0), NAMES) == [(1, 2), (5, 5)]


def test_a_bound_on_one_side_leaves_the_other_open():
    values = [0, 2, 2, 0, -9]
    assert violations(run(values), missed(start=0.0, end=4.0, low=None), NAMES) == [(1, 2)]


def test_what_was_found_first_is_told_also_where_the_band_is_that_of_another_piece():
    values = [0, 2, 2, 0, 0, 2]
    assert violations(run(values), missed(start=4.0, end=5.0), NAMES) == [(1, 2), (5, 5)]


def test_every_stretch_outside_of_a_corridor_is_violated():
    corridor = Corridor(
        name="limits",
        signal="crane.distance",
        ticks=(0, 6_000_000_000),
        low=(-1.0, -1.0),
        high=(float("nan"), float("nan")),
    )
    asked = replace(requirement(), metric="", signal="", corridor=corridor)
    found = replace(verdict(Status.FAIL, None), requirement=asked, band=None, violation=(1.0, 1.0))
    assert violations(run([0, -2, 9, -2, -2, 0, 0]), found, NAMES) == [(1, 1), (3, 4)]


@pytest.mark.parametrize(("names", "expected"), [(NAMES, [(20.0, 25.0)]), (("crane.sway",), [])])
def test_a_formula_is_violated_in_the_signals_that_are_to_blame(names, expected):
    text = "always (abs(crane.distance) < 1 m and crane.sway < 30 deg)"
    found = replace(of_formula(text, Status.FAIL), blamed=NAMES)
    assert violations(trace(), found, names) == expected


def test_stretches_of_several_requirements_are_told_as_one_where_they_overlap():
    first = missed(start=0.0, end=7.0)
    wider = replace(first, band=None, violation=(2.0, 4.0))
    values = [0, 2, 2, 0, 0, -2, 0, 2]
    assert all_violations(run(values), (first, wider, first), NAMES) == [(1, 4), (5, 5), (7, 7)]


def test_what_is_met_is_violated_nowhere():
    assert violations(trace(), verdict(), NAMES) == []

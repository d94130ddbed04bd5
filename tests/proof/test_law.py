"""The control law against closed forms, and against what is evaluated anywhere."""

from functools import cache

import numpy as np
import pytest

from fcl_sim.block import load
from fcl_sim.proof.law import Course, law_of
from fcl_sim.proof.universe import universe_of
from tests.house.places import ROOT

SHIPPED = [
    "crane/crane_completed.fcl",
    "exchanger/precontrol.fcl",
    "pi/linear4_min.fcl",
    "vessel/figure7.fcl",
]


def block_of(name):
    return load(ROOT / "scenarios" / name)


@cache
def laws_of(name, *stretches):
    block = block_of(name)
    return law_of(block, universe_of(block.function_block, stretches))


def test_a_linear_rule_base_has_its_gains_as_slopes_and_rises_alone():
    (law,) = laws_of("pi/linear9.fcl")
    assert (law.least.reached, law.most.reached) == (-0.5, 0.5)
    by_name = {each.variable: each for each in law.gains}
    for name, gain in (("e", 0.125), ("de", 1.25)):
        assert by_name[name].steepest.reached == pytest.approx(gain, rel=1e-6)
        assert gain <= by_name[name].steepest.bound <= 1.15 * gain
        assert by_name[name].course is Course.RISES
    assert (law.at_zero, law.symmetry) == (0.0, "odd")


def test_a_schedule_is_as_steep_as_the_line_between_two_peaks():
    gain = {each.output: each.gains[0] for each in laws_of("cone/schedule.fcl")}
    assert gain["Kp"].steepest.reached == pytest.approx((34 - 18) / (0.7 - 0.5), rel=1e-6)
    assert gain["Ti"].steepest.reached == pytest.approx((18 - 5) / (0.2 - 0.1), rel=1e-6)
    assert [each.course for each in gain.values()] == [Course.RISES] * 3


def test_ends_within_a_universe_are_those_of_the_law_there():
    (law,) = laws_of("pi/linear9.fcl", "e=-1..0.5", "de=0..0.1")
    assert law.least.reached == pytest.approx(-0.125, abs=1e-6)
    assert law.most.reached == pytest.approx(0.0625 + 0.125, abs=1e-6)


@pytest.mark.parametrize("name", SHIPPED)
def test_nothing_that_is_evaluated_lies_beyond_the_bounds(name):
    block = block_of(name)
    random = np.random.default_rng(5)
    for law in laws_of(name):
        low, high = law.least.bound, law.most.bound
        ends = {each.name: (-60.0, 110.0) for each in block.function_block.inputs}
        points = {key: random.uniform(*span, 50_000) for key, span in ends.items()}
        values = block.evaluate(points)[law.output]
        slack = 2e-6 * (high - low)
        assert low - slack <= values.min()
        assert values.max() <= high + slack
        for gain in law.gains:
            moved = points | {gain.variable: points[gain.variable] + 1e-3}
            slopes = (block.evaluate(moved)[law.output] - values) / 1e-3
            assert np.abs(slopes).max() <= gain.steepest.bound + 1e-6


@pytest.mark.parametrize("name", SHIPPED)
def test_witnesses_show_what_was_reached(name):
    block = block_of(name)
    for law in laws_of(name):
        for end in (law.least, law.most):
            assert float(block.evaluate(end.at)[law.output]) == pytest.approx(end.reached)
        for gain in law.gains:
            if gain.course is Course.BOTH:
                up, down = (slope(block, law.output, gain.variable, at) for at in gain.shown)
                assert up > 0.0 > down


def slope(block, output, variable, at):
    step = 1e-5
    low, high = at | {variable: at[variable] - step}, at | {variable: at[variable] + step}
    return float(block.evaluate(high)[output]) - float(block.evaluate(low)[output])


def test_where_an_output_is_undefined_its_slope_has_no_bound():
    (law,) = laws_of("crane/crane_printed.fcl")
    assert all(np.isinf(each.steepest.bound) for each in law.gains)
    assert (law.least.reached, law.most.reached) == (-9.0, 27.0)

"""Jumps, ends where an output stays, symmetry: an evaluation shows what is told of them."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from fcl_sim.block import load, loads
from fcl_sim.proof.exact import exactly
from fcl_sim.proof.law import law_of
from fcl_sim.proof.saturation import saturations
from fcl_sim.proof.space import axes_of
from fcl_sim.proof.symmetry import symmetry_of
from fcl_sim.proof.universe import universe_of
from tests.house.places import ROOT
from tests.proof.bases import block_of, inside, random_points, random_text

NEAR = Fraction(1, 10**12)

ONE_INPUT = """
FUNCTION_BLOCK one
VAR_INPUT a: REAL; END_VAR
VAR_OUTPUT y: REAL; END_VAR
FUZZIFY a
    TERM low  := (-4, 1) (0, 0);
    TERM high := (0, 0) (4, 1);
    TERM step := (-2, 0) (-2, 1) (0, 0);
END_FUZZIFY
DEFUZZIFY y
    TERM down := -3;
    TERM up   := 3;
    TERM much := 7;
    METHOD: {method};
    DEFAULT := {default};
END_DEFUZZIFY
RULEBLOCK r
    ACCU: MAX;
    RULE 1: IF a IS low THEN y IS down;
    RULE 2: IF a IS {second} THEN y IS {then};
END_RULEBLOCK
END_FUNCTION_BLOCK
"""
PLAIN = {"method": "CoGS", "default": "0", "second": "high", "then": "up"}


def law(**choices):
    block = loads(ONE_INPUT.format(**(PLAIN | choices)))
    (found,) = law_of(block, universe_of(block.function_block))
    return found


def jump(**choices):
    (found,) = law(**choices).jumps
    return found


def test_at_a_point_without_a_rule_it_jumps_to_default_and_away():
    found = jump(default="5")
    assert (found.at, found.before, found.behind, found.without) == ({"a": 0.0}, -3.0, 5.0, "behind")
    assert (found.height, found.is_exact) == (8.0, True)


def test_an_output_that_is_kept_does_not_jump_to_what_it_was_before():
    assert law(default="NC").jumps == ()


def test_the_leftmost_maximum_switches_where_two_degrees_are_the_same():
    found = jump(method="LM", second="NOT low", then="much")
    assert (found.at, found.before, found.behind) == ({"a": -2.0}, -3.0, 7.0)
    assert (found.without, found.is_exact) == ("", True)


def test_at_an_edge_of_a_term_it_jumps_by_what_the_term_pulls():
    found = jump(second="step", then="much")
    assert (found.at, found.before) == ({"a": -2.0}, -3.0)
    assert found.behind == pytest.approx((0.5 * -3 + 7) / 1.5)


def value(block, output, at):
    return next(each.value for each in exactly(block, at).outputs if each.variable == output)


@pytest.mark.parametrize("name", ["crane/crane_printed.fcl", "oven/oven_printed.fcl"])
def test_an_evaluation_beside_a_jump_shows_its_height(name):
    block = load(ROOT / "scenarios" / name)
    for law in law_of(block, universe_of(block.function_block)):
        assert law.jumps
        for each in law.jumps:
            at = {key: Fraction(str(value)) for key, value in each.at.items()}
            xs = [at[each.variable] + step for step in (-NEAR, 0, NEAR)]
            values = [value(block.function_block, law.output, {**at, each.variable: x}) for x in xs]
            steps = [float(abs(after - before)) for before, after in pairwise(values)]
            assert max(steps) == pytest.approx(each.height, abs=1e-6)


@pytest.mark.parametrize("seed", range(10))
def test_where_an_output_stays_at_an_end_it_has_that_value(seed):
    text = random_text(seed)
    block = block_of(text)
    found = saturations(block, axes_of(block, universe_of(block)), "y")
    points = random_points([each.name for each in block.inputs], seed, 500, low=-4, high=16)
    values = loads(text).evaluate(
        {name: np.array([float(each[name]) for each in points]) for name in points[0]}
    )["y"]
    for each in found:
        assert not each.more
        there = np.array([any(inside(box, point) for box in each.boxes) for point in points])
        assert (values[there] == each.value).all()
        assert not (values[~there] == each.value).any() or each.value == 7.0


@pytest.mark.parametrize(
    ("name", "output", "told"),
    [
        ("crane/crane_precise.fcl", "power", "odd"),
        ("pi/linear9.fcl", "y", "odd"),
        ("crane/crane_completed.fcl", "power", ""),
        ("vessel/figure7.fcl", "valve", ""),
    ],
)
def test_what_is_proved_odd_is_so_anywhere(name, output, told):
    block = load(ROOT / "scenarios" / name)
    assert symmetry_of(block.function_block, output) == told
    random = np.random.default_rng(4)
    points = {each: random.uniform(-20, 20, 20_000) for each in block.inputs}
    here = block.evaluate(points)[output]
    there = block.evaluate({each: -values for each, values in points.items()})[output]
    assert (np.abs(here + there).max() < 1e-9) == (told == "odd")


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("TERM s4 := 0.5;", "TERM s4 := 0.51;"),
        ("DEFAULT := 0;", "DEFAULT := 0.1;"),
        ("THEN y IS s4", "THEN y IS s3"),
    ],
)
def test_one_slip_breaks_the_symmetry(old, new):
    text = (ROOT / "scenarios/pi/linear9.fcl").read_text("utf-8")
    assert old in text
    assert symmetry_of(block_of(text.replace(old, new, 1)), "y") == ""

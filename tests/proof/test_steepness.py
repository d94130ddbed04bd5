"""Slopes of smooth terms keep within their bounds, and reach them."""

import numpy as np
import pytest

from fcl_sim.block import loads
from fcl_sim.engine.smooth import degrees_at
from fcl_sim.model import Curve, CurveKind
from fcl_sim.proof.law import law_of
from fcl_sim.proof.steepness import KINDS, slopes_of
from fcl_sim.proof.universe import universe_of

CURVES = [
    Curve(CurveKind.GAUSSIAN, (1.0, 2.0)),
    Curve(CurveKind.SIGMOID, (-1.5, 0.5), 0.8),
    Curve(CurveKind.BELL, (2.0, 3.0, -1.0)),
    Curve(CurveKind.BELL, (2.0, 0.75, 0.0)),
    Curve(CurveKind.COSINE, (3.0, 1.0)),
    Curve(CurveKind.Z_SHAPE, (-2.0, 3.0)),
    Curve(CurveKind.S_SHAPE, (-2.0, 3.0), 0.5),
    Curve(CurveKind.PI_SHAPE, (-4.0, -2.0, 0.0, 3.0)),
]


def test_every_kind_that_is_followed_is_tried():
    assert {each.kind for each in CURVES} == set(KINDS)


@pytest.mark.parametrize("curve", CURVES, ids=lambda each: f"{each.kind} {each.parameters}")
def test_no_difference_is_steeper_than_the_bounds_and_some_is_nearly_so(curve):
    random = np.random.default_rng(1)
    low = random.uniform(-6, 6, 400)
    high = low + random.choice([1e-3, 0.1, 2.0], 400)
    falls, rises = slopes_of(curve, low, high)
    xs = np.linspace(low, high, 400)
    rises_seen = np.diff([degrees_at(curve, row) for row in xs], axis=0) / np.diff(xs, axis=0)
    assert (rises_seen.min(axis=0) >= falls - 1e-6).all()
    assert (rises_seen.max(axis=0) <= rises + 1e-6).all()
    assert np.abs(rises_seen.max(axis=0) - rises).max() < 0.02
    assert np.abs(rises_seen.min(axis=0) - falls).max() < 0.02


@pytest.mark.parametrize("parameters", [(2.0, 0.5, 0.0), (2.0, 0.25, 0.0)])
def test_a_bell_with_a_cusp_has_no_bound(parameters):
    falls, rises = slopes_of(Curve(CurveKind.BELL, parameters), np.array([-1.0]), np.array([1.0]))
    assert (falls, rises) == (-np.inf, np.inf)


SMOOTH = """
FUNCTION_BLOCK smooth
VAR_INPUT a: REAL; END_VAR
VAR_OUTPUT y: REAL; END_VAR
FUZZIFY a TERM low := SIGM -2 0; TERM high := SIGM 2 0; END_FUZZIFY
DEFUZZIFY y TERM down := -1; TERM up := 1; METHOD: CoGS; DEFAULT := 0; END_DEFUZZIFY
RULEBLOCK r
    RULE 1: IF a IS low THEN y IS down;
    RULE 2: IF a IS high THEN y IS up;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""


def test_a_smooth_law_has_a_bounded_gain_and_a_proved_course():
    block = loads(SMOOTH)
    (law,) = law_of(block, universe_of(block.function_block, ["a=-3..3"]))
    (gain,) = law.gains
    assert str(gain.course) == "never falls"
    assert gain.steepest.reached == pytest.approx(1.0, rel=1e-3)  # tanh(a)
    assert 1.0 <= gain.steepest.bound < 1.02
    assert law.jumps == ()

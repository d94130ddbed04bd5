"""Smooth shapes: exact as terms of inputs, polylines within 1e-6 as terms of outputs (S33)."""

from dataclasses import replace
from itertools import pairwise
from math import erf, exp, pi, sqrt

import numpy as np
import pytest

from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.entries import evaluate_once
from fcl_sim.engine.evaluate import evaluate
from fcl_sim.engine.show import program_text
from fcl_sim.engine.smooth import TOLERANCE, degrees_at, polyline
from fcl_sim.model import (
    Activation,
    And,
    Curve,
    CurveKind,
    Is,
    Method,
    Not,
    Point,
    RuleBlock,
    Singletons,
    Term,
    Variable,
)
from tests.engine.bases import block, every, output, points, rule, singleton

GAUSS = Term("g", Curve(CurveKind.GAUSSIAN, (3.0, 2.0)))
MIXED = (points("low", (0, 1), (2, 0)), GAUSS, points("high", (2, 0), (6, 1)))

CURVES = [
    Curve(CurveKind.GAUSSIAN, (1.0, 0.5)),
    Curve(CurveKind.GAUSSIAN, (1.0, 1e-7), 0.5),
    Curve(CurveKind.GAUSSIAN, (40.0, 3.0)),
    Curve(CurveKind.GAUSSIAN_PRODUCT, (1.0, 0.5, 1.5, 2.0)),
    Curve(CurveKind.BELL, (2.0, 8.0, 0.25)),
    Curve(CurveKind.BELL, (0.01, 1.0, 0.25), 0.75),
    Curve(CurveKind.SIGMOID, (1e4, 0.5)),
    Curve(CurveKind.SIGMOID_DIFFERENCE, (50.0, -1.0, 4.0, 2.0)),
    Curve(CurveKind.SIGMOID_DISTANCE, (5.0, 2.0, 4.0, -1.0)),
    Curve(CurveKind.SIGMOID_PRODUCT, (5.0, -1.0, -400.0, 2.0)),
    Curve(CurveKind.COSINE, (2.0, 0.5)),
    Curve(CurveKind.Z_SHAPE, (-1.0, 2.0)),
    Curve(CurveKind.S_SHAPE, (-1.0, 20.0)),
    Curve(CurveKind.PI_SHAPE, (-2.0, -1.0, 1.0, 2.5)),
    Curve(CurveKind.SPIKE, (0.5, 8.0)),
    Curve(CurveKind.CONCAVE, (0.5, 1.5)),
    Curve(CurveKind.CONCAVE, (1.5, 0.5)),
]


def degrees(made, **values):
    """Return the degrees of the rules."""
    program = assemble(made)
    memory = program.initial.copy()
    for place, name in enumerate(program.input_names):
        memory[place] = values[name]
    evaluate_once(program, memory)
    return memory[program.degrees_at : program.recorded].tolist()


def ruled(inputs, *conditions, more=()):
    rules = tuple(rule(str(n), condition, ("y", "s")) for n, condition in enumerate(conditions, 1))
    outputs = (output("y", singleton("s", 1)),)
    return block(inputs, outputs, RuleBlock(name="r", rules=rules), more_inputs=more)


@pytest.mark.parametrize("x", [-50.0, 0.0, 1.0, 2.0, 3.0, 4.5, 9.0])
def test_a_curve_stands_beside_base_points(x):
    own = exp(-((x - 3) ** 2) / 8)
    high = min(1.0, max(0.0, (x - 2) / 4))
    found = degrees(
        ruled(
            {"x": MIXED},
            Is("x", "g"),
            Not(Is("x", "g")),
            Is("x", "high"),
            And((Is("x", "g"), Is("x", "high"))),
        ),
        x=x,
    )
    assert found == pytest.approx([own, 1 - own, high, min(own, high)], rel=1e-15)


def test_an_input_may_have_nothing_but_curves_and_many_rules():
    base = ruled({"x": (GAUSS,)}, *[Is("x", "g")] * 300)
    assert degrees(base, x=1.0) == pytest.approx([exp(-0.5)] * 300, rel=1e-15)


def test_a_variable_may_hold_a_parameter():
    moved = Term("g", Curve(CurveKind.GAUSSIAN, ("m", 2.0), 0.5))
    base = ruled({"x": (moved,)}, Is("x", "g"), more=(Variable("m"),))
    assert degrees(base, x=7.0, m=5.0) == pytest.approx([0.5 * exp(-0.5)], rel=1e-15)


def test_show_program_writes_a_curve():
    moved = Term("g", Curve(CurveKind.GAUSSIAN, ("m", 2.0), 0.5))
    base = ruled({"x": (moved,)}, Is("x", "g"), more=(Variable("m"),))
    assert "x IS g: 0.5 * GAUSS(m, 2)" in program_text(assemble(base)).splitlines()


def test_single_values_of_an_input_hold_there_and_nowhere_else():
    single = Term("s", Singletons((Point(4.0, 0.5), Point(1.0, 1.0), Point(4.0, 0.25))))
    base = ruled({"x": (single,)}, Is("x", "s"), Not(Is("x", "s")))
    assert degrees(base, x=1.0) == [1.0, 0.0]
    assert degrees(base, x=4.0) == [0.5, 0.5]
    assert degrees(base, x=2.0) == [0.0, 1.0]


def test_a_variable_may_hold_the_single_value_of_an_input():
    single = Term("s", Singletons((Point("m", 0.75),)))
    base = ruled({"x": (single,)}, Is("x", "s"), more=(Variable("m"),))
    assert degrees(base, x=2.0, m=2.0) == [0.75]
    assert degrees(base, x=2.0, m=2.5) == [0.0]


@pytest.mark.parametrize("curve", CURVES, ids=str)
def test_a_polyline_keeps_within_its_tolerance(curve):
    line = polyline(curve, -10.0, 15.0)
    xs = np.array([point.x for point in line])
    parts = np.linspace(0.0, 1.0, 24)
    between = np.concatenate([left + (right - left) * parts for left, right in pairwise(xs)])
    between = np.concatenate([between, np.linspace(-10.0, 15.0, 10007)])
    straight = np.interp(between, xs, [point.degree for point in line])
    assert np.abs(straight - degrees_at(curve, between)).max() <= TOLERANCE
    assert (xs[0], xs[-1]) == (-10.0, 15.0)
    assert len(xs) < 4000


def test_a_jump_becomes_an_edge():
    line = polyline(Curve(CurveKind.CONCAVE, (1.0, 1.0)), 0.0, 2.0)
    assert [point.degree for point in line] == [0.0, *([0.0] * (len(line) - 3)), 1.0, 1.0]
    assert np.nextafter(line[-3].x, 2.0) == line[-2].x == 1.0


def smooth_output(method, *terms, limits=(-2.0, 10.0)):
    return replace(output("y", *terms, method=method), range=limits)


@pytest.mark.parametrize("level", [0.25, 1.0])
def test_the_centre_of_a_smooth_area_is_that_of_its_integral(level):
    # of exp(-(u - 3)² / 8) from -2 to 10, times the degree (Table 4, PROD)
    low, high = -2.0, 10.0
    content = 2 * sqrt(pi / 2) * (erf((high - 3) / sqrt(8)) - erf((low - 3) / sqrt(8)))
    moment = 3 * content + 4 * (exp(-((low - 3) ** 2) / 8) - exp(-((high - 3) ** 2) / 8))
    base = block(
        {"x": (points("t", (0, 0), (1, 1)),)},
        (smooth_output(Method.COG, GAUSS),),
        RuleBlock(name="r", activation=Activation.PROD, rules=(rule("1", every(("x", "t")), ("y", "g")),)),
    )
    ours = evaluate(assemble(base), {"x": level}).outputs["y"]
    assert ours == pytest.approx(moment / content, abs=1e-6 * (high - low))


def test_the_mean_of_maxima_of_what_is_cut_off_is_where_the_curve_passes_the_cut():
    # 1 / (1 + ((u - 4) / 2)²) = 1 / 2 at 2 and 6
    bell = Term("b", Curve(CurveKind.BELL, (2.0, 1.0, 4.0)))
    rules = RuleBlock(name="r", rules=(rule("1", every(("x", "t")), ("y", "b")),))
    for method, place in ((Method.LM, 2.0), (Method.RM, 6.0), (Method.MM, 4.0)):
        base = block({"x": (points("t", (0, 0), (1, 1)),)}, (smooth_output(method, bell),), rules)
        assert evaluate(assemble(base), {"x": 0.5}).outputs["y"] == pytest.approx(place, abs=1e-5)

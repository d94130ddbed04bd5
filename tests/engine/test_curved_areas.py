"""Areas under norms of the Open Level: within 1e-6 of what the norms' formulae give, place by place (S33)."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fcl_sim.engine import assemble_curved
from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.evaluate import evaluate
from fcl_sim.engine.precision import REAL
from fcl_sim.engine.show import program_text
from fcl_sim.model import (
    Accumulation,
    Activation,
    Curve,
    CurveKind,
    Degree,
    Method,
    RuleBlock,
    Term,
    Variable,
)
from tests.engine.area_norms import (
    BENDING,
    HIGH,
    LOW,
    TOLERANCE,
    base_of,
    errors,
    random_area_errors,
    true_degrees,
)
from tests.engine.bases import block, output, points, rule

TERMS = (
    points("l", (1, 1), (6, 0)),
    points("m", (2, 0), (5, 1), (6, 1), (9, 0)),
    points("r", (4, 0.25), (9, 1)),
)
CONCLUDED = (("l", 1.0), ("m", 1.0), ("m", 0.75), ("r", 1.0))
DEGREES = (0.9, 0.6, 0.3, 0.7)
LINEAR = (Activation.MIN, Activation.PROD, Activation.BDIF, Activation.NMIN)
SUMS = (Accumulation.MAX, Accumulation.BSUM, Accumulation.NSUM, Accumulation.SUM)


PAIRS = [
    (activation, accumulation)
    for activation in Activation
    for accumulation in Accumulation
    if accumulation is not Accumulation.NMAX or activation not in BENDING
]


@pytest.mark.parametrize(("activation", "accumulation"), PAIRS)
def test_every_pair_of_norms_keeps_to_the_tolerance(activation, accumulation):
    assert errors(TERMS, CONCLUDED, DEGREES, activation, accumulation).max() <= TOLERANCE


@pytest.mark.parametrize("activation", LINEAR)
@pytest.mark.parametrize("accumulation", [*SUMS, Accumulation.DSUM])
def test_what_is_piecewise_linear_is_exact(activation, accumulation):
    assert errors(TERMS, CONCLUDED, DEGREES, activation, accumulation).max() <= 1e-11


@pytest.mark.parametrize(("activation", "accumulation"), PAIRS)
def test_in_binary32_they_keep_to_what_it_can_tell_apart(activation, accumulation):
    found = errors(TERMS, CONCLUDED, DEGREES, activation, accumulation, REAL)
    assert not found.size or found.max() <= 1e-5


@st.composite
def shapes(draw):
    xs = sorted(draw(st.lists(st.integers(0, 40), min_size=2, max_size=5, unique=True)))
    degree = st.sampled_from((0.0, 1.0)) | st.floats(1e-9, 1.0)
    return [(x / 4, draw(degree)) for x in xs]


@settings(max_examples=60, deadline=None)
@given(
    st.lists(shapes(), min_size=1, max_size=3),
    st.lists(
        st.tuples(st.integers(0, 2), st.sampled_from((1.0, 0.5)), st.floats(0.01, 1.0)),
        min_size=1,
        max_size=8,
    ),
    st.sampled_from((Activation.MIN, Activation.PROD, Activation.BDIF, Activation.HPROD, Activation.EPROD)),
    st.sampled_from((*SUMS, Accumulation.ASUM, Accumulation.HSUM, Accumulation.ESUM)),
)
def test_any_terms_and_rules_keep_to_the_tolerance(drawn, concluded, activation, accumulation):
    terms = tuple(points(f"t{n}", *each) for n, each in enumerate(drawn))
    then = tuple((f"t{number % len(terms)}", weight) for number, weight, _ in concluded)
    degrees = tuple(degree for _, _, degree in concluded)
    assert errors(terms, then, degrees, activation, accumulation).max() <= 1.1 * TOLERANCE


@settings(max_examples=60, deadline=None)
@given(
    st.lists(shapes(), min_size=1, max_size=3),
    st.lists(
        st.tuples(st.integers(0, 2), st.sampled_from((1.0, 0.5)), st.floats(0.01, 1.0)),
        min_size=1,
        max_size=8,
    ),
    st.sampled_from((Activation.MIN, Activation.PROD, Activation.BDIF)),
)
def test_every_jump_of_nmax_is_found(drawn, concluded, activation):
    terms = tuple(points(f"t{n}", *each) for n, each in enumerate(drawn))
    then = tuple((f"t{number % len(terms)}", weight) for number, weight, _ in concluded)
    degrees = tuple(degree for _, _, degree in concluded)
    assert errors(terms, then, degrees, activation, Accumulation.NMAX).max() <= 1.1 * TOLERANCE


@pytest.mark.parametrize("accumulation", [Accumulation.HSUM, Accumulation.MAX, Accumulation.BSUM])
def test_where_there_is_no_room_for_the_polyline_there_is_no_number(accumulation, monkeypatch):
    base = base_of(TERMS, CONCLUDED, Activation.EPROD, accumulation)
    degrees = {f"d{n}": degree for n, degree in enumerate(DEGREES)}
    assert LOW < evaluate(assemble(base), degrees).outputs["y"] < HIGH
    monkeypatch.setattr(assemble_curved, "RUN", 1.0)
    found = evaluate(assemble(base), degrees)
    assert np.isnan(found.outputs["y"])
    assert found.active["y"]


@pytest.mark.parametrize("method", [Method.COG, Method.COA, Method.LM, Method.RM, Method.MM])
@pytest.mark.parametrize("activation", [Activation.EPROD, Activation.HPROD, Activation.BDIF])
@pytest.mark.parametrize("accumulation", [Accumulation.ASUM, Accumulation.HSUM, Accumulation.MAX])
def test_outputs_are_those_of_dense_samples(method, activation, accumulation):
    base = base_of(TERMS, CONCLUDED, activation, accumulation, method)
    found = evaluate(assemble(base), {f"d{n}": degree for n, degree in enumerate(DEGREES)}).outputs["y"]
    edges = np.linspace(LOW, HIGH, 400_001)
    xs = 0.5 * (edges[1:] + edges[:-1])
    true = true_degrees(TERMS, CONCLUDED, DEGREES, activation, accumulation, xs)
    highest = xs[true >= true.max() - 1e-9]
    expected = {
        Method.COG: np.sum(true * xs) / np.sum(true),
        Method.COA: xs[np.searchsorted(np.cumsum(true), 0.5 * np.sum(true))],
        Method.LM: highest[0],
        Method.RM: highest[-1],
        Method.MM: 0.5 * (highest[0] + highest[-1]),
    }
    assert found == pytest.approx(expected[method], abs=5e-5)


def test_the_centre_under_the_probabilistic_sum_is_that_of_its_integral():
    # 1 - (1 - u) (1 - u) = 2 u - u² over 0 … 1: 5/12 over 2/3
    ramp = points("t", (0, 0), (1, 1))
    base = base_of((ramp,), (("t", 1.0), ("t", 1.0)), Activation.MIN, Accumulation.ASUM)
    base = replace(base, defuzzifications=(replace(base.defuzzifications[0], range=(0.0, 1.0)),))
    found = evaluate(assemble(base), {"d0": 1.0, "d1": 1.0}).outputs["y"]
    assert found == pytest.approx(5 / 8, abs=1e-6)


def test_rule_blocks_that_disagree_are_joined_by_max():  # S26
    ramp = points("t", (0, 0), (10, 1))
    one = RuleBlock(
        name="a",
        activation=Activation.BDIF,
        accumulation=Accumulation.ASUM,
        rules=(rule("1", Degree("d"), ("y", "t")),),
    )
    two = RuleBlock(name="b", rules=(rule("1", Degree("e"), ("y", "t")),))
    area = replace(output("y", ramp, method=Method.LM), range=(LOW, HIGH))
    program = assemble(block({}, (area,), one, two, more_inputs=(Variable("d"), Variable("e"))))
    assert evaluate(program, {"d": 0.75, "e": 0.25}).outputs["y"] == 10.0
    assert evaluate(program, {"d": 0.25, "e": 0.5}).outputs["y"] == 5.0


def test_smooth_and_moved_terms_are_followed():
    bell = Term("b", Curve(CurveKind.GAUSSIAN, (5.0, 1.0)))
    base = base_of((bell,), (("b", 1.0), ("b", 1.0)), Activation.EPROD, Accumulation.HSUM)
    assert evaluate(assemble(base), {"d0": 0.5, "d1": 0.25}).outputs["y"] == pytest.approx(5.0, abs=1e-6)


def test_where_nothing_is_left_of_the_terms_no_rule_is_active():  # S31
    base = base_of((points("t", (0, 0), (10, 0.5)),), (("t", 1.0),), Activation.BDIF, Accumulation.MAX)
    found = evaluate(assemble(base), {"d0": 0.5})
    assert (float(found.outputs["y"]), bool(found.active["y"])) == (99.0, False)
    assert evaluate(assemble(base), {"d0": 0.0}).outputs["y"] == 99.0


def test_the_norms_of_an_area_are_shown():
    text = program_text(assemble(base_of(TERMS, CONCLUDED, Activation.EPROD, Accumulation.HSUM)))
    assert "      HSUM" in text.splitlines()
    assert "0.75 · EPROD(" in text


@pytest.mark.parametrize("seed", range(40))
def test_random_areas_keep_to_the_tolerance(seed):
    what, distances = random_area_errors(seed)
    assert distances.max(initial=0.0) <= 1.1 * TOLERANCE, what

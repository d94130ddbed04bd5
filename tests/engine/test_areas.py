"""Outputs with areas, against closed forms and the decisions of SEMANTICS S20 to S34."""

from dataclasses import replace
from math import sqrt

import pytest

from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.evaluate import evaluate
from fcl_sim.model import (
    Accumulation,
    Activation,
    Defuzzification,
    Degree,
    Is,
    Method,
    Point,
    Points,
    RuleBlock,
    Singleton,
    Term,
    Variable,
)
from tests.engine.bases import block, output, points, rule, singleton

TRIANGLE = points("t", (0, 0), (3, 1), (6, 0))
LEFT, RIGHT = points("l", (0, 0), (1, 1), (2, 0)), points("r", (6, 0), (7, 1), (8, 0))
IS_FAR = Is("x", "far")


def degrees(output, *then, values, initial=None, **settings):
    """Return the output and its flag where the first conclusion has the degree d, the second e, and so on."""
    names = ("d", "e", "f")[: len(then)]
    rules = tuple(rule(name, Degree(name), each) for name, each in zip(names, then, strict=True))
    extra = tuple(Variable(name) for name in values if name not in names)
    base = block(
        {},
        (output,),
        RuleBlock(name="r", rules=rules, **settings),
        more_inputs=(*map(Variable, names), *extra),
        initial=initial or {},
    )
    result = evaluate(assemble(base), values)
    return float(result.outputs["y"]), bool(result.active["y"])


def area(*terms, method=Method.COG, limits=None, default=99.0):
    return Defuzzification(variable="y", terms=terms, method=method, default=default, range=limits)


@pytest.mark.parametrize("activation", [Activation.MIN, Activation.PROD])
@pytest.mark.parametrize("method", [Method.COG, Method.COA, Method.MM])
@pytest.mark.parametrize("degree", [1e-9, 0.25, 1.0])
def test_a_symmetrical_term_gives_its_middle(activation, method, degree):
    value, active = degrees(
        area(TRIANGLE, method=method), ("y", "t"), values={"d": degree}, activation=activation
    )
    assert active
    assert abs(value - 3) <= 2e-15


@pytest.mark.parametrize(
    ("activation", "expected"),
    [(Activation.MIN, (0.5**3 / 3 + 0.5 * (1 - 0.5**2) / 2) / 0.375), (Activation.PROD, 2 / 3)],
)
def test_min_cuts_off_and_prod_lowers(activation, expected):
    ramp = points("t", (0, 0), (1, 1))
    value, _ = degrees(area(ramp), ("y", "t"), values={"d": 0.5}, activation=activation)
    assert abs(value - expected) <= 1e-15


def test_lm_and_rm_are_the_ends_of_a_plateau():
    for method, expected in ((Method.LM, 1.5), (Method.RM, 4.5), (Method.MM, 3.0)):
        assert degrees(area(TRIANGLE, method=method), ("y", "t"), values={"d": 0.5}) == (expected, True)


def test_of_equal_maxima_lm_takes_the_first_and_rm_the_last():
    for method, expected in ((Method.LM, 0.25), (Method.RM, 7.75)):
        terms = area(LEFT, RIGHT, method=method)
        assert degrees(terms, ("y", "l"), ("y", "r"), values={"d": 0.25, "e": 0.25})[0] == expected


def test_half_the_area_reached_at_a_gap_gives_its_midpoint():
    terms = area(LEFT, RIGHT, method=Method.COA)
    assert degrees(terms, ("y", "l"), ("y", "r"), values={"d": 0.3, "e": 0.3})[0] == 4.0


def test_centre_of_area_solves_the_quadratic():
    ramp = points("t", (0, 0), (1, 1))
    value, _ = degrees(area(ramp, method=Method.COA), ("y", "t"), values={"d": 1.0})
    assert abs(value - sqrt(0.5)) <= 1e-15


def test_the_weight_multiplies_what_was_cut_off():
    terms = area(LEFT, RIGHT)
    lower, _ = degrees(terms, ("y", "l", 0.5), ("y", "r"), values={"d": 0.5, "e": 0.5})
    left, right = 0.5 * 0.75, 0.75  # 0.5 · MIN(0.5, μ), not MIN(0.25, μ)
    assert abs(lower - (1 * left + 7 * right) / (left + right)) <= 1e-14


@pytest.mark.parametrize(
    ("accumulation", "expected"),
    [(Accumulation.MAX, 1.0), (Accumulation.BSUM, 1.0), (Accumulation.NSUM, 1.0)],
)
def test_rules_on_one_term_accumulate(accumulation, expected):
    value, _ = degrees(
        area(LEFT, limits=(0.0, 2.0)),
        ("y", "l"),
        ("y", "l", 0.25),
        values={"d": 0.5, "e": 0.75},
        accumulation=accumulation,
    )
    assert abs(value - expected) <= 1e-15


def test_a_sum_is_bounded_where_it_exceeds_1_and_norming_keeps_its_shape():
    box, ramp = points("b", (0, 1), (4, 1)), points("r", (0, 0), (4, 1))
    for accumulation, expected in (
        (Accumulation.BSUM, 0.0),
        (Accumulation.NSUM, 4.0),
        (Accumulation.MAX, 0.0),
    ):
        terms = area(box, ramp, method=Method.LM)
        values = {"d": 1.0, "e": 1.0}
        assert degrees(terms, ("y", "b"), ("y", "r"), values=values, accumulation=accumulation)[0] == expected


def test_the_range_cuts_and_shoulders_reach_to_its_ends():
    shoulder = points("s", (2, 0), (4, 1))
    assert degrees(area(shoulder, limits=(4.0, 10.0)), ("y", "s"), values={"d": 0.5})[0] == 7.0
    assert degrees(area(shoulder, limits=(-5.0, 2.0)), ("y", "s"), values={"d": 0.5}) == (99.0, False)


def test_without_range_the_hull_of_the_points_is_taken_also_of_terms_that_do_not_fire():
    shoulder = points("s", (2, 0), (2, 1))
    other = points("o", (6, 0), (8, 1))
    assert degrees(area(shoulder, other), ("y", "s"), values={"d": 0.5})[0] == 5.0


def test_an_area_of_nothing_is_as_no_rule():
    spike = points("s", (1, 0), (1, 1), (1, 0))
    for method in (Method.COG, Method.COA, Method.LM):
        assert degrees(area(spike, method=method), ("y", "s"), values={"d": 1.0}) == (99.0, False)
        kept = area(spike, method=method, default=None)
        assert degrees(kept, ("y", "s"), values={"d": 1.0}, initial={"y": 5.0}) == (5.0, False)


def test_a_vertical_edge_belongs_to_both_sides():
    left, right = points("l", (0, 1), (2, 1), (2, 0)), points("r", (2, 0), (2, 1), (4, 1))
    for method, expected in ((Method.LM, 2.0), (Method.RM, 2.0), (Method.COG, 2.0)):
        value, _ = degrees(
            area(left, right, method=method),
            ("y", "l"),
            ("y", "r"),
            values={"d": 0.4, "e": 0.4},
            accumulation=Accumulation.NSUM,
        )
        assert abs(value - expected) <= 1e-15


def test_moved_points_move_the_area_and_never_fall():
    term = Term("t", Points((Point("a", 0.0), Point(3.0, 1.0), Point("b", 0.0))))
    for a, b, expected in ((0.0, 6.0, 3.0), (2.0, 4.0, 3.0), (3.0, 6.0, 4.0)):
        value, _ = degrees(area(term, limits=(-20.0, 20.0)), ("y", "t"), values={"d": 1.0, "a": a, "b": b})
        assert abs(value - expected) <= 1e-14
    crossed = degrees(area(term), ("y", "t"), values={"d": 1.0, "a": 5.0, "b": 4.0})
    assert crossed == (99.0, False)  # all points at 5: no width


def test_moved_singletons_and_their_maxima():
    terms = (Term("s", Singleton("a")), singleton("u", 2.0))
    for method, expected in ((Method.COGS, 4.0), (Method.LM, 2.0), (Method.RM, 6.0), (Method.MM, 4.0)):
        value, _ = degrees(
            output("y", *terms, method=method), ("y", "s"), ("y", "u"), values={"d": 0.5, "e": 0.5, "a": 6.0}
        )
        assert value == expected


def test_a_term_moved_by_a_variable_is_fuzzified_where_it_stands():
    far = Term("far", Points((Point("start", 0.0), Point(10.0, 1.0))))
    base = block(
        {"x": (far,)},
        (output("y", singleton("s", 1.0), singleton("z", 0.0)),),
        RuleBlock(name="r", rules=(rule("1", Degree("d"), ("y", "z")), rule("2", IS_FAR, ("y", "s")))),
        more_inputs=(Variable("start"), Variable("d")),
    )
    program = assemble(base)
    for start, x, degree in ((0.0, 4.0, 0.4), (8.0, 9.0, 0.5), (12.0, 11.0, 0.0), (12.0, 12.0, 1.0)):
        value = float(evaluate(program, {"x": x, "start": start, "d": 1.0 - degree}).outputs["y"])
        assert abs(value - degree) <= 1e-15


def test_an_output_s_own_accu_goes_before_that_of_the_rule_block():
    base = block(
        {},
        (replace(output("y", singleton("s", 1.0), singleton("z", 0.0)), accumulation=Accumulation.BSUM),),
        RuleBlock(
            name="r",
            rules=(
                rule("1", Degree("d"), ("y", "s")),
                rule("2", Degree("d"), ("y", "s")),
                rule("3", Degree("d"), ("y", "z")),
            ),
        ),
        more_inputs=(Variable("d"),),
    )
    assert abs(float(evaluate(assemble(base), {"d": 0.25}).outputs["y"]) - 2 / 3) <= 1e-16

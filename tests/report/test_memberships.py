"""Terms: each where it lies, named, singletons as stems, with what runs visited."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fcl_sim.block import loads
from fcl_sim.loop.trace import FuzzyRecord
from fcl_sim.model import Curve, CurveKind, Point, Points, Singleton, Singletons, Term
from fcl_sim.report.canvas import Dot, Line
from fcl_sim.report.characteristics import memberships
from fcl_sim.report.memberships import Panel, Visit, membership_plot, panels
from fcl_sim.report.terms import abscissae, extent, standing
from fcl_sim.report.terms import drawn as shown_as
from tests.report.legible import clashes, cut, texts
from tests.report.synthetic import EVIL, LONG, THREE_INPUTS, crane

UNITS = {"distance": "m", "angle": "deg", "power": "kW"}


def drawn(*visits: Visit):
    return membership_plot(panels(crane().function_block, UNITS, {"distance": visits}))


def test_every_variable_has_an_axis_with_its_unit_and_every_term_its_name():
    shown = [text for text, _ in texts(drawn())]
    assert {"distance [m]", "angle [deg]", "power [kW]", "degree [1]"} <= set(shown)
    for term in ("too_far", "medium", "neg_small", "pos_big", "neg_high", "pos_medium"):
        assert term in shown
    assert shown.count("zero") == 3


def test_singletons_are_stems_at_their_places():
    figure = drawn()
    stems = [each.x for each in figure.axes[2].of(Dot, "stem")]
    assert sorted(stems) == [-27.0, -9.0, 0.0, 9.0, 27.0]


def test_a_term_is_drawn_from_its_first_degree_above_0_to_its_last():
    figure = drawn()
    close = next(line for line in figure.axes[0].of(Line, "term") if list(line.x) == [0.0, 5.0, 10.0])
    assert list(close.y) == [0.0, 1.0, 0.0]


def test_what_a_run_visited_widens_the_axis_within_reason():
    near, far = (drawn(Visit("base", low, 30.0)).axes[0].x for low in (-20.0, -1e9))
    assert near[0] < -20.0
    assert -100.0 < far[0] < -50.0


def test_letter_case_of_variables_does_not_matter():
    panel = panels(crane().function_block, {"DISTANCE": "m"}, {"Distance": [Visit("base", 0.0, 1.0)]})[0]
    assert (panel.unit, len(panel.visits)) == ("m", 1)


@pytest.mark.parametrize(
    "visits",
    [
        [],
        [Visit("base", -0.4, 25.0), Visit("raw_distance", -12.0, -11.9), Visit("right", 24.9, 25.0)],
        [Visit(LONG, -30.0, 30.0), Visit(EVIL, 3.0, 3.0), Visit(LONG + EVIL, -5.0, -4.0)],
        [Visit("run away", -1e9, 1e9)],
    ],
    ids=["none", "several", "long names", "far away"],
)
def test_no_text_is_cut_and_no_two_meet(visits):
    figure = drawn(*visits)
    assert cut(figure) == []
    assert clashes(figure) == []


NAMES = st.text("abcdefghij_", min_size=1, max_size=40)


@settings(max_examples=12)
@given(st.lists(st.tuples(NAMES, st.floats(-10.0, 10.0)), min_size=1, max_size=12))
def test_names_of_terms_do_not_meet_however_close_they_lie(terms):
    panel = Panel(
        variable="x",
        role="output",
        unit="",
        terms=[Term(name, Singleton(value)) for name, value in terms],
        visits=[],
        low=-10.0,
        high=10.0,
    )
    figure = membership_plot([panel])
    assert cut(figure) == []
    assert clashes(figure) == []


def test_points_moved_by_variables_stand_at_their_initial_values_and_never_fall():
    term = Term("t", Points((Point(1.0, 0.0), Point("Limit", 1.0), Point(5.0, 0.0))))
    assert abscissae(term, {"limit": 3.0}) == [1.0, 3.0, 5.0]
    moved = shown_as(standing(term, {"limit": 9.0}))
    assert [point.x for point in moved.shape.points] == [1.0, 9.0, 9.0]


@pytest.mark.parametrize(("value", "low", "high"), [(0.0, -1.0, 1.0), (4.0, 0.0, 8.0)])
def test_around_a_lone_place_there_is_room(value, low, high):
    assert extent([Term("t", Singleton(value))], {}) == (low, high)


def test_many_runs_are_drawn_as_one():
    block = crane()
    visited = {
        f"run {index}": FuzzyRecord(
            block.inputs, block.outputs, ("1",), np.full((2, 2), index), np.zeros((2, 1)), np.zeros((2, 1)),
            np.ones((2, 1), dtype=bool),
        )
        for index in range(40)
    }  # fmt: skip
    (picture,) = memberships(block, UNITS, "terms", visited)
    assert "Visited by all 40 runs: 0 to 39" in picture.alt


def test_the_alternative_text_tells_every_term_and_point():
    (picture,) = memberships(crane(), UNITS, "terms")
    assert "Input distance: too_far (−5, 1) (0, 0); zero (−5, 0) (0, 1) (5, 0)" in picture.alt
    assert "Output power: neg_high at −27;" in picture.alt


def test_many_variables_take_several_figures():
    more = "".join(f"FUZZIFY {name} TERM lo := (0, 1) (1, 0); END_FUZZIFY\n" for name in "de")
    text = THREE_INPUTS.replace("c: REAL;", "c: REAL; d: REAL; e: REAL;")
    many = loads(text.replace("DEFUZZIFY u", f"{more}DEFUZZIFY u", 1))
    assert [each.name for each in memberships(many, {}, "terms")] == ["terms-1", "terms-2"]


def test_a_smooth_curve_is_drawn_where_it_can_be_seen():
    term = Term("t", Curve(CurveKind.GAUSSIAN, ("m", 2.0), 0.5))
    points = shown_as(standing(term, {"m": 3.0})).shape.points
    assert extent([term], {"m": 3.0}) == (-3.0, 9.0)
    assert (points[0].x, points[-1].x) == (-3.0, 9.0)
    assert max(points, key=lambda point: point.degree) == Point(3.0, 0.5)
    assert points[0].degree < 0.01


@pytest.mark.parametrize("kind", CurveKind)
def test_a_curve_of_any_kind_is_seen_between_two_places(kind):
    term = Term("t", Curve(kind, (1.0, 2.0, 3.0, 4.0)))
    points = shown_as(standing(term, {})).shape.points
    low, high = extent([term], {})
    assert low < high
    assert max(point.degree for point in points) > 0.5


def test_single_values_are_drawn_as_stems_of_their_degrees():
    term = Term("t", Singletons((Point("m", 0.5), Point(1.0, 1.0))))
    assert shown_as(standing(term, {"m": 3.0})).shape == Points(
        (Point(1.0, 0.0), Point(1.0, 1.0), Point(1.0, 0.0), Point(3.0, 0.0), Point(3.0, 0.5), Point(3.0, 0.0))
    )
    assert extent([term], {"m": 3.0}) == (1.0, 3.0)


FORMULAE = """FUNCTION_BLOCK law
VAR_INPUT x: REAL; END_VAR
VAR_OUTPUT u: REAL; v: REAL; END_VAR
FUZZIFY x TERM near := GAUSS 0 2; TERM far := SIGM 2 5; TERM at := 3; END_FUZZIFY
DEFUZZIFY u TERM slow := FUNCTION 2 * x + 1; METHOD: CoGS; DEFAULT := 0; END_DEFUZZIFY
DEFUZZIFY v TERM slow := FUNCTION x; TERM fast := 20; METHOD: CoGS; DEFAULT := 0; END_DEFUZZIFY
RULEBLOCK rules AND: MIN; ACCU: MAX;
    RULE 1: IF x IS near THEN u IS slow, v IS slow;
    RULE 2: IF x IS far OR x IS at THEN v IS fast;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""


def test_a_term_that_is_a_formula_is_written_with_it():
    (picture,) = memberships(loads(FORMULAE), {}, "terms")
    figure = picture.draw()
    written = [text for text, _ in texts(figure)]
    assert "Calculated at each evaluation: slow = 2 * x + 1." in written
    assert "Calculated at each evaluation: slow = x." in written
    assert written.count("slow") == 0
    assert "Output u: slow = 2 * x + 1, calculated at each evaluation." in picture.alt
    assert cut(figure) == []
    assert clashes(figure) == []


def test_a_variable_of_formulae_alone_has_no_axis():
    figure = memberships(loads(FORMULAE), {}, "terms")[0].draw()
    assert [len(axes.of(Line)) > 0 for axes in figure.axes] == [True, False, True]


def test_a_smooth_term_is_told_by_its_shape():
    (picture,) = memberships(loads(FORMULAE), {}, "terms")
    assert picture.alt.startswith(
        "Input x: near GAUSS, mean 0, deviation 2; seen from −6 to 6, highest, 1, at 0; "
        "far SIGM, gain 2, inflection 5; seen from 2 to 8, highest, 0.9975, at 8; at (3, 1). "
    )


def test_a_smooth_curve_is_drawn_as_far_as_its_axis_goes():
    figure = memberships(loads(FORMULAE), {}, "terms")[0].draw()
    (low, high) = figure.axes[0].x
    near = max(figure.axes[0].of(Line, "term"), key=lambda line: len(line.x))
    assert (near.x[0], near.x[-1]) == (low, high)
    assert near.y == pytest.approx(np.exp(-(np.square(near.x)) / 8.0), abs=1e-9)

"""The figure of an inference: it shows the numbers of the explanation, and can be read."""

from dataclasses import replace
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.block import load, loads
from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.explain import Activated, Explanation, Origin
from fcl_sim.engine.instance import Instance
from fcl_sim.model import Point, Points, Term
from fcl_sim.report.canvas import Dot, Line, Shape, Text
from fcl_sim.report.inference import PAGE, draw, picture, pictures
from fcl_sim.report.inference_rules import LINES
from fcl_sim.report.inference_shapes import activated_line, line_over
from fcl_sim.report.lettering import text_width
from fcl_sim.report.strips import Strip, parted
from fcl_sim.report.vector import svg
from fcl_sim.report.words import number, with_unit
from tests.report.inferences import grid, long_inputs, long_names, nested, three, tip
from tests.report.legible import clashes, cut, texts
from tests.report.synthetic import EVIL, LONG, crane

C8 = {"distance": 12.0, "angle": 4.0}
UNITS = {"distance": "m", "Angle": "deg", "power": "kW"}


def drawn(block, units=None, **values):
    explanation = block.explain(**values)
    return draw(block.function_block, explanation, units), explanation


def axes_of(figure, label):
    return [axes for axes in figure.axes if axes.label == label]


def lines(axes, label):
    return axes.of(Line, label)


def dots(axes):
    """Return place and degree of each dot."""
    return [(each.x, each.y) for each in axes.of(Dot, "degree")]


def bars(figure):
    """Return what the bars of degrees are called, in their order."""
    return [each.label for each in figure.axes[0].of(Shape) if each.label.startswith("degree")]


def written(figure):
    return [text for text, _ in texts(figure)]


# -- what is drawn is what the explanation tells


def test_each_input_has_its_value_as_a_line_and_a_dot_at_each_degree_above_0():
    figure, explanation = drawn(crane(), **C8)
    for told in explanation.fuzzified:
        (axes,) = axes_of(figure, f"input {told.variable}")
        (line,) = lines(axes, "value")
        assert line.x == [told.value] * 2
        assert dots(axes) == [(told.value, each.degree) for each in told.degrees if each.degree > 0.0]
        assert len(lines(axes, "term")) == len(told.degrees)


def test_the_dot_of_a_degree_lies_on_its_term():
    figure, _ = drawn(nested(), temperature=30.0, x=3.0, ready=0.6)
    for label, count in (("input temperature", 2), ("input x", 1)):
        (axes,) = axes_of(figure, label)
        terms = {line.colour: (line.x, line.y) for line in lines(axes, "term")}
        found = axes.of(Dot, "degree")
        assert len(found) == count
        for dot in found:
            assert np.interp(dot.x, *terms[dot.colour]) == pytest.approx(dot.y, abs=1e-3)


def test_each_rule_that_fired_has_the_degrees_of_its_conditions_and_its_own():
    figure, explanation = drawn(three(), **C8)
    shown = {
        variable: [dots(axes)[0][1] for axes in axes_of(figure, f"condition {variable}")]
        for variable in ("distance", "angle")
    }
    assert shown == {"distance": [5 / 6, 5 / 6, 1 / 6], "angle": [0.8, 0.2, 0.2]}
    assert bars(figure) == [f"degree {each.degree!r}" for each in explanation.aggregated]
    for formula in ("MIN(0.8333, 0.8) = 0.8", "MIN(0.8333, 0.2) = 0.2", "MIN(0.1667, 0.2) = 0.1667"):
        assert formula in written(figure)


def test_a_negated_condition_is_drawn_with_the_degree_of_not():
    figure, _ = drawn(nested(), temperature=20.0, x=3.0, ready=0.6)
    (axes,) = axes_of(figure, "condition temperature")[:1]
    (term,) = lines(axes, "term")
    assert dots(axes)[0][1] == 0.5
    assert np.interp(20.0, term.x, term.y) == 0.5
    assert np.interp(39.0, term.x, term.y) == pytest.approx(0.975)


def test_singletons_have_stems_up_to_their_degrees_and_the_result_is_a_line():
    figure, explanation = drawn(three(), units=UNITS, **C8)
    (axes,) = axes_of(figure, "output power")
    stems = dots(axes)
    (told,) = explanation.accumulated
    (result,) = explanation.defuzzified
    assert stems == [(x, each.degree) for x, each in zip(result.places, told.degrees, strict=True)]
    assert stems == [(0.0, 0.2), (9.0, 0.8)]
    (line,) = lines(axes, "result")
    assert line.x == [7.2, 7.2]
    blank = "\N{NO-BREAK SPACE}"
    assert {f"7.2{blank}kW", f"distance = 12{blank}m", f"angle = 4{blank}deg"} <= set(written(figure))
    assert "power = (0 · 0.2 + 9 · 0.8) / (0.2 + 0.8) = 7.2  (CoGS)" in written(figure)


def test_a_conclusion_has_its_stem_at_its_activated_degree():
    figure, explanation = drawn(nested(), temperature=55.5, x=3.0, ready=0.6)
    for each in explanation.activated:
        if each.variable == "speed":
            (axes,) = axes_of(figure, f"conclusion {each.rule} speed")
            place = 7.0 if each.term == "slow" else 100.0 - 55.5 / 2.0
            assert dots(axes) == [(place, each.degree)]


@pytest.mark.parametrize(("activation", "accumulation"), [("MIN", "MAX"), ("PROD", "MAX"), ("MIN", "BSUM")])
def test_the_accumulated_area_is_that_of_the_explanation_to_the_last_bit(activation, accumulation):
    figure, explanation = drawn(tip(activation, accumulation), service=3.2, food=2.2)
    (axes,) = axes_of(figure, "output tip")
    (area,) = lines(axes, "area")
    vertices = tuple(zip(area.x.tolist(), area.y.tolist(), strict=True))
    assert vertices == explanation.accumulated[0].area
    (line,) = lines(axes, "result")
    assert line.x == [explanation.defuzzified[0].value] * 2


@pytest.mark.parametrize("activation", ["MIN", "PROD"])
def test_the_activated_areas_of_the_rules_make_the_accumulated_one(activation):
    figure, explanation = drawn(tip(activation), service=3.2, food=2.2)
    xs = np.linspace(0.0, 28.0, 561)
    whole = np.zeros_like(xs)
    for rule in explanation.fired:
        (axes,) = axes_of(figure, f"conclusion {rule} tip")
        (area,) = lines(axes, "area")
        whole = np.maximum(whole, np.interp(xs, area.x, area.y, left=0.0, right=0.0))
    told = np.array(explanation.accumulated[0].area).T
    assert whole == pytest.approx(np.interp(xs, *told, left=0.0, right=0.0), abs=1e-12)


DEGREES = st.floats(0.0, 1.0)


@given(
    st.lists(st.tuples(st.integers(-20, 20), DEGREES), min_size=1, max_size=6).map(sorted),
    DEGREES,
    DEGREES,
    st.sampled_from(["MIN", "PROD", "BDIF", "HPROD"]),
)
def test_an_activated_term_is_its_algorithm_at_every_vertex(pairs, level, weight, algorithm):
    term = Term("t", Points(tuple(Point(float(x), degree) for x, degree in pairs)))
    line = line_over(term, -25.0, 25.0)
    each = Activated("1", "y", "t", level, weight, weight * level, algorithm)
    xs, degrees = activated_line(line, each)
    assert (xs[0], xs[-1]) == (-25.0, 25.0)
    assert (np.diff(xs) >= 0.0).all()
    steep = {float(x) for x in xs[1:][np.diff(xs) < 1e-9]}
    norms = {
        "MIN": min,
        "PROD": lambda a, b: a * b,
        "BDIF": lambda a, b: max(0.0, a + b - 1.0),
        "HPROD": lambda a, b: a * b / (a + b - a * b) if a or b else 0.0,
    }
    for x, degree in zip(xs, degrees, strict=True):
        if float(x) not in steep:
            expected = weight * norms[algorithm](float(np.interp(x, *line)), level)
            assert degree == pytest.approx(expected, abs=1e-9)


# -- which rules are shown


def test_only_rules_that_fired_have_rows_and_the_others_are_counted():
    figure, explanation = drawn(crane(), **C8)
    assert explanation.fired == ("1",)
    assert "Aggregation and activation: 1 of 6 rules fired" in written(figure)
    assert "Did not fire: 2, 3, 4, 5 and 6." in written(figure)
    assert [text for text in written(figure) if text.startswith("RULE")] == ["RULE 1"]


def test_many_rules_have_a_line_each_and_every_one_its_bar():
    figure, explanation = drawn(grid(7, smooth=True), error=2.3, change=1.6)
    assert len(explanation.fired) == 49
    assert bars(figure) == [f"degree {each.degree!r}" for each in explanation.aggregated]
    assert axes_of(figure, "condition error") == []
    assert figure.height < 320.0


def test_of_very_many_rules_those_of_the_largest_degrees_are_shown():
    figure, explanation = drawn(grid(11, smooth=True), error=2.3, change=1.6)
    degrees = sorted((each.degree for each in explanation.aggregated if each.degree > 0.0), reverse=True)
    assert len(bars(figure)) == LINES
    assert sorted(bars(figure)) == sorted(f"degree {each!r}" for each in degrees[:LINES])
    left = f"{len(degrees) - LINES} rules more fired, by at most {number(degrees[LINES])}"
    assert f"Shown are the {LINES} of the largest degrees; {left}." in written(figure)


def test_where_no_rule_fired_the_default_is_shown_and_said():
    figure, explanation = drawn(crane(), distance=-10.0, angle=0.0)
    assert explanation.fired == ()
    (axes,) = axes_of(figure, "output power")
    assert dots(axes) == []
    assert lines(axes, "result")[0].x == [0.0, 0.0]
    assert {"0 (DEFAULT)", "power = 0: no rule is active, DEFAULT"} <= set(written(figure))


def test_a_previous_value_is_said_to_be_one():
    figure, explanation = drawn(tip(), service=20.0, food=5.0)
    assert explanation.defuzzified[0].origin is Origin.PREVIOUS
    assert "0 (NC)" in written(figure)


def test_formulae_are_written_with_what_they_gave_or_that_nothing_was_calculated():
    figure, _ = drawn(nested(), temperature=55.5, x=3.0, ready=0.6)
    assert "Calculated: slow = 2 * x + 1 = 7; fast = 100 - temperature / 2 = 72.25." in written(figure)
    figure, explanation = drawn(nested(), temperature=20.0, x=300.0, ready=1.6)
    assert explanation.defuzzified[0].origin is Origin.DEFAULT
    assert any(text.startswith("Not calculated, as no rule is active: slow") for text in written(figure))
    (axes,) = axes_of(figure, "output speed")
    assert dots(axes) == []


def test_a_value_far_from_all_terms_is_an_arrow_at_the_end_of_the_axis():
    figure, _ = drawn(crane(), distance=12.0, angle=1e9)
    (axes,) = axes_of(figure, "input angle")
    assert axes.x[1] < 60.0
    assert lines(axes, "value") == []
    assert [each.kind for each in axes.of(Dot)] == ["right"]
    assert "angle = 1e9" in written(figure)


def test_degrees_brought_in_and_given_out_are_bars():
    figure, _ = drawn(nested(), temperature=20.0, x=300.0, ready=1.6)
    shown = written(figure)
    assert {"ready = 1.6, taken as 1", "mode = 1", "edge = 0"} <= set(shown)


def test_an_explanation_without_a_number_as_its_result_is_drawn_without_a_line():
    block = crane()
    explanation = block.explain(distance=-10.0, angle=0.0)
    (result,) = explanation.defuzzified
    broken = replace(explanation, defuzzified=(replace(result, value=float("nan")),))
    (axes,) = axes_of(draw(block.function_block, broken), "output power")
    assert lines(axes, "result") == []


# -- whether it can be read

NESTED = {"temperature": 55.5, "x": 3.0, "ready": 0.6}
CASES = {
    "figure C.8": (three, C8, UNITS),
    "printed crane": (crane, C8, None),
    "no rule": (crane, {"distance": -10.0, "angle": 1e9}, UNITS),
    "areas": (tip, {"service": 3.2, "food": 2.2}, None),
    "49 rules": (lambda: grid(7), {"error": 2.3, "change": 1.6}, None),
    "49 rules, all fire": (lambda: grid(7, smooth=True), {"error": 2.3, "change": 1.6}, None),
    "nested": (nested, NESTED, None),
    "long names": (long_names, long_inputs(), None),
    "long units": (long_names, long_inputs(), dict.fromkeys([*long_inputs(), "v"], EVIL + LONG)),
}


@pytest.mark.parametrize("case", CASES)
def test_no_text_is_cut_and_no_two_meet(case):
    block, values, units = CASES[case]
    figure, _ = drawn(block(), units=units, **values)
    assert cut(figure) == []
    assert clashes(figure) == []


@pytest.mark.parametrize("case", ["figure C.8", "nested"])
def test_the_same_explanation_gives_the_same_bytes(case):
    block, values, units = CASES[case]
    assert svg(drawn(block(), units=units, **values)[0]) == svg(drawn(block(), units=units, **values)[0])


def test_a_long_inference_is_parted_into_pages_that_lose_nothing():
    block = grid(7, smooth=True)
    explanation = block.explain(error=2.3, change=1.6)
    parts = pictures(block.function_block, explanation)
    assert [each.name for each in parts] == ["inference-1", "inference-2"]
    assert parts[1].caption.endswith("Part 2 of 2.")
    figures = [each.draw() for each in parts]
    assert all(figure.height <= PAGE for figure in figures)
    both = [text for figure in figures for text in written(figure)]
    assert sorted(both) == sorted(written(draw(block.function_block, explanation)))
    headings = [figure.axes[0].of(Text)[-1].text for figure in figures]
    assert "Accumulation and defuzzification" not in headings


def test_a_short_one_is_one_picture_as_of_the_whole():
    block = three()
    explanation = block.explain(**C8)
    (part,) = pictures(block.function_block, explanation, stem="at-12-s")
    assert part.name == "at-12-s"
    assert part.caption == picture(block.function_block, explanation).caption


# -- for who cannot see it


def test_the_alternative_text_tells_every_step():
    block = three()
    told = picture(block.function_block, block.explain(**C8), UNITS).alt
    assert told == (
        "Input distance = 12\N{NO-BREAK SPACE}m: medium 0.8333, far 0.1667. "
        "Input angle = 4\N{NO-BREAK SPACE}deg: zero 0.2, pos_small 0.8. 3 of 3 rules fired. "
        "Rule 1: MIN(0.8333, 0.8) = 0.8; power IS pos_medium: 0.8. "
        "Rule 2: MIN(0.8333, 0.2) = 0.2; power IS zero: 0.2. "
        "Rule 3: MIN(0.1667, 0.2) = 0.1667; power IS pos_medium: 0.1667. "
        "Output power, accumulated by MAX: zero 0.2 and pos_medium 0.8. "
        "power = (0 · 0.2 + 9 · 0.8) / (0.2 + 0.8) = 7.2  (CoGS)."
    )


def test_the_alternative_text_of_many_rules_tells_the_strongest():
    block = grid(7, smooth=True)
    told = picture(block.function_block, block.explain(error=2.3, change=1.6)).alt
    assert "49 of 49 rules fired. The 12 of the largest degrees:" in told
    assert told.count("Rule ") == 12


def test_an_explanation_is_drawn_of_a_block_that_remembers():
    instance = tip().instance()
    instance(service=7.5, food=8.0)
    explanation: Explanation = instance.explain(service=20.0, food=5.0)
    (axes,) = axes_of(draw(tip().function_block, explanation), "output tip")
    assert lines(axes, "result")[0].x == [instance.tip] * 2


def test_the_degree_of_a_rule_keeps_clear_of_the_degree_beside_it():
    figure, _ = drawn(crane(), distance=21.98, angle=-2.6530001)
    numbers = [each for each in texts(figure) if each[0].replace(".", "").isdigit()]
    for (one, a), (other, b) in combinations(numbers, 2):
        if min(a[3], b[3]) > max(a[1], b[1]):
            assert max(a[0], b[0]) - min(a[2], b[2]) > 0.8, (one, other)


def test_a_heading_does_not_end_a_page():
    def strip(height, *, heading=False):
        return Strip(height, lambda figure, page, top: None, heading)

    body, heading = strip(40.0), strip(10.0, heading=True)
    assert parted([body, body, heading, body], 100.0) == [[body, body], [heading, body]]
    assert parted([heading, strip(200.0), body], 100.0)[0][0] == heading
    assert [len(page) for page in parted([body] * 5, 100.0)] == [2, 2, 1]


def test_an_input_kept_in_its_range_shows_its_value_and_where_its_degrees_are_taken():
    model = three().function_block
    kept = replace(
        model,
        inputs=tuple(replace(each, range=(0.0, 10.0)) for each in model.inputs),
        fuzzifications=tuple(replace(each, clamped=True) for each in model.fuzzifications),
    )
    figure = draw(kept, Instance(kept, assemble(kept)).explain(distance=12.0, angle=4.0))
    (axes,) = axes_of(figure, "input distance")
    assert [line.x[0] for line in lines(axes, "value") + lines(axes, "clamped")] == [12.0, 10.0]
    assert dots(axes) == [(10.0, 1.0)]
    assert "distance = 12, taken as 10" in written(figure)


def test_no_label_of_the_oven_is_cut_though_its_rules_have_four_inputs():
    block = load(Path(__file__).parents[2] / "scenarios" / "oven" / "oven_completed.fcl")
    values = {"humidity": 49.67, "color.brown": 0.9257, "color.light": 0.04998, "color.dark": 0.02429}
    explanation = block.explain(**values)
    figure = draw(block.function_block, explanation, {})
    assert not [each for each in written(figure) if "…" in each]
    assert clashes(figure) == []


CLOSE_STEMS = """FUNCTION_BLOCK close
VAR_INPUT x: REAL; END_VAR
VAR_OUTPUT y: REAL; END_VAR
FUZZIFY x TERM a := (0, 1) (1, 0); TERM b := (0, 0) (1, 1) (2, 0); TERM c := (1, 0) (2, 1); END_FUZZIFY
DEFUZZIFY y TERM a := 1.0; TERM b := 1.4; TERM c := 9.0; METHOD: CoGS; DEFAULT := 0; END_DEFUZZIFY
RULEBLOCK r AND: MIN; ACCU: MAX;
RULE 1: IF x IS a THEN y IS a; RULE 2: IF x IS b THEN y IS b; RULE 3: IF x IS c THEN y IS c;
END_RULEBLOCK
END_FUNCTION_BLOCK"""


@given(st.floats(0.0, 0.99))
def test_the_result_hides_no_end_of_a_stem(x):
    figure, explanation = drawn(loads(CLOSE_STEMS), x=x)
    (axes,) = axes_of(figure, "output y")
    value = with_unit(explanation.defuzzified[0].value, "")
    (told,) = [each for each in axes.of(Text) if each.backed == 0.2 and each.text == value]
    width, half = text_width(told.text) / axes.width, 1.3 / axes.height
    left = told.x if told.across == "left" else told.x - width
    for place, degree in zip((1.0, 1.4, 9.0), explanation.accumulated[0].degrees, strict=True):
        across = (place - axes.x[0]) / (axes.x[1] - axes.x[0])
        if degree.degree > 0.0 and left <= across <= left + width:
            assert abs(degree.degree / axes.y[1] - told.y) > half

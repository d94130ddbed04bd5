"""Characteristics: undefined regions told exactly, the run drawn over them, nothing cut."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.block import loads
from fcl_sim.loop.trace import FuzzyRecord
from fcl_sim.report.canvas import Dot, Line, Shape
from fcl_sim.report.characteristics import characteristic, memberships, over_inputs
from fcl_sim.report.exits import told
from fcl_sim.report.sampling import Track, closer, curve, domains, following, surface
from fcl_sim.report.style import INK, VIOLATION_EDGE
from fcl_sim.report.surface import kept_points
from tests.report.legible import clashes, cut, texts
from tests.report.synthetic import EVIL, LONG, ONE_INPUT, THREE_INPUTS, crane, run

UNITS = {"distance": "m", "angle": "deg", "power": "kW"}


def record(block, **columns) -> FuzzyRecord:
    count = len(next(iter(columns.values())))
    return FuzzyRecord(
        input_names=block.inputs,
        output_names=block.outputs,
        rule_labels=("1",),
        inputs=np.column_stack([columns[name] for name in block.inputs]),
        outputs=np.column_stack([columns.get(name, np.zeros(count)) for name in block.outputs]),
        degrees=np.zeros((count, 1)),
        flags=np.ones((count, len(block.outputs)), dtype=bool),
    )


@pytest.mark.parametrize(
    ("distance", "angle", "share"),
    [((-10, 40), (-60, 60), 43 / 80), ((-10, 40), (-10, 10), 13 / 40), ((-10, 30), (-90, 90), 179 / 288)],
)
def test_the_share_without_a_rule_of_the_printed_crane_is_exact(distance, angle, share):
    block = crane()
    across, up = domains(block.function_block, UNITS)
    plane = (
        replace(across, low=distance[0], high=distance[1]),
        replace(up, low=angle[0], high=angle[1]),
    )
    found = surface(block, "power", plane, {}, "kW", "")
    area = np.diff(found.y)[:, None] * np.diff(found.x)[None, :]
    assert area[found.undefined].sum() / area.sum() == pytest.approx(share, rel=1e-12)


def test_a_map_shows_what_the_block_gives_in_the_middle_of_each_cell():
    block = crane()
    across, up = domains(block.function_block, UNITS)
    found = surface(block, "power", (across, up), {}, "kW", "")
    row, column = 17, 143
    x = (found.x[column] + found.x[column + 1]) / 2.0
    y = (found.y[row] + found.y[row + 1]) / 2.0
    assert found.values[row, column] == block.evaluate({"distance": x, "angle": y})["power"]


def test_a_curve_is_undefined_between_terms_that_do_not_meet():
    block = loads(ONE_INPUT)
    (level,) = domains(block.function_block, {"level": "m"})
    found = curve(block, "opening", level, {}, "%")
    inside = (found.x >= 2.0) & (found.x <= 5.0)
    assert np.array_equal(found.undefined, inside)


def test_domains_cover_all_terms_and_have_their_units():
    across, up = domains(crane().function_block, {"DISTANCE": "m", "angle": "deg"})
    assert (across.unit, up.unit) == ("m", "deg")
    assert across.low < -5.0 < 22.0 < across.high
    assert across.knots == (-5.0, 0.0, 5.0, 10.0, 22.0)


def test_a_degree_brought_in_from_outside_goes_from_0_to_1():
    text = ONE_INPUT.replace("level: REAL;", "level: REAL; damp: REAL;").replace(
        "IF level IS low", "IF level IS low AND damp"
    )
    damp = domains(loads(text).function_block, {})[1]
    assert (damp.name, damp.low, damp.high) == ("damp", 0.0, 1.0)


RUNS = st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=20).map(np.array)


@given(RUNS)
def test_a_domain_follows_a_run_within_reason_and_never_shrinks(values):
    (level,) = domains(loads(ONE_INPUT).function_block, {})
    wider = following(level, values)
    span = level.high - level.low
    assert wider.low <= level.low
    assert wider.high >= level.high
    assert wider.high - wider.low <= 5.0 * span * (1 + 1e-12)


def test_the_closer_look_is_taken_only_where_it_shows_more():
    plane = domains(crane().function_block, UNITS)
    whole = [np.linspace(each.low, each.high, 9) for each in plane]
    assert closer(plane, whole) is None
    near = closer(plane, [whole[0], np.array([-4.0, 4.0])])
    assert near is not None
    assert -6.0 < near[1].low < -4.0 < 4.0 < near[1].high < 6.0


@given(RUNS, RUNS)
def test_a_thinned_path_keeps_its_ends(x, y):
    count = min(len(x), len(y))
    x, y = x[:count], y[:count]
    kept = kept_points(Track(x, y, np.ones(count, dtype=bool)), (1.0, 1.0))
    assert (kept[0], kept[-1]) == (0, count - 1)


def test_a_thinned_path_keeps_where_rules_stop_being_active():
    still = np.zeros(9)
    active = np.array([True] * 4 + [False] * 2 + [True] * 3)
    kept = kept_points(Track(still, still, active), (1.0, 1.0))
    assert active[kept].tolist() == [True, False, True, True]


def test_the_way_without_an_active_rule_is_drawn_in_another_colour(tmp_path):
    (picture,) = over_inputs(run(tmp_path))
    colours = [line.colour for line in picture.draw().axes[0].of(Line)]
    assert colours.count(VIOLATION_EDGE) == 1


def test_two_inputs_make_a_map_with_the_run_on_it(tmp_path):
    (picture,) = over_inputs(run(tmp_path))
    assert picture.name == "base-controller.rules"
    assert picture.caption == "Run base: power over distance and angle. Hatched: no rule is active."
    assert "no rule is active on" in picture.alt
    assert "The run goes from (25 m, 0 deg) to" in picture.alt.replace("\N{NO-BREAK SPACE}", " ")
    figure = picture.draw()
    drawn = [text for text, _ in texts(figure)]
    assert {"distance [m]", "angle [deg]", "power [kW]"} <= set(drawn)
    assert any(each.hatched for axes in figure.axes for each in axes.of(Shape))


def test_one_input_makes_a_curve():
    block = loads(ONE_INPUT)
    level = np.linspace(0.0, 8.0, 30)
    seen = record(block, level=level, opening=np.zeros(30))
    (picture,) = characteristic(block, {"level": "m", "opening": "%"}, "valve", seen)
    assert picture.alt.startswith("Curve of opening over level")
    figure = picture.draw()
    assert {"level [m]", "opening [%]"} <= {text for text, _ in texts(figure)}


def test_of_more_inputs_the_two_that_moved_most_are_drawn_and_the_others_held_at_their_median():
    block = loads(THREE_INPUTS)
    step = np.linspace(0.0, 1.0, 11)
    seen = record(block, a=step, b=0.25 + 0.0 * step, c=step**2)
    pictures = characteristic(block, {}, "mixer", seen)
    assert [each.name for each in pictures] == ["mixer-u", "mixer-v"]
    assert pictures[0].caption == "u over a and c; b = 0.25 held at the run's median."


def test_of_an_input_that_is_held_it_is_told_from_where_to_where_it_went():
    block = loads(THREE_INPUTS)
    step = np.linspace(0.0, 1.0, 11)
    seen = record(block, a=step, b=0.2 + 0.1 * step, c=step)
    picture = characteristic(block, {"b": "m"}, "mixer", seen)[0]
    assert "b = 0.25\N{NO-BREAK SPACE}m (of 0.2 to 0.3) held at the run's median" in picture.caption


@pytest.mark.parametrize(("active", "colour"), [(True, INK), (False, VIOLATION_EDGE)])
def test_a_way_that_ends_where_no_rule_is_active_ends_in_another_mark(active, colour, tmp_path):
    made = run(tmp_path)
    made.trace.fuzzy["controller.rules"].flags[-5:] = active
    (picture,) = over_inputs(made)
    (end,) = (dot for dot in picture.draw().axes[0].of(Dot) if dot.kind == "square")
    assert end.colour == colour
    assert bool(end.face) == (not active)


def test_without_a_run_the_others_are_held_in_the_middle():
    picture = characteristic(loads(THREE_INPUTS), {}, "mixer")[0]
    assert picture.caption == "u over a and b; c = 0.5 held."


def test_a_run_that_stood_still_can_be_drawn():
    block = crane()
    still = record(block, distance=np.full(5, 10.0), angle=np.zeros(5))
    for picture in characteristic(block, UNITS, "still", still):
        picture.draw()


def test_a_run_with_values_that_are_not_finite_can_be_drawn():
    block = crane()
    broken = record(block, distance=np.array([10.0, np.nan]), angle=np.array([0.0, np.inf]))
    never = record(block, distance=np.full(2, np.nan), angle=np.full(2, np.nan))
    for seen in (broken, never):
        for picture in characteristic(block, UNITS, "broken", seen):
            picture.draw()


def renamed(text: str) -> str:
    for name in ("distance", "angle", "power"):
        text = text.replace(name, f"{name}_{LONG.replace('.', '_').replace('/', '_')}")
    return text


@pytest.mark.parametrize("text", [None, ONE_INPUT, THREE_INPUTS], ids=["crane", "one", "three"])
@pytest.mark.parametrize("unit", ["", "m", EVIL])
def test_no_text_is_cut_and_no_two_meet(text, unit):
    block = loads(text) if text else crane()
    units = dict.fromkeys((*block.inputs, *block.outputs), unit)
    for picture in characteristic(block, units, "x"):
        figure = picture.draw()
        assert cut(figure) == []
        assert clashes(figure) == []


def test_long_names_wrap(tmp_path):
    from tests.report.synthetic import CRANE

    for picture in characteristic(loads(renamed(CRANE)), {}, "x"):
        figure = picture.draw()
        assert cut(figure) == []
        assert clashes(figure) == []


def far_run(block):
    """A run that goes out of the map to the right, comes back, and goes out at its upper edge."""
    return record(
        block, distance=np.array([5.0, 400.0, 5.0, 5.0, 5.0]), angle=np.array([0.0, 0.0, 0.0, 900.0, 0.0])
    )


def test_where_a_run_leaves_the_map_an_arrow_head_stands_at_the_edge():
    (found,) = characteristic(crane(), UNITS, "far", far_run(crane()), np.arange(5.0))
    assert found.caption.endswith("The run leaves the picture where an arrow head stands at its edge.")
    axes = found.draw().axes[0]
    right, top = axes.of(Shape, "exit")
    assert (right.x[0], right.y[0]) == (pytest.approx(axes.x[1]), pytest.approx(0.0))
    assert (top.x[0], top.y[0]) == (pytest.approx(5.0), pytest.approx(axes.y[1]))
    for head in (right, top):
        assert axes.x[0] <= min(head.x) <= max(head.x) <= axes.x[1] * (1 + 1e-12)
        assert axes.y[0] <= min(head.y) <= max(head.y) <= axes.y[1] * (1 + 1e-12)


def test_of_a_run_that_stays_on_the_map_nothing_is_said():
    stays = record(crane(), distance=np.array([5.0, 10.0]), angle=np.array([0.0, 1.0]))
    (found,) = characteristic(crane(), UNITS, "near", stays, np.arange(2.0))
    assert "leaves" not in found.caption
    assert not found.draw().axes[0].of(Shape, "exit")


@pytest.mark.parametrize(
    ("x", "sentence"),
    [
        ([0.5, 0.6], ""),
        ([0.5, 2.0], "The run leaves the picture where an arrow head stands at its edge."),
        ([2.0, 0.5], "The run begins outside of the picture."),
        ([2.0, 3.0, np.nan], "The run is outside of the picture all the time."),
    ],
)
def test_it_is_told_how_a_run_is_outside(x, sentence):
    values = np.array(x)
    assert told(values, np.zeros(len(x)), (0.0, 1.0), (0.0, 1.0)) == sentence


APART = THREE_INPUTS.replace(
    "RULE 1: IF a IS lo AND b IS lo AND c IS lo THEN u IS small, v IS large;\n"
    "    RULE 2: IF a IS hi OR b IS hi OR c IS hi THEN u IS large, v IS small;",
    "RULE 1: IF a IS lo AND b IS lo THEN u IS small; RULE 2: IF a IS hi OR b IS hi THEN u IS large;"
    "RULE 3: IF b IS lo AND c IS lo THEN v IS small; RULE 4: IF b IS hi OR c IS hi THEN v IS large;",
)


def test_each_output_is_drawn_over_the_inputs_that_move_it():
    block = loads(APART, "mixer.fcl")
    u, v = characteristic(block, {}, "mixer")
    assert u.caption.startswith("u over a and b; c = 0.5 held")
    assert v.caption.startswith("v over b and c; a = 0.5 held")


MOVING = """FUNCTION_BLOCK moving
VAR_INPUT x: REAL; pressure: REAL; low: REAL; high: REAL; END_VAR
VAR_OUTPUT y: REAL; END_VAR
FUZZIFY x
    TERM small := (low, 1) (high, 0);
    TERM large := (low, 0) (high, 1);
END_FUZZIFY
FUZZIFY pressure
    TERM few := (0, 1) (10, 0);
    TERM much := (0, 0) (10, 1);
END_FUZZIFY
DEFUZZIFY y TERM no := 0; TERM yes := 10; METHOD: CoGS; DEFAULT := 0; END_DEFUZZIFY
RULEBLOCK first
    RULE 1: IF x IS small OR pressure IS few THEN y IS no;
    RULE 2: IF x IS large AND pressure IS much THEN y IS yes;
END_RULEBLOCK
END_FUNCTION_BLOCK"""


def seen_of_moving():
    inputs = np.column_stack(
        [np.linspace(20.0, 60.0, 9), np.linspace(2.0, 8.0, 9), np.full(9, 30.0), np.full(9, 50.0)]
    )
    return FuzzyRecord(
        input_names=("x", "pressure", "low", "high"),
        output_names=("y",),
        rule_labels=("1", "2"),
        inputs=inputs,
        outputs=np.full((9, 1), 5.0),
        degrees=np.full((9, 2), 0.5),
        flags=np.ones((9, 1), np.bool_),
    )


@pytest.mark.parametrize("drawn", [True, False])
def test_points_that_inputs_move_stand_where_a_run_had_them(drawn):
    record = seen_of_moving()
    given = {"record": record, "time": np.arange(9.0)} if drawn else {"held": record}
    (picture,) = characteristic(loads(MOVING), {}, "moving", **given)
    assert "over x and pressure" in picture.caption
    assert f"low = 30 and high = 50 held at {'the' if drawn else 'a'} run's median" in picture.caption
    axes = picture.draw().axes[0]
    assert axes.x[0] <= 30.0
    assert axes.x[1] >= 50.0
    (terms,) = memberships(loads(MOVING), {}, "moving", {"base": record})
    assert "stand at the medians of run base" in terms.caption
    left, right = terms.draw().axes[0].x
    assert left <= 30.0
    assert right >= 50.0


def test_points_that_do_not_move_are_drawn_without_a_word(tmp_path):
    (terms,) = memberships(crane(), {}, "crane", {"base": run(tmp_path).trace.fuzzy["controller.rules"]})
    assert "medians" not in terms.caption

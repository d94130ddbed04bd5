"""Time plots: every signal once, bands and violations where they belong, nothing cut."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.judge.corridor import edges
from fcl_sim.judge.verdict import Band, Corridor, Status
from fcl_sim.loop.diagram import Node
from fcl_sim.report.bands import RIGHT, apart, draw_corridors, focus_on, listed, worth_showing
from fcl_sim.report.canvas import Axes, Line, Shape
from fcl_sim.report.lettering import text_width
from fcl_sim.report.pictures import all_runs, over_time
from fcl_sim.report.style import BAND, SMALL, VIOLATION, stroke
from fcl_sim.report.time_plots import Shown, lanes, lanes_of, thinned, time_plot
from tests.report.legible import clashes, cut, texts
from tests.report.synthetic import EVIL, LONG, of_formula, outcome, requirement, run, trace, verdict, verdicts


def shown(kind: str = "settles", label: str = "base", **given) -> Shown:
    return Shown(
        label=label,
        trace=given.get("trace") or trace(kind),
        duration=60.0,
        verdicts=given.get("verdicts") or verdicts(kind),
    )


def figure(*runs: Shown):
    return time_plot(runs, lanes(runs[0]))


def test_signals_that_are_equal_are_drawn_once_under_all_their_names():
    names = [lane.names for lane in lanes(shown()) if lane.focus is None]
    assert sorted(names) == [
        ("controller.rules.power",),
        ("crane.distance", "controller.distance"),
        ("crane.sway",),
    ]


def shifted(found, by=7.0):
    """Return a trace whose sensor is off: what the controller reads is not what the crane does."""
    values = found.values.copy()
    values[:, 2] += by
    return replace(found, values=values)


def test_signals_that_part_in_any_run_have_an_axis_each():
    runs = [shown(), shown(label="sensor off", trace=shifted(trace()))]
    names = [lane.names for lane in lanes_of(runs) if lane.focus is None]
    assert ("crane.distance",) in names
    assert ("controller.distance",) in names
    beside = [lane.names for lane in lanes_of(runs[:1], runs[1:]) if lane.focus is None]
    assert sorted(beside) == sorted(names)  # one that is drawn behind counts, too


def test_a_signal_that_only_a_later_run_has_gets_an_axis():
    other = trace(names=("crane.distance", "crane.sway", "controller.distance", "valve"))
    found = lanes_of([shown(), shown(label="other", trace=other)])
    assert {"valve", "controller.rules.power"} <= {name for lane in found for name in lane.names}


def test_what_only_a_variant_is_judged_by_is_among_the_judged_signals(tmp_path):
    sway = verdict(id="CR-9", signal="crane.sway", unit="deg")
    runs = [run(tmp_path, verdicts=(verdict(),)), run(tmp_path, "v2", verdicts=(verdict(), sway))]
    (picture,) = all_runs(outcome(tmp_path, *runs))
    assert "crane.sway" in [axes.label for axes in picture.draw().axes]
    assert "CR-9: PASS" in picture.alt


def test_the_text_of_runs_tells_the_time_of_the_longest(tmp_path):
    made = run(tmp_path, "long")
    timing = replace(made.diagram.timing, duration=120 * 10**9)
    longer = replace(made, diagram=replace(made.diagram, timing=timing))
    (picture,) = all_runs(outcome(tmp_path, run(tmp_path), longer))
    assert " over 120\N{NO-BREAK SPACE}s, run base and long." in picture.alt


def test_judged_signals_stand_first():
    judged = [lane.judged for lane in lanes(shown())]
    assert judged == sorted(judged, reverse=True)


def test_equal_values_in_other_units_are_not_one_signal():
    run = trace()
    other = replace(run, units={**run.units, "controller.distance": "mm"})
    assert ("crane.distance",) in [lane.names for lane in lanes(shown(trace=other))]


def test_a_signal_with_narrow_bounds_is_looked_at_closely():
    lane = next(lane for lane in lanes(shown()) if lane.focus)
    assert lane.signal == "crane.distance"
    assert lane.focus == pytest.approx((-1.1, 1.1))


@pytest.mark.parametrize(
    ("low", "high", "close"), [(-0.5, 0.5, True), (-5.0, 5.0, False), (None, 0.5, False), (0.0, 0.0, False)]
)
def test_only_narrow_bounds_on_both_sides_ask_for_a_closer_look(low, high, close):
    band = Band(signal="x", low=low, high=high, start=0.0, end=1.0)
    assert (focus_on([band], np.linspace(0.0, 25.0, 9)) is not None) == close


def test_the_closer_look_is_at_what_is_narrow_whatever_wide_bounds_there_are():
    bands = [Band(signal="x", low=-each, high=each, start=0.0, end=1.0) for each in (0.1, 0.5, 9.0)]
    assert focus_on(bands, np.linspace(0.0, 25.0, 9)) == pytest.approx((-1.1, 1.1))


def test_narrow_bounds_here_and_there_have_no_closer_look():
    bands = [Band(signal="x", low=each, high=each + 0.1, start=0.0, end=1.0) for each in (2.0, 9.0, 20.0)]
    assert focus_on(bands, np.linspace(0.0, 25.0, 9)) is None


def test_of_a_signal_at_rest_a_bound_is_shown_though_its_last_digit_moves():
    for high in (20.0, math.nextafter(20.0, 30.0)):
        assert worth_showing(22.0, 20.0, high)


@pytest.mark.filterwarnings("error")
def test_a_signal_that_spans_more_than_a_number_holds_is_looked_at_closely():
    band = Band(signal="x", low=-0.5, high=0.5, start=0.0, end=1.0)
    assert focus_on([band], np.array([-1.5e308, 1.5e308])) is not None


SERIES = st.lists(st.one_of(st.floats(-1e9, 1e9), st.just(float("nan"))), min_size=1, max_size=400)


@given(SERIES, st.integers(1, 20))
def test_thinning_keeps_the_ends_and_the_extremes(values, buckets):
    series = np.array(values)
    time, kept = thinned(np.arange(len(series), dtype=float), series, buckets)
    assert len(time) <= 5 * buckets + 1
    assert (time[0], time[-1]) == (0.0, len(series) - 1.0)
    assert np.array_equal(kept, series[time.astype(int)], equal_nan=True)
    if np.isfinite(series).any():
        assert (np.nanmin(kept), np.nanmax(kept)) == (np.nanmin(series), np.nanmax(series))


@given(st.integers(1, 999), st.sampled_from([1.0, -1.0]))
def test_a_step_stays_upright_when_it_is_thinned(at, height):
    time, kept = thinned(np.arange(1000.0), np.where(np.arange(1000) < at, 0.0, height), 20)
    before = int(np.flatnonzero(kept != height)[-1])
    assert (time[before], time[before + 1]) == (at - 1.0, float(at))


@given(st.lists(st.floats(0.0, 1.0), max_size=8), st.floats(0.01, 0.1))
def test_labels_beside_bounds_are_moved_apart(places, least):
    moved = apart(sorted(places), least)
    assert all(upper - lower >= least - 1e-9 for lower, upper in itertools.pairwise(moved))
    assert all(place <= 1.0 for place in moved)


@given(st.lists(st.floats(0.0, 1.0), max_size=8, unique=True))
def test_labels_that_stand_apart_stay_where_they_are(places):
    assert apart(sorted(places), 0.0) == sorted(places)


def test_every_axis_names_its_unit():
    drawn = [text for text, _ in texts(figure(shown()))]
    for label in ("crane.distance [m]", "crane.sway [deg]", "controller.rules.power [kW]", "time [s]"):
        assert label in drawn


def test_a_signal_without_a_unit_says_so():
    run = trace()
    bare = replace(run, units=dict.fromkeys(run.units, ""))
    assert "crane.sway [1]" in [text for text, _ in texts(figure(shown(trace=bare)))]


def spans(figure, colour: str) -> list[tuple[float, float]]:
    return [
        (min(each.x), max(each.x)) for axes in figure.axes for each in axes.of(Shape) if each.face == colour
    ]


def test_a_violation_is_shaded_from_its_start_to_its_end():
    assert set(spans(figure(shown("swings")), VIOLATION)) == {(35.0, 60.0)}
    assert spans(figure(shown("settles")), VIOLATION) == []


def test_a_violation_at_the_last_instant_is_wide_enough_to_be_seen():
    band = Band(signal="crane.distance", low=-0.5, high=0.5, start=60.0, end=60.0)
    judged = replace(verdict(Status.FAIL, 0.7), band=band, violation=(60.0, 60.0))
    drawn = figure(shown("swings", verdicts=(judged,)))
    for start, end in spans(drawn, VIOLATION):
        assert (end - start) / 60.0 * drawn.axes[0].width >= 0.69
        assert end == 60.0
    assert spans(drawn, VIOLATION)


@pytest.mark.parametrize("violated", [True, False])
def test_the_caption_explains_what_is_shaded_and_names_formulas(violated, tmp_path):
    judged = of_formula("crane.distance < 5 m", Status.FAIL if violated else Status.PASS)
    (picture,) = over_time(replace(run(tmp_path), verdicts=(judged,)))
    assert ("A shaded stretch with a bar" in picture.caption) == violated
    assert "CR-6, which is a formula, has no band." in picture.caption
    assert ("of a formula the first that does, in what is to blame." in picture.caption) == violated


@pytest.mark.parametrize("at", [30.0, 0.0, 60.0])
def test_a_band_of_an_instant_ends_there_and_is_wide_enough_to_be_seen(at):
    band = Band(signal="crane.distance", low=-1.0, high=1.0, start=at, end=at)
    judged = replace(verdict(), band=band)
    drawn = figure(shown(verdicts=(judged,)))
    found = spans(drawn, BAND)
    assert found
    for start, end in found:
        assert (end - start) / 60.0 * drawn.axes[0].width >= 3.9
        assert 0.0 <= start <= at <= end <= 60.0
        assert start == 0.0 or end == pytest.approx(at)


def strokes(figure) -> list[tuple[Axes, Line]]:
    return [(axes, each) for axes in figure.axes for each in axes.of(Line) if each.label == "violation"]


def test_of_several_runs_each_marks_its_violation_with_its_stroke():
    drawn = strokes(figure(shown("settles"), shown("swings", "raw")))
    assert {tuple(each.x) for _, each in drawn} == {(35.0, 60.0)}
    assert {(each.colour, each.dashes) for _, each in drawn} == {stroke(1)}


@pytest.mark.parametrize("count", [2, 5, 40])
def test_marks_of_violations_never_cover_a_line(count):
    drawn = strokes(figure(*(shown("swings", f"run {each}") for each in range(count))))
    assert len({float(each.y[0]) for _, each in drawn}) == count
    for axes, each in drawn:
        lines = [line for line in axes.of(Line) if line.label == "run"]
        assert max(np.max(line.y) for line in lines) < each.y[0] < axes.y[1]


def test_a_violated_formula_is_shaded_in_all_of_its_signals():
    missed = of_formula("always (crane.sway < 1 deg or crane.distance > 1 m)", Status.FAIL, -0.5)
    run = shown(verdicts=(missed,))
    assert [lane.signal for lane in lanes(run) if lane.judged] == ["crane.distance", "crane.sway"]
    assert spans(figure(run), VIOLATION).count((20.0, 25.0)) == 2


def test_a_corridor_is_drawn_with_its_edges_whole():
    corridor = Corridor(
        name="k.csv", signal="crane.sway", ticks=(0, 60_000_000_000), low=(-40.0, -1.0), high=(math.nan,) * 2
    )
    asked = requirement(metric="", signal="", corridor=corridor, maximum=None)
    judged = replace(verdict(), requirement=asked, band=None)
    run = shown(verdicts=(judged,))
    (lane,) = [each for each in lanes(run) if each.judged]
    (axes,) = time_plot([run], [lane]).axes
    assert axes.y[0] < -40.0
    assert [0.0, 60.0] in [[*line.x] for line in axes.of(Line)]


def corridor(low, high):
    ticks = tuple(each * 10**10 for each in range(len(low)))
    return Corridor(name="k.csv", signal="crane.sway", ticks=ticks, low=low, high=high)


CELL = st.one_of(st.just(math.nan), st.floats(-19.0, 0.0))


@given(st.lists(st.tuples(CELL, CELL), min_size=2, max_size=7))
def test_what_a_corridor_shades_is_what_its_judge_allows(rows):
    asked = corridor(tuple(row[0] for row in rows), tuple(-row[1] for row in rows))
    axes = Axes(0.0, 0.0, 100.0, 20.0)
    axes.x, axes.y = (0.0, 60.0), (-20.0, 20.0)
    draw_corridors(axes, [asked])
    shapes = axes.of(Shape)
    for middle in np.arange(len(rows) - 1) * 10.0 + 5.0:
        low, high = (float(each[0]) for each in edges(asked, np.array([middle * 1e9], dtype=np.int64)))
        around = [each for each in shapes if min(each.x) < middle < max(each.x)]
        if math.isinf(low) and math.isinf(high):
            assert around == []
            continue
        (shape,) = around
        half = len(shape.x) // 2
        assert np.interp(middle, shape.x[:half], shape.y[:half]) == pytest.approx(max(low, -20.0))
        assert np.interp(middle, shape.x[half:][::-1], shape.y[half:][::-1]) == pytest.approx(min(high, 20.0))


def test_a_requirement_is_named_once_beside_bounds_that_differ_only_in_time():
    early = replace(verdict(), band=Band(signal="crane.distance", low=-0.5, high=0.5, start=30.0, end=60.0))
    runs = [shown(verdicts=(verdict(),)), shown(label="early", verdicts=(early,))]
    told = [text for text, _ in texts(time_plot(runs, lanes_of(runs))) if "CR-1" in text]
    assert all(text.count("CR-1") == 1 for text in told)
    assert told


@given(st.lists(st.integers(1, 99), min_size=1, max_size=12, unique=True), st.sampled_from(["", " ↑25.5"]))
def test_names_beside_a_bound_are_whole_and_fit_and_it_is_seen_where_some_are_left_out(numbers, where):
    ids = [f"CR-{each}" for each in numbers]
    text = listed(ids, where)
    assert text_width(text, SMALL) <= RIGHT
    names = text.removesuffix(where).removesuffix(where[:2]).split(", ")
    assert names == ids or (names[-1] == "…" and names[:-1] == ids[: len(names) - 1])


def test_a_name_longer_than_there_is_room_is_cut():
    assert text_width(listed([LONG, "CR-2"], ""), SMALL) <= RIGHT
    assert listed([LONG, "CR-2"], "").endswith(", …")


def test_scans_without_an_active_rule_are_hatched_on_the_output_alone():
    drawn = figure(shown())
    (hatched,) = [each for axes in drawn.axes for each in axes.of(Shape) if each.hatched]
    assert (min(hatched.x), max(hatched.x)) == (20.0, 30.5)


def test_a_fault_is_marked_and_the_time_that_is_missing_stays_in_the_picture():
    drawn = figure(shown("fault"))
    assert "FAULT at 19.5 s" in [text for text, _ in texts(drawn)]
    assert drawn.axes[-1].x == (0.0, 60.0)


@pytest.mark.parametrize(
    "runs",
    [
        [shown()],
        [shown("swings")],
        [shown("fault")],
        [shown(), shown("swings", "raw_distance"), shown("fault", "early")],
        [shown(label=LONG), shown("swings", EVIL), *(shown("fault", f"run {i} {LONG}") for i in range(6))],
        [shown(verdicts=[verdict(id=f"REQ-{i}", maximum=5.0 * i) for i in range(1, 5)])],
        [shown(trace=trace(names=(LONG * 3, EVIL, f"{LONG} {EVIL}", "x")), verdicts=[verdict(signal="x")])],
    ],
    ids=["base", "violated", "fault", "several", "many long names", "bounds close by", "long signals"],
)
def test_no_text_is_cut_and_no_two_meet(runs):
    drawn = figure(*runs)
    assert cut(drawn) == []
    assert clashes(drawn) == []


def test_a_run_without_a_sample_can_be_drawn():
    run = trace()
    empty = replace(run, ticks=run.ticks[:0], values=run.values[:0], fuzzy={})
    figure(shown(trace=empty, verdicts=[verdict(Status.FAULT, None)]))


def test_a_signal_that_is_never_finite_can_be_drawn():
    run = trace()
    figure(shown(trace=replace(run, values=run.values * np.nan)))


def test_a_signal_that_never_changes_is_told_instead_of_drawn(tmp_path):
    names = ("crane.distance", "crane.sway", "setpoint", "controller.rules.power")
    found = trace(names=names)
    values = found.values.copy()
    values[:, 2] = 2.5
    (picture,) = over_time(run(tmp_path, trace=replace(found, values=values)))
    assert "setpoint" not in [each.label for each in picture.draw().axes]
    assert picture.caption.endswith(" Constant: setpoint = 2.5\N{NO-BREAK SPACE}m.")


def wired(made, *nodes):
    """Return a run with some sources before its rules, whose trace has a setpoint and a signal to spare."""
    found = trace(names=("crane.distance", "crane.sway", "setpoint", "spare"))
    values = found.values.copy()
    values[:, 2] += 1.0
    diagram = replace(made.diagram, nodes=(*nodes, *made.diagram.nodes))
    return replace(made, diagram=diagram, trace=replace(found, values=values), verdicts=(verdict(),))


def test_a_run_shows_what_is_asked_of_it_and_what_is_set_and_names_the_rest(tmp_path):
    source = Node(name="setpoint", type="staircase", inputs={}, parameters={})
    noise = Node(name="spare", type="noise", inputs={}, parameters={})
    base = wired(run(tmp_path), source, noise)
    (picture,) = over_time(base)
    assert [each.label for each in picture.draw().axes] == ["crane.distance", "crane.distance", "setpoint"]
    assert picture.caption.endswith(" Recorded and not drawn: crane.sway and spare.")
    (again,) = over_time(replace(base, variant="again"), base)
    assert [each.label for each in again.draw().axes] == ["crane.distance", "crane.distance"]
    assert " As in the base run: setpoint." in again.caption


def test_a_run_of_which_nothing_is_asked_shows_every_signal(tmp_path):
    made = run(tmp_path)
    bare = replace(made, verdicts=(), diagram=replace(made.diagram, nodes=()))
    (picture,) = over_time(bare)
    assert "drawn" not in picture.caption
    assert len(picture.draw().axes) == len(lanes(replace(shown(), verdicts=())))


def test_a_signal_that_moves_by_the_grain_of_binary32_is_at_rest(tmp_path):
    names = ("crane.distance", "crane.sway", "rules.gain", "controller.rules.power")
    found = trace(names=names)
    values = found.values.copy()
    values[:, 2] = 24.0 + 1e-6 * np.sin(found.time)
    (picture,) = over_time(run(tmp_path, trace=replace(found, values=values)))
    assert " Constant: rules.gain = 24" in picture.caption

"""The axes of the page, whatever they are of: rounding, huge numbers, nothing."""

import math
import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.block import loads
from fcl_sim.report.html.maps import characteristics
from fcl_sim.report.html.pack import Pack
from tests.report.html.scripts import Script
from tests.report.synthetic import CRANE, crane, trace

SCRIPT = Script("data.js", "numbers.js", "lanes.js", "maps.js")

LANE = """(values, bounds) => {
  const clock = clockOf({ begin: 0, step: 1e9, count: values.length }, null);
  const line = new Line(clock, { kept: null, values, grain: 0 });
  const end = values.length - 1;
  const bands = bounds.map((each) => ({ low: each, high: null, from: 0, to: end, far: 1.5 }));
  const lane = Object.create(Lane.prototype);
  const told = { bands, corridors: [], focus: null };
  Object.assign(lane, { lines: [line], older: [], scenario: { older: [], end }, told });
  lane.whole = lane.extent([line]);
  const state = { window: [0, end], shown: new Set([0]) };
  const [low, high] = lane.limits(state, () => true);
  const places = [low, high, ...values].map((each) => lane.down(each));
  const path = lane.path(line);
  return { whole: lane.whole, limits: [low, high], places, path, marks: marks(low, high, 4) };
}"""

ANY = st.floats(allow_nan=False, allow_infinity=False)


def lane(values, bounds=()):
    """Return how the script lays out the axis of a signal."""
    return SCRIPT.call(LANE, [float(each) for each in values], list(bounds))


@given(st.lists(ANY, min_size=2, max_size=9), st.lists(ANY, max_size=2))
def test_every_signal_lies_within_an_axis_that_has_a_length(values, bounds):
    found = lane(values, bounds)
    for low, high in (found["whole"], found["limits"]):
        assert low < high
        assert math.isfinite(high - low)
    edge = np.finfo(float).max / 8
    assert found["limits"][0] <= max(min(values), -edge)
    assert found["limits"][1] >= min(max(values), edge)
    assert None not in found["places"]
    assert "NaN" not in found["path"]
    assert len(found["marks"]) <= 5


@given(st.floats(-1e18, 1e18), st.integers(0, 12))
def test_a_signal_that_moves_by_rounding_is_drawn_as_the_constant_it_is(value, ulps):
    other = value
    for _ in range(ulps):
        other = math.nextafter(other, math.inf)
    low, high = lane([value, other, value])["limits"]
    assert high - low >= 0.19 * abs(value)


def test_a_bound_beside_a_constant_is_shown_as_it_is_on_paper():
    for moved in (20.0, math.nextafter(20.0, 30.0)):
        low, high = lane([20.0, moved], [22.0])["limits"]
        assert low < 20.0
        assert high > 22.0


WINDOW = LANE.replace("window: [0, end]", "window: [1, 2]")


def test_where_nothing_moves_within_the_window_the_axis_keeps_the_measure_of_the_whole():
    found = SCRIPT.call(WINDOW, [20.0, 20.0001, 20.0001, 20.0001], [])
    low, high = found["limits"]
    assert high - low <= 3 * (found["whole"][1] - found["whole"][0])


@given(ANY, ANY, st.integers(2, 9))
def test_marks_come_to_an_end_on_any_axis(one, other, most):
    low, high = sorted((one, other))
    found = SCRIPT.call("marks", low, high, most)
    assert len(found) <= most + 1
    labels = [each["label"] for each in found]
    assert len(set(labels)) == len(labels)


@given(st.floats(1e-300, 1e17), st.integers(1, 40), st.integers(2, 9))
def test_between_neighbouring_numbers_there_is_no_mark(low, ulps, most):
    assert SCRIPT.call("marks", low, low + ulps * math.ulp(low), most) == []


def test_a_signal_that_spans_more_than_a_number_holds_keeps_its_values_at_the_cursor():
    pack = Pack(50)
    number = pack.series(np.array([-1.5e308, 1.5e308, 1.0e308]))
    read = """(made, body, times) => {
      const clock = clockOf({ begin: 0, step: 1e9, count: 3 }, null);
      const line = new Line(clock, decoded(Uint8Array.from(body), made));
      return [0, 0.5, 1, 2].map((time) => line.at(time));
    }"""
    found = SCRIPT.call(read, pack._series[number], list(pack._body))
    assert found == pytest.approx([-1.5e308, 0.0, 1.5e308, 1.0e308], abs=1e304)


CURVE = """(values) => {
  const drawn = Object.create(Characteristic.prototype);
  const series = { x: { values: values.map((_, at) => at) }, y: { values: Float64Array.from(values) } };
  drawn.told = { x: "x", values: "y", undefined: [] };
  drawn.pack = { series: (name) => series[name] };
  drawn.back = { replaceChildren() {} };
  globalThis.svg = (name, given) => given;
  drawn.drawCurve();
  return drawn.limits;
}"""


@pytest.mark.parametrize(
    ("values", "least"),
    [
        ([20.0, math.nextafter(20.0, 30.0)], 3.9),
        ([1e17] * 3, 1e16),
        ([-1.7e308, 1.7e308], 1e307),
        ([0, 0], 1.9),
    ],
)
def test_a_curve_has_an_axis_with_a_length(values, least):
    _, _, low, high = SCRIPT.call(CURVE, values)
    assert least <= high - low < math.inf


WAY = """(x, at) => {
  const clock = clockOf({ begin: 0, step: 1e9, count: x.length }, null);
  const values = x.map((each) => (each === null ? NaN : each));
  const line = new Line(clock, { kept: null, values, grain: 0 });
  const drawn = Object.create(Characteristic.prototype);
  drawn.limits = [0, 10, 0, 10];
  const kept = {};
  for (const name of ["path", "lost", "ahead", "halo"]) {
    drawn[name] = { setAttribute: (_, d) => { kept[name] = d; } };
  }
  drawn.drawWay(line, line, at, []);
  return kept;
}"""


@pytest.mark.parametrize("at", [0.0, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0])
def test_a_way_with_a_hole_goes_on_behind_it_wherever_the_cursor_is(at):
    found = SCRIPT.call(WAY, [1.0, 2.0, None, 4.0, 5.0, 6.0], at)
    assert "NaN" not in "".join(found.values())
    assert found["halo"].endswith("600 400") or at == 5.0
    for place in ("100 900", "200 800", "400 600", "500 500", "600 400"):
        assert place in found["halo"]


def record_of_crane():
    return trace().fuzzy["controller.rules"]


def at(number):
    """Return the crane's rules with all their outputs at one number."""
    return loads(
        re.sub(r"(TERM (?:neg|pos)_(?:high|medium)|TERM zero) := [-0-9]+;", rf"\1 := {number};", CRANE)
    )


@pytest.mark.parametrize("number", ["1.0E17", "20", "-3.0E299"])
def test_the_scale_of_a_map_of_a_constant_has_a_length(number):
    (found,) = characteristics(at(number), {}, [record_of_crane()], Pack(100))
    assert found["low"] < found["high"]


def test_the_scale_of_a_map_that_moves_by_rounding_is_that_of_a_constant():
    areas = CRANE.replace("METHOD: CoGS", "METHOD: CoG")
    areas = re.sub(
        r"(TERM (?:neg|pos)_(?:high|medium)|TERM zero) := [-0-9]+;", r"\1 := (10, 0) (20, 1) (30, 0);", areas
    )
    areas = areas.replace("ACCU: MAX;", "ACT: MIN; ACCU: MAX;")
    (found,) = characteristics(loads(areas), {}, [record_of_crane()], Pack(100))
    assert found["high"] - found["low"] >= 1.0
    (moving,) = characteristics(crane(), {}, [record_of_crane()], Pack(100))
    assert moving["high"] - moving["low"] > 1.0


WALLS = """(corridor) => {
  const lane = Object.assign(Object.create(Lane.prototype), { scenario: { end: 100 }, whole: [0, 10] });
  return lane.walls(corridor);
}"""


def test_a_corridor_has_an_edge_only_between_rows_that_both_have_it():
    corridor = {
        "time": [0, 20, 40, 60, 80],
        "low": [None, None, 5, 5, None],
        "high": [10, 10, 10, None, None],
    }
    found = SCRIPT.call(WALLS, corridor)
    assert found["allowed"].split("Z") == [
        "M0 1000000L200 1000000L200 0L0 0",
        "M200 1000000L400 1000000L400 0L200 0",
        "M400 500L600 500L600 -1000000L400 -1000000",
        "",
    ]
    assert found["edges"] == "M400 500L600 500M0 0L200 0L400 0"


NAMED = """(bands) => {
  const lane = Object.create(Lane.prototype);
  const told = { bands: bands.map((each) => ({ from: 0, to: 1, ...each })), judged: true };
  const names = [];
  lane.placed = (name, part, attributes, text) => names.push(text);
  Object.assign(lane, { told, low: 0, high: 10, labels: { replaceChildren() {} } });
  lane.nameBands(0, 1);
  return names;
}"""


def test_a_requirement_is_named_once_beside_bounds_that_differ_only_in_time():
    bands = [
        {"low": 1, "high": 3, "ids": ["CR-1"]},
        {"low": 1, "high": 3, "ids": ["CR-2", "CR-1"], "from": 0.5},
    ]
    assert SCRIPT.call(NAMED, bands) == ["CR-1", "CR-2"]

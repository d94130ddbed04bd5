"""What is known of elements, sources and choosing blocks beyond their equations: bounds, edges, slips."""

from itertools import permutations
from math import isnan, nan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.diagnostics import InputFault
from fcl_sim.diagnostics.render import render
from fcl_sim.loop.blocks.setting import Text
from fcl_sim.loop.blocks.time_series import TableFault, time_series
from fcl_sim.loop.run import run
from fcl_sim.loop.trace_file import write
from fcl_sim.loop.wiring import wire
from fcl_sim.units import parse_quantity, parse_unit
from tests.loop.block_bench import Alone, diagram
from tests.loop.block_loops import node, outputs_of


def rows(*given):
    return tuple(tuple(parse_quantity(each) for each in row) for row in given)


def named(**given):
    return {name: tuple(parse_quantity(each) for each in row) for name, row in given.items()}


THREE = {"1": "signals.wave", "2": "signals.stairs", "3": "signals.ramp"}
CURVE = rows(("0 m", "0 kW"), ("1 m", "2 kW"), ("3 m", "1 kW"))


def test_a_rate_limiter_reaches_a_step_after_its_height_over_its_rate(tmp_path):
    limiter = node("y", "rate_limiter", {"input": "signals.wave"}, rising="4 m/s", falling="2 m/s")
    given = outputs_of(tmp_path, limiter, [[1.0]] * 20 + [[0.0]] * 40)
    assert [n for n, y in enumerate(given) if y == 1.0] == list(range(12, 20))
    assert next(n for n, y in enumerate(given) if n >= 20 and y == 0.0) == 20 + 24


def test_a_relay_remembers_between_its_levels(tmp_path):
    relay = node("y", "hysteresis_relay", {"input": "signals.wave"}, lower="-1 m", upper="1 m", on="5 kW")
    given = outputs_of(tmp_path, relay, [[0.0], [1.0], [0.0], [nan], [-1.0], [0.0], [2.0], [-0.99]])
    assert given == [0.0, 5.0, 5.0, 5.0, 0.0, 0.0, 5.0, 5.0]


@pytest.fixture(scope="module")
def quantiser(tmp_path_factory):
    block = node("y", "quantiser", {"input": "signals.wave"}, step="0.3 m", offset="0.1 m")
    return Alone(diagram(tmp_path_factory.mktemp("q"), block))


@given(st.floats(-1e3, 1e3))
def test_a_quantised_value_is_a_whole_step_and_no_further_off_than_half_of_one(quantiser, value):
    (y,) = quantiser.step([value], 0.02, 0.0, 0)
    steps = (y - 0.1) / 0.3
    assert steps == pytest.approx(round(steps), abs=1e-9)
    assert abs(y - value) <= 0.15 + 1e-9


def test_a_characteristic_meets_its_points_exactly_and_is_held_beyond_them(tmp_path):
    block = node("y", "characteristic", {"input": "signals.wave"}, points=CURVE)
    assert outputs_of(tmp_path, block, [[0.0], [1.0], [3.0], [-9.0], [1e9]]) == [0.0, 2.0, 1.0, 0.0, 1.0]
    assert isnan(outputs_of(tmp_path, block, [[nan]])[0])


def test_a_characteristic_goes_on_along_its_ends(tmp_path):
    block = node("y", "characteristic", {"input": "signals.wave"}, points=CURVE, ends="extrapolate")
    assert outputs_of(tmp_path, block, [[-2.0], [5.0], [3.0]]) == [-4.0, 0.0, 1.0]


@pytest.mark.parametrize("order", list(permutations([-1.0, 0.5, 0.7])))
def test_a_median_does_not_depend_on_the_order(order, tmp_path):
    assert outputs_of(tmp_path, node("y", "selector", THREE, by="median"), [order]) == [0.5]


@pytest.mark.parametrize("by", ["min", "max", "median"])
@pytest.mark.parametrize("place", range(3))
def test_a_selector_hides_no_broken_signal(by, place, tmp_path):
    values = [1.0, 2.0, 3.0]
    values[place] = nan
    assert isnan(outputs_of(tmp_path, node("y", "selector", THREE, by=by), [values])[0])


def test_a_selector_takes_the_nearest_index_and_stays_within(tmp_path):
    block = node("y", "selector", {"index": "signals.ratio", **THREE}, by="index")
    given = outputs_of(tmp_path, block, [[i, 10.0, 20.0, 30.0] for i in (-3.0, 0.4, 0.5, 1.2, 2.0, 9.0)])
    assert given == [10.0, 10.0, 20.0, 20.0, 30.0, 30.0]


def test_a_split_range_drives_one_element_at_a_time(tmp_path):
    elements = named(cooling=("-1 m", "0 m", "100 %", "0 %"), heating=("0 m", "1 m", "0 kW", "8 kW"))
    loop = diagram(tmp_path, node("y", "distribute", {"input": "signals.wave"}, elements=elements))
    trace = run(loop)
    assert trace.units["y.cooling"], trace.units["y.heating"] == ("%", "kW")
    assert not ((trace["y.cooling"] > 0) & (trace["y.heating"] > 0)).any()
    assert trace["y.cooling"].max() == 100.0
    assert trace["y.heating"].max() == 8.0


coordinates = st.floats(-100, 100)


@pytest.fixture(scope="module")
def classes(tmp_path_factory):
    marks = named(a=("0 m", "0 m"), b=("3 m", "4 m"), c=("-3 m", "1 m"))
    ports = {"1": "signals.wave", "2": "signals.stairs"}
    return Alone(diagram(tmp_path_factory.mktemp("c"), node("y", "classifier", ports, prototypes=marks)))


@given(coordinates, coordinates)
def test_memberships_add_up_to_one_and_the_nearest_prototype_has_most(classes, x, y):
    shares = classes.step([x, y], 0.02, 0.0, 0)
    distances = [np.hypot(x - a, y - b) for a, b in ((0, 0), (3, 4), (-3, 1))]
    assert shares.sum() == pytest.approx(1.0, abs=1e-14)
    assert (shares >= 0.0).all()
    assert distances[int(np.argmax(shares))] == pytest.approx(min(distances), rel=1e-12, abs=1e-12)


def test_memberships_are_one_at_a_prototype_and_as_the_inverse_squares_elsewhere(classes):
    assert classes.step([3.0, 4.0], 0.02, 0.0, 0).tolist() == [0.0, 1.0, 0.0]
    a, b, _ = classes.step([1.5, 2.0], 0.02, 0.0, 0)
    assert a == b
    a, _, c = classes.step([-1.0, 0.0], 0.02, 0.0, 0)
    assert a / c == pytest.approx(5.0, rel=1e-14)


def test_the_colours_of_the_oven_are_told_apart(tmp_path):
    marks = named(light=(189.7, 152.5, 111.8), brown=(186.0, 147.5, 107.4), dark=(182.2, 142.6, 103.3))
    ports = {"1": "signals.ratio", "2": "signals.flag", "3": "signals.other_flag"}
    alone = Alone(diagram(tmp_path, node("y", "classifier", ports, prototypes=marks)))
    light, brown, dark = alone.step([187.85, 150.0, 109.6], 0.02, 0.0, 0)
    assert light == pytest.approx(brown, rel=0.01)
    assert dark < 0.06


SLIPS = {
    "points do not rise": (
        node("y", "characteristic", {"input": "signals.wave"}, points=CURVE[::-1]),
        "`y`: point 2 of `points`, 1, is not beyond 3",
    ),
    "one point": (
        node("y", "characteristic", {"input": "signals.wave"}, points=CURVE[:1]),
        "`y`: `points` has one point",
    ),
    "points in another unit": (
        node("y", "characteristic", {"input": "signals.moment"}, points=CURVE),
        "`points` of `y`: 0 m does not convert to s",
    ),
    "levels crossed": (
        node("y", "hysteresis_relay", {"input": "signals.wave"}, lower="2 m", upper="1 m"),
        "`y`: `lower` lies above `upper`",
    ),
    "no step": (node("y", "quantiser", {"input": "signals.wave"}, step="0 m"), "`step` of `y` is 0 m"),
    "index missing": (node("y", "selector", THREE, by="index"), "`y`: its `index` is not connected"),
    "index for nothing": (
        node("y", "selector", {"index": "signals.flag", **THREE}, by="max"),
        "`y`: `index` has no effect, since it selects by max",
    ),
    "one of another unit": (
        node("y", "selector", {"1": "signals.wave", "2": "signals.flag"}, by="max"),
        "`2` of `y` is in m, and `signals.flag` is in 1",
    ),
    "branches in two units": (
        node("y", "switch", {"when": "signals.flag", "then": "signals.wave"}, otherwise="1 s"),
        "`otherwise` of `y`: 1 s does not convert to m",
    ),
    "a range backwards": (
        node("y", "distribute", {"input": "signals.wave"}, elements=named(a=("1 m", "1 m", 0, 1))),
        "`y`: the range of `a` ends at 1, not beyond 1 where it begins",
    ),
    "an element in two units": (
        node("y", "distribute", {"input": "signals.wave"}, elements=named(a=("0 m", "1 m", "0 kW", "1 s"))),
        "`elements` of `y`: 1 s does not convert to kW",
    ),
    "no elements": (
        node("y", "distribute", {"input": "signals.wave"}, elements={}),
        "`elements` of `y` is empty",
    ),
    "a prototype too short": (
        node("y", "classifier", {"1": "signals.wave"}, prototypes=named(a=("1 m", "2 m"))),
        "`y`: the prototype `a` has 2 numbers, and there are 1 inputs",
    ),
    "a fuzzifier of 1": (
        node("y", "classifier", {"1": "signals.wave"}, prototypes=named(a=("1 m",)), fuzzifier="1"),
        "`fuzzifier` of `y` is 1",
    ),
    "steps do not rise": (
        node("y", "staircase", steps=rows(("1 s", 1), ("1 s", 2))),
        "`y`: step 2 of `steps`, 1, is not beyond 1",
    ),
    "an exponential sweep from 0": (
        node("y", "chirp", start="0 Hz", end="1 Hz", duration="1 s", sweep="exponential"),
        "`y`: an exponential sweep has no `start` of 0 Hz",
    ),
}


@pytest.mark.parametrize("slip", SLIPS)
def test_a_slip_is_told(slip, tmp_path):
    block, told = SLIPS[slip]
    with pytest.raises(InputFault) as fault:
        wire(diagram(tmp_path, block))
    assert [each.message for each in fault.value.diagnostics] == [told]


FILES = {
    "empty": ("", "", "1:1", "the file is empty"),
    "one column": ("time [s]\n1\n", "", "1:1", "there is one column"),
    "no unit": ("time [s],speed\n", "", "1:10", "the column `speed` has no unit"),
    "an unknown unit": ("time [s],speed [mps]\n", "", "1:10", "there is no unit `mps`"),
    "no time": ("speed [m/s],time [s]\n", "", "1:1", "the first column is the time, and `speed` is in m/s"),
    "no numbers": ("time [s],x [m]\n\n", "", "1:1", "there is no line of numbers below the names"),
    "several": ("time [s],x [m],y [m]\n0,1,2\n", "", "1:1", "the file has several columns"),
    "unknown": ("time [s],x [m],y [m]\n0,1,2\n", "xx", "1:1", "`speed.csv` has no column `xx`"),
    "too short": ("time [s],x [m]\n0,1\n\n2\n", "", "4:1", "a line of 2 columns is wanted, and this has 1"),
    "no number": ("time [s]; x [m]\n0;1\n1; 1.2.3\n", "", "3:4", "`1.2.3` is not a number"),
    "decimal comma": ("time [s],x [m]\n0,1\n1,2,5\n", "", "3:1", "and this has 3"),
    "not finite": ("time [s]\tx [m]\n0\tnan\n", "", "2:3", "`nan` is not a finite number"),
    "backwards": ("time [s],x [m]\n0,1\n2,1\n2.0,3\n", "", "4:1", "2.0 is not later than the line before"),
}


@pytest.mark.parametrize("case", FILES)
def test_a_file_that_is_no_table_is_told_with_its_line(case, tmp_path):
    text, column, place, told = FILES[case]
    parameters = {"file": Text("speed.csv", text)} | ({"column": column} if column else {})
    next_one = node("z", "gain", {"input": "y"}, gain="2 kW/m")
    with pytest.raises(InputFault) as fault:
        wire(diagram(tmp_path, node("y", "table", **parameters), next_one))
    shown = render(fault.value.diagnostics[0])
    assert len(fault.value.diagnostics) == 1
    assert f"speed.csv:{place}" in shown
    assert told in shown


def test_a_table_may_be_separated_by_semicolons_with_decimal_commas():
    text = '\ufefftime [ms];"x [%]"\r\n0;1,5\r\n500; -2\r\n'
    series = time_series(Text("a.csv", text), "x")
    assert (series.times, series.values) == ((0.0, 0.5), (1.5, -2.0))
    assert series.unit.same_as(parse_unit("%"))


def test_a_missing_column_is_guessed():
    with pytest.raises(TableFault) as fault:
        time_series(Text("a.csv", "time [s],speed [m],way [m]\n0,1,2\n"), "sped")
    assert fault.value.hint == "did you mean `speed`?"


def test_a_recorded_trace_can_be_read_back(tmp_path):
    trace = run(diagram(tmp_path, node("y", "gain", {"input": "signals.wave"}, gain="3 kW/m")))
    write(trace, tmp_path / "trace.csv")
    file = Text("trace.csv", (tmp_path / "trace.csv").read_text("utf-8"))
    again = run(diagram(tmp_path, node("y", "table", file=file, column="y", between="hold")))
    assert np.array_equal(again["y"], trace["y"])
    assert again.units["y"] == "kW"

"""Function blocks in FCL evaluated in INT, by the blocks of the library wired as their text says."""

import numpy as np
import pytest

from fcl_sim.arithmetic.integer import ROUND, TRUNCATE
from fcl_sim.block import load, loads
from fcl_sim.diagnostics import InputFault
from fcl_sim.jit import I, compiled, entry, i8, signature, void
from tests.concept.test_manual_example import (
    GOLDEN,
    buffers,
    valve_int,
)

VALVE = """
FUNCTION_BLOCK valve
VAR_INPUT ipress, itemp: INT; END_VAR
VAR_OUTPUT y: INT; END_VAR
FUZZIFY ipress
    TERM low := (3900, 1) (4000, 0); TERM normal := (3900, 0) (4000, 1) (4100, 0);
    TERM high := (4000, 0) (4100, 1);
END_FUZZIFY
FUZZIFY itemp
    TERM low := (5000, 1) (6500, 0); TERM middle := (5000, 0) (6500, 1) (8000, 0);
    TERM high := (6500, 0) (8000, 1) (9500, 0); TERM very_high := (8000, 0) (9500, 1);
END_FUZZIFY
DEFUZZIFY y
    TERM shut := 0; TERM nearly_shut := 3333; TERM nearly_open := 6667; TERM open := 10000;
    METHOD: CoGS; DEFAULT := NC;
END_DEFUZZIFY
RULEBLOCK rules
    AND: MIN; OR: MAX; ACCU: MAX;
    RULE 1: IF ipress IS normal AND itemp IS high THEN y IS nearly_shut;
    RULE 2: IF ipress IS high {extreme} itemp IS very_high THEN y IS shut;
    RULE 3: IF ipress IS normal AND itemp IS middle THEN y IS nearly_open;
    RULE 4: IF ipress IS low {extreme} itemp IS low THEN y IS open;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""

READINGS = pytest.mark.parametrize("extreme", ["OR", "AND"])
PRESSURE, TEMPERATURE = np.arange(3850, 4151), np.arange(4900, 9601)


@entry(signature(void, i8, i8, *[I] * 9))
def wired(disjunction, rounding, p, t, low, mid, pair, out, defuzzed, y, results):  # noqa: PLR0917
    """Write what the blocks wired by hand give at every point, each from the output 0."""
    for index in range(results.size):
        y[0] = 0
        pressure, temperature = 3850 + index // 4701, 4900 + index % 4701
        valve_int(pressure, temperature, disjunction, rounding, p, t, low, mid, pair, out, defuzzed, y)
        results[index] = y[0]


@pytest.mark.skipif(not compiled(), reason="a million points")
@READINGS
@pytest.mark.parametrize(("rounding", "code"), [("truncate", TRUNCATE), ("round", ROUND)])
def test_the_manuals_example_is_what_its_blocks_give_at_every_point(extreme, rounding, code):
    instance = loads(VALVE.format(extreme=extreme)).instance(arithmetic="INT", rounding=rounding)
    ours = instance.evaluate({"ipress": PRESSURE[:, None], "itemp": TEMPERATURE})["y"]
    theirs = np.empty(ours.size, np.int64)
    wired(int(extreme == "OR"), code, *buffers(np.int64), theirs)
    assert ours.size == 1_415_001
    assert np.array_equal(ours.ravel(), theirs)


@pytest.mark.parametrize(("point", "by_or", "by_and"), GOLDEN)
def test_the_golden_points_hold_in_both_readings(point, by_or, by_and):
    for extreme, wanted in (("OR", by_or), ("AND", by_and)):
        instance = loads(VALVE.format(extreme=extreme)).instance(arithmetic="INT")
        instance(ipress=point[0], itemp=point[1])
        assert instance.y == wanted


def test_where_no_rule_is_active_the_last_output_is_held():
    instance = loads(VALVE.format(extreme="AND")).instance(arithmetic="INT")
    instance(ipress=4025, itemp=8200)
    assert instance.y == 2830
    instance(ipress=3900, itemp=9500)
    assert instance.y == 2830
    assert set(instance.degrees.values()) == {0}
    instance.reset()
    assert instance.y == 0
    assert instance.inputs == {"ipress": 0, "itemp": 0}


def test_scaled_channels_give_the_same_counts():
    scaled = VALVE.format(extreme="OR")
    for count in (3900, 4000, 4100, 5000, 6500, 8000, 9500):
        scaled = scaled.replace(f"({count},", f"({count / 100:.2f},")
    scaled = (
        scaled.replace(": INT", ": REAL")
        .replace("3333", "33.33")
        .replace("6667", "66.67")
        .replace("10000", "100")
    )
    scale = {"ipress": 0.01, "itemp": 0.01, "y": 0.01}
    ours = loads(scaled).instance(arithmetic="INT", scale=scale)
    theirs = loads(VALVE.format(extreme="OR")).instance(arithmetic="INT")
    for (pressure, temperature), _, _ in GOLDEN:
        ours(ipress=pressure / 100, itemp=temperature / 100)
        theirs(ipress=pressure, itemp=temperature)
        assert ours.y == theirs.y * 0.01
        assert ours.degrees == theirs.degrees


def test_an_offset_moves_the_counts():
    moved = VALVE.format(extreme="OR")
    for count in (3900, 4000, 4100):
        moved = moved.replace(f"({count},", f"({count - 3000},")
    ours = loads(moved).instance(arithmetic="INT", scale={"ipress": (1, -3000)})
    ours(ipress=1050, itemp=7250)
    assert ours.y == 3333
    assert ours.inputs == {"ipress": 1050, "itemp": 7250}


CRANE = "scenarios/crane/crane_completed.fcl"


def test_the_crane_in_int_keeps_near_to_the_crane_in_lreal():
    block = load(CRANE)
    scale = {"distance": 0.01, "angle": 0.01, "power": 0.01}
    instance = block.instance(arithmetic="INT", scale=scale)
    distance, angle = np.round(np.linspace(-10, 30, 41), 2)[:, None], np.round(np.linspace(-60, 60, 41), 2)
    ours = instance.evaluate({"distance": distance, "angle": angle})["power"]
    exact = block.evaluate({"distance": distance, "angle": angle})["power"]
    assert np.abs(ours - exact).max() < 0.05
    assert np.abs(ours - exact).max() > 0.0


BATH = """
FUNCTION_BLOCK bath
VAR_INPUT temp, flow: INT; END_VAR
VAR_OUTPUT valve: INT; END_VAR
FUZZIFY temp TERM cold := (30, 1) (270, 0); TERM warm := (100, 0) (200, 1) (300, 1) (400, 0); END_FUZZIFY
FUZZIFY flow TERM low := (0, 1) (100, 0); TERM high := (0, 0) (100, 1); END_FUZZIFY
DEFUZZIFY valve TERM shut := 0; TERM open := 10000; METHOD: CoGS; DEFAULT := 0; END_DEFUZZIFY
RULEBLOCK No1
AND: PROD; ACCU: BSUM;
RULE 1: IF temp IS cold THEN valve IS open WITH 0.3;
RULE 2: IF temp IS warm AND flow IS low THEN valve IS shut;
RULE 3: IF temp IS cold AND flow IS high THEN valve IS open;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""


def test_terms_that_do_not_share_out_1_are_fuzzified_each_by_itself_and_weights_are_products():
    instance = loads(BATH).instance(arithmetic="INT")
    instance(temp=150, flow=25)
    cold, warm, high = (270 - 150) * 10000 // 240, (150 - 100) * 10000 // 100, 2500
    low = 10000 - high
    first, second, third = cold, warm * low // 10000, cold * high // 10000
    assert instance.degrees == {"1": first, "2": second, "3": third}
    opened = first * 3000 // 10000 + third
    assert instance.valve == opened * 10000 // (opened + second)


def test_rounding_is_an_option():
    cut, rounded = (loads(BATH).instance(arithmetic="INT", rounding=each) for each in ("truncate", "round"))
    for each in (cut, rounded):
        each(temp=33, flow=0)
    assert cut.degrees["1"] == 9875
    for each in (cut, rounded):
        each(temp=35, flow=0)
    assert (cut.degrees["1"], rounded.degrees["1"]) == (9791, 9792)


def test_a_sum_beyond_32_bits_is_an_error_that_names_the_step_and_changes_nothing():
    text = BATH.replace("open := 10000", "open := 32767").replace("shut := 0", "shut := 32766")
    more = "".join(f"TERM t{i} := {32700 + i}; " for i in range(6))
    text = text.replace("METHOD", more + "METHOD")
    rules = "".join(f"RULE {10 + i}: IF temp IS cold THEN valve IS t{i}; " for i in range(6))
    text = text.replace("END_RULEBLOCK", rules + "END_RULEBLOCK")
    instance = loads(text).instance(arithmetic="INT")
    instance(temp=350, flow=50)
    before = instance.inputs, instance.outputs, instance.degrees
    with pytest.raises(OverflowError, match=r"^bath: defuzzification of valve: OVERFLOW$"):
        instance(temp=30, flow=100)
    assert before == (instance.inputs, instance.outputs, instance.degrees)


def test_inputs_beyond_int_are_refused_by_name():
    instance = loads(BATH).instance(arithmetic="INT", scale={"temp": 0.02})
    with pytest.raises(ValueError, match=r"temp is 700, 35000 counts; an INT lies in -32768 .. 32767"):
        instance(temp=700)
    with pytest.raises(ValueError, match="flow is nan"):
        instance(flow=float("nan"))
    with pytest.raises(TypeError, match=r"no input tmp; did you mean temp\?"):
        instance(tmp=1)


@pytest.mark.parametrize(
    ("old", "new", "feature"),
    [
        ("METHOD: CoGS", "METHOD: LM", "METHOD: LM"),
        ("AND: PROD", "AND: BDIF", "AND: BDIF"),
        ("ACCU: BSUM", "ACCU: NSUM", "ACCU: NSUM"),
        ("DEFAULT := 0", "DEFAULT := 5", "DEFAULT := 5, where FUZ has 0 or the last value"),
        ("IF temp IS cold THEN", "IF NOT temp IS cold THEN", "NOT, hedges, and degrees brought in"),
        ("(270, 0)", "(270, 0.5)", "`cold` of `temp` is not of straight lines between 0 and 1"),
        (
            "(30, 1) (270, 0)",
            "(0, 1) (30, 0) (270, 1)",
            "`cold` of `temp` has not one side up, one down, or both",
        ),
        ("open := 10000", "open := 40000", "`valve` has a number beyond INT, 40000 counts"),
        (
            "TERM open := 10000",
            "TERM open := (0, 0) (10000, 1)",
            "`open` of `valve` is not a constant singleton",
        ),
    ],
)
def test_what_the_library_cannot_do_is_refused_with_its_place(old, new, feature):
    text = BATH.replace(old, new).replace("AND: BDIF;", "AND: BDIF; OR: BSUM;")
    text = text.replace("METHOD: CoGS", "METHOD: CoG") if "(0, 0) (10000" in new else text
    text = text.replace("TERM shut := 0;", "TERM shut := (0, 1) (10, 0);") if "(0, 0) (10000" in new else text
    with pytest.raises(InputFault) as fault:
        loads(text).instance(arithmetic="INT")
    messages = [each.message for each in fault.value.diagnostics]
    assert f"not in INT: {feature}" in messages
    assert {each.code for each in fault.value.diagnostics} == {"FCL414"}
    assert all(each.places for each in fault.value.diagnostics)

"""Numbers and sentences for readers: short, but never misleading."""

import math
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.judge.formulae import consider
from fcl_sim.judge.verdict import Status
from fcl_sim.report.summary import endings
from fcl_sim.report.words import (
    NO_BREAK,
    bound,
    counted,
    exactly,
    expectation,
    joined,
    metric_name,
    number,
    one_line,
    plain,
    readably,
    together,
    value,
    with_unit,
)
from fcl_sim.units import parse_quantity
from tests.report.synthetic import of_formula, outcome, requirement, run, trace, verdict

FINITE = st.floats(-1e300, 1e300)


def read(text: str) -> float:
    return float(text.replace("−", "-"))


@given(FINITE, st.integers(1, 12))
def test_a_number_reads_back_to_its_digits(x, digits):
    assert math.isclose(read(number(x, digits)), x, rel_tol=0.51 * 10.0 ** (1 - digits), abs_tol=0.0)


@given(FINITE)
def test_a_number_has_a_true_minus_sign_and_zero_has_none(x):
    text = number(x)
    assert not text.startswith("-")
    assert (text == "0") == (x == 0)


@pytest.mark.parametrize(
    ("x", "text"),
    [
        (math.nan, "not a number"),
        (math.inf, "∞"),
        (-math.inf, "−∞"),
        (1e-8, "1e−8"),
        (-0.0, "0"),
        (25.404, "25.4"),
    ],
)
def test_numbers_that_are_special(x, text):
    assert number(x) == text


@pytest.mark.parametrize(
    ("written", "text"),
    [
        ("position = -40 m", "position = −40\N{NO-BREAK SPACE}m"),
        ("load_mass = 10 t, x2 = 5, k = -1e-05", "load_mass = 10\N{NO-BREAK SPACE}t, x2 = 5, k = −1e−5"),
        ("`x == -10 m` at -3 s", "`x == -10 m` at −3\N{NO-BREAK SPACE}s"),
        ("a-1 is 3.5 %", "a-1 is 3.5\N{NO-BREAK SPACE}%"),
    ],
)
def test_numbers_in_a_text_have_a_true_minus_sign_and_do_not_part_from_their_units(written, text):
    assert together(written) == text


@pytest.mark.parametrize(
    ("unit", "text"), [("", "1.5"), ("1", "1.5"), ("kN s/m", "1.5\N{NO-BREAK SPACE}kN s/m")]
)
def test_a_unit_does_not_part_from_its_number(unit, text):
    assert with_unit(1.5, unit) == text


@pytest.mark.parametrize(
    ("low", "high", "text"),
    [
        (None, 35.0, "at most 35 s"),
        (-0.125, None, "at least −0.125 s"),
        (1.0, 2.0, "1 s to 2 s"),
        (2.0, 2.0, "exactly 2 s"),
        (None, 35.123456789, "at most 35.123456789 s"),
        (None, None, "no bound"),
        (None, 1e-5, "at most 1e−5 s"),
        (None, 1e22, "at most 1e22 s"),
    ],
)
def test_a_bound_is_told_with_all_its_digits(low, high, text):
    assert bound(requirement(minimum=low, maximum=high)).replace("\N{NO-BREAK SPACE}", " ") == text


@given(st.floats(0.1, 1e6), st.floats(1e-12, 1e-3))
def test_a_value_beside_its_bound_does_not_look_like_it(maximum, excess):
    over = maximum * (1.0 + excess)
    shown = value(verdict(Status.FAIL, over, maximum=maximum, unit=""))
    assert (read(shown) > maximum) == (over > maximum)


@pytest.mark.parametrize(
    "text",
    [
        "always (crane.distance < 500 m and crane.sway < 1 deg)",
        "always (crane.distance < 1 m and crane.sway < 500 deg)",
        "always[0 s, 1 s] (crane.distance == 7 m or crane.sway == 0.001 deg)",
    ],
)
def test_a_formula_over_two_units_tells_the_margin_that_decided(text):
    made = of_formula(text, value=None)
    found = consider(trace("swings"), made.requirement.formula)
    assert found.value is None
    told = value(replace(made, reason=found.reason)).replace(NO_BREAK, " ").replace("−", "-")
    assert f", by a {told}, that of" in found.reason.replace("margin of", "margin")
    assert told.split()[2] in {"m", "deg"}


def test_a_number_below_a_million_has_no_exponent():
    assert [number(each) for each in (14412.0, -99999.0, 999949.0, 1234567.0)] == [
        "14410",
        "−100000",
        "999900",
        "1.235e6",
    ]


@pytest.mark.parametrize(
    ("written", "unit", "told"),
    [
        (1100000.0, "W", "1.1 MW"),
        (2454545.0, "J/kg", "2.454545 MJ/kg"),
        (123456.7, "N s/m", "123.4567 kN s/m"),
        (99999.0, "W", "99999 W"),
        (-2e9, "Pa", "−2 GPa"),
        (1100000.0, "kW", "1100000 kW"),
        (1100000.0, "", "1100000"),
        (1100000.0, "s", "1100000 s"),
        (0.00166666667, "Hz", "1/600 Hz"),
        (0.00041666667, "Hz", "1/2400 Hz"),
        (0.00166666666, "Hz", "0.00166666666 Hz"),
        (0.00208333333, "1/s2", "0.00208333333 1/s2"),
        (0.4883667, "", "0.4883667"),
        (0.0625, "s", "0.0625 s"),
        (0.0, "W", "0 W"),
    ],
)
def test_a_number_that_was_written_is_told_readably_and_no_digit_is_lost(written, unit, told):
    assert readably(written, unit).replace(NO_BREAK, " ") == told


@given(st.floats(-1e15, 1e15), st.sampled_from(["W", "Hz", "N s/m", "s", "", "degC"]))
def test_what_is_told_readably_is_the_value_that_is_told_exactly(written, unit):
    def value_of(text):
        quantity = text.replace("−", "-").replace(NO_BREAK, " ")
        if quantity.startswith("1/") and quantity.split()[0] != "1/s":
            parts, _, rest = quantity[2:].partition(" ")
            quantity = f"{1 / float(parts)!r} {rest}"
        return parse_quantity(quantity).to(unit)

    assert value_of(readably(written, unit)) == pytest.approx(value_of(exactly(written, unit)), rel=1e-5)


def test_what_could_not_be_measured_is_a_dash():
    assert value(verdict(Status.FAULT, None)) == "—"


@pytest.mark.parametrize(
    ("measured", "text"),
    [
        (Status.FAIL, ""),
        (Status.PASS, "met, though expected to fail"),
        (Status.FAULT, "expected to fail; measured FAULT"),
    ],
)
def test_an_expectation_is_told_where_it_did_not_come_true(measured, text):
    assert expectation(verdict(measured, expect_fail=True)) == text
    assert expectation(verdict(measured)) == ""


@given(st.text())
def test_plain_text_has_no_character_that_a_page_cannot_show(text):
    shown = plain(text)
    assert plain(shown) == shown
    assert not any(ord(each) < 32 and each != "\n" for each in shown)
    assert "\n" not in one_line(text)
    shown.encode()


def test_counts_and_lists_read_as_a_sentence():
    assert counted(1, "run") == "1 run"
    assert counted(0, "miss", "misses") == "0 misses"
    assert joined(["a", "b", "c"]) == "a, b and c"


def test_of_a_formula_is_asked_that_it_holds_and_its_robustness_is_measured():
    found = of_formula("always crane.sway < 3 deg")
    assert bound(found.requirement) == "the formula holds"
    assert value(found) == "margin\N{NO-BREAK SPACE}0.5\N{NO-BREAK SPACE}deg"


def test_a_run_that_ended_early_is_told_with_its_time_signal_and_reason(tmp_path):
    found = outcome(tmp_path, run(tmp_path), run(tmp_path, "lost", "fault"))
    fault = found.variants["lost"].trace.fault
    (ending,) = endings([found])
    assert ending.startswith(f"{found.scenario.name} lost: FAULT: the run ended at ")
    assert ending.endswith(f"s, at {fault.signal}: the integrator cannot reach its tolerance.")


@pytest.mark.parametrize(("metric", "name"), [("itae", "ITAE"), ("settling_time", "settling time"), ("", "")])
def test_a_metric_is_called_as_people_call_it(metric, name):
    assert metric_name(metric) == name

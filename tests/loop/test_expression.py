"""The block `expression`: its postfix code against the tree itself, units of its result, slips."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.arithmetic.formulas import of_one, of_two
from fcl_sim.diagnostics import InputFault
from fcl_sim.formula.functions import FUNCTIONS
from fcl_sim.formula.text import plain
from fcl_sim.loop.blocks.expression import OPERATIONS
from fcl_sim.loop.run import run
from fcl_sim.loop.wiring import wire
from tests.loop.block_bench import Alone, diagram
from tests.loop.block_loops import node

INPUTS = {"a": "signals.ratio", "b": "signals.flag", "c": "signals.other_flag"}


def block(text, inputs=None):
    return node("y", "expression", inputs or INPUTS, formula=plain(text))


def values(tmp_path, text, *rows):
    alone = Alone(diagram(tmp_path, block(text)))
    return [float(alone.step(row, 0.02, 0.0, 0)[0]) for row in rows]


def test_every_function_of_formulae_has_its_code():
    assert set(OPERATIONS) == {*FUNCTIONS, "+", "-", "*", "/", "negative"}
    assert len(set(OPERATIONS.values())) == len(OPERATIONS)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("exp(a)", math.exp(0.3)),
        ("ln(a)", math.log(0.3)),
        ("log10(a)", math.log10(0.3)),
        ("sqrt(a)", math.sqrt(0.3)),
        ("sin(a * 1 rad)", math.sin(0.3)),
        ("cos(a * 1 rad)", math.cos(0.3)),
        ("tan(a * 1 rad)", math.tan(0.3)),
        ("asin(a) / 1 rad", math.asin(0.3)),
        ("acos(a) / 1 rad", math.acos(0.3)),
        ("atan(a) / 1 rad", math.atan(0.3)),
        ("atan2(a, b) / 1 rad", math.atan2(0.3, -1.7)),
        ("sinh(a)", math.sinh(0.3)),
        ("cosh(a)", math.cosh(0.3)),
        ("tanh(a)", math.tanh(0.3)),
        ("floor(b)", -2.0),
        ("ceil(b)", -1.0),
        ("round(b)", -2.0),
        ("mod(c, b)", math.fmod(2.5, -1.7)),
        ("pow(a, c)", 0.3**2.5),
        ("abs(b)", 1.7),
        ("min(a, b, c)", -1.7),
        ("max(a, b, c)", 2.5),
        ("a - b - c", 0.3 + 1.7 - 2.5),
        ("a / b / c", 0.3 / -1.7 / 2.5),
        ("-a * -b", 0.3 * -1.7),
        ("50 % + a * 1", 0.8),
    ],
)
def test_a_formula_means_what_it_says(text, expected, tmp_path):
    assert values(tmp_path, text, (0.3, -1.7, 2.5)) == [pytest.approx(expected, rel=1e-15)]


def test_what_has_no_number_gives_none_and_raises_nothing(tmp_path):
    given = values(tmp_path, "sqrt(a) + b / c", (-1.0, 1.0, 1.0), (4.0, 1.0, 0.0), (4.0, 1.0, 2.0))
    assert [math.isnan(each) for each in given] == [True, False, False]
    assert given[1:] == [math.inf, 2.5]


operands = st.one_of(st.sampled_from("abc"), st.integers(1, 9).map(str))
formulae = st.recursive(
    operands,
    lambda inner: st.one_of(
        st.tuples(inner, st.sampled_from("+-*/"), inner).map(lambda each: f"({each[0]} {each[1]} {each[2]})"),
        inner.map(lambda each: f"-{each}"),
        inner.map(lambda each: f"abs({each})"),
        st.tuples(inner, inner).map(lambda each: f"max({each[0]}, {each[1]})"),
    ),
    max_leaves=12,
)


@given(formulae)
def test_a_formula_is_calculated_as_python_does(folder, text):
    row = {"a": 0.375, "b": -2.0, "c": 5.5}
    alone = Alone(diagram(folder, block(text)))
    try:
        expected = eval(text, {"abs": abs, "max": max, **row})  # noqa: S307  the text is ours
    except ZeroDivisionError:
        return
    assert float(alone.step(list(row.values()), 0.02, 0.0, 0)[0]) == expected


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("signals")


def test_the_kernels_of_formulae_are_those_of_the_engine():
    assert of_two(OPERATIONS["-"], 3.0, 5.0) == -2.0
    assert of_one(OPERATIONS["negative"], 3.0) == -3.0


def test_the_result_has_its_unit_and_is_read_in_it(tmp_path):
    inputs = {"x": "signals.wave", "t": "signals.moment"}
    speed = block("x / t - 20 cm/s", inputs)
    power = node("power", "gain", {"input": "y"}, gain="2 kN")
    trace = run(diagram(tmp_path, power, speed))
    assert trace.units["y"] == "m/s"
    assert trace.units["power"] == "m kN/s"
    expected = trace["signals.wave"] / trace["signals.moment"] - 0.2
    assert np.abs(trace["y"] - expected).max() < 1e-14


@pytest.mark.parametrize(
    ("text", "code", "told"),
    [
        ("a +", "WIR203", "`y`: a number, a signal or `(` is wanted here, not the end of the formula"),
        ("a + d", "WIR203", "`y`: there is no signal called `d`"),
        ("a + 1 m", "WIR203", "`y`: `a` has no unit, and `1 m` is in m"),
    ],
)
def test_a_slip_is_told_once_and_nothing_that_follows_from_it(text, code, told, tmp_path):
    following = node("next", "gain", {"input": "y"}, gain=2.0)
    with pytest.raises(InputFault) as fault:
        wire(diagram(tmp_path, block(text), following))
    (only,) = fault.value.diagnostics
    assert (only.code, only.message) == (code, told)

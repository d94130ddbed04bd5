"""A plant file that breaks the contract is refused, with its line, before anything is compiled."""

import pytest

from fcl_sim.plant.catalog import load
from tests.plant.tanks import refusal, written


def test_a_plant_that_keeps_the_contract_is_loaded(tmp_path):
    model = load(written(tmp_path))
    assert model.declaration.name == "tank"
    assert not model.samples


def test_a_missing_derivative_is_named_with_its_function(tmp_path):
    assert refusal(tmp_path, ("    dx[1] = u[0] - x[1]\n", "")) == (
        "plants/tank.py:17:1: error[PLT205]: "
        "`dynamics` leaves dx[1] (`flow`) unset\n"
        "  17 | def dynamics(t, x, u, p, mode, dx):\n"
        "     | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^\n"
        "  hint: set dx[1] on every path through `dynamics`"
    )


@pytest.mark.parametrize("index", ["2", "-1"])
def test_an_index_that_compiled_code_would_accept_is_refused_at_its_line(tmp_path, index):
    text = refusal(tmp_path, ("dx[1] = u[0] - x[1]", f"dx[{index}] = u[0] - x[1]"))
    assert text.startswith(
        "plants/tank.py:19:5: error[PLT301]: `dynamics` fails at the start values: IndexError"
    )
    assert f"dx[{index}] = u[0] - x[1]\n" in text


def test_a_fault_in_a_helper_is_shown_in_the_helper(tmp_path):
    text = refusal(tmp_path, ("return -flow / area", "return flow * (1 // int(area - 2.0))"))
    assert "plants/tank.py:14:5: error[PLT301]" in text
    assert "`dynamics` fails at the start values: ZeroDivisionError" in text


def test_a_missing_function_is_named_with_its_arguments(tmp_path):
    text = refusal(tmp_path, ("def dynamics(", "def dynamic("))
    assert "the plant has no function `dynamics(t, x, u, p, mode, dx)`" in text
    assert "`dynamic` looks like it" in text


def test_arguments_in_another_order_are_refused(tmp_path):
    text = refusal(tmp_path, ("def outputs(t, x, u, p, mode, y):", "def outputs(t, u, x, p, mode, y):"))
    assert "`outputs` takes (t, u, x, p, mode, y)" in text
    assert "the contract is `outputs(t, x, u, p, mode, y)`" in text


def test_a_syntax_error_is_shown_at_its_line(tmp_path):
    text = refusal(tmp_path, ("    y[0] = x[0]\n", "    y[0] = = x[0]\n"))
    assert "plants/tank.py:23:5: error[PLT301]: the plant's file cannot be run: invalid syntax" in text


def test_a_transition_must_give_a_mode(tmp_path):
    text = refusal(
        tmp_path,
        ("    y[0] = x[0]\n", "    y[0] = x[0]\n\n\ndef transition(i, t, x, u, p, mode):\n    return 3\n"),
    )
    assert "`transition` gives 3 for event -1 in mode 0" in text
    assert "it must return the number of a mode: 0 (only)" in text


def test_a_derivative_that_is_nan_is_told_apart_from_one_that_is_unset(tmp_path):
    text = refusal(tmp_path, ("dx[1] = u[0] - x[1]", 'dx[1] = float("nan")'))
    assert text == (
        "plants/tank.py:17:1: error[PLT205]: `dynamics` makes dx[1] (`flow`) NaN\n"
        "  17 | def dynamics(t, x, u, p, mode, dx):\n"
        "     | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^\n"
        "  hint: at the start values every result of `dynamics` is a number"
    )


def test_a_derivative_that_is_read_before_it_is_set_is_told_so(tmp_path):
    text = refusal(tmp_path, ("dx[1] = u[0] - x[1]", "dx[1] += 1.0 + u[0] - x[1]"))
    assert "`dynamics` reads dx[1] (`flow`) before it sets it\n" in text
    assert text.endswith("hint: set dx[1] before it is read")


def test_a_mode_is_named_where_the_plant_declares_several(tmp_path):
    modes = '"[A]"),),\n    modes=(Mode("free", "moves"), Mode("held", "stands")),'
    text = refusal(tmp_path, ('"[A]"),),', modes), ("    dx[1] =", "    if mode == 0:\n        dx[1] ="))
    assert "`dynamics` leaves dx[1] (`flow`) unset in the mode `held`\n" in text

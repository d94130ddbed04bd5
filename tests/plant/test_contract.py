"""A plant file that breaks the contract is refused, with its line, before anything is compiled."""

import pytest

from fcl_sim.diagnostics import InputFault
from fcl_sim.plant.catalog import load

GOOD = """from fcl_sim.plant import *

PLANT = Plant(
    name="tank", title="tank",
    states=(State("level", "m", 1.0, "level"), State("flow", "m3/s", 0.0, "flow")),
    inputs=(Input("valve", "1", "opening"),),
    outputs=(Output("level", "m", "level"),),
    parameters=(Parameter("area", "m2", 2.0, "area", "[A]"),),
)


@kernel
def rate(flow, area):
    return -flow / area


def dynamics(t, x, u, p, mode, dx):
    dx[0] = rate(x[1], p[0])
    dx[1] = u[0] - x[1]


def outputs(t, x, u, p, mode, y):
    y[0] = x[0]
"""


def refusal(tmp_path, *changes):
    text = GOOD
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path = tmp_path / "tank.py"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputFault) as caught:
        load(path)
    return str(caught.value).replace(str(path), "plants/tank.py")


def test_a_plant_that_keeps_the_contract_is_loaded(tmp_path):
    path = tmp_path / "tank.py"
    path.write_text(GOOD, encoding="utf-8")
    model = load(path)
    assert model.declaration.name == "tank"
    assert not model.samples


def test_a_missing_derivative_is_named_with_its_function(tmp_path):
    assert refusal(tmp_path, ("    dx[1] = u[0] - x[1]\n", "")) == (
        "plants/tank.py:17:1: error[PLT205]: "
        "`dynamics` leaves dx[1] (`flow`) unset or NaN in the mode `only`\n"
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


def test_a_file_without_a_plant_is_refused(tmp_path):
    text = refusal(tmp_path, ("PLANT = Plant(", "PLAN = Plant("))
    assert (
        text
        == "plants/tank.py: error[PLT201]: a plant file declares `PLANT = Plant(...)`, and this one does not"
    )


def test_a_name_declared_twice_is_refused(tmp_path):
    text = refusal(tmp_path, ('State("flow"', 'State("level"'))
    assert "the plant declares `level` twice" in text


def test_a_syntax_error_is_shown_at_its_line(tmp_path):
    text = refusal(tmp_path, ("    y[0] = x[0]\n", "    y[0] = = x[0]\n"))
    assert "plants/tank.py:23:5: error[PLT301]: the plant's file cannot be run: invalid syntax" in text


def test_what_cannot_be_compiled_is_refused_too(tmp_path):
    model = load(
        path_of(tmp_path, GOOD.replace("y[0] = x[0]", "y[0] = sorted({1: x[0]}.items(), key=str)[0][1]"))
    )
    with pytest.raises(InputFault) as caught:
        model.functions.ready()
    assert "error[PLT302]" in str(caught.value)


def test_a_transition_must_give_a_mode(tmp_path):
    text = refusal(
        tmp_path,
        ("    y[0] = x[0]\n", "    y[0] = x[0]\n\n\ndef transition(i, t, x, u, p, mode):\n    return 3\n"),
    )
    assert "`transition` gives 3 for event -1 in mode 0" in text
    assert "it must return the number of a mode: 0 (only)" in text


def path_of(tmp_path, text):
    path = tmp_path / "tank.py"
    path.write_text(text, encoding="utf-8")
    return path

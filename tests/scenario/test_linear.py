"""Linear plants in a scenario: written in numbers, bound to the same plant whatever form they have."""

from pathlib import Path

import numpy as np
import pytest

from fcl_sim.diagnostics import InputFault
from fcl_sim.loop.run import run
from fcl_sim.scenario.binder import bind
from fcl_sim.scenario.reader import read
from fcl_sim.scenario.show import show_scenario
from fcl_sim.testbench import prepare

SCENARIO = """
title = "A bath"
duration = "10 s"
scan = "100 ms"

[blocks.heating]
type = "constant"
value = "30 %"

[plant]
name    = "bath"
inputs  = { heating = "heating" }
outputs = ["temperature"]
units   = { heating = "%", temperature = "degC" }
"""

FIRST_ORDER = """
model = "first_order"
parameters = { gain = "0.5 K/%", time_constant = "2 s", delay = "0.75 s" }
"""
FORMS = {
    "first_order": FIRST_ORDER,
    "transfer_function": """
model = "transfer_function"
parameters = { numerator = [0.5], denominator = [2, 1], delay = "750 ms" }
""",
    "zero_pole_gain": """
model = "zero_pole_gain"
parameters = { poles = [-0.5], gain = 0.25, delay = "0.75 s" }
""",
    "state_space": """
model = "state_space"
parameters = { A = [[-0.5]], B = [[1.0]], C = [[0.25]], delay = "0.75 s" }
""",
}


@pytest.fixture
def scenario(tmp_path, monkeypatch):
    """Read a scenario with these lines in [plant]."""
    (tmp_path / "scenarios").mkdir()
    monkeypatch.chdir(tmp_path)

    def made(plant, more="", **overrides):
        text = SCENARIO.replace("[plant]\n", f"[plant]\n{plant.strip()}\n") + more
        Path("scenarios/own.toml").write_text(text, "utf-8")
        return read("scenarios/own.toml", {key.replace("__", "."): each for key, each in overrides.items()})

    return made


@pytest.mark.parametrize("form", FORMS)
def test_a_lag_is_the_same_plant_in_every_form(form, scenario):
    trace = run(bind(scenario(FORMS[form])))
    late = np.maximum(trace.time - 0.75, 0.0)
    assert trace["bath.temperature"] == pytest.approx(15.0 * -np.expm1(-late / 2.0), abs=1e-13)
    assert trace.units["bath.temperature"] == "degC"
    assert trace.units["bath.heating"] == "%"


def test_complex_poles_and_zeros_are_written_as_texts(scenario):
    poles = 'parameters = { zeros = ["-2 + 1j", "-2-1j"], poles = [-3, "-1+2i", "-1-2i"], gain = 3 }'
    roots = run(bind(scenario(f'model = "zero_pole_gain"\n{poles}')))
    powers = "parameters = { numerator = [3, 12, 15], denominator = [1, 5, 11, 15] }"
    plain = run(bind(scenario(f'model = "transfer_function"\n{powers}')))
    assert roots["bath.temperature"] == pytest.approx(plain["bath.temperature"], rel=1e-12, abs=1e-13)


def test_a_variant_changes_a_parameter_as_it_does_of_other_plants(scenario):
    more = '[variants.late]\n"plant.parameters.delay" = "3 s"\n'
    more += '[variants.strong]\nplant.parameters.gain = "1 K/%"\n'
    read_in = scenario(FIRST_ORDER, more, plant__parameters__time_constant="4 s")
    late, strong = (run(bind(read_in, name)) for name in ("late", "strong"))
    t = late.time
    assert late["bath.temperature"] == pytest.approx(
        15.0 * -np.expm1(-np.maximum(t - 3.0, 0) / 4.0), abs=1e-13
    )
    assert strong["bath.temperature"] == pytest.approx(
        30.0 * -np.expm1(-np.maximum(t - 0.75, 0) / 4.0), abs=1e-13
    )
    assert bind(read_in, "late").plant.parameters == {"gain": 0.5, "time_constant": 4.0, "delay": 3.0}


@pytest.mark.parametrize("form", ["first_order", "transfer_function", "zero_pole_gain"])
def test_a_plant_starts_at_rest_at_its_output(form, scenario):
    trace = run(bind(scenario(f'{FORMS[form]}start = {{ temperature = "15 degC" }}')))
    assert trace["bath.temperature"] == pytest.approx(15.0, abs=1e-13)
    falling = run(bind(scenario(f'{FORMS[form]}start = {{ temperature = "20 degC" }}')))
    late = np.maximum(falling.time - 0.75, 0.0)
    assert falling["bath.temperature"] == pytest.approx(15.0 + 5.0 * np.exp(-late / 2.0), abs=1e-13)


def test_states_of_state_space_start_where_they_are_told_to(scenario):
    trace = run(bind(scenario(f"{FORMS['state_space']}start = {{ x1 = 8.0 }}")))
    assert trace["bath.temperature"][:8] == pytest.approx(2.0 * np.exp(-0.5 * trace.time[:8]), abs=1e-14)


def test_an_output_that_nobody_names_is_called_output(scenario):
    text = scenario(FIRST_ORDER.replace("K/%", "1/%"), "").path.read_text("utf-8")
    text = text.replace('outputs = ["temperature"]\n', "").replace(', temperature = "degC"', "")
    Path("scenarios/own.toml").write_text(text, "utf-8")
    assert "bath.output" in run(bind(read("scenarios/own.toml"))).names


def test_a_plant_has_several_inputs_and_outputs_in_state_space(scenario):
    matrices = "A = [[-1, 0], [0, -2]], B = [[1, 0], [0, 1]], C = [[1, 0], [1, 1]]"
    lines = f'model = "state_space"\nparameters = {{ {matrices} }}'
    text = scenario(FIRST_ORDER).path.read_text("utf-8").replace(FIRST_ORDER.strip(), lines)
    text = text.replace(
        'inputs  = { heating = "heating" }', 'inputs = { heating = "heating", loss = "-heating" }'
    )
    text = text.replace('"temperature"]', '"temperature", "other"]').replace(
        "units   = {", 'units = { loss = "%",'
    )
    Path("scenarios/own.toml").write_text(text, "utf-8")
    trace = run(bind(read("scenarios/own.toml")))
    first, second = -30.0 * np.expm1(-trace.time), 15.0 * np.expm1(-2.0 * trace.time)
    assert trace["bath.temperature"] == pytest.approx(first, abs=1e-13)
    assert trace["bath.other"] == pytest.approx(first + second, abs=1e-13)


def test_a_scenario_is_shown_with_the_numbers_of_its_plant(scenario):
    shown = show_scenario(scenario(FORMS["transfer_function"]))
    assert "integration exact" in shown
    assert "plant bath = transfer_function" in shown
    assert "bath parameter denominator = [2, 1]" in shown
    assert "bath.temperature is an output" in shown
    assert "bath unit of heating = %" in shown


AC_COUPLED = 'model = "transfer_function"\nparameters = { numerator = [1, 0], denominator = [1, 1, 1] }'
FAULTS = {
    "gain": (
        'model = "first_order"\nparameters = { time_constant = "2 s" }',
        "SCN202", "the plant `bath` has no `gain` among its `parameters`",
    ),
    "unit": (
        'model = "first_order"\nparameters = { gain = "2 m/%", time_constant = "2 s" }',
        "SCN404", "`gain` is in",
    ),
    "misspelt": (
        f'{FIRST_ORDER.strip()[:-1]}, dealy = "1 s" }}',
        "SCN309", "did you mean `delay`?",
    ),
    "negative": (
        'model = "first_order"\nparameters = { gain = "2 K/%", time_constant = "2 s", delay = "-1 s" }',
        "SCN310", "`delay` cannot be -1 s",
    ),
    "clock": (
        'model = "first_order"\nparameters = { gain = "2 K/%", time_constant = "2 s", delay = "0.1 ns" }',
        "SCN204", "not a whole number of nanoseconds",
    ),
    "time": (
        'model = "first_order"\nparameters = { gain = "2 K/%", time_constant = "0 s" }',
        "SCN311", "`time_constant` must be greater than 0",
    ),
    "list": (
        'model = "transfer_function"\nparameters = { numerator = 2.0, denominator = [2, 1] }',
        "SCN311", "write it as in numerator = [1.0, 3.0, 2.0]",
    ),
    "text": (
        'model = "transfer_function"\nparameters = { numerator = ["2 s"], denominator = [2, 1] }',
        "SCN311", "`numerator` is a list of numbers",
    ),
    "root": (
        'model = "zero_pole_gain"\nparameters = { poles = ["-1+j2"], gain = 2 }',
        "SCN311", "`poles` is a list of numbers",
    ),
    "improper": (
        'model = "transfer_function"\nparameters = { numerator = [1, 0, 0], denominator = [2, 1] }',
        "SCN311", "`numerator` has a higher power of s",
    ),
    "matrix": (
        'model = "state_space"\nparameters = { A = [[1, 2]], B = [[1]], C = [[1]] }',
        "SCN311", "`A` is 1 by 2",
    ),
    "outputs": (
        'model = "state_space"\nparameters = { A = [[1]], B = [[1]], C = [[1], [2]] }',
        "SCN311", "has 2 outputs, and 1 are named",
    ),
    "start": (
        f'{FIRST_ORDER.strip()}\nstart = {{ heat = "1 degC" }}',
        "SCN309", "no output called `heat` to start from",
    ),
    "rest": (
        f'{AC_COUPLED}\nstart = {{ temperature = "1 degC" }}',
        "SCN311", "does not rest at this output",
    ),
    "model": (
        FIRST_ORDER.replace("first_order", "first_oder"),
        "PLT101", "did you mean `first_order`?",
    ),
    "list of a crane": (
        'model = "crane"',
        "SCN201", "the plant `crane` has no key `outputs`",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", FAULTS)
def test_a_plant_that_cannot_be_is_refused_where_it_is_written(name, scenario):
    plant, code, words = FAULTS[name]
    with pytest.raises(InputFault) as caught:
        prepare(scenario(plant))
    assert code in {each.code for each in caught.value.diagnostics}
    assert words in str(caught.value)
    assert all(each.places for each in caught.value.diagnostics)


def test_a_unit_of_a_signal_that_is_not_there_is_refused(scenario):
    text = (
        scenario(FIRST_ORDER).path.read_text("utf-8").replace('temperature = "degC"', 'temprature = "degC"')
    )
    Path("scenarios/own.toml").write_text(text, "utf-8")
    with pytest.raises(InputFault, match="did you mean `temperature`"):
        prepare(read("scenarios/own.toml"))

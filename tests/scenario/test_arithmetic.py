"""Arithmetic of a scenario's fuzzy blocks: INT declared or chosen, what a count is, reports (S36)."""

import json
from pathlib import Path

import numpy as np
import pytest

import fcl_sim
from fcl_sim import testbench
from fcl_sim.jit import compiled
from fcl_sim.report.results import document
from fcl_sim.scenario.reader import read
from tests.concept.test_function_block import VALVE

TANK = """
from fcl_sim.plant import *

PLANT = Plant(
    name="tank",
    title="500 kg of water, heated through a valve with a lag of 5 s",
    states=(State("water", "degC", 45.0, "temperature"), State("opening", "1", 0.0, "of the valve")),
    inputs=(Input("valve", "%", "asked opening"),),
    outputs=(Output("temperature", "degC", "of the water"), Output("pressure", "mbar", "of the steam")),
    parameters=(),
)


def dynamics(t, x, u, p, mode, dx):
    demand = 1.0 if t < 2400.0 else 1.5 if t < 4800.0 else 0.7
    dx[0] = (60000.0 * x[1] - 700.0 * demand * (x[0] - 20.0)) / (500.0 * 4186.0)
    dx[1] = (u[0] / 100.0 - x[1]) / 5.0


def outputs(t, x, u, p, mode, y):
    y[0] = x[0]
    y[1] = 4000.0 + 2.0 * (x[0] - 72.5) + (30.0 if t >= 6000.0 else 0.0)
"""

SCENARIO = """
title    = "Valve of the manual"
duration = "{seconds} s"
scan     = "1 s"

[plant]
model  = "tank"
inputs = {{ valve = "rules.y" }}

[integration]
scheme = "rk4"
step   = "1 s"

[blocks.rules]
type   = "fuzzy"
file   = "valve.fcl"
inputs = {{ ipress = "tank.pressure", itemp = "tank.temperature" }}
units  = {{ ipress = "mbar", itemp = "degC", y = "%" }}
{rules}
"""

SCALE = 'scale = { ipress = "0.1 kPa", itemp = "0.01 degC", y = "0.01 %" }'
EXACT = '[variants.exact]\n"blocks.rules.arithmetic" = "LREAL"\n'


def scaled(extreme="OR", kind="INT"):
    """The manual's valve, temperatures in degC and openings in %."""
    text = VALVE.format(extreme=extreme).replace(": INT", f": {kind}")
    for count in (5000, 6500, 8000, 9500):
        text = text.replace(f"({count},", f"({count // 100},")
    return text.replace("3333", "33.33").replace("6667", "66.67").replace("10000", "100")


@pytest.fixture
def own(tmp_path, monkeypatch):
    """Write a bench of one's own; return the scenario."""

    def written(rules=SCALE, text=None, seconds=60):
        monkeypatch.chdir(tmp_path)
        for folder in ("plants", "scenarios"):
            Path(folder).mkdir(exist_ok=True)
        Path("plants/tank.py").write_text(TANK, "utf-8")
        Path("scenarios/valve.fcl").write_text(text or scaled(), "utf-8")
        Path("scenarios/own.toml").write_text(SCENARIO.format(rules=rules, seconds=seconds), "utf-8")
        return Path("scenarios/own.toml")

    return written


def diagram(file, variant="base"):
    return testbench.prepare(read(file)).variants[variant].wiring.diagram


def node(file):
    (found,) = testbench.run(file).base.diagram.nodes
    return found


def test_a_block_of_int_types_computes_in_int_without_being_asked(own):
    found = node(own())
    assert found.arithmetic == "INT"
    assert found.scale == {"ipress": (1.0, 0.0), "itemp": (0.01, 0.0), "y": (0.01, 0.0)}
    assert found.rounding == "truncate"


@pytest.mark.parametrize(
    ("kind", "arithmetic"), [("SINT", "INT"), ("USINT", "INT"), ("DINT", "LREAL"), ("REAL", "REAL")]
)
def test_other_types_decide_likewise(kind, arithmetic):
    assert fcl_sim.loads(scaled(kind=kind)).declared_arithmetic == arithmetic


def test_reports_name_int(own):
    outcome = testbench.run(own(SCALE + '\nrounding = "round"\n' + EXACT))
    base, exact = json.loads(json.dumps(document([outcome])))["scenarios"][0]["variants"]
    assert [each["arithmetic"] for each in base["rule_bases"]] == ["INT"]
    assert [each["arithmetic"] for each in exact["rule_bases"]] == ["LREAL"]


def test_an_offset_is_the_value_of_the_count_0(own):
    found = node(own('scale = { itemp = ["0.005 degC", "-20 degC"], y = "0.01 %" }'))
    assert found.scale["itemp"] == (0.005, -20.0)


@pytest.mark.parametrize(
    ("rules", "message"),
    [
        ('scale = { itemp = "0.01 bar" }', "SCN404 a count of `itemp` is in degC, and this is in bar"),
        ('scale = { itemp = "0 degC" }', "SCN203 a count of `itemp` must be greater than 0"),
        (
            'scale = { itemp = ["1 degC"] }',
            "SCN203 `itemp` is what a count is, or that and what the count 0 is",
        ),
        ('scale = { itmp = "1" }', "WIR104 `rules` has no variable called `itmp`"),
        ('rounding = "up"', "SCN203 `rounding` cannot be `up`"),
        ('arithmetic = "DINT"', "SCN203 `arithmetic` cannot be `DINT`"),
    ],
)
def test_what_a_count_cannot_be_is_refused_at_its_place(own, rules, message):
    file = own(rules)
    with pytest.raises(fcl_sim.InputFault) as caught:
        testbench.prepare(read(file))
    assert message.split(" ", 1)[0] in str(caught.value)
    assert message.split(" ", 1)[1] in str(caught.value)
    assert "own.toml" in str(caught.value)


def test_what_the_library_lacks_is_refused_before_the_run_at_its_place(own):
    file = own(text=scaled().replace("OR: MAX", "OR: ASUM").replace("AND: MIN", "AND: PROD"))
    with pytest.raises(fcl_sim.InputFault) as caught:
        testbench.prepare(read(file))
    assert "FCL414" in str(caught.value)
    assert "not in INT: OR: ASUM" in str(caught.value)
    assert "valve.fcl" in str(caught.value)


def test_a_scale_without_int_is_told(own):
    file = own(text=scaled(kind="REAL"))
    with pytest.raises(fcl_sim.InputFault, match=r'SCN201(.|\n)*ask for it: arithmetic = "INT"'):
        testbench.prepare(read(file))
    assert node(own('arithmetic = "INT"\n' + SCALE, text=scaled(kind="REAL"))).arithmetic == "INT"


def test_the_tank_runs_on_the_numbers_of_the_instance_in_python(own):
    trace = testbench.run(own()).trace
    instance = fcl_sim.loads(scaled()).instance("INT", scale={"itemp": 0.01, "y": 0.01})
    for pressure, temperature, opening in zip(
        trace["tank.pressure"], trace["tank.temperature"], trace["rules.y"], strict=True
    ):
        instance(ipress=pressure, itemp=temperature)
        assert instance.y == opening
    assert trace.units["rules.y"] == "%"


@pytest.mark.skipif(not compiled(), reason="two runs of two hours")
def test_the_tank_in_int_keeps_to_the_exact_one_for_two_hours(own):
    outcome = testbench.run(own(SCALE + "\n" + EXACT, seconds=7200))
    base, exact = (outcome.variants[each].trace["tank.temperature"] for each in ("base", "exact"))
    assert 0.0 < np.abs(base - exact).max() < 0.05
    ends = base[[2400, 4800, 6000, 7200]]
    assert ends == pytest.approx([67.51, 62.99, 71.26, 71.19], abs=0.02)

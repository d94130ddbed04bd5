"""The controller on the page about Concept's blocks is the manual's valve, in both readings, INT and REAL."""

import re
from textwrap import dedent

import numpy as np
import pytest

from fcl_sim.diagnostics import InputFault
from fcl_sim.loop.run import run
from fcl_sim.scenario.binder import bind
from fcl_sim.scenario.reader import read
from tests.concept.test_manual_example import GOLDEN
from tests.house.places import ROOT

PAGE = (ROOT / "docs" / "concept.md").read_text("utf-8")
CONTROLLER = dedent(re.search(r"(?:^    .*\n|^\n)+", PAGE[PAGE.index("    # valve") :], re.MULTILINE)[0])

POINTS = [(point, by_or, by_and) for point, by_or, by_and in reversed(GOLDEN)]
"""The point without a rule comes first, where there is no output yet that could stay."""

PLANT = """
from fcl_sim.plant import *
from math import floor

PLANT = Plant(
    name="points",
    title="One point of the valve after another",
    states=(State("nothing", "1", 0.0, "stays"),),
    inputs=(Input("position", "%", "of the valve"),),
    outputs=(Output("pressure", "mbar", "of the vessel"), Output("temperature", "degC", "of its water")),
    parameters=(),
)


def dynamics(t, x, u, p, mode, dx):
    dx[0] = 0.0


def outputs(t, x, u, p, mode, y):
    at = int(floor(10.0 * t + 0.5))
    y[0] = {pressures}[at]
    y[1] = {temperatures}[at]
"""

SCENARIO = """
title = "The points of the manual's valve"
duration = "{duration} ms"
controller = {{ file = "valve.controller.toml", inputs = {{ {inputs} }} }}
[plant]
model = "points"
inputs = {{ position = "controller.position" }}
"""


@pytest.fixture
def valve(tmp_path, monkeypatch):
    """Run a controller over POINTS."""

    def trace(controller):
        monkeypatch.chdir(tmp_path)
        for name in ("plants", "scenarios"):
            (tmp_path / name).mkdir()
        pressures, temperatures = (tuple(float(point[i]) for point, _, _ in POINTS) for i in (0, 1))
        temperatures = tuple(each / 100.0 for each in temperatures)
        inputs = 'pressure = "points.pressure", temperature = "points.temperature"'
        written = {
            "plants/points.py": PLANT.format(pressures=pressures, temperatures=temperatures),
            "scenarios/valve.controller.toml": controller,
            "scenarios/valve.toml": SCENARIO.format(duration=100 * (len(POINTS) - 1), inputs=inputs),
        }
        for name, text in written.items():
            (tmp_path / name).write_text(text, "utf-8")
        return run(bind(read("scenarios/valve.toml")))

    return trace


@pytest.mark.parametrize("disjunction", [True, False], ids=["OR", "AND"])
def test_the_controller_of_the_page_gives_the_golden_points(valve, disjunction):
    trace = valve(CONTROLLER if disjunction else CONTROLLER.replace("FUZ_MAX", "FUZ_MIN"))
    assert trace.fault is None
    assert trace.events == ()
    expected = np.array([by_or if disjunction else by_and for _, by_or, by_and in POINTS], dtype=float)
    assert trace["controller.valve.Y"].tolist() == expected.tolist()
    assert trace["controller.position"] == pytest.approx(0.01 * expected, abs=1e-12)
    assert trace.units["controller.position"] == "%"


@pytest.mark.parametrize("disjunction", [True, False], ids=["OR", "AND"])
def test_in_real_it_gives_them_to_the_roundings_of_int(valve, disjunction):
    text = CONTROLLER if disjunction else CONTROLLER.replace("FUZ_MAX", "FUZ_MIN")
    text = text.replace("_INT", "_REAL").replace(
        'type = "from_int", input = "valve.Y", step =', 'type = "gain", input = "valve.Y", gain ='
    )
    trace = valve(text)
    assert trace.fault is None
    expected = np.array([by_or if disjunction else by_and for _, by_or, by_and in POINTS], dtype=float)
    assert trace["controller.valve.Y"] == pytest.approx(expected, abs=1.21)
    assert np.array_equal(trace["controller.valve.Y"], trace["controller.valve.Y"].astype(np.float32))


def test_the_values_may_have_their_units_in_real(valve):
    text = (
        CONTROLLER.replace("_INT", "_REAL")
        .replace('"p.OUT"', '"pressure"')
        .replace('"t.OUT"', '"temperature"')
    )
    text = re.sub(r"(S\d) = (3900|4000|4100)", r'\1 = "\2 mbar"', text)
    text = re.sub(r"(S\d) = (50|65|80|95)00", r'\1 = "\2 degC"', text)
    text = re.sub(r"(MDiSi[2468]) = (\d+)", lambda found: f'{found[1]} = "{int(found[2]) / 100} %"', text)
    text = text.replace('position = "percent"', 'position = "valve.Y"')
    text = re.sub(r'percent +=.*\n|[pt] +=.*"to_int".*\n', "", text)
    trace = valve(text)
    assert trace.units["controller.valve.Y"] == "%"
    expected = np.array([by_or for _, by_or, _ in POINTS])
    assert trace["controller.position"] == pytest.approx(0.01 * expected, abs=0.0121)


def test_a_structure_is_wired_by_its_members(valve):
    text = re.sub(r"temp\.MD(\d)", r"temp.MD.term\1", CONTROLLER)
    text = re.sub(r"(temp +=.*)FUZ_ATERM_INT", r"\1FUZ_ATERM_STI", text)
    members = ", ".join(f'"temp.MD.{member}"' for member in ("n", "term1", "term2", "term3", "term4"))
    places = "S1 = 5000, S2 = 6500, S3 = 8000, S4 = 9500"
    text = text.replace(
        "[blocks]\n", f'[blocks]\nback = {{ type = "DEFUZ_STI", MD = [{members}], {places} }}\n'
    )
    trace = valve(text)
    assert trace.fault is None
    assert trace.events == ()
    assert trace["controller.valve.Y"].tolist() == [by_or for _, by_or, _ in POINTS]
    assert trace["controller.back.Y"] == pytest.approx([point[1] for point, _, _ in POINTS], abs=1.0)


def test_a_pin_that_cannot_be_is_told_with_its_place(valve):
    with pytest.raises(InputFault) as caught:
        valve(CONTROLLER.replace("S2 = 4000", "S2 = 4000.5"))
    assert "`controller.press`: `S2` cannot be 4000.5" in str(caught.value)
    assert "valve.controller.toml:14" in str(caught.value)
    assert "it is INT, a whole number from -32768 to 32767" in str(caught.value)

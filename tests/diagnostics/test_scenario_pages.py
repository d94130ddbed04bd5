"""The examples about scenarios and wirings, in a scenario of the crane."""

import re
import shutil
from pathlib import Path

import pytest

from fcl_sim.diagnostics import InputFault
from fcl_sim.diagnostics.page import pages
from fcl_sim.plant.catalog import shipped_bench
from fcl_sim.report.findings import findings
from fcl_sim.scenario.reader import read
from fcl_sim.testbench import prepare, run_scenario

FRAMED = [each for each in pages().values() if each.within in {"scenario", "controller"}]
JUDGED = [each for each in FRAMED if each.code.startswith("JDG4")]
PAGES = [each for each in FRAMED if each not in JUDGED]
UNFRAMED = {"SCN104", "SCN409", "WIR202", "WIR204"}
"""Of what stands on the command line, in a table or in Python."""

SCENARIO = """\
title = "The first second"
duration = "1 s"

[controller]
file   = "crane.controller.toml"
inputs = { distance = "crane.distance", angle = "crane.angle" }

[plant]
model  = "crane"
start  = { position = "-25 m" }
inputs = { power = "controller.power" }

[[require]]
id = "S-1"
text = "The container hardly swings"
metric = { peak = { signal = "crane.sway" } }
max = "9 deg"
"""

CONTROLLER = """\
scan = "50 ms"

[inputs]
distance = "m"
angle    = "deg"

[outputs]
power = "rules.power"

[blocks.speed]
type   = "differentiator"
input  = "-distance"
filter = "0.05 s"

[blocks.predicted]
type  = "sum"
terms = { distance = 1.0, speed = "-6 s" }

[blocks.rules]
type   = "fuzzy"
file   = "crane_completed.fcl"
units  = { distance = "m", angle = "deg", power = "kW" }
inputs = { distance = "predicted", angle = "angle" }
"""


def parts(text):
    """Return a text in TOML by what its parts are called: single keys, then tables."""
    head, *tables = re.split(r"^(?=\[)", text, flags=re.MULTILINE)
    named = [(line.split("=")[0].strip(), line) for line in head.splitlines(keepends=True) if line.strip()]
    return named + [(table.partition("\n")[0], table) for table in tables]


def framed(frame, example):
    """Return the frame with the parts of an example in the place of those of the same name, or added."""
    given = parts(f"{example}\n")
    replaced = {name for name, _ in given}
    kept = [(name, part) for name, part in parts(frame) if name not in replaced]
    whole = sorted([*kept, *given], key=lambda each: each[0].startswith("["))
    return "\n".join(part for _, part in whole)


@pytest.fixture
def codes(tmp_path, monkeypatch):
    """Return the codes of what is wrong with an example."""
    folder = tmp_path / "scenarios" / "crane"
    shutil.copytree(shipped_bench() / "scenarios" / "crane", folder)
    monkeypatch.chdir(tmp_path)

    def found(example, within, *, run=False):
        texts = {"scenario": SCENARIO, "controller": CONTROLLER}
        if within:
            texts[within] = framed(texts[within], example)
        (folder / "crane.controller.toml").write_text(texts["controller"], "utf-8")
        (folder / "example.toml").write_text(texts["scenario"], "utf-8")
        try:
            file = Path("scenarios/crane/example.toml")
            if run:  # a run with overrides is of no baseline, and of these there is none
                overridden = read(file, {"title": "An example"})
                return {each.code for each in findings([run_scenario(overridden)])}
            prepare(read(file))
        except InputFault as fault:
            return {each.code for each in fault.diagnostics}
        return set()

    return found


def test_the_frame_of_the_examples_is_sound(codes):
    assert codes("", "") == set()


@pytest.mark.parametrize("told", PAGES, ids=lambda told: told.code)
def test_a_bad_example_has_its_finding_and_no_other_and_the_mended_one_has_none(told, codes):
    assert codes(told.bad, told.within) == {told.code}
    assert codes(told.mended, told.within) == set()


@pytest.mark.parametrize("told", JUDGED, ids=lambda told: told.code)
def test_a_run_of_a_bad_example_has_its_finding_and_no_other_and_of_the_mended_one_none(told, codes):
    assert codes(told.bad, told.within, run=True) == {told.code}
    assert codes(told.mended, told.within, run=True) == set()


def test_every_page_about_scenarios_and_wirings_is_tried():
    about = {each.code for each in pages().values() if each.code.startswith(("JDG2", "SCN", "WIR"))}
    assert about - UNFRAMED == {each.code for each in PAGES}

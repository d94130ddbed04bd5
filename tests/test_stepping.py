"""The page on loops in the hand: its example prints what it says; variants are opened by name."""

import re
import subprocess
import sys

import pytest

import fcl_sim
from fcl_sim.diagnostics import InputFault
from fcl_sim.scenario.reader import read
from tests.house.places import ROOT

PAGE = (ROOT / "docs" / "stepping.md").read_text("utf-8")
CRANE = ROOT / "scenarios" / "crane" / "transfer.toml"


def test_the_example_of_the_page_prints_what_the_page_says():
    example, printed = re.search(r"```python\n(.*?)```\n```\n(.*?)```", PAGE, re.DOTALL).groups()
    command = [sys.executable, "-W", "error", "-c", example]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr) == (printed, "")


def test_the_page_names_all_that_a_loop_has():
    named = set(re.findall(r"`loop[.]?(\w*)", PAGE)) | set(re.findall(r"`loop\.state`, `loop\.(\w+)", PAGE))
    public = {name for name in vars(fcl_sim.OpenLoop) if not name.startswith("_")}
    assert public <= named


def test_a_scenario_that_was_read_is_opened_by_its_variant():
    raw = fcl_sim.open_loop(read(CRANE), "raw_distance")
    base = fcl_sim.open_loop(CRANE, overrides={"plant.parameters.load_mass": "10 t"})
    raw.scan(40)
    base.scan(40)
    assert raw["crane.distance"] != base["crane.distance"]
    with pytest.raises(InputFault, match="did you mean `raw_distance`"):
        fcl_sim.open_loop(CRANE, "raw_distanc")

import os
import shutil
import subprocess
import sys

import pytest
from click.testing import CliRunner

from fcl_sim.cli.program import program
from fcl_sim.testbench import run, update_baseline
from tests.house.places import ROOT

SHORT = """\
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

GITHUB = ("GITHUB_ACTIONS", "GITHUB_STEP_SUMMARY", "GITHUB_WORKSPACE")
"""What changes the output of commands on the build server that these tests may run on."""


@pytest.fixture
def invoke(monkeypatch):
    """Run the command line in this process: exit code, stdout and stderr are attributes of the result.

    Whether kernels are still to be compiled changes nothing that is printed.
    """
    for name in ("NO_COLOR", *GITHUB):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr("fcl_sim.cli.run._is_warm", lambda: True)

    def run(*arguments):
        return CliRunner().invoke(program, [str(each) for each in arguments], prog_name="fcl-sim")

    return run


@pytest.fixture
def start(tmp_path):
    """Run the command line as a process of its own in `tmp_path`, as a user does."""

    def run(*arguments, cwd=tmp_path, env=None, stdout=subprocess.PIPE):
        return subprocess.run(
            [sys.executable, "-m", "fcl_sim", *map(str, arguments)],
            cwd=cwd,
            env=env or environment(),
            stdout=stdout,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )

    return run


def environment(**settings):
    """Return the environment of a user who has fcl_sim installed."""
    kept = {name: value for name, value in os.environ.items() if name not in {"COLUMNS", "NO_COLOR", *GITHUB}}
    return kept | {"PYTHONPATH": str(ROOT)} | settings


def accept(*paths):
    """Write the baselines of scenarios, as somebody does who has looked at them."""
    for path in paths:
        outcome = run(path)
        for variant in outcome.variants:
            update_baseline(outcome, variant, reason="as they are", date="2026-01-31")


@pytest.fixture
def bench(tmp_path, monkeypatch):
    """Stand in a bench with one short scenario, `scenarios/crane/short.toml`, and its baseline."""
    folder = tmp_path / "bench"
    crane = folder / "scenarios" / "crane"
    crane.mkdir(parents=True)
    for name in ("crane.controller.toml", "crane_completed.fcl", "crane_printed.fcl"):
        shutil.copy(ROOT / "scenarios" / "crane" / name, crane)
    (crane / "short.toml").write_text(SHORT)
    monkeypatch.chdir(folder)
    accept(crane / "short.toml")
    return folder

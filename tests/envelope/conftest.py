"""A small crane scenario, quick to run, with a grid that each test writes."""

from collections.abc import Callable
from pathlib import Path

import pytest

from fcl_sim.plant.catalog import shipped_bench

CRANE = shipped_bench() / "scenarios" / "crane"

SCENARIO = f"""
title      = "Ten seconds of a transfer"
duration   = "10 s"

[controller]
file   = "{(CRANE / "crane.controller.toml").as_posix()}"
inputs = {{ distance = "seen", angle = "crane.angle" }}

[blocks]
seen = {{ type = "sensor", input = "crane.distance", noise = "2 cm" }}

[plant]
model      = "crane"
parameters = {{ load_mass = "20 t" }}
inputs     = {{ power = "controller.power" }}

[timing]
seed = 7
"""

REQUIRE = """
[[require]]
id     = "E-1"
text   = "It drives no faster than the crane may"
metric = { maximum = { signal = "crane.speed" } }
max    = "2 m/s"

[[require]]
id      = "E-2"
text    = "It does not swing far"
formula = "never crane.sway > 4 deg"
"""


@pytest.fixture
def written(tmp_path: Path) -> Callable[..., Path]:
    """Write a scenario: the crane, then what a test gives; return the file."""

    def write(more: str, require: str = REQUIRE) -> Path:
        file = tmp_path / "scenarios" / "own.toml"
        file.parent.mkdir(exist_ok=True)
        file.write_text(f"{SCENARIO}\n{more}\n{require}", "utf-8")
        return file

    return write

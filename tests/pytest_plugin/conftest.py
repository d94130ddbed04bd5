"""A bench with one small scenario, and pytest run in it, in this process or in workers of its own."""

from pathlib import Path

import pytest

from fcl_sim.kernel_cache import cache_folder
from fcl_sim.pytest_plugin import items  # what simulates is loaded before pytester looks at sys.modules
from fcl_sim.testbench import run

PLUGIN = ("-p", "fcl_sim.pytest_plugin", "-W", "ignore::pytest.PytestAssertRewriteWarning")
"""Ours by its name; it is imported already, which a session of a user's would not have done."""

FCL = """\
FUNCTION_BLOCK bath
VAR_INPUT temperature: LREAL; END_VAR
VAR_OUTPUT heating: LREAL; END_VAR
FUZZIFY temperature
    TERM cold := (20, 1) (40, 0);
    TERM warm := (20, 0) (40, 1);
END_FUZZIFY
DEFUZZIFY heating
    TERM off := 0;
    TERM full := 100;
    METHOD: COGS;
    DEFAULT := 0;
END_DEFUZZIFY
RULEBLOCK rules
    AND: MIN; ACCU: MAX;
    RULE 1: IF temperature IS cold THEN heating IS full;
    RULE 2: IF temperature IS warm THEN heating IS off;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""

HEAT = """\
title    = "Heating a bath"
duration = "60 s"
scan     = "1 s"

[blocks.rules]
type   = "fuzzy"
file   = "bath.fcl"
units  = { temperature = "degC", heating = "%" }
inputs = { temperature = "bath.temperature" }

[plant]
model      = "first_order"
name       = "bath"
parameters = { gain = "0.5 K/%", time_constant = "10 s" }
inputs     = { heating = "rules.heating" }
outputs    = ["temperature"]
units      = { heating = "%", temperature = "degC" }
start      = { temperature = "20 degC" }

[variants.slow]
"plant.parameters.time_constant" = "20 s"

[[require]]
id     = "B-1"
text   = "The bath stays below 45 degC"
metric = { peak = { signal = "bath.temperature" } }
max    = "45 degC"

[[require]]
id      = "B-2"
text    = "It is warm after twelve seconds. The slow one is not."
formula = "always[12 s, 60 s] (bath.temperature > 28 degC)"
expect  = { slow = "fail" }
"""


class Bench:
    """Its folder, edited by replacing text; pytest's own results are what `pytester` gives."""

    def __init__(self, pytester):
        self.pytester = pytester
        self.folder = Path(pytester.path)
        self.write("scenarios/bath/bath.fcl", FCL)
        self.write("scenarios/bath/heat.toml", HEAT)

    def write(self, name, text):
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, "utf-8")

    def edit(self, name, before, after):
        text = (self.folder / name).read_text("utf-8")
        assert before in text
        self.write(name, text.replace(before, after))

    def run(self, *arguments, workers=0):
        """Run pytest with our plugin alone, and with xdist where there are workers."""
        parallel = ("-p", "xdist", "-n", str(workers)) if workers else ()
        return self.pytester.runpytest_inprocess(*PLUGIN, *parallel, *arguments)

    def collected(self, *arguments):
        """Return the node ids that pytest would run."""
        lines = self.run("--collect-only", "-q", *arguments).outlines
        return [line for line in lines if "::" in line]

    def accept(self):
        """Write the baselines of all runs."""
        self.run("--update-baseline", "as it is")


@pytest.fixture(scope="session")
def kernels():
    """Return where compiled kernels are: pytester has another home, without any."""
    folder = cache_folder()
    return "" if folder is None else str(folder.parent)


@pytest.fixture
def bench(kernels, pytester, monkeypatch):
    """Stand in a bench; pytest loads no plugin by itself, whether ours is installed here or not."""
    monkeypatch.setenv("FCL_SIM_CACHE_DIR", kernels)
    monkeypatch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")
    monkeypatch.delenv("PYTEST_ADDOPTS", raising=False)
    return Bench(pytester)


@pytest.fixture
def simulations(monkeypatch):
    """Count how often a scenario is simulated."""
    seen = []

    def counted(scenario):
        seen.append(scenario.name)
        return run_scenario(scenario)

    run_scenario = items.run_scenario
    monkeypatch.setattr(items, "run_scenario", counted)
    return seen


@pytest.fixture(scope="session", autouse=True)
def warm(tmp_path_factory):
    """Run the scenario once, for pytester forgets every module that is first loaded in a run of its own."""
    folder = tmp_path_factory.mktemp("warm") / "scenarios"
    folder.mkdir()
    (folder / "bath.fcl").write_text(FCL)
    (folder / "heat.toml").write_text(HEAT)
    assert run(folder / "heat.toml").metrics["B-1"] is not None

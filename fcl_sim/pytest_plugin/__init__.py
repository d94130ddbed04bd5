"""Scenarios as test items of pytest: one more door beside the command line.

In: files below `scenarios/`, as pytest finds them. Out: an item for each
requirement on each run, and for each run beside its baseline. May import every
room but cli; what simulates is loaded when a scenario is met, for pytest loads
this module in every session. Tests: tests/pytest_plugin.
"""

from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from fcl_sim.scenario.bench import SCENARIOS, is_scenario

UPDATE = "--update-baseline"
MARKER = "fcl_sim(scenario, variant, requirement, envelope, baseline): what a run is held against"


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add our option."""
    group = parser.getgroup("fcl_sim", "scenarios of fcl_sim")
    group.addoption(
        UPDATE,
        metavar="REASON",
        help="Write the baselines of runs that leave theirs or have none; they fail all the same, once.",
    )


def pytest_configure(config: pytest.Config) -> None:
    """Register our marker; refuse to accept runs without a reason."""
    config.addinivalue_line("markers", MARKER)
    reason = config.getoption(UPDATE)
    if reason is not None and not reason.strip():
        raise pytest.UsageError(f"{UPDATE}: say why the runs are accepted as they are")


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> Any:
    """Take scenarios of a bench, and those that are named on the command line wherever they are."""
    if not is_scenario(file_path):
        return None
    if not (_is_in_bench(file_path, parent.config) or parent.session.isinitpath(file_path)):
        return None
    items = import_module("fcl_sim.pytest_plugin.items")
    return items.ScenarioFile.from_parent(parent, path=file_path)


def _is_in_bench(file: Path, config: pytest.Config) -> bool:
    """Return whether a file lies below a folder `scenarios`; one above the project is not looked at."""
    for folder in file.parents:
        if folder.name == SCENARIOS:
            return True
        if folder == config.rootpath and config.inipath is not None:
            break
    return False

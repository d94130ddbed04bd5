"""Which files are scenarios, which bench one belongs to, and what it is called there."""

from collections.abc import Iterator
from pathlib import Path

SCENARIOS, PLANTS = "scenarios", "plants"
SCENARIO, CONTROLLER, WAIVERS = ".toml", ".controller.toml", ".waivers.toml"
"""What the names of scenarios, of controllers and of files of waivers end in."""
NO_SCENARIOS = (CONTROLLER, WAIVERS)
BASELINES = "baselines"
"""The folder of baselines, beside the scenarios that they belong to; no scenario stands in it."""


def is_scenario(path: Path) -> bool:
    """Return whether a file is a scenario by its name: TOML, but no controller, baseline or waivers."""
    ours = path.name.endswith(SCENARIO) and not path.name.endswith(NO_SCENARIOS)
    return ours and path.absolute().parent.name != BASELINES


def scenarios_below(folder: Path) -> Iterator[Path]:
    """Yield the scenarios below a folder, below its `scenarios/` where it is a bench, sorted."""
    bench = folder / SCENARIOS
    for file in sorted((bench if bench.is_dir() else folder).rglob(f"*{SCENARIO}")):
        if is_scenario(file):
            yield file


def bench_of(path: Path) -> Path:
    """Return the folder that holds the `scenarios/` in which a file lies.

    Outside of any, it is the nearest folder that has `scenarios/` or `plants/`,
    and where there is none, the file's own.
    """
    folders = path.absolute().parents
    for folder in folders:
        if folder.name == SCENARIOS:
            return folder.parent
    for folder in folders:
        if (folder / SCENARIOS).is_dir() or (folder / PLANTS).is_dir():
            return folder
    return folders[0]


def name_of(path: Path) -> str:
    """Return the scenario's name: its path below `scenarios/` without the ending, `crane/transfer`."""
    folder = bench_of(path) / SCENARIOS
    whole = path.absolute()
    inside = whole.relative_to(folder) if whole.is_relative_to(folder) else Path(whole.name)
    return inside.with_suffix("").as_posix()

"""Which bench a scenario belongs to, and what the scenario is called there."""

from pathlib import Path

SCENARIOS, PLANTS = "scenarios", "plants"


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

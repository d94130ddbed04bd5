"""Which bench a command works on, and where it may write."""

from pathlib import Path

from fcl_sim.diagnostics import InputFault
from fcl_sim.plant.catalog import shipped_bench

PACKAGE = Path(__file__).parents[1]


def bench_here(folder: Path) -> Path | None:
    """Return the nearest folder, from `folder` upwards, that holds `scenarios/`; None where there is none."""
    for each in (folder, *folder.parents):
        if (each / "scenarios").is_dir():
            return each
    return None


def default_bench() -> Path:
    """Return the bench of the current folder, else the shipped one."""
    return bench_here(Path.cwd()) or shipped_bench()


def reports_folder() -> Path:
    """Return `reports/` of the bench of the current folder, else of the current folder.

    InputFault inside an installed package: a shipped bench is never written to.
    """
    here = Path.cwd()
    if here.is_relative_to(PACKAGE):
        raise InputFault.at_file(
            "RUN102", str(here), "the shipped bench is never written to", "name a folder with --reports"
        )
    return (bench_here(here) or here) / "reports"

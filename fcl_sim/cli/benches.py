"""Which bench a command works on, and where it may write."""

from pathlib import Path

from fcl_sim.diagnostics import Diagnostic, InputFault, Place, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.plant.catalog import shipped_bench
from fcl_sim.scenario.bench import BASELINES, NO_SCENARIOS, SCENARIOS, scenarios_below

PACKAGE = Path(__file__).parents[1]


def bench_here(folder: Path) -> Path | None:
    """Return the nearest folder, from `folder` upwards, that holds `scenarios/`; None where there is none."""
    for each in (folder, *folder.parents):
        if (each / SCENARIOS).is_dir():
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


def scenario_files(paths: tuple[Path, ...]) -> tuple[Path, ...]:
    """Return the scenario files under `paths`, of the default bench where none are given.

    A folder stands for the `*.toml` files below it (below its `scenarios/`
    where it is a bench), controllers, baselines and waivers excepted. InputFault names every path
    that is missing or has no scenario.
    """
    found: dict[Path, None] = {}
    faults: list[Diagnostic] = []
    for path in paths or (default_bench(),):
        files = [path] if _is_named(path) else list(scenarios_below(path))
        if not files:
            faults.append(_nothing(path))
        found.update(dict.fromkeys(files))
    if faults:
        raise InputFault(faults)
    return tuple(found)


def watched_folders(paths: tuple[Path, ...]) -> tuple[Path, ...]:
    """Return the folders under which `scenario_files` looks for scenarios."""
    return tuple(path for path in paths or (default_bench(),) if path.is_dir())


def _is_named(path: Path) -> bool:
    return path.is_file() and path.absolute().parent.name != BASELINES


def _nothing(path: Path) -> Diagnostic:
    places = (Place(file=str(path)),)
    if path.is_dir():
        hint = f"a scenario is a .toml file whose name does not end in {listed(NO_SCENARIOS)}"
        return Diagnostic(
            code="RUN105", message="there is no scenario below this folder", places=places, hint=hint
        )
    if path.is_file():
        hint = "name the scenario that it belongs to, in the folder above"
        return Diagnostic(
            code="RUN105", message="this is a baseline, not a scenario", places=places, hint=hint
        )
    siblings = [each.name for each in path.parent.iterdir()] if path.parent.is_dir() else []
    near = nearest(path.name, siblings)
    hint = f"did you mean {path.with_name(near)}?" if near else ""
    return Diagnostic(code="RUN105", message="there is no such file or folder", places=places, hint=hint)

"""What a file is by its name, and what is said where a file of another kind was wanted."""

import shlex
from enum import StrEnum
from pathlib import Path

from fcl_sim.diagnostics import InputFault
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.scenario.bench import BASELINES, CONTROLLER, SCENARIO, WAIVERS
from fcl_sim.scenario.document import shown


class File(StrEnum):
    """A kind of file, as messages call it."""

    SCENARIO = "a scenario"
    CONTROLLER = "a controller"
    WAIVERS = "a file of waivers"
    BASELINE = "a baseline"
    RULE_BASE = "a rule base"
    PLANT = "a plant"
    TRACE = "a trace"
    STORED = "what a run has stored"
    RESULTS = "the results of a run"
    REPORT = "a report"


BY_ENDING = {
    ".fcl": File.RULE_BASE,
    ".py": File.PLANT,
    ".csv": File.TRACE,
    ".npz": File.TRACE,
    ".json": File.RESULTS,
    ".pdf": File.REPORT,
    ".html": File.REPORT,
    ".png": File.REPORT,
}
RESULTS = "results.json"
USES = {
    File.SCENARIO: "`fcl-sim run {file}` runs it and writes its report",
    File.CONTROLLER: 'name a scenario that uses it: [controller] has the key file = "{name}" there',
    File.WAIVERS: "it is read by itself with the rule base that it belongs to",
    File.BASELINE: "name the scenario that it belongs to, in the folder above",
    File.RULE_BASE: "`fcl-sim check {file}` checks it, `fcl-sim eval {file} NAME=NUMBER ...` evaluates it",
    File.PLANT: 'name a scenario that uses it: [plant] has the key model = "{stem}" there',
    File.TRACE: "`fcl-sim judge {file} --with SCENARIO.toml` judges it",
    File.STORED: "`fcl-sim report {results}` makes a report of it",
    File.RESULTS: "`fcl-sim report {file}` writes the report again",
    File.REPORT: "`fcl-sim report {beside}` writes it again",
}
"""What each kind is good for, and where it is named."""
FOR_TRACES = "`fcl-sim run {run} --trace TRACE.csv` writes a trace"
FOR_RESULTS = "`fcl-sim run {run}` writes results and report"
NO_RESULTS = frozenset({File.CONTROLLER, File.WAIVERS, File.BASELINE, File.RULE_BASE, File.PLANT})
"""What has nothing to do with the results of a run."""


def kind_of(path: Path) -> File | None:
    """Return what a file is by its name and by what stands beside it; None where its name says nothing."""
    if path.name.endswith(CONTROLLER):
        return File.CONTROLLER
    if path.name.endswith(WAIVERS):
        return File.WAIVERS
    if path.name.endswith(SCENARIO):
        return File.BASELINE if path.absolute().parent.name == BASELINES else File.SCENARIO
    if path.suffix == ".npz" and path.with_suffix(".json").is_file():
        return File.STORED
    return BY_ENDING.get(path.suffix.lower())


def check_kind(path: Path, wanted: File, code: str) -> None:
    """Raise InputFault where a path is a folder, or a file whose name says that it is of another kind.

    Nothing is said of what is not there.
    """
    if path.is_dir():
        inside = sorted(each.name for each in path.iterdir() if kind_of(each) is wanted)
        hint = f"name a file in it: {listed(inside)}" if inside else ""
        raise InputFault.at_file(code, shown(path), f"this is a folder, not {wanted}", hint)
    kind = kind_of(path)
    if kind is None or kind is wanted or not path.is_file():
        return
    this = "these are" if kind is File.RESULTS else "this is"
    raise InputFault.at_file(code, shown(path), f"{this} {kind}, not {wanted}", _hint(path, kind, wanted))


def _hint(path: Path, kind: File, wanted: File) -> str:
    """Return the right command for a file, or for what was wanted instead of it."""
    hint = USES[kind]
    if wanted is File.TRACE:
        hint = FOR_TRACES
    elif wanted is File.RESULTS and kind in NO_RESULTS:
        hint = FOR_RESULTS
    beside = path.with_name(RESULTS)
    return hint.format(
        file=shlex.quote(shown(path)),
        name=path.name,
        stem=path.stem,
        run=shlex.quote(shown(path)) if kind is File.SCENARIO else "SCENARIO.toml",
        results=shlex.quote(shown(path.with_suffix(".json"))),
        beside=shlex.quote(shown(beside)) if beside.is_file() else "RESULTS.json",
    )

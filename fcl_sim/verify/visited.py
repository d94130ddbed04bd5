"""What was proved of a rule base, joined with the runs: an output that was undefined in one is an error."""

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from fcl_sim.diagnostics import Diagnostic, InputFault, Severity
from fcl_sim.proof.finding import Finding

RESULTS = "results.json"
UNDEFINED = "FCL601"
VISITED = "FCL616"


@dataclass(frozen=True, slots=True, kw_only=True)
class Visits:
    """What runs recorded of one output: in how many of `scans` it was undefined, and in which first."""

    runs: int
    scans: int
    undefined: int
    run: str = ""
    seconds: float = 0.0


Key = tuple[str, str, str]
"""The name of a rule base's file, its function block and the output, in lower case."""


def visits_of(paths: Sequence[Path]) -> Mapping[Key, Visits]:
    """Return what the results of runs tell of every output; a folder stands for all `results.json` below it.

    Raises InputFault for what is no such file, with every fault.
    """
    found: dict[Key, Visits] = {}
    faults: list[Diagnostic] = []
    for path in paths:
        files = sorted(path.rglob(RESULTS)) if path.is_dir() else [path]
        if not files:
            message = f"there is no {RESULTS} below this folder"
            faults += InputFault.at_file("VER205", str(path), message, "`fcl-sim run` writes it").diagnostics
        for file in files:
            try:
                for key, visits in _read(file):
                    found[key] = _added(found.get(key), visits)
            except (OSError, ValueError, KeyError, TypeError) as error:
                message = f"these are no results of a run: {error}"
                hint = f"`fcl-sim run --reports FOLDER` writes FOLDER/{RESULTS}"
                faults += InputFault.at_file("VER205", str(file), message, hint).diagnostics
    if faults:
        raise InputFault(faults)
    return found


def _read(file: Path) -> Iterator[tuple[Key, Visits]]:
    document: Mapping[str, Any] = json.loads(file.read_text("utf-8"))
    for each in document["coverage"]:
        for output in each["outputs"]:
            key = (Path(each["file"]).name, each["function_block"].casefold(), output["variable"].casefold())
            seen, first = output["undefined"], output["undefined"]["first"]
            yield (
                key,
                Visits(
                    runs=len(each["runs"]),
                    scans=each["scans"],
                    undefined=seen["scans"],
                    run=first["run"] if first else "",
                    seconds=first["time_ns"] / 1e9 if first else 0.0,
                ),
            )


def _added(one: Visits | None, other: Visits) -> Visits:
    if one is None:
        return other
    first = one if one.undefined else other
    return replace(
        first,
        runs=one.runs + other.runs,
        scans=one.scans + other.scans,
        undefined=one.undefined + other.undefined,
    )


def joined(finding: Finding, file: Path, block: str, visits: Mapping[Key, Visits]) -> Finding:
    """Return a finding with what the runs tell of it: an error if an output was undefined in one of them."""
    told = finding.diagnostic
    own = visits.get((file.name, block.casefold(), finding.variable.casefold()))
    if told.code != UNDEFINED or own is None:
        return finding
    scans = f"{own.undefined} of {own.scans} scans"
    if own.undefined:
        message = f"{told.message}; it was so in {scans}, first at {own.seconds:.9g} s of {own.run}"
        return replace(
            finding,
            diagnostic=replace(told, code=VISITED, severity=Severity.ERROR, message=message),
        )
    runs = f"{own.runs} run{'' if own.runs == 1 else 's'}"
    return replace(finding, diagnostic=replace(told, message=f"{told.message}; no scan of {runs} was there"))

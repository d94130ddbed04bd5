"""Where results come from: the input files with their hashes, and the date of a report."""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from fcl_sim.diagnostics import InputFault
from fcl_sim.loop.diagram import FuzzyNode
from fcl_sim.scenario.revision import Revision, revision_of
from fcl_sim.testbench import Outcome, Run

EPOCH = datetime(1980, 1, 1, tzinfo=UTC)
"""The date of a report whose inputs have none, as texts in memory."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Origin:
    """What a report depends on besides its inputs: the day it is of, and the state of git in each bench."""

    date: datetime
    revisions: tuple[Revision, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class InputFile:
    """A file that a run depends on: what it is for, its name for a reader, its path, its SHA-256 in hex.

    `text` is there where it is shown.
    """

    role: str
    name: str
    path: Path
    digest: str
    text: str = ""


def fuzzy_nodes(run: Run) -> list[FuzzyNode]:
    """Return the fuzzy blocks of a run."""
    return [node for node in run.diagram.nodes if isinstance(node, FuzzyNode)]


def inputs_of(outcome: Outcome) -> list[InputFile]:
    """Return the files of a scenario and all its variants, each once, the plants last."""
    files = [
        InputFile(role=each.role, name=each.name, path=each.path, digest=each.digest, text=each.source.text)
        for each in outcome.scenario.files
    ]
    plants = [run.diagram.plant.model for run in outcome.variants.values()]
    files += [
        InputFile(role="plant", name=shown(each.path), path=each.path, digest=each.digest) for each in plants
    ]
    return list(dict.fromkeys(files))


def rule_base(outcome: Outcome, run: Run, node: FuzzyNode) -> InputFile:
    """Return the file that the rule base of a fuzzy block was read from."""
    path = outcome.scenario.variants[run.variant].rule_bases[node.name]
    return next(each for each in inputs_of(outcome) if each.path == path)


def shown(path: Path) -> str:
    """Return a path relative to the current folder where it lies below, else its last two parts."""
    whole, here = path.absolute(), Path.cwd()
    return whole.relative_to(here).as_posix() if whole.is_relative_to(here) else "/".join(whole.parts[-2:])


def origin_of(outcomes: Sequence[Outcome]) -> Origin:
    """Return where outcomes come from, as it is now; InputFault as of `date_of`."""
    benches = dict.fromkeys(each.scenario.bench for each in outcomes)
    return Origin(date=date_of(outcomes), revisions=tuple(revision_of(each) for each in benches))


def date_of(outcomes: Sequence[Outcome]) -> datetime:
    """Return the date of a report: SOURCE_DATE_EPOCH, else the newest input file's time; never now.

    InputFault where SOURCE_DATE_EPOCH is no number of seconds.
    """
    asked = date_asked()
    if asked is not None:
        return asked
    files = [each for outcome in outcomes for each in inputs_of(outcome)]
    times = [each.path.stat().st_mtime for each in files if each.path.is_file()]
    return datetime.fromtimestamp(int(max(times)), UTC) if times else EPOCH


def date_asked() -> datetime | None:
    """Return what SOURCE_DATE_EPOCH says; InputFault where that is no number of seconds."""
    given = os.environ.get("SOURCE_DATE_EPOCH")
    if not given:
        return None
    try:
        return datetime.fromtimestamp(int(given), UTC)
    except (ValueError, OverflowError, OSError):
        raise InputFault.at_file(
            "RUN203",
            "",
            f"SOURCE_DATE_EPOCH is `{given}`, which is not a date",
            "give whole seconds since 1970",
        ) from None

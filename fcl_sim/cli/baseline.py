"""`fcl-sim baseline`: accept what runs come to; show what was accepted."""

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from datetime import UTC, date, datetime
from pathlib import Path
from typing import TypeVar

import click

from fcl_sim import testbench
from fcl_sim.cli.benches import PACKAGE, scenario_files
from fcl_sim.cli.progress import progress
from fcl_sim.cli.regressions import told_lost
from fcl_sim.diagnostics import Diagnostic, InputFault
from fcl_sim.judge.envelope import EnvelopeVerdict
from fcl_sim.judge.verdict import Status
from fcl_sim.report import baselines, summary
from fcl_sim.report.words import counted
from fcl_sim.scenario import baseline_file
from fcl_sim.scenario.binder import setup_called
from fcl_sim.scenario.document import shown
from fcl_sim.scenario.model import Scenario
from fcl_sim.scenario.reader import read
from fcl_sim.testbench import Outcome, Update

PATHS = click.argument("paths", metavar="[PATH]...", nargs=-1, type=click.Path(path_type=Path))
VARIANTS = click.option(
    "--variant", "variants", metavar="NAME", multiple=True, help="Only this run, as often as you like."
)
DAY = re.compile(r"\d{4}-\d{2}-\d{2}")

T = TypeVar("T")


@click.group()
def command() -> None:
    """Accept what runs come to, as the baseline for the next ones; show what was accepted."""


def _today() -> str:
    return datetime.now(UTC).date().isoformat()


def _day(_ctx: click.Context, _param: click.Parameter, text: str) -> str:
    try:
        if DAY.fullmatch(text):
            return date.fromisoformat(text).isoformat()
    except ValueError:
        pass
    raise click.BadParameter(f"`{text}` is no day: write it as 2026-01-31")


def _reason(_ctx: click.Context, _param: click.Parameter, text: str) -> str:
    if not text.strip():
        raise click.BadParameter("say in a sentence why the runs are accepted as they are")
    return text.strip()


@command.command()
@PATHS
@click.option("--reason", required=True, metavar="TEXT", callback=_reason, help="Why they are accepted.")
@VARIANTS
@click.option("--date", "day", default=_today, metavar="DAY", callback=_day, help="Day of it; else today.")
def update(*, paths: tuple[Path, ...], reason: str, variants: tuple[str, ...], day: str) -> None:
    """Run scenarios and write what they come to as their baselines.

    PATH is a scenario or a folder of them; without one, the bench of the current folder is taken. Each
    run has a file baselines/SCENARIO.VARIANT.toml beside its scenario. Tolerances that are there are kept.
    """
    files = scenario_files(paths)
    _not_shipped(files)
    outcomes = _each(files, variants, testbench.run_scenario)
    updates = [
        (outcome, testbench.new_baseline(outcome, name, reason=reason, date=day))
        for outcome in outcomes
        for name in outcome.variants
        if name in (variants or outcome.variants)
    ]
    for outcome, made in updates:
        baseline_file.write(made.after, made.path)
        for line in _told(outcome, made):
            click.echo(line)
    for line in _open(updates):
        click.echo(line)
    click.echo(f"{counted(len(updates), 'baseline')} written.")


@command.command()
@PATHS
@VARIANTS
def show(*, paths: tuple[Path, ...], variants: tuple[str, ...]) -> None:
    """Print what was accepted, when and why, without running anything."""
    for scenario in _each(scenario_files(paths), variants, lambda each: each):
        for variant in scenario.variants:
            if variant in (variants or scenario.variants):
                found = baseline_file.read(scenario.path, variant)
                click.echo(f"{scenario.name} {variant}: {baselines.accepted(found)}")
                for line in baselines.figures(found):
                    click.echo(f"  {line}")
        for lost in testbench.lost_runs(scenario) if not variants else ():
            click.echo(told_lost(lost))


def _not_shipped(files: Sequence[Path]) -> None:
    for file in files:
        if file.absolute().is_relative_to(PACKAGE):
            hint = "copy it, and run the copy: fcl-sim new DIR"
            raise InputFault.at_file("RUN102", str(file), "the shipped bench is never written to", hint)


def _each(files: Sequence[Path], variants: Sequence[str], of: Callable[[Scenario], T]) -> list[T]:
    """Return what is made of every scenario, before anything is written; InputFault with all faults."""
    made: list[T] = []
    faults: dict[Diagnostic, None] = {}
    with progress("simulating") as advance:
        for done, file in enumerate(files):
            advance(done, len(files), file.stem)
            try:
                scenario = read(file)
                for name in variants:
                    setup_called(scenario, name)
                made.append(of(scenario))
            except InputFault as fault:
                faults.update(dict.fromkeys(fault.diagnostics))
    if faults:
        raise InputFault(faults)
    return made


def _open(updates: Sequence[tuple[Outcome, Update]]) -> Iterator[str]:
    """Yield what is accepted though it is not green: of each verdict which requirements of which runs."""
    found: dict[Status, list[str]] = {}
    for outcome, made in updates:
        run = outcome.variants[made.after.variant]
        for verdict in summary.verdicts_of(run):
            if verdict.status is not Status.PASS:
                where = f"{verdict.requirement.id} in {outcome.scenario.name} {run.variant}"
                over = " over its envelope" if isinstance(verdict, EnvelopeVerdict) else ""
                found.setdefault(verdict.status, []).append(where + over)
    for status in Status:
        if status in found:
            yield f"accepts {len(found[status])} {status}: {', '.join(found[status])}"


def _told(outcome: Outcome, made: Update) -> Iterator[str]:
    run = outcome.variants[made.after.variant]
    yield f"written: {shown(made.path)}"
    if made.before is None:
        yield f"  new: {counted(len(made.after.metrics), 'figure')}, {baselines.kept(made.after)}"
        return
    told = list(baselines.lines(replace(run, cause=None)))
    yield from (f"  {line}" for line in told or ["nothing beyond its tolerance changed"])

"""`fcl-sim baseline`: accept what runs come to; show what was accepted."""

from collections.abc import Iterator, Sequence
from datetime import UTC, date, datetime
from pathlib import Path

import click

from fcl_sim import testbench
from fcl_sim.cli.benches import PACKAGE, scenario_files
from fcl_sim.cli.progress import progress
from fcl_sim.diagnostics import Diagnostic, InputFault
from fcl_sim.scenario.binder import setup_called
from fcl_sim.scenario.document import shown
from fcl_sim.scenario.reader import read
from fcl_sim.testbench import Outcome, Update

PATHS = click.argument("paths", metavar="[PATH]...", nargs=-1, type=click.Path(path_type=Path))


@click.group()
def command() -> None:
    """Accept what runs come to, as the baseline for the next ones; show what was accepted."""


def _today() -> str:
    return datetime.now(UTC).date().isoformat()


def _day(_ctx: click.Context, _param: click.Parameter, text: str) -> str:
    try:
        return date.fromisoformat(text).isoformat()
    except ValueError:
        raise click.BadParameter("write the day as 2026-01-31") from None


def _reason(_ctx: click.Context, _param: click.Parameter, text: str) -> str:
    if not text.strip():
        raise click.BadParameter("say why the runs are accepted as they are")
    return text.strip()


@command.command()
@PATHS
@click.option("--reason", required=True, metavar="TEXT", callback=_reason, help="Why they are accepted.")
@click.option("--variant", "variants", metavar="NAME", multiple=True, help="Update this run alone.")
@click.option("--date", "day", default=_today, metavar="DAY", callback=_day, help="Day of it; else today.")
def update(*, paths: tuple[Path, ...], reason: str, variants: tuple[str, ...], day: str) -> None:
    """Run scenarios and write what they come to as their baselines.

    PATH is a scenario or a folder of them; without one, the bench of the current folder is taken. Each
    run has a file baselines/SCENARIO.VARIANT.toml beside its scenario. Tolerances that are there are kept.
    """
    files = scenario_files(paths)
    _not_shipped(files)
    outcomes = _run(files, variants)
    for outcome in outcomes:
        for name in outcome.variants:
            if not variants or name in variants:
                made = testbench.update_baseline(outcome, name, reason=reason, date=day)
                click.echo("\n".join(_told(made)))


def _not_shipped(files: Sequence[Path]) -> None:
    for file in files:
        if file.absolute().is_relative_to(PACKAGE):
            hint = "copy it: fcl-sim new DIR"
            raise InputFault.at_file("RUN102", str(file), "the shipped bench is never written to", hint)


def _run(files: Sequence[Path], variants: Sequence[str]) -> list[Outcome]:
    """Run every scenario before anything is written; InputFault with the faults of all."""
    outcomes: list[Outcome] = []
    faults: dict[Diagnostic, None] = {}
    with progress("simulating") as advance:
        for done, file in enumerate(files):
            advance(done, len(files), file.stem)
            try:
                scenario = read(file)
                for name in variants:
                    setup_called(scenario, name)
                outcomes.append(testbench.run_scenario(scenario))
            except InputFault as fault:
                faults.update(dict.fromkeys(fault.diagnostics))
    if faults:
        raise InputFault(faults)
    return outcomes


def _told(made: Update) -> Iterator[str]:
    yield f"written: {shown(made.path)}"

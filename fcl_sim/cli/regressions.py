"""Runs beside their baselines, on a terminal: what changed, why, and how it is accepted."""

import shlex
from collections.abc import Sequence

import click

from fcl_sim import testbench
from fcl_sim.cli.doors import Exit
from fcl_sim.diagnostics import Diagnostic
from fcl_sim.judge.verdict import Status, worst
from fcl_sim.report import baselines, summary
from fcl_sim.scenario.document import shown
from fcl_sim.testbench import Outcome


def print_regressions(outcomes: Sequence[Outcome], lost: Sequence[Diagnostic]) -> None:
    """Print runs that leave their baselines, with what left them, that have none, and that are `lost`."""
    for outcome in outcomes:
        before: baselines.Told = {}
        for run in outcome.variants.values():
            told = [*baselines.lines(run), *baselines.causes(run, before)]
            if told and run.compared and run.compared.baseline:
                accepted = run.compared.baseline
                click.echo(f"\n{outcome.scenario.name} {run.variant} beside its baseline of {accepted.date}:")
                for line in told:
                    click.echo(f"  {line}")
        missing = [run.variant for run in outcome.variants.values() if baselines.is_missing(run.compared)]
        if missing:
            click.echo(f"\n{outcome.scenario.name} has NO BASELINE of {', '.join(missing)}.")
        if missing or any(list(baselines.lines(run)) for run in outcome.variants.values()):
            file = shlex.quote(shown(outcome.scenario.path))
            click.echo(f'  If that is meant: fcl-sim baseline update {file} --reason "..."')
    for each in lost:
        click.echo(f"\n{told_lost(each)}")
    told_all = baselines.sentence(outcomes)
    if told_all:
        click.echo(told_all)


def lost_runs(outcomes: Sequence[Outcome]) -> list[Diagnostic]:
    """Return a finding for each baseline of a run that is no more."""
    return [lost for outcome in outcomes for lost in testbench.lost_runs(outcome.scenario)]


def told_lost(lost: Diagnostic) -> str:
    """Return what is told of a baseline of a run that is no more, with its mend in a line of its own."""
    mend = f"{lost.hint[0].upper()}{lost.hint[1:]}."
    return f"{lost.places[0].name} {lost.message.removeprefix('this ')}.\n  {mend}"


def exit_code(outcomes: Sequence[Outcome], lost: Sequence[Diagnostic] = ()) -> Exit:
    """Return 1 where a requirement is missed or a run broke down, 4 where only baselines are not kept.

    One whose run is `lost` is not kept either.
    """
    runs = [run for outcome in outcomes for run in outcome.variants.values()]
    if worst([run.verdict for run in runs]) is Status.PASS:
        return Exit.BASELINE if lost else Exit.GREEN
    verdicts = [verdict.status for run in runs for verdict in summary.verdicts_of(run)]
    broke_down = any(run.trace.fault is not None for run in runs)
    compared = all(run.compared is not None for run in runs)
    met = all(each is Status.PASS for each in verdicts)
    return Exit.BASELINE if compared and met and not broke_down else Exit.VERDICT

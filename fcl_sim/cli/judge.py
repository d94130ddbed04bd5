"""`fcl-sim judge`: a recorded trace by the requirements of a scenario."""

from pathlib import Path

import click

from fcl_sim import testbench
from fcl_sim.cli.doors import Exit
from fcl_sim.cli.table import console, print_verdicts
from fcl_sim.judge.verdict import Status, worst
from fcl_sim.loop.trace_reader import read as read_trace
from fcl_sim.report import results, summary
from fcl_sim.report.words import counted
from fcl_sim.scenario.kinds import File, check_kind
from fcl_sim.scenario.reader import read


@click.command()
@click.argument("trace", type=click.Path(path_type=Path))
@click.option(
    "--with",
    "scenario_file",
    type=click.Path(path_type=Path),
    metavar="SCENARIO.toml",
    required=True,
    help="Scenario whose requirements are asked.",
)
@click.option(
    "--variant", default=testbench.BASE, metavar="NAME", help="Run whose expectations count; else base."
)
@click.option("--json", "as_json", is_flag=True, help="Print the results as one JSON document.")
def command(*, trace: Path, scenario_file: Path, variant: str, as_json: bool) -> Exit:
    """Judge a recorded trace by the requirements of a scenario.

    TRACE is a .csv with a header `time [s],NAME [UNIT],...` or a .npz that `fcl-sim run --trace` wrote.
    """
    scenario = read(scenario_file)
    check_kind(trace, File.TRACE, "JDG301")
    verdicts = testbench.judge_trace(read_trace(trace), scenario, variant)
    if as_json:
        click.echo(results.recorded(trace.as_posix(), scenario, variant, verdicts), nl=False)
    else:
        print_verdicts(list(summary.rows_of(scenario.name, variant, verdicts)), console())
        click.echo(summary.sentence_of(counted(len(verdicts), "verdict"), verdicts))
    passed = worst([each.status for each in verdicts]) is Status.PASS
    return Exit.GREEN if passed else Exit.VERDICT

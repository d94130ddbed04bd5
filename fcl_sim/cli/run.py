"""`fcl-sim run`: the main job."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import click
from click.core import ParameterSource

from fcl_sim import testbench
from fcl_sim.cli.against import against, print_against
from fcl_sim.cli.benches import reports_folder, scenario_files, watched_folders
from fcl_sim.cli.coverage import check_waivers, met, print_coverage
from fcl_sim.cli.doors import Exit, say
from fcl_sim.cli.outputs import Outputs
from fcl_sim.cli.progress import progress
from fcl_sim.cli.regressions import exit_code, lost_runs, print_regressions
from fcl_sim.cli.stopwatch import Stopwatch
from fcl_sim.cli.table import console, print_envelopes, print_runs, print_verdicts
from fcl_sim.cli.warned import warnings
from fcl_sim.cli.watch import watch as watch_scenarios
from fcl_sim.diagnostics import Diagnostic, InputFault
from fcl_sim.diagnostics.render import render
from fcl_sim.judge.verdict import Status
from fcl_sim.kernel_cache import cache_folder
from fcl_sim.loop import trace_file
from fcl_sim.report import coverage_words, results, summary, writer
from fcl_sim.report.rules_there import misses
from fcl_sim.scenario.document import shown
from fcl_sim.scenario.overrides import setting
from fcl_sim.testbench import Outcome
from fcl_sim.verify.cover import LEAST
from fcl_sim.verify.coverage import Coverage, Item

MOST_MISSES = 5
"""Misses that are told without `--verbose`."""
FORMATS = ("text", "json", "github")
COMPILING = "Compiling the simulator for this machine. It takes a minute or more, and is done once."
FILE: click.Path = click.Path(path_type=Path, dir_okay=False)


def _settings(_ctx: click.Context, _param: click.Parameter, texts: tuple[str, ...]) -> dict[str, object]:
    """Return overrides by key; wrong usage where a text is not KEY=VALUE."""
    try:
        return dict(setting(text) for text in texts)
    except InputFault as fault:
        wrong = fault.diagnostics[0]
        raise click.BadParameter(f"{wrong.message}: {wrong.hint}") from None


@click.command()
@click.argument("paths", metavar="[PATH]...", nargs=-1, type=click.Path(path_type=Path))
@click.option("--watch", "is_watched", is_flag=True, help="Run again what is saved, and show it on a page.")
@click.option(
    "--set",
    "overrides",
    metavar="KEY=VALUE",
    multiple=True,
    callback=_settings,
    help="Override a key of every scenario.",
)
@click.option("--reports", type=click.Path(path_type=Path), metavar="DIR", help="Write the reports there.")
@click.option("--no-report", is_flag=True, help="Write no reports.")
@click.option("--png", is_flag=True, help="Write the pictures of the report as PNG, too.")
@click.option("--pages", is_flag=True, help="Write the pages of the report as PNG, too: pages/001.png ...")
@click.option("--html", is_flag=True, help="Write a page for a browser, too: report.html.")
@click.option("-v", "--verbose", is_flag=True, help="Print every verdict, of however many scenarios.")
@click.option(
    "--format",
    "form",
    type=click.Choice(FORMATS),
    help="How results are printed; github adds annotations, as it does by itself under GITHUB_ACTIONS.",
)
@click.option("--json", "form", flag_value="json", help="Print one JSON document: --format json.")
@click.option("--junit", type=FILE, metavar="FILE", help="Write the verdicts to FILE as JUnit XML.")
@click.option("--sarif", type=FILE, metavar="FILE", help="Write what is not green to FILE as SARIF.")
@click.option(
    "--summary",
    type=FILE,
    metavar="FILE",
    help="Write a page of Markdown to FILE; else to the job's, where GITHUB_STEP_SUMMARY names one.",
)
@click.option(
    "--trace",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Write every signal to FILE, .csv or .npz; of several runs to FILE-SCENARIO-VARIANT each.",
)
@click.option(
    "--against",
    "older",
    metavar="REV|OLD.fcl",
    help="Show every figure and signal beside those of a git revision, or of an older rule base.",
)
@click.option("--coverage", "show_coverage", is_flag=True, help="Tell how far each rule was exercised.")
@click.option(
    "--require-coverage",
    "required",
    type=click.Choice([each.value for each in Item]),
    help="Leave with 1 unless every rule fired, was dominant or was decisive, or is waived.",
)
@click.option(
    "--decisive-by",
    "least",
    type=click.FloatRange(0.0, 1.0, max_open=True),
    metavar="PART",
    default=LEAST,
    show_default=True,
    help="Part of its range by which an output must change without a rule for it to be decisive.",
)
def command(  # noqa: PLR0913  an option each
    *,
    paths: tuple[Path, ...],
    is_watched: bool,
    overrides: dict[str, object],
    reports: Path | None,
    no_report: bool,
    png: bool,
    pages: bool,
    html: bool,
    verbose: bool,
    form: str | None,
    older: str | None,
    show_coverage: bool,
    required: str | None,
    least: float,
    **targets: Path | None,
) -> Exit:
    """Simulate scenarios in closed loop, judge them, write reports.

    PATH is a scenario or a folder of them; without one, the bench of the current folder is run, else the
    shipped one. Reports are written to reports/ of the bench of the current folder, else of
    that folder itself.
    """
    files = scenario_files(paths)
    if is_watched:
        _check_alone(click.get_current_context())
        watch_scenarios(files, overrides, watched_folders(paths))
    folder = None if no_report else reports or reports_folder()
    trace = targets.pop("trace")
    outputs = Outputs.of(targets, form)
    as_json = form == "json"
    watch = Stopwatch(click.get_current_context().obj)
    outcomes, faults = _simulate(files, overrides, watch)
    lost = lost_runs(outcomes)
    if older is not None and not faults:
        outcomes = against(outcomes, older)
        watch.lap("the older version")
    if not as_json:
        _print(outcomes, lost, verbose=verbose)
        if older is not None:
            print_against(outcomes, older, console())
    written = outputs.write(outcomes, [*faults, *lost])
    if faults:
        raise InputFault(faults)  # no report either: it would not say what is missing
    covered = testbench.coverage(outcomes, least)
    watch.lap("coverage")
    check_waivers(covered)
    if as_json:
        click.echo(results.text(outcomes, covered), nl=False)
        for each in lost:
            say(render(each))
    else:
        _print_coverage(covered, whole=show_coverage)
    written += _write_traces(outcomes, trace) if trace else []
    if folder:
        with progress("writing reports") as advance:
            also = {"png": png, "pages": pages, "html": html}
            made = writer.write(outcomes, folder, advance, covered, lap=watch.lap, **also)
            written += made[: 1 + html]
    for file in written:
        click.echo(f"written: {shown(file)}", err=as_json)
    click.echo(str(watch), err=as_json)
    code = exit_code(outcomes, lost)
    if code is Exit.GREEN and required and not met(covered, Item(required)):
        return Exit.VERDICT
    return code


def _check_alone(ctx: click.Context) -> None:
    """Raise UsageError where an option stands beside --watch that asks for files or for another output."""
    for each in ctx.command.params:
        given = each.name and ctx.get_parameter_source(each.name) is ParameterSource.COMMANDLINE
        if given and each.name not in {"paths", "overrides", "is_watched"}:
            raise click.UsageError(
                f"--watch writes nothing and judges nothing at the end: leave {each.opts[0]} out."
            )


def _print_coverage(covered: Sequence[Coverage], *, whole: bool) -> None:
    if whole:
        click.echo()
        print_coverage(covered, console())
    told = coverage_words.sentence(covered)
    if told:
        click.echo(told if whole else f"{told} (--coverage tells which)")


def _simulate(
    files: Sequence[Path], overrides: Mapping[str, object], watch: Stopwatch
) -> tuple[list[Outcome], dict[Diagnostic, None]]:
    """Run every scenario; return what came of those that could be run, and each fault of the others once."""
    outcomes: list[Outcome] = []
    faults: dict[Diagnostic, None] = {}
    is_warm = _is_warm()
    if not is_warm:
        click.echo(COMPILING, err=True)
    with progress("simulating") as advance:
        advance(0, len(files))
        each_found = zip(files, testbench.run_files(files, overrides), strict=True)
        for done, (file, found) in enumerate(each_found, 1):
            advance(done, len(files), file.stem)
            if isinstance(found, Outcome):
                outcomes.append(found)
            else:
                faults.update(dict.fromkeys(each.within(str(file)) for each in found.diagnostics))
    for told in warnings(outcomes):
        say(told)
    watch.lap("simulating and judging" if is_warm else "compiling, simulating and judging")
    return outcomes, faults


def _is_warm() -> bool:
    """Return whether an earlier process has left compiled kernels."""
    folder = cache_folder()
    return folder is not None and any(folder.iterdir())


def _print(outcomes: Sequence[Outcome], lost: Sequence[Diagnostic], *, verbose: bool) -> None:
    """Print every verdict of one scenario; of several their runs, and what is not green, unless `verbose`."""
    brief = len(outcomes) > 1 and not verbose
    rows, over = list(summary.rows(outcomes)), list(summary.envelope_rows(outcomes))
    if brief:
        print_runs(list(summary.run_rows(outcomes)), console())
        rows = [row for row in rows if row.status is not Status.PASS]
        over = [row for row in over if row.status is not Status.PASS]
        click.echo()
    if rows or not brief:
        print_verdicts(rows, console())
    for ending in summary.endings(outcomes):
        click.echo(ending)
    _print_misses(list(misses(outcomes)), verbose=verbose)
    if over:
        click.echo()
        print_envelopes(over, console())
    if over or (brief and rows):
        click.echo()
    if outcomes:
        click.echo(summary.sentence(outcomes))
        print_regressions(outcomes, lost)


def _print_misses(told: Sequence[str], *, verbose: bool) -> None:
    """Print how requirements are missed, and what the rules do there: the first few, unless `verbose`."""
    shown = told if verbose or len(told) <= MOST_MISSES + 1 else told[:MOST_MISSES]
    if shown:
        click.echo()
    for each in shown:
        click.echo(each)
    if len(shown) < len(told):
        click.echo(f"and {len(told) - len(shown)} further misses (-v tells them)")


def _write_traces(outcomes: Sequence[Outcome], file: Path) -> list[Path]:
    runs = [(outcome.scenario.name, run) for outcome in outcomes for run in outcome.variants.values()]
    written = []
    for scenario, run in runs:
        name = f"{file.stem}-{writer.slug(scenario)}-{writer.slug(run.variant)}{file.suffix}"
        path = file if len(runs) == 1 else file.with_name(name)
        trace_file.write(run.trace, path)
        written.append(path)
    return written

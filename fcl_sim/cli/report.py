"""`fcl-sim report`: the pages of a run again, from what it has stored, or those of a rule base alone."""

from dataclasses import replace
from pathlib import Path

import click

from fcl_sim.cli.benches import reports_folder
from fcl_sim.cli.progress import progress
from fcl_sim.cli.stopwatch import Stopwatch
from fcl_sim.diagnostics import InputFault
from fcl_sim.report import archive, writer
from fcl_sim.report.provenance import date_asked
from fcl_sim.scenario.document import shown
from fcl_sim.scenario.kinds import RESULTS, File, check_kind

RULE_BASE = ".fcl"


@click.command()
@click.argument("file", metavar="RESULTS.json|FILE.fcl", type=click.Path(path_type=Path))
@click.argument("scenarios", metavar="[SCENARIO]...", nargs=-1)
@click.option("--reports", type=click.Path(path_type=Path), metavar="DIR", help="Write the report there.")
@click.option("--html", is_flag=True, help="Write the page for a browser, too: report.html.")
@click.option("--png", is_flag=True, help="Write the pictures of the report as PNG, too.")
@click.option("--pages", is_flag=True, help="Write the pages of the report as PNG, too: pages/001.png ...")
def command(
    file: Path, scenarios: tuple[str, ...], reports: Path | None, *, html: bool, png: bool, pages: bool
) -> None:
    """Write the report of a run from what it has stored, or that of a rule base alone.

    RESULTS.json is what `fcl-sim run` has written, with the runs beside it in RESULTS.npz, or the folder
    of a results.json; nothing is simulated. The report is written into the same folder; that of some
    SCENARIOs alone, by their names, into a folder in there. The report of FILE.fcl is FILE.pdf in
    reports/: terms, rules, characteristic, findings.
    """
    watch = Stopwatch(click.get_current_context().obj)
    if file.suffix.lower() == RULE_BASE:
        if scenarios:
            raise click.UsageError("a rule base has no scenarios; name a RESULTS.json to choose some of its")
        if html:
            raise click.UsageError("the page shows runs, and a rule base alone has none; leave --html out")
        written = writer.write_alone(file, reports or reports_folder(), png=png, pages=pages)
    else:
        written = _of_results(file, scenarios, reports, watch, html=html, png=png, pages=pages)
    for each in written[: 1 + html]:
        click.echo(f"written: {shown(each)}")
    click.echo(str(watch), err=True)


def _of_results(
    file: Path, scenarios: tuple[str, ...], reports: Path | None, watch: Stopwatch, **also: bool
) -> list[Path]:
    if file.is_dir():
        file = _inside(file)
    check_kind(file, File.RESULTS, "RUN204")
    stored = archive.chosen(archive.read(file), scenarios)
    asked = date_asked()
    source = None if scenarios or asked else file
    if asked is not None:
        stored = replace(stored, origin=replace(stored.origin, date=asked))
    watch.lap("reading")
    part = ["-".join(map(writer.slug, scenarios))] if scenarios else []
    folder = reports or file.parent.joinpath(*part)
    with progress("writing reports") as advance:
        return writer.write_stored(stored, folder, advance, lap=watch.lap, source=source, **also)


def _inside(folder: Path) -> Path:
    """Return the results in a folder; InputFault where there are none."""
    if (folder / RESULTS).is_file():
        return folder / RESULTS
    hint = "`fcl-sim run` writes it into reports/, or into the folder that --reports names"
    raise InputFault.at_file("RUN204", shown(folder), f"there is no {RESULTS} in this folder", hint)

"""`fcl-sim report`: the pages of a run again, from what it has stored; nothing is simulated."""

from dataclasses import replace
from pathlib import Path

import click

from fcl_sim.cli.progress import progress
from fcl_sim.cli.stopwatch import Stopwatch
from fcl_sim.report import archive, writer
from fcl_sim.report.provenance import date_asked
from fcl_sim.scenario.document import shown


@click.command()
@click.argument("results", metavar="RESULTS.json", type=click.Path(path_type=Path))
@click.argument("scenarios", metavar="[SCENARIO]...", nargs=-1)
@click.option("--reports", type=click.Path(path_type=Path), metavar="DIR", help="Write the report there.")
@click.option("--png", is_flag=True, help="Write the pictures of the report as PNG, too.")
def command(results: Path, scenarios: tuple[str, ...], reports: Path | None, *, png: bool) -> None:
    """Write the report of a run from what it has stored.

    RESULTS.json is what `fcl-sim run` has written, with the runs beside it in RESULTS.npz. The report is
    written into the same folder; that of some SCENARIOs alone, by their names, into a folder in there.
    """
    watch = Stopwatch()
    stored = archive.chosen(archive.read(results), scenarios)
    asked = date_asked()
    if asked is not None:
        stored = replace(stored, origin=replace(stored.origin, date=asked))
    watch.lap("reading")
    part = ["-".join(map(writer.slug, scenarios))] if scenarios else []
    folder = reports or results.parent.joinpath(*part)
    with progress("writing reports") as advance:
        written = writer.write_stored(stored, folder, advance, png=png, lap=watch.lap)
    click.echo(f"written: {shown(written[0])}")
    click.echo(str(watch), err=True)

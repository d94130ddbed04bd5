"""`fcl-sim plot`: a rule base in pictures."""

from datetime import UTC, datetime
from pathlib import Path

import click

from fcl_sim.block import load_all
from fcl_sim.report.sheet import pictures_of, write_sheet


@click.command()
@click.argument("file", metavar="FILE.fcl", type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path),
    metavar="OUT",
    help="Where to: OUT.png, OUT.svg or OUT.pdf; else FILE.png in the current folder.",
)
def command(file: Path, output: Path | None) -> None:
    """Draw membership functions and the characteristic curve or surface.

    Two inputs make a map, one a curve; of more inputs two are drawn and the others held in the middle of
    their ranges. Where no rule is active the picture is hatched.
    """
    pictures = [picture for block in load_all(file).values() for picture in pictures_of(block)]
    target = output or Path(f"{file.stem}.png")
    write_sheet(pictures, target, datetime.fromtimestamp(int(file.stat().st_mtime), UTC))
    click.echo(f"written: {target}")

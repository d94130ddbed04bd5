"""`fcl-sim vectors`: inputs that try a rule base, with what it gives, for a test of its translation."""

from pathlib import Path

import click

from fcl_sim.block import ARITHMETICS, load
from fcl_sim.loop import trace_file
from fcl_sim.proof.prove import prove
from fcl_sim.proof.universe import UniverseError, universe_of
from fcl_sim.report.words import counted
from fcl_sim.verify.vectors import MOST, vectors


@click.command()
@click.argument("file", metavar="FILE.fcl", type=click.Path(path_type=Path))
@click.argument("out", metavar="OUT.csv", type=click.Path(path_type=Path))
@click.option("--block", metavar="NAME", help="Which function block, where the file has several.")
@click.option(
    "--arithmetic", type=click.Choice(ARITHMETICS), help="What the answers are in; else what it declares."
)
@click.option(
    "--universe",
    "stretches",
    metavar="NAME=LOW..HIGH",
    multiple=True,
    help="From where to where an input goes; else a little beyond its terms' points.",
)
@click.option(
    "--most", type=click.IntRange(1), default=MOST, show_default=True, help="How many vectors at most."
)
def command(
    *, file: Path, out: Path, block: str | None, arithmetic: str | None, stretches: tuple[str, ...], most: int
) -> None:
    """Write test vectors for a PLC: inputs, and the outputs that are right.

    Beside each output stands by how much it may differ. They visit every breakpoint, both sides of it,
    the cells between and the gaps, in an order that matters: an output without a rule may keep its value.
    Put the inputs through the PLC one after the other, write its answers into the columns of the outputs,
    and `fcl-sim replay FILE.fcl ANSWERS.csv` names the first row that deviates, with its rules.
    """
    loaded = load(file, block)
    try:
        universe = universe_of(loaded.function_block, stretches)
    except UniverseError as error:
        raise click.UsageError(str(error)) from None
    found = vectors(loaded, universe, prove(loaded.function_block, universe), arithmetic or "", most)
    out.parent.mkdir(parents=True, exist_ok=True)
    trace_file.write(found, out)
    click.echo(f"written: {out}, {counted(len(found.ticks), 'vector')}", err=True)

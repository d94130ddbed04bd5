"""`fcl-sim replay`: recorded inputs through a rule base, its outputs beside the recorded ones."""

import csv
import json
import sys
from dataclasses import asdict
from pathlib import Path
from typing import Any

import click
import numpy as np

from fcl_sim.block import ARITHMETICS, Block, load
from fcl_sim.cli.doors import Exit
from fcl_sim.judge.wording import number, seconds
from fcl_sim.loop import trace_file
from fcl_sim.loop.trace_reader import read
from fcl_sim.proof.told_gaps import instead
from fcl_sim.report.words import counted
from fcl_sim.scenario.kinds import File, check_kind
from fcl_sim.verify.replay import Comparison, Deviation, Replay, replay

SCHEMA = 1


def _columns(_ctx: click.Context, _param: click.Parameter, texts: tuple[str, ...]) -> dict[str, str]:
    """Return variables by column; wrong usage where a text is not COLUMN=VARIABLE."""
    found = {}
    for text in texts:
        column, equals, variable = (part.strip() for part in text.rpartition("="))
        if not (column and equals and variable):
            raise click.BadParameter(f"'{text}' is not COLUMN=VARIABLE")
        found[column] = variable
    return found


@click.command()
@click.argument("file", metavar="FILE.fcl", type=click.Path(path_type=Path))
@click.argument("log", metavar="LOG", type=click.Path(path_type=Path))
@click.option("--block", metavar="NAME", help="Which function block, where the file has several.")
@click.option(
    "--arithmetic", type=click.Choice(ARITHMETICS), help="What it computes in; else what it declares."
)
@click.option(
    "--map",
    "columns",
    metavar="COLUMN=VARIABLE",
    multiple=True,
    callback=_columns,
    help="Say which variable a column is.",
)
@click.option(
    "--absolute", type=click.FloatRange(0.0), metavar="VALUE", help="Tolerance in the unit of the output."
)
@click.option(
    "--relative", type=click.FloatRange(0.0), metavar="PART", help="Tolerance as part of the output's range."
)
@click.option(
    "--write", type=click.Path(path_type=Path), metavar="FILE", help="Write what came out, as .csv or .npz."
)
@click.option("--json", "as_json", is_flag=True, help="Print the results as one JSON document.")
def command(  # noqa: PLR0913  an option each
    *,
    file: Path,
    log: Path,
    block: str | None,
    arithmetic: str | None,
    columns: dict[str, str],
    absolute: float | None,
    relative: float | None,
    write: Path | None,
    as_json: bool,
) -> Exit:
    """Put recorded inputs through a rule base and compare its outputs with the recorded ones.

    LOG is a .csv with a header `time [s],NAME [UNIT],...` or a .npz, as of `fcl-sim run --trace`. Its columns
    have the names of the variables, or end in `.VARIABLE`. Without one for an output the outputs are printed.
    """
    loaded = load(file, block)
    check_kind(log, File.TRACE, "JDG301")
    found = replay(
        loaded,
        read(log),
        arithmetic or "",
        columns=columns,
        absolute=absolute,
        relative=relative,
        name=log.as_posix(),
    )
    if write is not None:
        write.parent.mkdir(parents=True, exist_ok=True)
        trace_file.write(found.trace, write)
        click.echo(f"written: {write}", err=True)
    if as_json:
        click.echo(json.dumps(document(found, file, log), indent=1, ensure_ascii=False))
    elif found.comparisons:
        for line in _lines(found, loaded):
            click.echo(line)
    elif write is None:
        _print_outputs(found)
    return Exit.GREEN if found.first is None else Exit.VERDICT


def _lines(found: Replay, block: Block) -> list[str]:
    head = f"{found.name} in {found.arithmetic}: {counted(len(found.ticks), 'sample')}"
    lines = [head, *(_line(each) for each in found.comparisons)]
    first = found.first
    if first is None or first.first is None:
        return lines
    at, record = first.first, found.record
    values = zip(record.input_names, record.inputs[at.sample - 1].tolist(), strict=True)
    inputs = ", ".join(f"{name} = {value:.9g}" for name, value in values)
    when = f"in sample {at.sample}, at {seconds(at.tick / 1e9)}"
    lines += ["", f"First {when}: {_beside(first, at)}", f"  {inputs}"]
    for variable, terms in found.terms.items():
        told = ", ".join(f"{term} {number(degree)}" for term, degree in terms.items())
        lines.append(f"  {variable}: {told}")
    lines += [f"  {number(each.degree):>7}  rule {each.label}: {each.text}" for each in found.rules]
    if not record.active[at.sample - 1, record.output_names.index(first.variable)]:
        lines.append(f"  no rule is active for {first.variable}: {_instead(block, first.variable)}")
    return lines


def _instead(block: Block, output: str) -> str:
    """Return what is given out for an output without an active rule."""
    own = [each for each in block.function_block.defuzzifications if each.variable == output]
    return instead(own[0]) if own else "0 is given out"


def _line(each: Comparison) -> str:
    allowed = f"tolerance {number(each.tolerance)}"
    if each.deviating:
        most = f"; most {_at(each.largest)}" if each.largest else ""
        many = f"{each.deviating} of {counted(each.compared, 'sample')} deviate"
        return f"{each.variable}: {many} ({allowed}){most}"
    if not each.compared:
        return f"{each.variable}: nothing was recorded in `{each.column}`"
    most = f"largest difference {_at(each.largest)}" if each.largest else "no difference"
    return f"{each.variable}: agrees in {counted(each.compared, 'sample')} ({allowed}); {most}"


def _at(each: Deviation) -> str:
    return f"{number(each.difference)} in sample {each.sample}, at {seconds(each.tick / 1e9)}"


def _beside(first: Comparison, at: Deviation) -> str:
    return f"{first.variable} is {at.replayed:.9g}, and `{first.column}` has {at.recorded:.9g}"


def _print_outputs(found: Replay) -> None:
    """Print time, inputs and outputs as CSV."""
    trace = found.trace
    lines = csv.writer(sys.stdout, lineterminator="\n")
    lines.writerow(["time [s]", *(f"{name} [{trace.units[name] or '1'}]" for name in trace.names)])
    lines.writerows(np.column_stack([trace.time, trace.values]).tolist())


def document(found: Replay, file: Path, log: Path) -> dict[str, Any]:
    """Return a replay as JSON's types."""
    return {
        "schema": SCHEMA,
        "tool": "fcl_sim",
        "file": file.as_posix(),
        "log": log.as_posix(),
        "function_block": found.name,
        "arithmetic": found.arithmetic,
        "samples": len(found.ticks),
        "inputs": dict(found.inputs),
        "outputs": [_comparison(each) for each in found.comparisons],
        "rules": [asdict(each) for each in found.rules],
        "terms": {variable: dict(terms) for variable, terms in found.terms.items()},
    }


def _comparison(each: Comparison) -> dict[str, Any]:
    return {
        "variable": each.variable,
        "column": each.column,
        "tolerance": each.tolerance,
        "compared": each.compared,
        "deviating": each.deviating,
        "first": _deviation(each.first),
        "largest": _deviation(each.largest),
    }


def _deviation(each: Deviation | None) -> dict[str, Any] | None:
    if each is None:
        return None
    finite = np.isfinite(each.replayed)
    return {
        "sample": each.sample,
        "time_ns": each.tick,
        "recorded": each.recorded,
        "replayed": each.replayed if finite else None,
        "difference": each.difference if finite else None,
    }

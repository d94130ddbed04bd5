"""`fcl-sim matrix`: the rules of a table put into a rule base; and the table that a rule base is."""

from pathlib import Path

import click

from fcl_sim.cli.doors import say
from fcl_sim.diagnostics import Diagnostic, InputFault, Place
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.fcl import read_file, replace_rules
from fcl_sim.fcl.files import open_source
from fcl_sim.fcl.write_rules import rule_lines
from fcl_sim.matrix import Found, as_csv, as_text, as_toml, matrices, read, rules
from fcl_sim.model import FunctionBlock

WIDTH = 100
FORMS = {"csv": as_csv, "toml": as_toml}


@click.command()
@click.argument("table", type=click.Path(path_type=Path))
@click.argument("file", metavar="FILE.fcl", type=click.Path(path_type=Path))
@click.option(
    "-o", "--output", type=click.Path(path_type=Path), metavar="OUT.fcl", help="Where to; else stdout."
)
def command(table: Path, file: Path, output: Path | None) -> None:
    """Put the rules of a table into a rule base, in place of its own.

    TABLE is CSV or TOML: a row for each term of one input, a column for each of another, in the cells the
    terms of the output. FILE.fcl has the variables and their terms; all but its rules stays as it is.
    `fcl-sim show matrix FILE.fcl --as csv` writes the table that a rule base has now.
    """
    source = open_source(file)
    block = _only(file)
    found = read(open_source(table))
    text = replace_rules(source, block, rules(found, block))
    if output is None:
        click.echo(text, nl=False)
    else:
        output.write_text(text, encoding="utf-8")
        say(f"written: {output}")


def matrix_text(file: Path, form: str) -> str:
    """Return the matrices of a rule base as text, CSV or TOML.

    InputFault where it has none, or in CSV and TOML where it has rules beside them.
    """
    blocks = read_file(file)
    if blocks.errors:
        raise InputFault(blocks.errors)
    found = {each.name: matrices(each) for each in blocks.blocks}
    if form == "text":
        parts = [_with_rest(each) for each in found.values()]
        if len(parts) > 1:
            parts = [f"{name}:\n\n{part}" for name, part in zip(found, parts, strict=True)]
        return "\n".join(parts)
    beside = [rule for each in found.values() for rule in each.beside]
    if beside:
        places = tuple(Place(each.span) for each in beside if each.span)
        message = f"{len(beside)} of the rules stand in no cell of a matrix"
        hint = "as text they are shown below it: fcl-sim show matrix without --as"
        raise InputFault([Diagnostic(code="MTX106", message=message, places=places, hint=hint)])
    return "\n".join(FORMS[form](each.matrices) for each in found.values())


def _with_rest(found: Found) -> str:
    text = as_text(found.matrices)
    rest = [line for rule in found.beside for line in rule_lines(rule, WIDTH)]
    return f"{text}\nNot in a cell:\n" + "".join(f"{line}\n" for line in rest) if rest else text


def _only(file: Path) -> FunctionBlock:
    """Return the one function block of a file, which has one rule block."""
    reading = read_file(file)
    if reading.errors:
        raise InputFault(reading.errors)
    if len(reading.blocks) > 1:
        names = listed([each.name for each in reading.blocks])
        raise _refused(
            reading.blocks[1], "there are several function blocks in this file", f"part them: {names}"
        )
    (block,) = reading.blocks
    if len(block.rule_blocks) != 1:
        hint = "keep one of them: a table says nothing of the others"
        raise _refused(block, f"`{block.name}` has {len(block.rule_blocks)} rule blocks", hint)
    return block


def _refused(block: FunctionBlock, message: str, hint: str) -> InputFault:
    places = (Place(block.span),) if block.span else ()
    return InputFault([Diagnostic(code="MTX106", message=message, places=places, hint=hint)])

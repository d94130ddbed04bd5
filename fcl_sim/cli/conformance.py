"""`fcl-sim conformance`: Tables 8 to 11 of IEC 61131-7, of fcl_sim and of rule bases."""

import json
from pathlib import Path
from typing import Any

import click

from fcl_sim import fcl
from fcl_sim.cli.doors import Exit, say
from fcl_sim.diagnostics import InputFault
from fcl_sim.diagnostics.render import render_all
from fcl_sim.fcl.conformance_json import blocks_document, tables_document
from fcl_sim.fcl.conformance_targets import target as find_target
from fcl_sim.fcl.conformance_text import block_text, statement_text, tables_text


@click.command()
@click.argument("file", metavar="[FILE.fcl]", required=False, type=click.Path(path_type=Path))
@click.option("--target", metavar="NAME|FILE.toml", help="Print what a target says of itself instead.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON document.")
def command(file: Path | None, target: str | None, *, as_json: bool) -> Exit:
    """Print Tables 8 to 11 of IEC 61131-7: what fcl_sim has, or what a rule base needs.

    Without a file, every language element of the three levels with what fcl_sim does, and its data check
    list. With one, the level that each of its function blocks needs, every feature beyond the Basic Level
    with its lines, and its own figures in the form of Table 11. `fcl-sim check --target` holds a rule base
    against the tables of a PLC.
    """
    if target is not None:
        if file is not None or as_json:
            raise click.UsageError(
                "--target stands alone; to hold a rule base against it: fcl-sim check --target"
            )
        click.echo(statement_text(find_target(target)))
        return Exit.GREEN
    if file is None:
        click.echo(_document(tables_document()) if as_json else tables_text())
        return Exit.GREEN
    reading = fcl.read_file(file)
    if reading.errors:
        raise InputFault(reading.diagnostics)
    if as_json:
        click.echo(_document(blocks_document(str(file), reading.blocks)))
    else:
        click.echo("\n\n".join(block_text(each) for each in reading.blocks))
    if reading.diagnostics:
        say(render_all(reading.diagnostics))
    return Exit.GREEN


def _document(document: dict[str, Any]) -> str:
    return json.dumps(document, indent=2, ensure_ascii=False)

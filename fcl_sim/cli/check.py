"""`fcl-sim check`: what is wrong with rule bases."""

from pathlib import Path

import click

from fcl_sim import fcl
from fcl_sim.cli.doors import Exit
from fcl_sim.diagnostics import Diagnostic, InputFault
from fcl_sim.diagnostics.render import render, summary
from fcl_sim.engine.assemble import assemble


@click.command()
@click.argument("files", metavar="FILE.fcl...", nargs=-1, required=True, type=click.Path(path_type=Path))
def command(files: tuple[Path, ...]) -> Exit:
    """Read rule bases and list what is wrong with them.

    Every finding is listed with its place and a hint: characters, grammar, names, and what cannot be
    evaluated. What the rules say together (gaps, contradictions, rules without effect) is not looked at.
    """
    is_clean = True
    for file in files:
        findings = _findings(file)
        for each in findings:
            click.echo(render(each))
        click.echo(f"{file}: {summary(findings)}")
        is_clean &= not any(each.is_error for each in findings)
    return Exit.GREEN if is_clean else Exit.INPUT


def _findings(file: Path) -> tuple[Diagnostic, ...]:
    """Return everything that is to be said about a file, whether it can be read or not."""
    try:
        reading = fcl.read_file(file)
    except InputFault as fault:
        return fault.diagnostics
    findings = reading.diagnostics
    for block in reading.blocks:
        try:
            assemble(block)
        except InputFault as fault:
            findings += fault.diagnostics
    return findings

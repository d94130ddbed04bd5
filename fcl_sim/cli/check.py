"""`fcl-sim check`: what is wrong with rule bases."""

import json
from collections.abc import Sequence
from pathlib import Path

import click

from fcl_sim import __version__, fcl
from fcl_sim.cli.doors import Exit
from fcl_sim.cli.outputs import root
from fcl_sim.cli.rule_bases import rule_bases
from fcl_sim.diagnostics import Diagnostic, InputFault, Severity
from fcl_sim.diagnostics.as_github import as_github
from fcl_sim.diagnostics.as_json import as_json
from fcl_sim.diagnostics.as_sarif import as_sarif
from fcl_sim.diagnostics.render import render, summary
from fcl_sim.engine.assemble import assemble
from fcl_sim.fcl.conformance_excess import excesses
from fcl_sim.fcl.conformance_statement import Statement
from fcl_sim.fcl.conformance_targets import target
from fcl_sim.fcl.targets import NAMES

FORMATS = ("text", "json", "sarif", "github")


@click.command()
@click.argument("paths", metavar="PATH...", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option(
    "--format", "form", type=click.Choice(FORMATS), default="text", help="How findings are printed."
)
@click.option("--json", "form", flag_value="json", help="Print one JSON document: --format json.")
@click.option(
    "--target",
    "targets",
    metavar="NAME|FILE.toml",
    multiple=True,
    help=f"Hold them against the statement of a PLC as well: {', '.join(NAMES)}, or a file.",
)
def command(paths: tuple[Path, ...], form: str, targets: tuple[str, ...]) -> Exit:
    """Read rule bases and list what is wrong with them.

    PATH is a file, a folder to search for *.fcl, or a pattern.

    Every finding is listed with its place and a hint: characters, grammar, names, and what cannot be
    evaluated. What the rules say together (gaps, contradictions, rules without effect) is not looked at.
    `fcl-sim explain CODE` tells more about a finding.
    """
    statements = [target(each) for each in targets]
    files, faults = rule_bases(paths)
    findings = [*faults, *(each for file in files for each in _findings(file, statements))]
    match form:
        case "json":
            click.echo(_document(as_json(findings, [str(each) for each in files])))
        case "sarif":
            click.echo(_document(as_sarif(findings, __version__, root())))
        case _:
            for each in findings:
                click.echo(as_github(each, root()) if form == "github" else render(each))
            click.echo(_summary(files, findings))
    return Exit.INPUT if any(each.is_error for each in findings) else Exit.GREEN


def _findings(file: Path, statements: Sequence[Statement]) -> list[Diagnostic]:
    """Return everything that is to be said about a file, whether it can be read or not."""
    try:
        reading = fcl.read_file(file)
    except InputFault as fault:
        return list(fault.diagnostics)
    findings = list(reading.diagnostics)
    for block in reading.blocks:
        try:
            assemble(block)
        except InputFault as fault:
            findings += fault.diagnostics
        for statement in statements:
            findings += excesses(block, statement)
    return [each.within(str(file)) for each in findings]


def _summary(files: Sequence[Path], findings: Sequence[Diagnostic]) -> str:
    """Return one line on all files, and where to read more of the gravest finding."""
    subject = str(files[0]) if len(files) == 1 else f"{len(files)} files"
    line = f"{subject}: {summary(findings)}"
    if not findings:
        return line
    gravest = min(findings, key=lambda each: list(Severity).index(each.severity))
    return f"{line} (fcl-sim explain {gravest.code} tells more)"


def _document(content: object) -> str:
    return json.dumps(content, indent=2, ensure_ascii=False)

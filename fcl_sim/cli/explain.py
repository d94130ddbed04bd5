"""`fcl-sim explain`: what the code of a finding means."""

import json

import click

from fcl_sim.diagnostics import nearest
from fcl_sim.diagnostics.codes import CODES
from fcl_sim.diagnostics.page import Page, page
from fcl_sim.diagnostics.page_text import list_text, page_text

SCHEMA = 1


@click.command()
@click.argument("codes", metavar="[CODE]...", nargs=-1)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON document.")
def command(*, codes: tuple[str, ...], as_json: bool) -> None:
    """Tell what the code of a finding means, why it is a fault, and how it is mended.

    Without CODE all codes are listed.
    """
    asked = [_known(each) for each in codes]
    if as_json:
        told = [_table(page(each)) for each in asked or CODES]
        click.echo(json.dumps({"schema": SCHEMA, "codes": told}, indent=2, ensure_ascii=False))
    elif asked:
        click.echo("\n\n\n".join(page_text(page(each)) for each in asked))
    else:
        click.echo(list_text())


def _known(text: str) -> str:
    """Return a code as it is written in the table; wrong usage, with the nearest, where there is none."""
    code = text.strip("[]").upper()
    if code in CODES:
        return code
    near = nearest(code, CODES)
    hint = f" Did you mean {near}?" if near else " `fcl-sim explain` lists all."
    raise click.UsageError(f"There is no code '{text}'.{hint}")


def _table(told: Page) -> dict[str, str]:
    return {
        "code": told.code,
        "title": told.title,
        "severity": str(told.severity),
        "rule": told.rule,
        "means": told.means,
        "why": told.why,
        "within": told.within,
        "language": told.language,
        "bad": told.bad,
        "mended": told.mended,
    }

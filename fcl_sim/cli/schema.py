"""`fcl-sim schema`: the shape of scenario and controller files, and that of the results."""

import json

import click

from fcl_sim.report import schema as of_results
from fcl_sim.scenario import schema as of_files


@click.command()
@click.argument("kind", type=click.Choice(["scenario", "controller", "results"]), default="scenario")
def command(kind: str) -> None:
    """Print the JSON Schema of scenario files, of controller files or of results.

    `fcl-sim schema controller` prints that of controller files (*.controller.toml), for editors as well;
    `fcl-sim schema results` that of what every command prints with --json.
    """
    shape = of_results.json_schema() if kind == "results" else of_files.json_schema(kind)
    click.echo(json.dumps(shape, indent=2, ensure_ascii=False))

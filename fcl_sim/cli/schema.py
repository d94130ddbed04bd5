"""`fcl-sim schema`: the shape of a scenario file, for editors."""

import json

import click

from fcl_sim.scenario.schema import json_schema


@click.command()
@click.argument("kind", type=click.Choice(["scenario", "controller"]), default="scenario")
def command(kind: str) -> None:
    """Print the JSON Schema of scenario files, for editors.

    `fcl-sim schema controller` prints that of controller files (*.controller.toml).
    """
    click.echo(json.dumps(json_schema(kind), indent=2, ensure_ascii=False))

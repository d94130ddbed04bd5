"""`fcl-sim new`: a bench of one's own, copied from the shipped one."""

import shutil
import tempfile
from pathlib import Path

import click

from fcl_sim.cli.doors import say
from fcl_sim.diagnostics import InputFault
from fcl_sim.plant.catalog import shipped_bench

FOLDERS = ("plants", "scenarios")


@click.command()
@click.argument("folder", metavar="DIR", type=click.Path(path_type=Path))
def command(folder: Path) -> None:
    """Copy the shipped bench into a new folder, as a start.

    DIR gets plants/ and scenarios/, yours to change; run it with `fcl-sim run DIR`. A folder that has
    something in it is left alone.
    """
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise InputFault.at_file(
            "RUN103", str(folder), "there is something here already", "name a folder that is new or empty"
        )
    folder.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=folder.parent, prefix=".fcl-sim-") as name:
        made = Path(name) / folder.name
        for each in FOLDERS:
            ignored = shutil.ignore_patterns("__pycache__", ".*")
            shutil.copytree(shipped_bench() / each, made / each, ignore=ignored)
        if folder.exists():
            folder.rmdir()
        made.rename(folder)
    say(f"A bench to start from is in {folder}. Run it: fcl-sim run {folder}")

"""`fcl-sim`: the table of commands, each loaded when it is called."""

import gc
import sys
from importlib import import_module
from time import perf_counter

import click

from fcl_sim import __version__
from fcl_sim.cli.doors import Doors
from fcl_sim.diagnostics import nearest

COMMANDS = {
    "run": "Simulate scenarios in closed loop, judge them, write reports.",
    "report": "Write the report of a run from what it has stored, or that of a rule base alone.",
    "baseline": "Accept what runs come to, as the baseline for the next ones; show what was accepted.",
    "judge": "Judge a recorded trace by the requirements of a scenario.",
    "mutate": "Change one thing at a time in the rule bases, and see which changes the bench notices.",
    "replay": "Put recorded inputs through a rule base and compare its outputs with the recorded ones.",
    "vectors": "Write test vectors for a PLC: inputs, and the outputs that are right.",
    "eval": "Evaluate a rule base once.",
    "plot": "Draw membership functions and the characteristic curve or surface.",
    "check": "Read rule bases, and prove what their rules say together.",
    "diff": "Tell by how much two rule bases differ in what they give, where most, and which rules do it.",
    "conformance": "Print Tables 8 to 11 of IEC 61131-7: what fcl_sim has, or what a rule base needs.",
    "fmt": "Write rule bases in the canonical form of the standard.",
    "matrix": "Put the rules of a table into a rule base, in place of its own.",
    "explain": "Tell what the code of a finding means, why it is a fault, and how it is mended.",
    "show": "Print what a file becomes on its way: tokens, tree, model, wiring ...",
    "schema": "Print the JSON Schema of scenario files, of controller files or of results.",
    "new": "Copy the shipped bench into a new folder, as a start.",
}

SELDOM = (100_000, 20, 50)
"""When Python looks for cycles: a command keeps what it builds up, and to look takes a tenth of its time."""


class Program(Doors):
    """The group of all commands: the command NAME is `command` of `fcl_sim.cli.NAME`."""

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002  click's signature
        """Return the names of all commands, the main job first."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command:
        """Return a command, imported now; UsageError with the nearest name where there is none."""
        if cmd_name not in COMMANDS:
            near = nearest(cmd_name, COMMANDS)
            hint = f" Did you mean '{near}'?" if near else ""
            raise click.UsageError(f"There is no command '{cmd_name}'.{hint}", ctx)
        command = import_module(f"fcl_sim.cli.{cmd_name}").command
        assert isinstance(command, click.Command)  # noqa: S101  each command's file keeps this
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002
        """Write the table of commands without importing them."""
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))


@click.group(
    cls=Program,
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog=(
        "Exit codes: 0 all green; 1 a verdict other than PASS, or a deviation; 2 wrong usage; 3 an input or "
        "the environment (a file, the disk); 4 a run that leaves its baseline, or has none; 70 a mistake in "
        "fcl_sim itself; 130 interrupted."
    ),
)
@click.version_option(__version__, prog_name="fcl-sim", message="%(prog)s %(version)s")
def program() -> None:
    """A test bench on which a fuzzy rule base in FCL (IEC 61131-7) is proved in closed loop."""  # noqa: D401  it is the help's title


def main() -> None:
    """Run the command line of this process and leave it with an exit code."""
    begun = perf_counter()
    gc.set_threshold(*SELDOM)
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="replace")  # a terminal without a sign shows a question mark
    try:
        program(prog_name="fcl-sim", obj=begun)
    finally:
        gc.freeze()  # a process that ends need not look for cycles first, which takes it a second

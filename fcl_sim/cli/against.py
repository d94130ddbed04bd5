"""`fcl-sim run --against REV|OLD.fcl`: outcomes beside what an older version comes to."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack
from itertools import groupby
from pathlib import Path

import click
from rich.console import Console
from rich.table import Table
from rich.text import Text

from fcl_sim import testbench
from fcl_sim.block import Block, load_all
from fcl_sim.diagnostics import InputFault, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.loop.diagram import FuzzyNode
from fcl_sim.report.beside import Beside, against_rows
from fcl_sim.scenario.document import shown
from fcl_sim.scenario.reader import read
from fcl_sim.scenario.revision import checked_out
from fcl_sim.testbench import Outcome

RULE_BASE = ".fcl"
ARROW = "\N{RIGHTWARDS ARROW}"


def against(outcomes: Sequence[Outcome], older: str) -> list[Outcome]:
    """Return outcomes beside those of a revision of their benches, or of an older rule base.

    A scenario that the revision does not have stays alone. InputFault where
    there is nothing to hold any of them against.
    """
    if older.lower().endswith(RULE_BASE):
        return _rule_base(outcomes, Path(older))
    with ExitStack() as stack:
        benches = {each.scenario.bench for each in outcomes}
        folders = {bench: stack.enter_context(checked_out(bench, older)) for bench in benches}
        return [_revision(each, folders[each.scenario.bench], older) for each in outcomes]


def _revision(outcome: Outcome, folder: Path, revision: str) -> Outcome:
    scenario = outcome.scenario
    path = folder / scenario.path.absolute().relative_to(scenario.bench)
    if not path.is_file():
        return outcome
    return testbench.against_scenario(outcome, read(path, scenario.overrides), revision)


def _rule_base(outcomes: Sequence[Outcome], file: Path) -> list[Outcome]:
    blocks: Mapping[str, Block] = load_all(file)
    names = {node.block.name for outcome in outcomes for node in _fuzzy(outcome)}
    if not {each.casefold() for each in blocks} & {each.casefold() for each in names}:
        blocks = _only(blocks, names, file)
    return [testbench.against_rule_bases(each, blocks, shown(file)) for each in outcomes]


def _only(blocks: Mapping[str, Block], names: set[str], file: Path) -> Mapping[str, Block]:
    """Return the only function block of a file in place of the only one that is run."""
    if len(blocks) == len(names) == 1:
        return dict(zip(names, blocks.values(), strict=True))
    near = next(filter(None, (nearest(each, names) for each in blocks)), None)
    hint = f"did you mean `{near}`? " if near else ""
    message = f"it has {listed(list(blocks))}, and no scenario uses a function block of that name"
    raise InputFault.at_file("RUN110", shown(file), message, f"{hint}they use {listed(sorted(names))}")


def _fuzzy(outcome: Outcome) -> Iterator[FuzzyNode]:
    for run in outcome.variants.values():
        yield from (each for each in run.diagram.nodes if isinstance(each, FuzzyNode))


def print_against(outcomes: Sequence[Outcome], older: str, console: Console) -> None:
    """Print every figure as it was and as it is: one table for each scenario."""
    for outcome in outcomes:
        if outcome.against is None:
            click.echo(f"\n{outcome.scenario.name} against {older}: there is no older version of it.")
            continue
        click.echo(f"\n{outcome.scenario.name} against {outcome.against.label}:")
        console.print(_table(list(against_rows(outcome))))


def print_changes(outcome: Outcome, console: Console) -> None:
    """Print the figures that are not what they were in the older version of an outcome."""
    rows = [row for row in against_rows(outcome) if row.change != "none" or ARROW in row.verdict]
    if not rows:
        click.echo(f"{outcome.scenario.name}: every figure is what it was.")
        return
    click.echo(f"{outcome.scenario.name}:")
    console.print(_table(rows))


def _table(rows: Sequence[Beside]) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="bold")
    for heading in ("variant", "metric", "old", "new", "change", "verdict"):
        is_figure = heading in {"old", "new"}
        table.add_column(heading, justify="right" if is_figure else "left", overflow="fold")
    for variant, group in groupby(rows, key=lambda each: each.run):
        for index, row in enumerate(group):
            name = variant if index == 0 else ""
            cells = (name, row.about, row.old, row.new, row.change, row.verdict)
            table.add_row(*(Text(each) for each in cells))
    return table

"""The verdicts of a run, on a terminal of any width."""

from collections.abc import Iterator, Sequence

from rich.console import Console
from rich.table import Table
from rich.text import Text

from fcl_sim.judge.verdict import Status
from fcl_sim.report.summary import Row

NARROW = 72
"""Below this width a verdict is a few lines, not a row."""

COLOURS = {Status.PASS: "green", Status.FAIL: "red", Status.FAULT: "red"}
OTHER_COLOUR = "yellow"


def print_verdicts(rows: Sequence[Row], console: Console) -> None:
    """Print every verdict: scenario, variant, requirement, what is asked, what was measured, verdict."""
    if console.width < NARROW:
        for line in _lines(rows):
            console.print(line)
    elif rows:
        console.print(_table(rows))


def _table(rows: Sequence[Row]) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="bold")
    for heading in ("scenario", "variant", "requirement", "asked"):
        table.add_column(heading, overflow="fold")
    table.add_column("measured", justify="right", overflow="fold")
    table.add_column("verdict", overflow="fold")
    for row, (scenario, variant) in zip(rows, _headings(rows), strict=True):
        cells = (scenario, variant, row.id, row.bound, row.value)
        table.add_row(*(Text(cell) for cell in cells), _verdict(row))
    return table


def _lines(rows: Sequence[Row]) -> Iterator[Text]:
    for row, (scenario, variant) in zip(rows, _headings(rows), strict=True):
        if scenario:
            yield Text(scenario, style="bold")
        if variant:
            yield Text(f"  {variant}")
        yield Text(f"    {row.id}: ").append_text(_verdict(row))
        yield Text(f"      {row.value}, {row.bound}")


def _headings(rows: Sequence[Row]) -> Iterator[tuple[str, str]]:
    """Yield scenario and variant of each row, empty where the row above has the same."""
    above = ("", "")
    for row in rows:
        here = (row.scenario, row.variant)
        yield ("" if here[0] == above[0] else here[0]), ("" if here == above else here[1])
        above = here


def _verdict(row: Row) -> Text:
    word = Text(str(row.status), style=COLOURS.get(row.status, OTHER_COLOUR))
    return word.append(f" ({row.note})", style="default") if row.note else word

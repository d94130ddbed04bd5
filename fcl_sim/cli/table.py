"""The verdicts of a run, on a terminal of any width."""

from collections.abc import Iterator, Sequence

from rich.console import Console
from rich.table import Table
from rich.text import Text

from fcl_sim.judge.verdict import Status
from fcl_sim.report.summary import Row

HEADINGS = ("scenario", "variant", "requirement", "asked", "measured", "verdict")
MEASURED = HEADINGS.index("measured")
GAP = 2

COLOURS = {Status.PASS: "green", Status.FAIL: "red", Status.FAULT: "red"}
OTHER_COLOUR = "yellow"


def print_verdicts(rows: Sequence[Row], console: Console) -> None:
    """Print every verdict: scenario, variant, requirement, what is asked, what was measured, verdict.

    A row each where the terminal is wide enough for all of them, else a few lines each.
    """
    cells = [_cells(row, *heading) for row, heading in zip(rows, _headings(rows), strict=True)]
    if _width(cells) > console.width:
        for row, heading in zip(rows, _headings(rows), strict=True):
            console.print(Text("\n").join(_lines(row, *heading)))
    elif rows:
        console.print(_table(cells))


def _cells(row: Row, scenario: str, variant: str) -> list[Text]:
    return [*(Text(cell) for cell in (scenario, variant, row.id, row.bound, row.value)), _verdict(row)]


def _width(cells: Sequence[Sequence[Text]]) -> int:
    """Return how many columns the table takes."""
    columns = zip(*cells, strict=True)
    widest: list[int] = [
        max(len(heading), *(cell.cell_len for cell in column))
        for heading, column in zip(HEADINGS, columns, strict=False)
    ]
    return sum(widest) + GAP * len(HEADINGS)


def _table(cells: Sequence[Sequence[Text]]) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, GAP, 0, 0), header_style="bold")
    for index, heading in enumerate(HEADINGS):
        table.add_column(heading, justify="right" if index == MEASURED else "left", no_wrap=True)
    for row in cells:
        table.add_row(*row)
    return table


def _lines(row: Row, scenario: str, variant: str) -> Iterator[Text]:
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
    word = Text.assemble((str(row.status), COLOURS.get(row.status, OTHER_COLOUR)))
    return word.append(f" ({row.note})") if row.note else word

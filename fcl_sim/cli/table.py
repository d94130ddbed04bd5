"""The verdicts of a run, on a terminal of any width."""

from collections.abc import Iterator, Sequence
from itertools import groupby

from rich.console import Console
from rich.table import Table
from rich.text import Text

from fcl_sim.judge.verdict import Status
from fcl_sim.report.summary import Row

HEADINGS = ("scenario", "variant", "requirement", "asked", "measured", "verdict")
OF_RUN = 2
"""How many columns say which run it is; the rest is about the requirement."""
MEASURED = "measured"
GAP = 2

PIPE_WIDTH = 1000
"""Where the reader is no terminal, a verdict stays one line, however long its names."""

COLOURS = {Status.PASS: "green", Status.FAIL: "red", Status.FAULT: "red"}
OTHER_COLOUR = "yellow"

Cells = Sequence[Sequence[Text]]


def console() -> Console:
    """Return the terminal of this process, or what takes its place."""
    found = Console(highlight=False)
    if not found.is_terminal:
        found.width = PIPE_WIDTH
    return found


def print_verdicts(rows: Sequence[Row], console: Console) -> None:
    """Print every verdict: scenario, variant, requirement, what is asked, what was measured, verdict.

    In one table where the terminal is wide enough, else in one for each run,
    else in lines.
    """
    cells = [_cells(row, *heading) for row, heading in zip(rows, _headings(rows), strict=True)]
    about = [row[OF_RUN:] for row in cells]
    if rows and sum(_widths(HEADINGS, cells)) <= console.width:
        console.print(_table(HEADINGS, _widths(HEADINGS, cells), cells))
        return
    widths = _widths(HEADINGS[OF_RUN:], about)
    for (scenario, variant), run in groupby(zip(rows, about, strict=True), key=_run):
        console.print(Text(f"{scenario}  {variant}", style="bold"))
        if sum(widths) <= console.width:
            part = [each for _, each in run]
            console.print(_table(HEADINGS[OF_RUN:], widths, part, show_header=False))
        else:
            for row, _ in run:
                console.print(Text(f"  {row.id}: ").append_text(_verdict(row)))
                console.print(Text(f"    {row.value}, {row.bound}"))


def _run(pair: tuple[Row, Sequence[Text]]) -> tuple[str, str]:
    return pair[0].scenario, pair[0].variant


def _cells(row: Row, scenario: str, variant: str) -> list[Text]:
    return [*(Text(cell) for cell in (scenario, variant, row.id, row.bound, row.value)), _verdict(row)]


def _headings(rows: Sequence[Row]) -> Iterator[tuple[str, str]]:
    """Yield scenario and variant of each row, empty where the row above has the same."""
    above = ("", "")
    for row in rows:
        here = (row.scenario, row.variant)
        yield ("" if here[0] == above[0] else here[0]), ("" if here == above else here[1])
        above = here


def _widths(headings: Sequence[str], cells: Cells) -> list[int]:
    """Return how many columns of the terminal each column of the table takes, the gap behind it included."""
    columns = zip(*cells, strict=True)
    return [
        max(len(heading), *(cell.cell_len for cell in column)) + GAP
        for heading, column in zip(headings, columns, strict=False)
    ]


def _table(
    headings: Sequence[str], widths: Sequence[int], cells: Cells, *, show_header: bool = True
) -> Table:
    table = Table(
        box=None, pad_edge=False, padding=(0, GAP, 0, 0), header_style="bold", show_header=show_header
    )
    for heading, width in zip(headings, widths, strict=True):
        table.add_column(
            heading, justify="right" if heading == MEASURED else "left", no_wrap=True, min_width=width - GAP
        )
    for row in cells:
        table.add_row(*row)
    return table


def _verdict(row: Row) -> Text:
    word = Text.assemble((str(row.status), COLOURS.get(row.status, OTHER_COLOUR)))
    return word.append(f" ({row.note})") if row.note else word

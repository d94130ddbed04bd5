"""The verdicts of a run, on a terminal of any width."""

from collections.abc import Iterator, Sequence
from itertools import groupby

from rich.console import Console
from rich.table import Table
from rich.text import Text

from fcl_sim.judge.verdict import Status
from fcl_sim.report.summary import EnvelopeRow, Row, RunRow
from fcl_sim.report.words import counted

HEADINGS = ("scenario", "variant", "requirement", "asked", "measured", "verdict")
OF_ENVELOPES = ("scenario", "variant", "requirement", "asked", "as required", "verdict", "worst")
OF_RUNS = ("scenario", "variant", "requirements", "over its envelope", "verdict")
OF_RUN = 2
"""How many columns say which run it is; the rest is about the requirement."""
MEASURED = ("measured", "as required")
GAP = 2

PIPE_WIDTH = 1000
"""Where the reader is no terminal, a verdict stays one line, however long its names."""

COLOURS = {Status.PASS: "green", Status.FAIL: "red", Status.FAULT: "red"}
OTHER_COLOUR = "yellow"

Cells = Sequence[Sequence[Text]]
Run = tuple[str, str]
"""Scenario and variant, as a table calls them."""


def console() -> Console:
    """Return the terminal of this process, or what takes its place."""
    found = Console(highlight=False)
    if not found.is_terminal:
        found.width = PIPE_WIDTH
    return found


def print_runs(rows: Sequence[RunRow], console: Console) -> None:
    """Print a line for each run: how many requirements are met, of how many, and its verdict.

    Where the terminal is too narrow, scenarios stand on lines of their own.
    """
    headings = OF_RUNS if any(row.envelope for row in rows) else (*OF_RUNS[:3], OF_RUNS[-1])
    told = _told_once([(row.scenario, row.variant) for row in rows])
    cells = []
    for (scenario, _), row in zip(told, rows, strict=True):
        about = [row.requirements, row.envelope] if len(headings) == len(OF_RUNS) else [row.requirements]
        cells.append([*(Text(each) for each in (scenario, row.variant, *about)), _coloured(row.status)])
    if cells and sum(_widths(headings, cells)) <= console.width:
        console.print(_table(headings, _widths(headings, cells), cells))
        return
    own = _widths(headings[1:], [row[1:] for row in cells])
    for _, group in groupby(zip(rows, cells, strict=True), key=lambda each: each[0].scenario):
        part = [row for _, row in group]
        console.print(Text(part[0][0].plain, style="bold"))
        console.print(_table(headings[1:], own, [row[1:] for row in part], show_header=False))


def print_verdicts(rows: Sequence[Row], console: Console) -> None:
    """Print every verdict: scenario, variant, requirement, what is asked, what was measured, verdict.

    In one table where the terminal is wide enough, else in one for each run,
    else in lines.
    """
    runs = [(row.scenario, row.variant) for row in rows]
    lines = [
        [Text(f"  {row.id}: ").append_text(_verdict(row)), Text(f"    {row.value}, {row.bound}")]
        for row in rows
    ]
    _print(HEADINGS, runs, [_about(row) for row in rows], lines, console)


def print_envelopes(rows: Sequence[EnvelopeRow], console: Console) -> None:
    """Print every verdict over an envelope: what is asked, at how many points it held, the worst of them."""
    runs = [(row.scenario, f"{row.variant}, {counted(row.points, 'point')}") for row in rows]
    lines = [
        [
            Text(f"  {row.id}: ").append_text(_word(row)),
            Text(f"    {row.passed}, {row.bound}"),
            *([Text(f"    worst {row.worst}")] if row.worst else []),
        ]
        for row in rows
    ]
    about = [[Text(row.id), Text(row.bound), Text(row.passed), _word(row), Text(row.worst)] for row in rows]
    _print(OF_ENVELOPES, runs, about, lines, console)


def _print(
    headings: Sequence[str], runs: Sequence[Run], about: Cells, lines: Cells, console: Console
) -> None:
    told = zip(_told_once(runs), about, strict=True)
    cells = [[*(Text(each) for each in run), *row] for run, row in told]
    if cells and sum(_widths(headings, cells)) <= console.width:
        console.print(_table(headings, _widths(headings, cells), cells))
        return
    widths = _widths(headings[OF_RUN:], about)
    for (scenario, variant), run in groupby(zip(runs, about, lines, strict=True), key=lambda each: each[0]):
        console.print(Text(f"{scenario}  {variant}", style="bold"))
        if sum(widths) <= console.width:
            part = [row for _, row, _ in run]
            console.print(_table(headings[OF_RUN:], widths, part, show_header=False))
        else:
            for line in (line for _, _, row_lines in run for line in row_lines):
                console.print(line)


def _about(row: Row) -> list[Text]:
    return [*(Text(cell) for cell in (row.id, row.bound, row.value)), _verdict(row)]


def _told_once(runs: Sequence[Run]) -> Iterator[Run]:
    """Yield scenario and variant of each row, empty where the row above has the same."""
    above = ("", "")
    for here in runs:
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
            heading, justify="right" if heading in MEASURED else "left", no_wrap=True, min_width=width - GAP
        )
    for row in cells:
        table.add_row(*row)
    return table


def _verdict(row: Row) -> Text:
    word = _word(row)
    return word.append(f" ({row.note})") if row.note else word


def _word(row: Row | EnvelopeRow) -> Text:
    """Return the verdict; what was meant to be missed, and is, is no success to be seen from afar."""
    return _coloured(row.status) if row.shown == str(row.status) else Text(row.shown)


def _coloured(status: Status) -> Text:
    return Text.assemble((str(status), COLOURS.get(status, OTHER_COLOUR)))

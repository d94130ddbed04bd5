"""Outcomes as a page of Markdown, for the summary of a job on a build server."""

import re
from collections.abc import Iterable, Sequence

from fcl_sim.diagnostics import Diagnostic, Place
from fcl_sim.judge.verdict import Status
from fcl_sim.report.findings import findings
from fcl_sim.report.summary import EnvelopeRow, Row, envelope_rows, overall, rows, sentence
from fcl_sim.report.words import counted, one_line
from fcl_sim.testbench import Outcome

ROOM = 500_000
"""Bytes that a table may take: GitHub drops a summary beyond 1 MiB."""

COLUMNS = ("scenario", "run", "requirement", "asked", "measured", "verdict")
OVER = ("scenario", "run", "requirement", "asked", "points that pass", "worst", "verdict")
SIGNS = re.compile(r"([\\`*_\[\]|~#$])")
HTML = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;"})


def text(outcomes: Sequence[Outcome], faults: Iterable[Diagnostic] = ()) -> str:
    """Return the page: the verdict, what is not green with its places, then everything, folded away."""
    errors = [each for each in faults if each.is_error]
    verdict = "input faults" if errors else str(overall(outcomes))
    parts = [f"## fcl-sim: {verdict}", escaped(sentence(outcomes))]
    if errors:
        parts += [f"### {counted(len(errors), 'input fault')}", _findings(errors)]
    missed = list(findings(outcomes))
    if missed:
        parts += ["### Not passed", _findings(missed)]
    found = list(rows(outcomes))
    if found:
        title = f"<summary>{counted(len(found), 'verdict')}</summary>"
        parts += ["<details>", title, _table(COLUMNS, [_cells(row) for row in found]), "</details>"]
    over = list(envelope_rows(outcomes))
    if over:
        title = f"<summary>{counted(len(over), 'verdict')} over envelopes</summary>"
        parts += ["<details>", title, _table(OVER, [_over(row) for row in over]), "</details>"]
    return "\n\n".join(parts) + "\n"


def escaped(words: str) -> str:
    """Return words on one line that Markdown shows as they are, in a table as well."""
    return SIGNS.sub(r"\\\1", one_line(words).translate(HTML))


def _findings(listed: Sequence[Diagnostic]) -> str:
    return _table(("finding", "where"), [(f"{each.code}: {each.message}", _where(each)) for each in listed])


def _where(finding: Diagnostic) -> str:
    place = finding.places[0] if finding.places else Place()
    return f"{place.name}:{place.span.line}" if place.span else place.name


def _cells(row: Row) -> tuple[str, ...]:
    note = f" ({row.note})" if row.note else ""
    return (
        row.scenario,
        row.variant,
        f"{row.id}: {row.text}",
        row.bound,
        row.value,
        f"{_word(row)}{note}",
    )


def _over(row: EnvelopeRow) -> tuple[str, ...]:
    return (
        row.scenario,
        row.variant,
        f"{row.id}: {row.text}",
        row.bound,
        row.passed,
        row.worst,
        _word(row),
    )


def _word(row: Row | EnvelopeRow) -> str:
    return row.shown if row.status is Status.PASS else f"{row.shown} ✗"


def _table(headings: Sequence[str], cells: Sequence[Sequence[str]]) -> str:
    """Return a table with as many rows as there is room for, and how many more there were."""
    lines = [_line(headings), _line(["---"] * len(headings))]
    room = ROOM
    for number, row in enumerate(cells):
        line = _line([escaped(cell) for cell in row])
        room -= len(line.encode()) + 1
        if room < 0:
            return "\n".join([*lines, "", f"and {len(cells) - number} more"])
        lines.append(line)
    return "\n".join(lines)


def _line(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"

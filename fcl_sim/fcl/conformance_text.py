"""Tables of conformance in print: for a terminal, and in Markdown for the documentation."""

from collections.abc import Iterable, Iterator, Sequence
from textwrap import wrap

from fcl_sim.diagnostics import Span
from fcl_sim.fcl.conformance_elements import ELEMENTS, Choice
from fcl_sim.fcl.conformance_engine import data_check_list
from fcl_sim.fcl.conformance_features import features, level
from fcl_sim.fcl.conformance_figures import FIGURES, data_types, line_comments
from fcl_sim.fcl.conformance_statement import TEXTS, Statement
from fcl_sim.fcl.conformance_tables import TABLES, TITLES, Row
from fcl_sim.model import FunctionBlock

WIDTH = 100
TABLE_11 = "Table 11: data check list"
SHOWN_LINES = 8
"""Lines of one feature that are named; the others are counted."""


def tables_text() -> str:
    """Return our own Tables 8 to 11, for a terminal."""
    lines: list[str] = []
    for number, rows in TABLES.items():
        lines += [TITLES[number], ""]
        for row in rows:
            details = f": {row.details}" if row.details else ""
            lines += [*_wrapped(_what(row) + details, "  "), *_wrapped(row.ours, "      ")]
        lines.append("")
    lines += [TABLE_11, ""]
    for title, statement in data_check_list():
        lines += [*_wrapped(title, "  "), *_wrapped(statement, "      ")]
    return "\n".join(lines)


def tables_markdown() -> str:
    """Return our own Tables 8 to 11, in Markdown."""
    parts = []
    for number, rows in TABLES.items():
        cells = [(each.element, each.keyword, each.details, each.ours) for each in rows]
        header = ("language element", "keyword", "details", "fcl_sim")
        parts.append(f"## {TITLES[number]}\n\n" + markdown_table(header, cells))
    parts.append(f"## {TABLE_11}\n\n" + markdown_table(("technical data", "fcl_sim"), data_check_list()))
    return "\n\n".join(parts)


def markdown_table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table in Markdown."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in each) + " |" for each in lines)


def block_text(block: FunctionBlock) -> str:
    """Return what a function block needs: its level, each feature beyond the Basic Level, its figures."""
    lines = [f"{block.name} needs the {level(block)} Level", ""]
    for table in (9, 10):
        found = list(_beyond(block, table))
        if found:
            lines += [f"  {TITLES[table]}", *found, ""]
    lines.append(f"  {TABLE_11}, of this function block")
    rows = list(figures(block))
    width = max(len(title) for title, _ in rows)
    lines += [f"    {title:{width}}  {words}" for title, words in rows]
    return "\n".join(lines)


def statement_text(statement: Statement) -> str:
    """Return what a target says of itself, for a terminal."""
    lines = [statement.name, *_wrapped(statement.source, "  "), "", "  Tables 8 to 10"]
    for key, values in statement.elements.items():
        element = ELEMENTS[key]
        if isinstance(element, Choice):
            said = ", ".join(each for each in element.rows if each in values.values) or "none"
        else:
            said = "yes" if values.values else "no"
        lines += _wrapped(f"{key}: {said}", "    ")
    lines += ["", f"  {TABLE_11}"]
    lines += [line for title, words in _data(statement) for line in _wrapped(f"{title}: {words}", "    ")]
    if statement.differs:
        lines += ["", "  What it makes something else of"]
        for (key, value), told in statement.differs.items():
            lines += _wrapped(f"{ELEMENTS[key].said(value) if value else key}: {told.words}", "    ")
    if statement.remarks:
        lines += ["", "  Remarks"]
        lines += [line for each in statement.remarks for line in _wrapped(f"- {each}", "    ")]
    return "\n".join(lines)


def _data(statement: Statement) -> Iterator[tuple[str, str]]:
    if statement.data_types is not None:
        yield "data types", ", ".join(sorted(statement.data_types.values)) or "none"
    if statement.line_comments is not None:
        yield "line comments", "yes" if statement.line_comments.values else "no"
    for key, words in statement.texts.items():
        yield TEXTS[key], words
    for key, limit in statement.limits.items():
        yield FIGURES[key].title, f"{limit.number} at most"


def figures(block: FunctionBlock) -> Iterator[tuple[str, str]]:
    """Yield the rows of Table 11 for a function block, with the place of what is largest."""
    yield "data types of function block inputs and outputs", ", ".join(data_types(block)) or "none"
    comments = len(line_comments(block))
    yield "line comments", f"YES ({comments})" if comments else "NO"
    for figure in FIGURES.values():
        most = figure.most(block)
        where = f" ({most.subject})" if most.subject else ""
        yield figure.title, f"{most.number}{where}"


def _beyond(block: FunctionBlock, table: int) -> Iterator[str]:
    """Yield the lines on what a function block uses of a table, under the row that each belongs to."""
    row = None
    for each in features(block):
        if each.row.table == table:
            if each.row is not row:
                row = each.row
                yield from _wrapped(_what(row), "    ")
            lines = lines_of(each.places)
            where = f": line{'s' if len(lines) > 1 else ''} {_listed(lines)}" if lines else ""
            yield from _wrapped(f"{each.words}{where}", "      ")


def lines_of(places: Iterable[Span]) -> list[int]:
    """Return the lines of places, each once, in order."""
    return sorted({each.line for each in places})


def _listed(lines: Sequence[int]) -> str:
    shown = ", ".join(str(each) for each in lines[:SHOWN_LINES])
    rest = len(lines) - SHOWN_LINES
    return f"{shown} and {rest} more" if rest > 0 else shown


def _what(row: Row) -> str:
    return f"{row.element}, {row.keyword}" if row.keyword not in {"", "–"} else row.element


def _wrapped(text: str, indent: str) -> list[str]:
    return wrap(text, WIDTH, initial_indent=indent, subsequent_indent=indent + "  ", break_on_hyphens=False)

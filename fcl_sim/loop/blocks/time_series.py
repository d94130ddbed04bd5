"""Text of a CSV file → times and the values of one column, or what is wrong with it and in which line."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from math import isfinite

from fcl_sim.diagnostics import Source, Span, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.loop.blocks.setting import Text
from fcl_sim.units import Quantity, Unit, UnitError, parse_unit

SEPARATORS = ",;\t"
WITH_DECIMAL_COMMA = ";\t"
"""Separators of files in which a number may have a decimal comma."""
_HEADER = re.compile(r"(?P<name>.*?)\s*\[(?P<unit>[^\[\]]*)\]")
KEPT = 8


class TableFault(Exception):
    """A file that is no table of a signal; `span` is where, `hint` what would be right."""

    def __init__(self, message: str, span: Span, hint: str = "") -> None:
        super().__init__(message)
        self.span = span
        self.hint = hint


@dataclass(frozen=True, slots=True)
class Series:
    """A signal at rising times: seconds, and numbers in `unit`."""

    times: tuple[float, ...]
    values: tuple[float, ...]
    unit: Unit


@dataclass(frozen=True, slots=True)
class _Cell:
    """What stands between two separators, where, and the separator."""

    text: str
    span: Span
    separator: str = ""


@dataclass(frozen=True, slots=True)
class _Column:
    """A column by its header."""

    name: str
    unit: Unit
    header: Span


@lru_cache(maxsize=KEPT)
def time_series(file: Text, column: str) -> Series:
    """Return a column of a file against its time; TableFault where that cannot be read.

    The file is read once for all runs of a scenario. Empty `column`: the only one.
    """
    source = _source(file)
    header, rest = _header(source)
    columns = [_column(each) for each in header]
    time, place = _time(columns[0]), _place(columns, column, source)
    scale = None if time.same_as(parse_unit("s")) else time
    times: list[float] = []
    values: list[float] = []
    for cells in rest:
        if len(cells) != len(header):
            line = cells[0].span.to(cells[-1].span)
            raise TableFault(f"a line of {len(header)} columns is wanted, and this has {len(cells)}", line)
        at = _number(cells[0])
        at = at if scale is None else Quantity(at, scale).to("s")
        if times and not at > times[-1]:
            message = f"{cells[0].text} is not later than the line before"
            raise TableFault(message, cells[0].span, "the times rise from line to line")
        times.append(at)
        values.append(_number(cells[place]))
    if not times:
        raise TableFault("there is no line of numbers below the names", header[0].span)
    return Series(tuple(times), tuple(values), columns[place].unit)


@lru_cache(maxsize=KEPT)
def unit_of(file: Text, column: str) -> Unit:
    """Return the unit of a column; TableFault where the names of the columns cannot be read."""
    source = _source(file)
    columns = [_column(each) for each in _header(source)[0]]
    return columns[_place(columns, column, source)].unit


def _source(file: Text) -> Source:
    return Source(file.name, file.text)


def _header(source: Source) -> tuple[list[_Cell], Iterator[list[_Cell]]]:
    """Return the cells of the first line, and those of each line below; blank lines are left out."""
    lines = _lines(source)
    first = next(lines, None)
    if first is None:
        raise TableFault("the file is empty", Span(source, 0, 0), 'it begins as in "time [s],speed [m/s]"')
    separator = max(SEPARATORS, key=first.text.count)
    if separator not in first.text:
        hint = "columns are separated by commas, semicolons or tabs"
        raise TableFault("there is one column, and a time and a value are wanted", first.span, hint)
    return list(_cells(first, separator)), (list(_cells(each, separator)) for each in lines)


def _lines(source: Source) -> Iterator[_Cell]:
    for line, start in enumerate(source.line_starts, start=1):
        text = source.line_text(line)
        if text.strip("\ufeff \t"):
            yield _Cell(text, Span(source, start, start + len(text)))


def _cells(line: _Cell, separator: str) -> Iterator[_Cell]:
    start = line.span.start
    for part in line.text.split(separator):
        text = part.strip("\ufeff \t")
        begin = start + part.find(text)
        span = Span(line.span.source, begin, begin + max(1, len(text)))
        yield _Cell(text.strip('"').strip(), span, separator)
        start += len(part) + len(separator)


def _column(cell: _Cell) -> _Column:
    header = _HEADER.fullmatch(cell.text)
    if header is None:
        hint = f"write it in brackets: {cell.text or 'speed'} [m/s]; a plain number has [1]"
        raise TableFault(f"the column `{cell.text}` has no unit", cell.span, hint)
    try:
        return _Column(header["name"], parse_unit(header["unit"]), cell.span)
    except UnitError as error:
        raise TableFault(str(error), cell.span, error.hint) from error


def _time(column: _Column) -> Unit:
    if not column.unit.commensurate(parse_unit("s")):
        message = f"the first column is the time, and `{column.name}` is in {column.unit}"
        raise TableFault(message, column.header, "put the time first, as in time [s]")
    return column.unit


def _place(columns: list[_Column], wanted: str, source: Source) -> int:
    """Return which column is meant."""
    names = [each.name for each in columns[1:]]
    whole = columns[0].header.to(columns[-1].header)
    if not wanted and len(names) > 1:
        raise TableFault("the file has several columns", whole, f"say which: column = one of {listed(names)}")
    if wanted and wanted not in names:
        near = nearest(wanted, names)
        hint = f"did you mean `{near}`?" if near else f"there are {listed(names)}"
        raise TableFault(f"`{source.name}` has no column `{wanted}`", whole, hint)
    return names.index(wanted) + 1 if wanted else 1


def _number(cell: _Cell) -> float:
    digits = cell.text.replace(",", ".") if cell.separator in WITH_DECIMAL_COMMA else cell.text
    try:
        value = float(digits)
    except ValueError:
        raise TableFault(f"`{cell.text}` is not a number", cell.span) from None
    if not isfinite(value):
        raise TableFault(f"`{cell.text}` is not a finite number", cell.span)
    return value

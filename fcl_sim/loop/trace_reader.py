"""A file → trace: what `trace_file` wrote, or what a logger recorded on a real machine."""

import csv
import re
import zipfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from fcl_sim.diagnostics import Diagnostic, InputFault, Place, Source, Span
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.loop.trace import Trace, Values
from fcl_sim.loop.trace_columns import Table, parted
from fcl_sim.units import Unit, UnitError, parse_unit

TIME = "time"
SEPARATORS = ",;\t"
WITH_DECIMAL_COMMA = ";\t"
"""Separators of files in which a number may have a decimal comma."""
_COLUMN = re.compile(r"\s*(.*\S)\s*\[([^\[\]]*)\]\s*")


def read(path: Path) -> Trace:
    """Return the trace of a file; its ending says what it is.

    `.csv`: a header `time [s],NAME [UNIT],…`, `[1]` for no unit, then a line per
    sample; separated by commas, semicolons or tabs; an empty cell is NaN. Times
    in any unit, rising, are rounded to nanoseconds. `.npz`: as `trace_file`
    writes it. InputFault where it cannot be read, OSError where the system
    refuses.
    """
    reader = READERS.get(path.suffix.lower())
    if reader is None:
        hint = f"end the name in {listed(READERS)}"
        message = f"a trace is not read from `{path.suffix or path.name}`"
        raise InputFault.at_file("JDG301", path.as_posix(), message, hint)
    if not path.exists():
        raise InputFault.at_file("JDG301", path.as_posix(), "there is no such file")
    return reader(path)


def _read_csv(path: Path) -> Trace:
    try:
        text = path.read_text("utf-8-sig")
    except UnicodeDecodeError as error:
        message = f"the file is not UTF-8 text: byte {error.start + 1} does not fit"
        raise InputFault.at_file("JDG301", path.as_posix(), message, "save it as UTF-8") from error
    return parse_csv(Source(path.as_posix(), text))


def parse_csv(source: Source) -> Trace:
    """Return the trace that a text in CSV is; InputFault where it is none."""
    first = source.line_text(1)
    separator = max(SEPARATORS, key=first.count)
    names, units = _header(source, next(csv.reader([first], delimiter=separator), []))
    table = _numbers(source, separator, len(names))
    ticks = _ticks(source, table[:, 0], parse_unit(units[0]))
    return _trace(ticks, names[1:], units[1:], table[:, 1:])


def _trace(ticks: NDArray[np.int64], names: Sequence[str], units: Sequence[str], values: Values) -> Trace:
    signals, records = parted(Table(tuple(names), tuple(units), values))
    return Trace(
        ticks=ticks,
        names=signals.names,
        units=dict(zip(signals.names, signals.units, strict=True)),
        values=signals.values,
        fuzzy=records,
    )


def _header(source: Source, cells: Sequence[str]) -> tuple[list[str], list[str]]:
    """Return names and units of the columns, that of the time first."""
    names: list[str] = []
    units: list[str] = []
    for cell in cells:
        match = _COLUMN.fullmatch(cell)
        if match is None:
            hint = "write each as NAME [UNIT], as in crane.distance [m], with [1] for no unit"
            raise _at("JDG302", source, 1, f"the column `{cell.strip()}` has no unit", hint)
        try:
            units.append(parse_unit(match[2]).symbol)
        except UnitError as error:
            raise _at("JDG302", source, 1, f"the column `{match[1]}`: {error}", error.hint) from error
        if match[1] in names:
            raise _at("JDG302", source, 1, f"two columns are called `{match[1]}`")
        names.append(match[1])
    if not names or names[0] != TIME or not parse_unit(units[0]).commensurate(parse_unit("s")):
        raise _at("JDG302", source, 1, "the first column is not the time", "begin the header with time [s]")
    return names, units


def _numbers(source: Source, separator: str, width: int) -> Values:
    """Return the numbers (n, width) below the header."""
    lines = csv.reader(source.text.split("\n")[1:], delimiter=separator)
    try:
        rows = [
            _row(source, lines.line_num + 1, cells, separator, width)
            for cells in lines
            if any(cell.strip() for cell in cells)
        ]
    except csv.Error as error:
        raise _at("JDG303", source, lines.line_num + 1, f"the line cannot be parted: {error}") from error
    return np.array(rows, dtype=np.float64).reshape(len(rows), width)


def _row(source: Source, line: int, cells: Sequence[str], separator: str, width: int) -> list[float]:
    if len(cells) != width:
        message = f"the line has {len(cells)} cells, and the header has {width}"
        raise _at("JDG303", source, line, message)
    found = []
    for cell in cells:
        digits = cell.strip().replace(",", ".") if separator in WITH_DECIMAL_COMMA else cell.strip()
        try:
            found.append(float(digits or "nan"))
        except ValueError:
            hint = "an empty cell stands for what was not recorded"
            raise _at("JDG303", source, line, f"`{cell.strip()}` is no number", hint) from None
    return found


def _ticks(source: Source, times: Values, unit: Unit) -> NDArray[np.int64]:
    scaled = times * (unit.factor * 1e9)
    if not np.isfinite(scaled).all() or (np.abs(scaled) > 2**62).any():
        raise InputFault.at_file("JDG304", source.name, "a time is missing, or no trace is so long")
    ticks = np.rint(scaled).astype(np.int64)
    late = np.flatnonzero(np.diff(ticks) <= 0)
    if late.size:
        before, after = (f"{times[late[0] + each]:g} {unit}" for each in (0, 1))
        message = f"the times do not rise: {after} comes after {before}, in sample {late[0] + 2}"
        raise InputFault.at_file(
            "JDG304", source.name, message, "sort the samples, and keep one of each time"
        )
    return ticks


def _at(code: str, source: Source, line: int, message: str, hint: str = "") -> InputFault:
    start = source.line_starts[line - 1]
    span = Span(source, start, start + len(source.line_text(line)))
    return InputFault([Diagnostic(code=code, message=message, places=(Place(span=span),), hint=hint)])


def _read_npz(path: Path) -> Trace:
    try:
        with path.open("rb") as stream, np.load(stream, allow_pickle=False) as file:
            names, units = ([str(each) for each in file[key]] for key in ("names", "units"))
            ticks, values = file["ticks"].astype(np.int64), file["values"].astype(np.float64)
            found = _trace(ticks, names, units, values.reshape(len(ticks), len(names)))
    except (zipfile.BadZipFile, KeyError, ValueError, EOFError, AttributeError, TypeError) as error:
        message = "the file does not hold ticks, values, names and units of a trace"
        hint = "write it with `fcl-sim run --trace FILE.npz`"
        raise InputFault.at_file("JDG301", path.as_posix(), message, hint) from error
    if (np.diff(found.ticks) <= 0).any():
        raise InputFault.at_file("JDG304", path.as_posix(), "the ticks do not rise")
    return found


READERS: Mapping[str, Callable[[Path], Trace]] = {".csv": _read_csv, ".npz": _read_npz}

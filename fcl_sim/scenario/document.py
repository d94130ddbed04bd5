"""Files and texts in TOML → trees with places, or the fault and its mend."""

import hashlib
import re
import tomllib
from pathlib import Path

from fcl_sim.diagnostics import Diagnostic, InputFault, Place, Source, Span, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.scenario.model import SourceFile
from fcl_sim.scenario.positions import positions
from fcl_sim.scenario.tree import Entry, grow

SCENARIO, CONTROLLER_FILE, RULE_BASE = "scenario", "controller", "rule base"
"""The roles of files."""

BYTE_ORDER_MARK = "\ufeff"
_PLACE = re.compile(r" \(at (?:line (\d+), column (\d+)|end of document)\)$")
_TRAILING_COMMA = re.compile(r",\s*}")
_BARE_QUANTITY = re.compile(r"=\s*([+-]?[\d.]+(?:[eE][+-]?\d+)?\s*[a-zA-Z%°µ][^\s#,}\]]*)")


def read_file(path: Path, role: str, asked: Span | None = None) -> SourceFile:
    """Return a file; InputFault, at the place that asks for it, where it cannot be read.

    A rule base may be in another encoding than UTF-8: its reader sees to that.
    """
    try:
        data = path.read_bytes()
        text = data.decode("utf-8", "replace" if role == RULE_BASE else "strict")
    except FileNotFoundError as error:
        raise _unreadable(path, asked, f"there is no file `{shown(path)}`", _beside(path)) from error
    except OSError as error:
        raise _unreadable(path, asked, f"`{shown(path)}` cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        message = f"`{shown(path)}` is not UTF-8 text: byte {error.start + 1} does not fit"
        raise _unreadable(path, asked, message, "save it as UTF-8") from error
    except ValueError as error:
        raise _unreadable(path, asked, f"{str(path)!r} is no name of a file") from error
    source = Source(shown(path), text.removeprefix(BYTE_ORDER_MARK))
    return SourceFile(role=role, path=path, source=source, digest=hashlib.sha256(data).hexdigest())


def shown(path: Path) -> str:
    """Return a path as short as it can be said: relative to the current folder where it lies below."""
    whole, here = path.absolute(), Path.cwd()
    return whole.relative_to(here).as_posix() if whole.is_relative_to(here) else path.as_posix()


def _unreadable(path: Path, asked: Span | None, message: str, hint: str = "") -> InputFault:
    place = Place(span=asked) if asked else Place(file=shown(path))
    return InputFault([Diagnostic(code="SCN101", message=message, places=(place,), hint=hint)])


def _beside(path: Path) -> str:
    if not path.parent.is_dir():
        return f"there is no folder `{shown(path.parent)}` either"
    names = sorted(each.name for each in path.parent.glob(f"*{path.suffix}") if each.is_file())
    near = nearest(path.name, names)
    if near:
        return f"did you mean `{near}`?"
    return f"the folder holds {listed(names)}" if names else ""


def parse(source: Source) -> Entry:
    """Return a TOML text as a tree; InputFault where it is none."""
    try:
        data = tomllib.loads(source.text)
        places = positions(source)
    except RecursionError as error:
        raise _no_toml(source, 0, "arrays or tables are nested too deeply", "") from error
    except ValueError as error:
        raise _explained(source, error) from error
    tree, faults = grow(data, places, Span(source, 0, 0))
    if faults:
        raise InputFault(faults)
    return tree


def _explained(source: Source, error: ValueError) -> InputFault:
    match = _PLACE.search(str(error))
    message = str(error)[: match.start()] if match else str(error)
    offset = len(source.text.rstrip())
    if match and match[1]:
        text = source.text.replace("\r\n", "\n") if "\r\n" in source.text else source.text
        source = Source(source.name, text)
        offset = source.line_starts[int(match[1]) - 1] + int(match[2]) - 1
    line = source.line_of(min(offset, max(0, len(source.text) - 1)))
    if message.startswith(("Cannot overwrite", "Cannot declare", "Cannot mutate")):
        start = source.line_starts[line - 1]
        return _no_toml(source, start, "a key or table is given twice", "give it once")
    return _no_toml(source, offset, _plainly(message), _mend(source.line_text(line), message))


def _plainly(message: str) -> str:
    if message.startswith("Expected newline or end of document"):
        return "something stands behind the value that does not belong there"
    if message.startswith("Invalid value"):
        return "this is no value"
    return message[0].lower() + message[1:]


def _mend(line: str, message: str) -> str:
    if _TRAILING_COMMA.search(line):
        return "TOML allows no comma before }"
    quantity = _BARE_QUANTITY.search(line)
    if quantity:
        return f'write quantities in quotes: "{quantity[1]}"'
    if message.startswith("Invalid value"):
        return 'texts are written in quotes, as in title = "Crane"'
    return ""


def _no_toml(source: Source, offset: int, message: str, hint: str) -> InputFault:
    start = min(offset, max(0, len(source.text) - 1))
    place = Place(span=Span(source, start, start + 1))
    return InputFault([Diagnostic(code="SCN102", message=f"not TOML: {message}", places=(place,), hint=hint)])

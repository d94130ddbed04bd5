"""Texts in TOML → trees with places, or the fault and its mend."""

import re
import tomllib

from fcl_sim.diagnostics import Diagnostic, InputFault, Place, Source, Span
from fcl_sim.toml.positions import positions
from fcl_sim.toml.tree import Entry, grow

_PLACE = re.compile(r" \(at (?:line (\d+), column (\d+)|end of document)\)$")
_TRAILING_COMMA = re.compile(r",\s*}")
_BARE_QUANTITY = re.compile(r"=\s*([+-]?[\d.]+(?:[eE][+-]?\d+)?\s*[a-zA-Z%°µ][^\s#,}\]]*)")


def parse(source: Source, *, not_toml: str, twice: str) -> Entry:
    """Return a TOML text as a tree.

    InputFault where it is none, with the code `not_toml`, or where dotted keys
    give something twice, with the code `twice`.
    """
    try:
        data = tomllib.loads(source.text)
        places = positions(source)
    except RecursionError as error:
        raise _no_toml(not_toml, source, 0, "arrays or tables are nested too deeply", "") from error
    except ValueError as error:
        raise _explained(not_toml, source, error) from error
    tree, again = grow(data, places, Span(source, 0, 0))
    if again:
        raise InputFault(_given_twice(twice, second, first) for second, first in again)
    return tree


def _given_twice(code: str, second: Span, first: Span) -> Diagnostic:
    places = (Place(span=second), Place(span=first, label="given here first"))
    return Diagnostic(code=code, message=f"`{second.text}` is given twice", places=places)


def _explained(code: str, source: Source, error: ValueError) -> InputFault:
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
        return _no_toml(code, source, start, "a key or table is given twice", "give it once")
    return _no_toml(code, source, offset, _plainly(message), _mend(source.line_text(line), message))


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


def _no_toml(code: str, source: Source, offset: int, message: str, hint: str) -> InputFault:
    start = min(offset, max(0, len(source.text) - 1))
    place = Place(span=Span(source, start, start + 1))
    return InputFault([Diagnostic(code=code, message=f"not TOML: {message}", places=(place,), hint=hint)])

"""Findings as annotations of a GitHub workflow: one line each, shown beside the changed lines."""

import os
from pathlib import Path

from fcl_sim.diagnostics.codes import CODES
from fcl_sim.diagnostics.diagnostic import Diagnostic, Severity
from fcl_sim.diagnostics.render import printable

COMMANDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.NOTE: "notice"}

_DATA = str.maketrans({"%": "%25", "\r": "%0D", "\n": "%0A"})
_PROPERTY = str.maketrans({"%": "%25", "\r": "%0D", "\n": "%0A", ":": "%3A", ",": "%2C"})


def as_github(diagnostic: Diagnostic, root: Path | None = None) -> str:
    """Return the workflow command of a finding, `::error file=…,line=…::message`.

    It stands at the first place; further ones are named in the message, as is
    the hint. Columns count characters from 1, the last one included. Files below
    `root`, where it is given, are named relative to it.
    """
    properties = _place(diagnostic, root) | {"title": f"{diagnostic.code} {CODES[diagnostic.code]}"}
    listed = ",".join(f"{name}={str(value).translate(_PROPERTY)}" for name, value in properties.items())
    message = "\n".join(_lines(diagnostic))
    return f"::{COMMANDS[diagnostic.severity]} {listed}::{message.translate(_DATA)}"


def _place(diagnostic: Diagnostic, root: Path | None) -> dict[str, str | int]:
    place = diagnostic.places[0] if diagnostic.places else None
    if place is None or not place.name:
        return {}
    told: dict[str, str | int] = {"file": _file(place.name, root).replace("\\", "/")}
    if place.span is not None:
        last = place.span.behind
        told |= {"line": place.span.line, "endLine": last.line, "col": place.span.column}
        if last.line == place.span.line:
            told["endColumn"] = max(place.span.column, last.column - 1)
    return told


def _file(name: str, root: Path | None) -> str:
    whole = Path(os.path.abspath(name))  # noqa: PTH100  a link is not followed: the checkout has it where it is
    return str(whole.relative_to(root)) if root and whole.is_relative_to(root) else name


def _lines(diagnostic: Diagnostic) -> list[str]:
    lines = [printable(diagnostic.message)]
    for place in diagnostic.places[1:]:
        where = f"{place.name}:{place.span.line}" if place.span else place.name
        lines.append(f"{printable(where)}: {printable(place.label)}" if place.label else f"also at {where}")
    if diagnostic.hint:
        lines.append(f"hint: {printable(diagnostic.hint)}")
    return lines

"""`formula = "..."` → statement, its faults shown in the text of the scenario."""

from collections.abc import Mapping

from fcl_sim.diagnostics import Diagnostic, InputFault
from fcl_sim.formula.text import Text
from fcl_sim.judge.temporal.formula import Formula, Statement, bind, read
from fcl_sim.toml.strings import offsets
from fcl_sim.toml.tree import Entry


def statement_of(entry: Entry, faults: list[Diagnostic]) -> Statement | None:
    """Return what a formula says; None where it is no text, or a fault was found."""
    if not isinstance(entry.value, str):
        return None
    try:
        return read(Text(entry.value, entry.span.source, offsets(entry.span, entry.value)))
    except InputFault as fault:
        faults += fault.diagnostics
        return None


def in_units(statement: Statement, units: Mapping[str, str], faults: list[Diagnostic]) -> Formula | None:
    """Return a statement in the units of a run; None where a fault was found."""
    try:
        return bind(statement, units)
    except InputFault as fault:
        faults += fault.diagnostics
        return None

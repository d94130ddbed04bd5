"""`corridor = { signal = ..., file = ... }` → corridor, read from a table in the units of its header."""

from collections.abc import Mapping

import numpy as np

from fcl_sim.diagnostics import Diagnostic, InputFault, Place, Span, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.judge.verdict import Corridor
from fcl_sim.loop.trace import Values
from fcl_sim.loop.trace_reader import parse_csv
from fcl_sim.scenario.model import CorridorText
from fcl_sim.scenario.reading import Reading
from fcl_sim.toml.tree import Entry, finding
from fcl_sim.units import Quantity, parse_unit

CORRIDOR = "corridor"
"""The role of the file."""
EDGES = ("low", "high")


def corridor_text(reading: Reading, entry: Entry, faults: list[Diagnostic]) -> CorridorText | None:
    """Return what a corridor says; None where a fault was found, or its shape is not that of one."""
    signal, file = entry.get("signal"), entry.get("file")
    if signal is None or file is None or not isinstance(file.value, str):
        return None
    source = reading.open(reading.beside(file), CORRIDOR, file)
    if source is None:
        return None
    try:
        table = parse_csv(source.source)
    except InputFault as fault:
        faults += fault.diagnostics
        return None
    strange = [name for name in table.names if name not in EDGES]
    if strange or not table.names or not table.ticks.size:
        faults.append(_no_table(source.source.name, file.span, strange))
        return None
    return CorridorText(signal=signal, file=file, table=table)


def _no_table(name: str, span: Span, strange: list[str]) -> Diagnostic:
    told = f"has a column `{strange[0]}`" if strange else "has no rows, or no edges"
    return Diagnostic(
        code="SCN409",
        message=f"the table `{name}` {told}",
        places=(Place(span=span),),
        hint="a corridor has the columns time [s], low [UNIT], high [UNIT], or one of the two edges",
    )


def corridor_of(text: CorridorText, units: Mapping[str, str], faults: list[Diagnostic]) -> Corridor | None:
    """Return a corridor in the unit of its signal; None where a fault was found."""
    signal = str(text.signal.value)
    if signal not in units:
        near = nearest(signal, units) or nearest(signal.rpartition(".")[2], units)
        hint = f"did you mean `{near}`?" if near else f"there are {listed(sorted(units))}"
        faults.append(finding("SCN403", f"there is no signal called `{signal}`", text.signal, hint))
        return None
    sides = [_edge(text, name, units[signal], faults) for name in EDGES]
    low, high = (tuple(each.tolist()) for each in sides)
    ticks = tuple(int(each) for each in text.table.ticks)
    return Corridor(name=str(text.file.value), signal=signal, ticks=ticks, low=low, high=high)


def _edge(text: CorridorText, name: str, unit: str, faults: list[Diagnostic]) -> Values:
    """Return an edge in the unit of the signal, NaN where there is none."""
    if name not in text.table:
        return np.full(text.table.ticks.size, np.nan)
    given, wanted = parse_unit(text.table.units[name]), parse_unit(unit)
    if not given.commensurate(wanted):
        message = f"`{text.signal.value}` is in {wanted}, and `{name}` of its corridor is in {given}"
        faults.append(finding("SCN404", message, text.file, f"give it in {wanted}"))
        return np.full(text.table.ticks.size, np.nan)
    return text.table[name] * Quantity(1.0, given).to(wanted)

"""A trace as one table: a column per signal, and behind them what was recorded of each fuzzy block.

Of a block `rules` with the input `angle`, the output `power` and a rule 3a these are

    rules.angle  rules.power  rules.active(power)  rules.degree(3a)

and `rules.cold()`, where a cold restart set it to its initial state. An output
that is a signal by that name stands among the signals alone.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from fcl_sim.loop.trace import FuzzyRecord, Trace, Values

_OF_A_RULE_BASE = re.compile(r"(?P<block>.+)\.(?P<what>active|degree|cold)\((?P<of>.*)\)")


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """Columns with their names and units; `values` (n, columns)."""

    names: tuple[str, ...]
    units: tuple[str, ...]
    values: Values


def table(trace: Trace) -> Table:
    """Return all that a trace has of its signals and fuzzy blocks."""
    further = [
        (name, unit, column)
        for block, record in trace.fuzzy.items()
        for name, unit, column in _columns(block, record)
        if name not in trace.units
    ]
    return Table(
        names=(*trace.names, *(name for name, _, _ in further)),
        units=(*(trace.units[name] for name in trace.names), *(unit for _, unit, _ in further)),
        values=np.column_stack([trace.values, *(column for _, _, column in further)]),
    )


def _columns(block: str, record: FuzzyRecord) -> Iterator[tuple[str, str, Values]]:
    for names, values in ((record.input_names, record.inputs), (record.output_names, record.outputs)):
        for place, name in enumerate(names):
            yield f"{block}.{name}", record.units.get(name, ""), values[:, place]
    for place, name in enumerate(record.output_names):
        yield f"{block}.active({name})", "", record.active[:, place].astype(np.float64)
    for place, label in enumerate(record.rule_labels):
        yield f"{block}.degree({label})", "", record.degrees[:, place]
    if record.cold:
        cold = np.zeros(len(record.inputs))
        cold[list(record.cold)] = 1.0
        yield f"{block}.cold()", "", cold


def parted(found: Table) -> tuple[Table, dict[str, FuzzyRecord]]:
    """Return the signals of a table, and the records of fuzzy blocks by name.

    Columns that make no whole record, as of a logger that kept some of them, are signals.
    """
    places = {name: place for place, name in enumerate(found.names)}
    parts: dict[str, dict[str, list[str]]] = {}
    for name in found.names:
        match = _OF_A_RULE_BASE.fullmatch(name)
        if match:
            parts.setdefault(match["block"], {}).setdefault(match["what"], []).append(match["of"])
    records: dict[str, FuzzyRecord] = {}
    taken: set[str] = set()
    for block, own in parts.items():
        outputs = own.get("active", [])
        if outputs and "degree" in own and all(f"{block}.{name}" in places for name in outputs):
            record, columns = _record(found, places, block, own)
            records[block] = record
            taken.update(columns)
    return _columns_at(found, [place for name, place in places.items() if name not in taken]), records


def _columns_at(found: Table, places: Sequence[int]) -> Table:
    names, units = (tuple(each[place] for place in places) for each in (found.names, found.units))
    return Table(names, units, found.values[:, places])


def _record(
    found: Table, places: Mapping[str, int], block: str, own: Mapping[str, Sequence[str]]
) -> tuple[FuzzyRecord, set[str]]:
    """Return a record and the names of the columns that are nothing else."""
    outputs, labels = tuple(own["active"]), tuple(own["degree"])
    prefix = f"{block}."
    below = [name.removeprefix(prefix) for name in found.names if name.startswith(prefix)]
    variables = [name for name in below if not _OF_A_RULE_BASE.fullmatch(prefix + name)]
    inputs = tuple(name for name in variables if name not in outputs)

    def values(names: Sequence[str]) -> Values:
        return found.values[:, [places[name] for name in names]]

    cold = f"{prefix}cold()"
    active, degrees = ([f"{prefix}{what}({of})" for of in own[what]] for what in ("active", "degree"))
    record = FuzzyRecord(
        input_names=inputs,
        output_names=outputs,
        rule_labels=labels,
        inputs=values([prefix + name for name in inputs]),
        outputs=values([prefix + name for name in outputs]),
        degrees=values(degrees),
        flags=values(active),
        cold=tuple(np.flatnonzero(found.values[:, places[cold]]).tolist()) if cold in places else (),
        units={name: found.units[places[prefix + name]] for name in variables},
    )
    columns = {*active, *degrees, cold, *(prefix + name for name in inputs)}
    if block in places:  # it has one output, which is the signal of its own name
        columns |= {prefix + name for name in outputs}
    return record, columns

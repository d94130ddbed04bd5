"""Recorded inputs through a rule base, and its outputs beside the recorded ones."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fcl_sim.block import Block
from fcl_sim.diagnostics import Diagnostic, InputFault, Place
from fcl_sim.engine.precision import PRECISIONS
from fcl_sim.loop.alone import Alone
from fcl_sim.loop.trace import FuzzyRecord, Trace, Values
from fcl_sim.verify.cover import ranges, rule_text
from fcl_sim.verify.log_columns import Columns, columns_of
from fcl_sim.verify.subject import Subject

FULL = 10_000
TOLERANCES = {"LREAL": 1e-9, "REAL": 1e-5, "INT": 0.0}
"""By arithmetic, the part of its range by which an output may differ, where nothing is said.

Between two orders of summation, binary64 and binary32 leave far less; counts are exact.
"""


@dataclass(frozen=True, slots=True)
class Firing:
    """A rule that fired: its label, what it says, its degree."""

    label: str
    text: str
    degree: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Deviation:
    """A sample, counted from 1, at which an output is another than was recorded; `tick` in nanoseconds."""

    sample: int
    tick: int
    recorded: float
    replayed: float

    @property
    def difference(self) -> float:
        """Magnitude of the difference."""
        return abs(self.replayed - self.recorded)


@dataclass(frozen=True, slots=True, kw_only=True)
class Comparison:
    """An output beside its recorded column, over the samples at which one was recorded.

    `tolerance` in the unit of the output. `largest` is the largest deviation,
    also where it is within the tolerance; None where there is none at all.
    """

    variable: str
    column: str
    tolerance: float
    compared: int
    deviating: int
    first: Deviation | None
    largest: Deviation | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Replay:
    """What a rule base made of a log: `record` as of a run, over the samples `ticks` (n,).

    `inputs` gives the column of each input. `comparisons` has the outputs that
    were recorded. Of the first sample that deviates, `rules` are those that fired,
    and `terms` the degrees of the inputs' terms above 0.
    """

    name: str
    arithmetic: str
    ticks: NDArray[np.int64]
    record: FuzzyRecord
    inputs: Mapping[str, str]
    comparisons: tuple[Comparison, ...]
    rules: tuple[Firing, ...] = ()
    terms: Mapping[str, Mapping[str, float]]

    @property
    def first(self) -> Comparison | None:
        """The output that deviates first, if any does."""
        own = [each for each in self.comparisons if each.first is not None]
        return min(own, key=lambda each: each.first.sample if each.first else 0, default=None)

    @property
    def trace(self) -> Trace:
        """Inputs and outputs as signals by the names of the variables."""
        record = self.record
        names = (*record.input_names, *record.output_names)
        return Trace(
            ticks=self.ticks,
            names=names,
            units={name: record.units.get(name, "") for name in names},
            values=np.column_stack([record.inputs, record.outputs]),
            fuzzy={self.name: record},
        )


def replay(  # noqa: PLR0913  a keyword each
    block: Block,
    log: Trace,
    arithmetic: str = "",
    *,
    columns: Mapping[str, str] | None = None,
    absolute: float | None = None,
    relative: float | None = None,
    name: str = "the log",
) -> Replay:
    """Return what a block makes of recorded inputs, sample by sample from its initial state.

    `arithmetic` is LREAL, REAL or INT, else what the block declares. `columns`
    says by column which variable it is, where names do not tell. An output
    deviates where it differs by more than `absolute`, in its unit, plus `relative`
    times its range; where neither is given, as `TOLERANCES` has it. InputFault
    for inputs that are missing, not finite, or more than the arithmetic holds.
    """
    subject = Subject(block=block, arithmetic=arithmetic or block.declared_arithmetic)
    found = columns_of(log, subject.program, columns or {}, name)
    places = {each: place for place, each in enumerate(found.table.names)}
    inputs = found.table.values[:, [places[each] for each in found.inputs.values()]]
    _check(subject, found, inputs, log, name)
    record = _run(subject, found, inputs, _cold(log, found))
    if absolute is None and relative is None:
        relative = TOLERANCES[subject.arithmetic]
    widths = ranges(block.function_block, record)
    comparisons = tuple(
        _compared(
            variable,
            column,
            (absolute or 0.0) + (relative or 0.0) * widths[variable],
            found.table.values[:, places[column]],
            record.outputs[:, record.output_names.index(variable)],
            log.ticks,
        )
        for variable, column in found.outputs.items()
    )
    made = Replay(
        name=block.name,
        arithmetic=subject.arithmetic,
        ticks=log.ticks,
        record=record,
        inputs=found.inputs,
        comparisons=comparisons,
        terms={},
    )
    return made if made.first is None else _explained(made, subject)


def _check(subject: Subject, columns: Columns, inputs: Values, log: Trace, name: str) -> None:
    largest = 2.0**15 - 1 if subject.arithmetic == "INT" else PRECISIONS[subject.arithmetic].largest
    for (variable, column), values in zip(columns.inputs.items(), inputs.T, strict=True):
        bad = np.flatnonzero(~(np.abs(values) <= largest))
        if bad.size:
            at = f"in sample {bad[0] + 1}, at {log.ticks[bad[0]] / 1e9:.9g} s"
            value = values[bad[0]]
            message = f"`{column}` {at} is {'not recorded' if np.isnan(value) else f'{value:g}'}"
            hint = f"`{variable}` needs a number in {subject.arithmetic} at every sample"
            raise InputFault(
                [Diagnostic(code="VER203", message=message, places=(Place(file=name),), hint=hint)]
            )


def _cold(log: Trace, columns: Columns) -> tuple[int, ...]:
    """Return before which samples of a trace of ours its rule base was set to its initial state."""
    for block, record in log.fuzzy.items():
        if all(column.startswith(f"{block}.") for column in columns.inputs.values()):
            return record.cold
    return ()


def _run(subject: Subject, columns: Columns, inputs: Values, cold: tuple[int, ...]) -> FuzzyRecord:
    program = subject.program
    steps = _in_int if subject.arithmetic == "INT" else _as_in_a_loop
    ends = (*cold, len(inputs))
    parts = [steps(subject, inputs[start:end]) for start, end in zip((0, *cold), ends, strict=True)]
    rows = np.vstack(parts)
    units = dict(zip(columns.table.names, columns.table.units, strict=True))
    return FuzzyRecord(
        input_names=program.input_names,
        output_names=program.output_names,
        rule_labels=program.rule_labels,
        inputs=rows[:, : program.outputs_at],
        outputs=rows[:, program.outputs_at : program.active_at],
        degrees=rows[:, program.degrees_at :],
        flags=rows[:, program.active_at : program.degrees_at],
        cold=cold,
        units={
            **{variable: units[column] for variable, column in columns.inputs.items()},
            **{variable: units[column] for variable, column in columns.outputs.items()},
        },
    )


def _as_in_a_loop(subject: Subject, inputs: Values) -> Values:
    return Alone(subject.program).evaluate(inputs)


def _in_int(subject: Subject, inputs: Values) -> Values:
    """Return rows as `Alone` gives them; NaN for the outputs where a result leaves its width."""
    program = subject.program
    instance = subject.block.instance("INT")
    rows = np.full((len(inputs), program.recorded), np.nan)
    for row, point in zip(rows, inputs, strict=True):
        try:
            instance(**dict(zip(program.input_names, point.tolist(), strict=True)))
        except OverflowError:
            row[: len(point)] = point
            row[program.active_at :] = 0.0
            continue
        words = [instance.inputs[each] for each in program.input_names]
        words += [instance.outputs[each] for each in program.output_names]
        words += [float(instance.active[each]) for each in program.output_names]
        row[:] = words + [degree / FULL for degree in instance.degrees.values()]
    return rows


def _compared(
    variable: str, column: str, tolerance: float, recorded: Values, replayed: Values, ticks: NDArray[np.int64]
) -> Comparison:
    there = ~np.isnan(recorded)
    apart = np.where(there, np.nan_to_num(np.abs(replayed - recorded), nan=np.inf), 0.0)
    deviating = np.flatnonzero(apart > tolerance)

    def deviation(at: int) -> Deviation:
        return Deviation(
            sample=at + 1, tick=int(ticks[at]), recorded=float(recorded[at]), replayed=float(replayed[at])
        )

    return Comparison(
        variable=variable,
        column=column,
        tolerance=tolerance,
        compared=int(there.sum()),
        deviating=int(deviating.size),
        first=deviation(int(deviating[0])) if deviating.size else None,
        largest=deviation(int(np.argmax(apart))) if apart.size and apart.max() > 0.0 else None,
    )


def _explained(made: Replay, subject: Subject) -> Replay:
    """Return the replay with the rules and terms of the first sample that deviates."""
    first = made.first
    assert first is not None  # noqa: S101  asked by the caller
    assert first.first is not None  # noqa: S101  that is what makes it the first
    row = first.first.sample - 1
    record, program = made.record, subject.program
    texts = [rule_text(rule) for each in subject.block.function_block.rule_blocks for rule in each.rules]
    fired = [
        Firing(label, text, float(degree))
        for label, text, degree in zip(record.rule_labels, texts, record.degrees[row], strict=True)
        if degree > 0.0
    ]
    slots = program.layout.terms
    found = Alone(program).evaluate(record.inputs[row : row + 1], words=[*slots.values()])
    terms: dict[str, dict[str, float]] = {}
    for (variable, term), degree in zip(slots, found[0, program.recorded :].tolist(), strict=True):
        if degree > 0.0:
            terms.setdefault(variable, {})[term] = degree
    return replace(made, rules=tuple(sorted(fired, key=lambda each: -each.degree)), terms=terms)

"""Diagram → Trace: the whole way of one run."""

import numpy as np

from fcl_sim.loop import layout
from fcl_sim.loop.diagram import Diagram, FuzzyNode
from fcl_sim.loop.simulate import simulate
from fcl_sim.loop.tape import Tape, lower
from fcl_sim.loop.trace import Fault, FuzzyRecord, Trace, Values
from fcl_sim.loop.wiring import wire

REASONS = {
    layout.NOT_FINITE: "is NaN or infinite",
    layout.BLEW_UP: "is NaN or infinite, or grows faster than the integrator can follow",
    layout.STEP_TOO_SMALL: "needs steps too small for the clock to meet the tolerance",
    layout.CHATTERS: "happens over and over without time passing",
    layout.BUDGET_SPENT: "needs more than a million steps between two writes",
}
"""How a run can end early, in words that follow the name of a signal, state or event."""


def run(diagram: Diagram) -> Trace:
    """Run a closed loop and return its trace.

    Raises InputFault where the diagram does not fit together. A run that
    cannot go on ends with the trace's `fault` set; the samples up to there are kept.
    """
    return run_tape(lower(wire(diagram)))


def run_tape(tape: Tape) -> Trace:
    """Run a tape from its start; the tape itself is left as it was."""
    columns = sum(length for _, length in tape.segments)
    record = np.empty((tape.starts.size, columns))
    report = np.zeros(3, dtype=np.int64)
    functions = tape.wiring.diagram.plant.model.functions.ready()
    x, memory = tape.x.copy(), tape.memory.copy()
    simulate(*functions, tape.ints, tape.floats, memory, x, tape.p, tape.starts, record, report)
    return _trace(tape, record[: report[layout.REPORT_SAMPLES]], report)


def _trace(tape: Tape, record: Values, report: np.ndarray) -> Trace:
    wiring = tape.wiring
    names = tuple(wiring.units)
    values = np.empty((record.shape[0], len(names)))
    for index, name in enumerate(names):
        source = wiring.sources.get(name)
        slot = tape.slots[source.source if source else name]
        values[:, index] = (source.sign if source else 1.0) * record[:, tape.column(slot)]
    fuzzy = {
        node.name: _fuzzy_record(tape, node, record) for node in wiring.order if isinstance(node, FuzzyNode)
    }
    return Trace(
        ticks=tape.starts[: record.shape[0]],
        names=names,
        units={name: unit.symbol for name, unit in wiring.units.items()},
        values=values,
        fuzzy=fuzzy,
        fault=_fault(tape, report),
    )


def _fuzzy_record(tape: Tape, node: FuzzyNode, record: Values) -> FuzzyRecord:
    program = node.block.program
    first = tape.column(tape.instances[node.name])
    part = record[:, first : first + program.recorded]
    return FuzzyRecord(
        input_names=program.input_names,
        output_names=program.output_names,
        rule_labels=program.rule_labels,
        inputs=part[:, : program.outputs_at],
        outputs=part[:, program.outputs_at : program.active_at],
        degrees=part[:, program.degrees_at :],
        active=part[:, program.active_at : program.degrees_at] != 0.0,
    )


def _fault(tape: Tape, report: np.ndarray) -> Fault | None:
    status, samples, index = (int(each) for each in report)
    if status == layout.FINISHED:
        return None
    declaration = tape.wiring.diagram.plant.model.declaration
    prefix = tape.wiring.diagram.plant.name
    if status == layout.NOT_FINITE:
        name = next(name for name, slot in tape.slots.items() if slot == index)
        return Fault(int(tape.starts[samples]), name, f"`{name}` {REASONS[status]}")
    tick = int(tape.starts[max(0, samples - 1)])
    if status == layout.CHATTERS:
        name = declaration.events[index].name
        return Fault(tick, f"{prefix}.{name}", f"the event `{name}` of `{prefix}` {REASONS[status]}")
    name = declaration.states[index].name
    return Fault(tick, f"{prefix}.{name}", f"the state `{name}` of `{prefix}` {REASONS[status]}")

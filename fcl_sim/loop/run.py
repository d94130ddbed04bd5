"""Diagram → Trace: the whole way of one run."""

from threading import Event
from time import perf_counter

import numpy as np

from fcl_sim.loop import layout
from fcl_sim.loop.diagram import Diagram, FuzzyNode
from fcl_sim.loop.ended import fault_of
from fcl_sim.loop.linked import Linked, linked
from fcl_sim.loop.outside import execute_outside
from fcl_sim.loop.reported import events_of
from fcl_sim.loop.restart import restart_cold, restarted_nodes
from fcl_sim.loop.simulate import simulate
from fcl_sim.loop.stages import Shape
from fcl_sim.loop.state import RunState, initial_state
from fcl_sim.loop.tape import Tape, lower
from fcl_sim.loop.trace import FuzzyRecord, Incident, Trace, Values
from fcl_sim.loop.wiring import wire
from fcl_sim.loop.work import ROW, SAMPLES

FIRST_PIECE, MOST_SCANS, PIECE_SECONDS = 16, 1_000_000, 0.25
"""Scans that are run before Python looks up, at first and at most, and the seconds that they should take."""
MOST_GROWTH = 64.0
"""How much longer than the one before a piece may be: of several threads each waits for Python after it."""


class Halted(Exception):
    """A run was told to end: nobody waits for what comes of it."""


def run(diagram: Diagram, halt: Event | None = None) -> Trace:
    """Run a closed loop and return its trace.

    Raises InputFault where the diagram does not fit together or a function of
    the user's fails. A run that cannot go on ends with the trace's `fault` set;
    the samples up to there are kept. Halted soon after another thread sets `halt`.
    """
    return run_tape(lower(wire(diagram)), halt)


def compile_for(diagram: Diagram) -> None:
    """Compile what runs of a diagram call, as far as no run has; InputFault as of `run`.

    So that a thread which hears of an interrupt can do it: compiling takes a
    minute where nothing is cached, and cannot be halted.
    """
    tape = lower(wire(diagram))
    _linked(tape)
    simulate.compile()


def run_tape(tape: Tape, halt: Event | None = None) -> Trace:
    """Run a tape from its start; the tape itself is left as it was."""
    state, record = initial_state(tape), empty_record(tape)
    proceed(tape, state, record, halt=halt)
    return trace_of(tape, state, record)


def empty_record(tape: Tape) -> Values:
    """Return an array for the samples of a whole run, (scans + 1, columns)."""
    return np.empty((tape.starts.size, tape.recorded.width))


def proceed(
    tape: Tape, state: RunState, record: Values, until: int | None = None, halt: Event | None = None
) -> None:
    """Run on from `state`, which is changed, to the beginning of scan `until`, else to the end.

    The scans that are run fill their rows of `record`. A run that has ended
    early stays where it is. Halted where `halt` is set, which is looked at as
    often as Python looks up.
    """
    scans = tape.starts.size
    last = scans if until is None else min(until, scans)
    functions = _linked(tape)
    views = (tape.floats.view(np.float32), state.memory.view(np.float32))
    buffers = (tape.ints, tape.floats, state.memory, *views, state.x, tape.p, state.progress, state.rows)
    times = (tape.starts, tape.schedule.writes)
    piece = FIRST_PIECE
    while state.scan < last and not state.over:
        if halt is not None and halt.is_set():
            raise Halted
        if state.scan in tape.schedule.cold and not state.progress[ROW]:
            restart_cold(tape, state)
        stop = min(last, state.scan + piece)
        stop = min((each for each in tape.schedule.cold if state.scan < each < stop), default=stop)
        begun = perf_counter()
        while simulate(functions, *buffers, *times, record, stop) == layout.OUTSIDE:
            execute_outside(tape, state)
        piece = next_piece(piece, perf_counter() - begun)


_SHAPE = layout.TRUE_STATES, layout.STATES, layout.STAGES, layout.ADAPTIVE


def _linked(tape: Tape) -> Linked:
    functions = tape.wiring.diagram.plant.model.functions
    true, states, stages, adaptive = (int(tape.ints[word]) for word in _SHAPE)
    return linked(functions, Shape(true, states, stages, bool(adaptive)), tape.further, *tape.fuzzy)


def next_piece(scans: int, seconds: float) -> int:
    """Return how many scans to run next without coming back to Python, after so many took so long.

    It is for the user who interrupts a run: compiled code does not hear of that.
    """
    return max(1, min(MOST_SCANS, int(scans * min(MOST_GROWTH, PIECE_SECONDS / max(seconds, 1e-9)))))


def trace_of(tape: Tape, state: RunState, record: Values) -> Trace:
    """Return the trace of the scans that were run, all of them recorded in `record`."""
    return _trace(tape, record[: state.progress[SAMPLES]], state)


def _trace(tape: Tape, record: Values, state: RunState) -> Trace:
    wiring = tape.wiring
    found = tape.recorded
    values = record[:, : len(found.names)]
    if found.signs is not None:
        values = values * found.signs
    fuzzy = {
        node.name: _fuzzy_record(tape, node, record) for node in wiring.order if isinstance(node, FuzzyNode)
    }
    return Trace(
        ticks=tape.starts[: record.shape[0]],
        names=found.names,
        units=found.units,
        values=values,
        fuzzy=fuzzy,
        fault=fault_of(tape, state),
        events=events_of(tape, record),
        incidents=_incidents(tape, record.shape[0]),
        constants=wiring.diagram.plant.constants,
    )


def _incidents(tape: Tape, samples: int) -> tuple[Incident, ...]:
    """Return what happened up to the last of so many samples."""
    end = tape.starts[samples - 1] if samples else -1
    return tuple(each for each in tape.schedule.incidents if each.tick <= end)


def _fuzzy_record(tape: Tape, node: FuzzyNode, record: Values) -> FuzzyRecord:
    program = node.block.program
    first = tape.recorded.blocks[node.name]
    part = record[:, first : first + program.recorded]
    cold = tape.schedule.cold
    restarted = bool(cold) and node.name in {each.name for each in restarted_nodes(tape.wiring.diagram)}
    return FuzzyRecord(
        input_names=program.input_names,
        output_names=program.output_names,
        rule_labels=program.rule_labels,
        inputs=part[:, : program.outputs_at],
        outputs=part[:, program.outputs_at : program.active_at],
        degrees=part[:, program.degrees_at :],
        flags=part[:, program.active_at : program.degrees_at],
        cold=tuple(each for each in cold if restarted and each < len(record)),
        units=tape.recorded.block_units[node.name],
    )

"""The scan, over and over: read, execute, write, integrate. One kernel for every tape and plant."""

from math import isfinite
from typing import NamedTuple

import numpy as np

from fcl_sim.jit import F4, FF, F, I, copy_four, copy_two, entry, flat, i8, inlined, signature, u
from fcl_sim.loop.blocks.fuzzy import Fuzzy, Singles
from fcl_sim.loop.events import AT_BEGINNING, rearm
from fcl_sim.loop.exact import advance_exactly, send
from fcl_sim.loop.execute import Further, execute
from fcl_sim.loop.integrate import advance
from fcl_sim.loop.layout import (
    CYCLE,
    EVENTS,
    MEASURED,
    NOT_FINITE,
    OUTSIDE,
    PLANT_INPUTS,
    PLANT_INPUTS_AT,
    ROW_LENGTH,
    ROWS_AT,
    ROWS_END,
    SAMPLED,
    SCANS,
    SEGMENTS,
    SEGMENTS_AT,
    SIGNALS,
    STATES,
    STEP_AT,
    UNDER_WAY,
    WRITE_SIGNS_AT,
    WRITES_AT,
)
from fcl_sim.loop.linked import LINKED, Linked
from fcl_sim.loop.row import Row
from fcl_sim.loop.work import (
    AT_FLOATS,
    AT_G,
    AT_HELD,
    AT_INTS,
    AT_P,
    AT_ROWS,
    AT_X,
    AT_Y,
    GUESS,
    INDEX,
    MODE,
    P_SIZE,
    PLACES,
    ROW,
    SAMPLES,
    SCAN,
    STATUS,
    Called,
    Floats,
    Ints,
    Plant,
    Work,
)
from fcl_sim.plant.declaration import START
from fcl_sim.plant.functions import PlantFunction


@inlined
def write_outputs(ints: Ints, floats: Floats, memory: Floats) -> None:
    """Give the plant its inputs, to be held until the next write."""
    slots, signs = ints[u(WRITES_AT)], ints[u(WRITE_SIGNS_AT)]
    first = ints[u(PLANT_INPUTS_AT)]
    for i in range(ints[u(PLANT_INPUTS)]):
        memory[u(first + i)] = floats[u(signs + i)] * memory[u(ints[u(slots + i)])]


@inlined
def first_unsound(ints: Ints, memory: Floats) -> int:
    """Return the slot of the first signal that is NaN or infinite, -1 where all are sound."""
    total = 0.0
    for i in range(ints[u(SIGNALS)]):
        total += memory[u(i)] * 0.0
    if total == 0.0:
        return -1
    for i in range(ints[u(SIGNALS)]):
        if not isfinite(memory[u(i)]):
            return i
    return -1


@inlined
def record_sample(ints: Ints, memory: Floats, row: Floats) -> None:
    """Copy the recorded stretches of memory, one after the other."""
    at = ints[u(SEGMENTS_AT)]
    column = 0
    for _ in range(ints[u(SEGMENTS)]):
        word, left = ints[u(at)], ints[u(at + 1)]
        while left >= 4:
            copy_four(row, u(column), memory, u(word))
            column, word, left = column + 4, word + 4, left - 4
        if left >= 2:
            copy_two(row, u(column), memory, u(word))
            column, word, left = column + 2, word + 2, left - 2
        if left == 1:
            row[u(column)] = memory[u(word)]
            column += 1
        at += 2


@inlined
def begin_run(plant: Plant, work: Work, t: float) -> None:
    """Let the plant choose the mode in which it starts, and arm the events that do not stand beyond zero."""
    progress = work.progress
    progress[u(MODE)] = plant.transition(START, t, work.x, work.held, work.p, START)
    if work.ints[u(EVENTS)] > 0:
        plant.look(work.at, AT_BEGINNING, t, progress[u(MODE)])
        rearm(work.ints, work.g0, progress)


@inlined
def integrate_scan(plant: Plant, work: Work, memory: Floats, start: int, write: int, end: int) -> bool:
    """Integrate from scan to scan, in nanoseconds, writing in between, if then; return whether it could.

    Outputs that are written at the start have been, so that they are recorded.
    """
    ints = work.ints
    exact = ints[u(UNDER_WAY)] > 0
    done = start
    if write == start and exact:
        send(work, start)
    for piece in range(1 if write == start else 0, 2):
        target = min(write, end) if piece == 0 else end
        if target > done:
            if exact:
                if not advance_exactly(plant, work, done, target):
                    return False
            elif not advance(plant, work, done / 1e9, (target - done) / 1e9):
                return False
            done = target
        if piece == 0 and write <= end:
            write_outputs(ints, work.floats, memory)
            if exact:
                send(work, target)
    return True


class Buffers(NamedTuple):
    """What the scans of a run work in besides the integration: the blocks, and the record.

    All as `simulate` gets them.
    """

    memory: Floats
    constants: Singles
    singles: Singles
    starts: Ints
    writes: Ints
    record: Floats


class Others(NamedTuple):
    """The functions that a scan calls besides those of the integration."""

    outputs: Called
    sample: PlantFunction
    further: Further
    long: Fuzzy
    real: Fuzzy


@flat
def scan_on(plant: Plant, called: Others, work: Work, buffers: Buffers, until: int) -> int:
    """Run the scans up to `until`, as `simulate` does; flat, so that no scan counts references."""
    ints, floats, progress, memory = work.ints, work.floats, work.progress, buffers.memory
    nominal = floats[u(ints[u(STEP_AT)] + CYCLE)]
    if progress[u(SCAN)] == 0 and progress[u(ROW)] == 0:
        work.rows[u(GUESS)] = nominal
        begin_run(plant, work, buffers.starts[u(0)] / 1e9)
    for scan in range(progress[u(SCAN)], until):
        start = buffers.starts[u(scan)]
        write = buffers.writes[u(scan)]
        at = progress[u(ROW)]
        if at == 0:
            if ints[u(SAMPLED)] == 1:
                called.sample(start / 1e9, work.x, work.held, work.p)
            called.outputs(work.at, start / 1e9, progress[u(MODE)])
            at = ints[u(ROWS_AT)]
        late = ints[u(MEASURED)] == 1 and scan > 0
        cycle = (start - buffers.starts[u(scan - 1)]) / 1e9 if late else nominal
        here = Row(ints, floats, memory, at, cycle, start / 1e9, scan)
        at = execute(here, called.further, called.long, called.real, buffers.constants, buffers.singles)
        if at != ints[u(ROWS_END)]:
            progress[u(ROW)] = at + ints[u(at + ROW_LENGTH)]
            progress[u(INDEX)] = at
            return OUTSIDE
        progress[u(ROW)] = 0
        if write == start:
            write_outputs(ints, floats, memory)
        unsound = first_unsound(ints, memory)
        if unsound >= 0:
            progress[u(STATUS)] = NOT_FINITE
            progress[u(INDEX)] = unsound
            break
        record_sample(ints, memory, buffers.record[u(scan)])
        progress[u(SAMPLES)] = scan + 1
        if scan < ints[u(SCANS)] and not integrate_scan(
            plant, work, memory, start, write, buffers.starts[u(scan + 1)]
        ):
            break
        progress[u(SCAN)] = scan + 1
    return int(progress[u(STATUS)])


@entry(signature(i8, LINKED, I, F, F, F4, F4, F, F, I, F, I, I, FF, i8))
def simulate(
    functions: Linked,
    ints: Ints,
    floats: Floats,
    memory: Floats,
    constants: Singles,
    singles: Singles,
    x: Floats,
    p: Floats,
    progress: Ints,
    rows: Floats,
    starts: Ints,
    writes: Ints,
    record: Floats,
    until: int,
) -> int:
    """Run a tape from where `progress` stands to the beginning of scan `until`; return the status.

    x (states,), `memory`, `progress` (PROGRESS,) and `rows` are the state of a
    run (`loop.state`), taken up and left; `constants` and `singles` are
    `floats` and `memory` as binary32 (`loop.blocks.fuzzy`). `starts` (scans + 1,)
    holds the nanosecond at which each scan reads its inputs, the end included,
    `writes` those at which it writes its outputs (`loop.clock`); of `record`
    (scans + 1, columns) the scans that are run are filled. Status OUTSIDE asks for
    the block whose row is `index`, and to be called again.
    """
    first_input = ints[u(PLANT_INPUTS_AT)]
    held = memory[first_input : first_input + ints[u(PLANT_INPUTS)]]
    states, count = ints[u(STATES)], ints[u(EVENTS)]
    dx, trial, middle, g0, g1, gm = (
        np.zeros(states),
        np.zeros(states),
        np.zeros(states),
        np.zeros(count),
        np.zeros(count),
        np.zeros(count),
    )
    places = np.empty(PLACES, np.int64)
    places[AT_INTS], places[AT_FLOATS] = ints.ctypes.data, floats.ctypes.data
    places[AT_ROWS], places[AT_HELD] = rows.ctypes.data, held.ctypes.data
    places[AT_P], places[P_SIZE] = p.ctypes.data, p.size
    places[AT_Y], places[AT_X] = memory.ctypes.data, x.ctypes.data
    places[AT_X + 1], places[AT_X + 2] = trial.ctypes.data, middle.ctypes.data
    places[AT_G], places[AT_G + 1], places[AT_G + 2] = g0.ctypes.data, g1.ctypes.data, gm.ctypes.data
    at = int(np.int64(places.ctypes.data))
    plant = Plant(functions.step, functions.look, functions.transition)
    called = Others(functions.outputs, functions.sample, functions.further, functions.long, functions.real)
    work = Work(ints, floats, x, held, p, progress, rows, dx, trial, middle, g0, g1, gm, places, at)
    buffers = Buffers(memory, constants, singles, starts, writes, record)
    return scan_on(plant, called, work, buffers, until)

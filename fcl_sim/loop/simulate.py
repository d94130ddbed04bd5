"""The scan, over and over: read, execute, write, integrate. One kernel for every tape and plant."""

from math import isfinite

import numpy as np

from fcl_sim.jit import FF, F, I, entry, i8, inlined, signature, u
from fcl_sim.loop.events import rearm
from fcl_sim.loop.execute import execute
from fcl_sim.loop.integrate import advance
from fcl_sim.loop.layout import (
    CYCLE,
    EVENTS,
    FINISHED,
    LATENCY,
    MEASURED,
    NOT_FINITE,
    PLANT_INPUTS,
    PLANT_INPUTS_AT,
    PLANT_OUTPUTS,
    REPORT_INDEX,
    REPORT_SAMPLES,
    REPORT_STATUS,
    SAMPLED,
    SCANS,
    SEGMENTS,
    SEGMENTS_AT,
    SIGNALS,
    STAGES,
    STATES,
    STEP_AT,
    WRITE_SIGNS_AT,
    WRITES_AT,
)
from fcl_sim.loop.work import GUESS, INDEX, MODE, PROGRESS, STATUS, Floats, Ints, Plant, Work, rows_size
from fcl_sim.plant.declaration import START
from fcl_sim.plant.functions import FUNCTION_TYPES, PlantFunction


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
        first = ints[u(at)]
        for i in range(ints[u(at + 1)]):
            row[u(column)] = memory[u(first + i)]
            column += 1
        at += 2


@inlined
def integrate_scan(plant: Plant, work: Work, memory: Floats, start: int, end: int) -> bool:
    """Integrate from scan to scan, in nanoseconds, writing after the latency; return whether it could."""
    ints = work.ints
    done = start
    for piece in range(2):
        target = start + ints[u(LATENCY)] if piece == 0 else end
        if target > done:
            if not advance(plant, work, done / 1e9, (target - done) / 1e9):
                return False
            done = target
        if piece == 0:
            write_outputs(ints, work.floats, memory)
    return True


@entry(signature(i8, *FUNCTION_TYPES, I, F, F, F, F, I, FF, I))
def simulate(
    dynamics: PlantFunction,
    outputs: PlantFunction,
    events: PlantFunction,
    transition: PlantFunction,
    sample: PlantFunction,
    ints: Ints,
    floats: Floats,
    memory: Floats,
    x: Floats,
    p: Floats,
    starts: Ints,
    record: Floats,
    report: Ints,
) -> int:
    """Run a tape from its first scan to its end; return the status of `loop.layout`.

    x (states,) and `memory` are left as the run ends. `starts` (scans + 1,)
    holds the nanosecond at which each scan reads its inputs, the end included;
    `record` (scans + 1, columns) and `report` are filled.
    """
    first_input = ints[u(PLANT_INPUTS_AT)]
    y = memory[0 : ints[u(PLANT_OUTPUTS)]]
    held = memory[first_input : first_input + ints[u(PLANT_INPUTS)]]
    states, count = ints[u(STATES)], ints[u(EVENTS)]
    nominal = floats[u(ints[u(STEP_AT)] + CYCLE)]
    progress = np.zeros(PROGRESS, dtype=np.int64)
    rows = np.zeros(rows_size(ints[u(STAGES)], states))
    rows[u(GUESS)] = nominal
    dx, trial = np.zeros(states), np.zeros(states)
    g0, g1 = np.zeros(count), np.zeros(count)
    plant = Plant(dynamics, events, transition)
    work = Work(ints, floats, x, held, p, progress, rows, dx, trial, g0, g1)
    progress[u(MODE)] = transition(START, starts[u(0)] / 1e9, x, held, p, START)
    if count > 0:
        events(starts[u(0)] / 1e9, x, held, p, progress[u(MODE)], g0)
        rearm(ints, g0, progress)
    report[u(REPORT_STATUS)] = FINISHED
    for scan in range(ints[u(SCANS)] + 1):
        start = starts[u(scan)]
        if ints[u(SAMPLED)] == 1:
            sample(start / 1e9, x, p)
        outputs(start / 1e9, x, held, p, progress[u(MODE)], y)
        late = ints[u(MEASURED)] == 1 and scan > 0
        execute(ints, floats, memory, (start - starts[u(scan - 1)]) / 1e9 if late else nominal)
        if ints[u(LATENCY)] == 0:
            write_outputs(ints, floats, memory)
        unsound = first_unsound(ints, memory)
        if unsound >= 0:
            report[u(REPORT_STATUS)] = NOT_FINITE
            report[u(REPORT_INDEX)] = unsound
            break
        record_sample(ints, memory, record[scan])
        report[u(REPORT_SAMPLES)] = scan + 1
        if scan < ints[u(SCANS)] and not integrate_scan(plant, work, memory, start, starts[u(scan + 1)]):
            report[u(REPORT_STATUS)] = progress[u(STATUS)]
            report[u(REPORT_INDEX)] = progress[u(INDEX)]
            break
    return int(report[u(REPORT_STATUS)])

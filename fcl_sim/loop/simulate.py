"""The scan, over and over: read, execute, write, integrate. One kernel for every tape and plant."""

from math import isfinite

import numpy as np

from fcl_sim.jit import FF, F, I, entry, i8, inlined, kernel, signature, u
from fcl_sim.loop.execute import execute
from fcl_sim.loop.integrate import ARMED, INDEX, MODE, PROGRESS, STATUS, advance
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
from fcl_sim.plant.declaration import START
from fcl_sim.plant.functions import FUNCTION_TYPES


@inlined
def write_outputs(ints, floats, memory):
    """Give the plant its inputs, to be held until the next write."""
    slots, signs = ints[u(WRITES_AT)], ints[u(WRITE_SIGNS_AT)]
    first = ints[u(PLANT_INPUTS_AT)]
    for i in range(ints[u(PLANT_INPUTS)]):
        memory[u(first + i)] = floats[u(signs + i)] * memory[ints[u(slots + i)]]


@inlined
def first_unsound(ints, memory):
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
def record_sample(ints, memory, row):
    """Copy the recorded stretches of memory, one after the other."""
    at = ints[u(SEGMENTS_AT)]
    column = 0
    for _ in range(ints[u(SEGMENTS)]):
        first = ints[u(at)]
        for i in range(ints[u(at + 1)]):
            row[u(column)] = memory[u(first + i)]
            column += 1
        at += 2


@entry(signature(i8, *FUNCTION_TYPES, I, F, F, F, F, I, FF, I))
def simulate(
    dynamics, outputs, events, transition, sample, ints, floats, memory, x, p, starts, record, report
):
    """Run a tape from its first scan to its end; return the status of `loop.layout`.

    x (states,) and `memory` are left as the run ends. `starts` (scans + 1,)
    holds the nanosecond at which each scan reads its inputs, the end included;
    `record` (scans + 1, columns) and `report` are filled.
    """
    y = memory[0 : ints[u(PLANT_OUTPUTS)]]
    held = memory[ints[u(PLANT_INPUTS_AT)] : ints[u(PLANT_INPUTS_AT)] + ints[u(PLANT_INPUTS)]]
    k = np.zeros((ints[u(STAGES)] + 1) * ints[u(STATES)])
    dx = np.zeros(ints[u(STATES)])
    base = np.zeros(ints[u(STATES)])
    trial = np.zeros(ints[u(STATES)])
    g0 = np.zeros(ints[u(EVENTS)])
    g1 = np.zeros(ints[u(EVENTS)])
    guess = np.zeros(1)
    progress = np.zeros(PROGRESS, dtype=np.int64)
    nominal = floats[ints[u(STEP_AT)] + CYCLE]
    latency = ints[u(LATENCY)]
    guess[u(0)] = nominal
    progress[u(ARMED)] = (1 << ints[u(EVENTS)]) - 1
    progress[u(MODE)] = transition(START, starts[u(0)] / 1e9, x, held, p, START)
    report[u(REPORT_STATUS)] = FINISHED
    for scan in range(ints[u(SCANS)] + 1):
        t = starts[u(scan)] / 1e9
        if ints[u(SAMPLED)] == 1:
            sample(t, x, p)
        outputs(t, x, held, p, progress[u(MODE)], y)
        cycle = nominal
        if ints[u(MEASURED)] == 1 and scan > 0:
            cycle = (starts[u(scan)] - starts[u(scan - 1)]) / 1e9
        execute(ints, floats, memory, cycle)
        if latency == 0:
            write_outputs(ints, floats, memory)
        unsound = first_unsound(ints, memory)
        if unsound >= 0:
            report[u(REPORT_STATUS)], report[u(REPORT_INDEX)] = NOT_FINITE, unsound
            break
        record_sample(ints, memory, record[scan])
        report[u(REPORT_SAMPLES)] = scan + 1
        if scan == ints[u(SCANS)]:
            break
        sound = True
        begin = starts[u(scan)]
        for piece in range(2):
            end = starts[u(scan)] + latency if piece == 0 else starts[u(scan + 1)]
            if sound and end > begin:
                sound = advance(
                    dynamics, events, transition, begin / 1e9, (end - begin) / 1e9, x, held, p,
                    ints, floats, guess, progress, k, dx, base, trial, g0, g1,
                )  # fmt: skip
                begin = end
            if piece == 0:
                write_outputs(ints, floats, memory)
        if not sound:
            report[u(REPORT_STATUS)], report[u(REPORT_INDEX)] = progress[u(STATUS)], progress[u(INDEX)]
            break
    return report[u(REPORT_STATUS)]

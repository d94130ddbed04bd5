"""The scan, over and over: read, execute, write, integrate. One kernel for every tape and plant."""

from math import isfinite

import numpy as np

from fcl_sim.jit import FF, F, I, entry, i8, kernel, signature
from fcl_sim.loop.execute import execute
from fcl_sim.loop.integrate import ARMED, INDEX, MODE, STATUS, advance
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


@kernel
def write_outputs(ints, floats, memory):
    """Give the plant its inputs, to be held until the next write."""
    slots, signs = ints[WRITES_AT], ints[WRITE_SIGNS_AT]
    first = ints[PLANT_INPUTS_AT]
    for i in range(ints[PLANT_INPUTS]):
        memory[first + i] = floats[signs + i] * memory[ints[slots + i]]


@kernel
def first_unsound(ints, memory):
    """Return the slot of the first signal that is NaN or infinite, -1 where all are sound."""
    total = 0.0
    for i in range(ints[SIGNALS]):
        total += memory[i] * 0.0
    if total == 0.0:
        return -1
    for i in range(ints[SIGNALS]):
        if not isfinite(memory[i]):
            return i
    return -1


@kernel
def record_sample(ints, memory, row):
    """Copy the recorded stretches of memory, one after the other."""
    at = ints[SEGMENTS_AT]
    column = 0
    for _ in range(ints[SEGMENTS]):
        first = ints[at]
        for i in range(ints[at + 1]):
            row[column] = memory[first + i]
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
    y = memory[0 : ints[PLANT_OUTPUTS]]
    u = memory[ints[PLANT_INPUTS_AT] : ints[PLANT_INPUTS_AT] + ints[PLANT_INPUTS]]
    k = np.zeros((ints[STAGES] + 1, ints[STATES]))
    trial = np.zeros(ints[STATES])
    g0 = np.zeros(ints[EVENTS])
    g1 = np.zeros(ints[EVENTS])
    guess = np.zeros(1)
    progress = np.zeros(ARMED + ints[EVENTS], dtype=np.int64)
    nominal = floats[ints[STEP_AT] + CYCLE]
    latency = ints[LATENCY]
    guess[0] = nominal
    progress[MODE] = transition(START, starts[0] / 1e9, x, u, p, START)
    report[REPORT_STATUS] = FINISHED
    for scan in range(ints[SCANS] + 1):
        t = starts[scan] / 1e9
        if ints[SAMPLED] == 1:
            sample(t, x, p)
        outputs(t, x, u, p, progress[MODE], y)
        cycle = nominal
        if ints[MEASURED] == 1 and scan > 0:
            cycle = (starts[scan] - starts[scan - 1]) / 1e9
        execute(ints, floats, memory, cycle)
        if latency == 0:
            write_outputs(ints, floats, memory)
        unsound = first_unsound(ints, memory)
        if unsound >= 0:
            report[REPORT_STATUS], report[REPORT_INDEX] = NOT_FINITE, unsound
            break
        record_sample(ints, memory, record[scan])
        report[REPORT_SAMPLES] = scan + 1
        if scan == ints[SCANS]:
            break
        sound = True
        if latency > 0:
            sound = advance(
                dynamics, events, transition, t, latency / 1e9, x, u, p,
                ints, floats, guess, progress, k, trial, g0, g1,
            )  # fmt: skip
            write_outputs(ints, floats, memory)
            t = (starts[scan] + latency) / 1e9
        if sound and starts[scan] + latency < starts[scan + 1]:
            sound = advance(
                dynamics, events, transition, t, (starts[scan + 1] - starts[scan] - latency) / 1e9, x, u, p,
                ints, floats, guess, progress, k, trial, g0, g1,
            )  # fmt: skip
        if not sound:
            report[REPORT_STATUS], report[REPORT_INDEX] = progress[STATUS], progress[INDEX]
            break
    return report[REPORT_STATUS]

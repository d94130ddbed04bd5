"""A thousand runs of the crane on one thread and on two: throughput and memory."""

import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from statistics import median
from time import perf_counter

from benchmarks.crane_loop import crane
from fcl_sim.loop.run import empty_record, proceed
from fcl_sim.loop.state import initial_state
from fcl_sim.loop.tape import Tape, lower
from fcl_sim.loop.wiring import wire

RUNS = 1000
ROUNDS = 5


def measure_runs() -> Iterator[str]:
    """Yield a line on throughput, one on memory."""
    tape = lower(wire(crane("10 ms")))
    _seconds(tape, 1, RUNS // 10)
    before = _resident()
    ratios, alone = [], []
    for _ in range(ROUNDS):
        one, two = (_seconds(tape, threads, RUNS // ROUNDS) for threads in (1, 2))
        ratios.append(one / two)
        alone.append(one)
    each = 1e3 * median(alone) * ROUNDS / RUNS
    yield (
        f"crane, 60 s, 10 ms scan, {RUNS} runs: {each:.2f} ms a run on one thread, "
        f"two give {median(ratios):.2f} times its throughput"
    )
    yield f"memory over these {2 * RUNS} runs: grows by {(_resident() - before) / 2**20:.1f} MiB"


def _seconds(tape: Tape, threads: int, runs: int) -> float:
    """Return the time that runs take, each with a state and a record of its own."""

    def run(_: int) -> None:
        proceed(tape, initial_state(tape), empty_record(tape))

    begun = perf_counter()
    with ThreadPoolExecutor(threads) as pool:
        list(pool.map(run, range(runs)))
    return perf_counter() - begun


def _resident() -> int:
    """Return the bytes that this process holds."""
    pages = Path("/proc/self/statm").read_text(encoding="ascii").split()[1]
    return int(pages) * os.sysconf("SC_PAGE_SIZE")

"""Run scenarios side by side, as many at a time as there are processors.

The compiled loop leaves Python to the other threads while it runs. Texts are
read and bound, and kernels compiled, one scenario after the other in the thread
that asks: a plant's file is run for that, and compiling hears of an interrupt
in no other.
"""

import os
from collections.abc import Iterable, Iterator, Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from threading import Event
from typing import Any

from fcl_sim.diagnostics import InputFault
from fcl_sim.loop.run import compile_for
from fcl_sim.scenario.reader import read
from fcl_sim.testbench.outcome import Outcome
from fcl_sim.testbench.preparing import prepare
from fcl_sim.testbench.running import outcome_of, run_together


def run_files(
    paths: Iterable[Path | str], overrides: Mapping[str, Any] | None = None, workers: int | None = None
) -> Iterator[Outcome | InputFault]:
    """Yield what comes of each scenario file in their order: its outcome, or all its faults.

    As `run` of each, but `workers` at a time, else as many as there are
    processors; what comes of them is the same. Whoever leaves off before the
    end, as by an interrupt, ends the runs that are under way.
    """
    halt = Event()
    pool = ThreadPoolExecutor(workers or os.cpu_count() or 1)
    try:
        begun = [_begin(path, overrides, pool, workers, halt) for path in paths]
        for each in begun:
            yield each if isinstance(each, InputFault) else _finished(each)
    finally:
        halt.set()
        pool.shutdown(cancel_futures=True)


def _begin(
    path: Path | str,
    overrides: Mapping[str, Any] | None,
    pool: ThreadPoolExecutor,
    workers: int | None,
    halt: Event,
) -> Future[Outcome] | InputFault:
    try:
        scenario = read(path, overrides)
        prepared = prepare(scenario)
        compile_for(prepared[0].diagram)
    except InputFault as fault:
        return fault
    return pool.submit(lambda: outcome_of(scenario, run_together(prepared, workers, halt)))


def _finished(begun: Future[Outcome]) -> Outcome | InputFault:
    try:
        return begun.result()
    except InputFault as fault:
        return fault

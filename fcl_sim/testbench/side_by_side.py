"""Run scenarios side by side, as many at a time as there are processors.

Where copies of this process can work, each scenario is run by one of them,
since judging is Python, of which a process runs one thread at a time; else by a
thread, as the compiled loop leaves Python to the others while it runs. Texts are
read and bound, and kernels compiled, one scenario after the other in the thread
that asks: a plant's file is run for that, and compiling hears of an interrupt
in no other.
"""

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import closing
from functools import partial
from pathlib import Path
from threading import Event
from typing import Any

from fcl_sim.diagnostics import Diagnostic, InputFault
from fcl_sim.forked import Copies, Work, able
from fcl_sim.loop.diagram import FuzzyNode
from fcl_sim.loop.run import compile_for
from fcl_sim.scenario.model import Scenario
from fcl_sim.scenario.reader import read
from fcl_sim.testbench.outcome import Outcome, Prepared, Run
from fcl_sim.testbench.preparing import prepare
from fcl_sim.testbench.running import outcome_of, run_together

Ready = tuple[Scenario, tuple[Prepared, ...]]
Runs = Mapping[str, Run]
Faults = tuple[Diagnostic, ...]

ROW_WORK = 10
"""What a scan takes besides its plant, as the states of a plant that take as long."""


def run_files(
    paths: Iterable[Path | str], overrides: Mapping[str, Any] | None = None, workers: int | None = None
) -> Iterator[Outcome | InputFault]:
    """Yield what comes of each scenario file in their order: its outcome, or all its faults.

    As `run` of each, but `workers` at a time, else as many as there are
    processors; what comes of them is the same. Whoever leaves off before the
    end, as by an interrupt, ends the runs that are under way.
    """
    files = [*paths]
    ready = (_ready(path, overrides) for path in files)
    count = min(able(workers), len(files))
    if count < 2:
        return _by_threads(ready, workers)
    return _by_copies(ready, count, threads=able(workers) // count)


def _ready(path: Path | str, overrides: Mapping[str, Any] | None) -> Ready | InputFault:
    try:
        scenario = read(path, overrides)
        prepared = prepare(scenario)
        compile_for(prepared[0].diagram)
    except InputFault as fault:
        return fault
    return scenario, prepared


def _by_copies(
    found: Iterable[Ready | InputFault], count: int, threads: int
) -> Iterator[Outcome | InputFault]:
    with closing(Copies(count)) as copies:
        begun = [
            each if isinstance(each, InputFault) else (each[0], _begun(copies, each[1], threads))
            for each in found
        ]
        for each in begun:
            if isinstance(each, InputFault):
                yield each
            else:
                scenario, work = each
                runs = copies.result(work)
                yield outcome_of(scenario, runs) if isinstance(runs, Mapping) else InputFault(runs)


def _begun(copies: Copies, prepared: Sequence[Prepared], threads: int) -> Work[Runs | Faults]:
    return copies.begin(partial(_run, prepared, threads), _weight(prepared), _known(prepared))


def _run(prepared: Sequence[Prepared], threads: int) -> Runs | Faults:
    try:
        return run_together(prepared, threads)
    except InputFault as fault:
        return tuple(fault.diagnostics)


def _weight(prepared: Sequence[Prepared]) -> float:
    """Return about how much work the runs of a scenario are."""
    return sum(
        (ROW_WORK + len(each.diagram.plant.model.declaration.states))
        * (each.diagram.timing.duration / each.diagram.timing.scan)
        * (1 + (len(each.envelope.grid) if each.envelope else 0))
        for each in prepared
    )


def _known(prepared: Sequence[Prepared]) -> list[object]:
    """Return what runs are made of that was there before: the compiled parts can be sent in no other way."""
    known: list[object] = []
    for each in prepared:
        blocks = [node.block for node in each.diagram.nodes if isinstance(node, FuzzyNode)]
        known += [each.diagram, each.diagram.plant.model, *blocks, *each.requirements]
        known += [each.baseline] if each.baseline else []
    return known


def _by_threads(found: Iterable[Ready | InputFault], workers: int | None) -> Iterator[Outcome | InputFault]:
    halt = Event()
    pool = ThreadPoolExecutor(workers or os.cpu_count() or 1)
    try:
        begun = [
            each if isinstance(each, InputFault) else pool.submit(_outcome, *each, workers, halt)
            for each in found
        ]
        for each in begun:
            yield each if isinstance(each, InputFault) else _finished(each)
    finally:
        halt.set()
        pool.shutdown(cancel_futures=True)


def _outcome(scenario: Scenario, prepared: Sequence[Prepared], workers: int | None, halt: Event) -> Outcome:
    return outcome_of(scenario, run_together(prepared, workers, halt))


def _finished(begun: Future[Outcome]) -> Outcome | InputFault:
    try:
        return begun.result()
    except InputFault as fault:
        return fault

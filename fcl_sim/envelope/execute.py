"""Plan → Envelope: every point run and judged on as many threads as the machine has.

The compiled loop leaves Python to the other threads while it runs. What comes
of a point depends on the point alone, and the points are gathered in their
order, so the number of threads changes nothing. Of a point of many a few numbers
are kept; the worst ones are run once more for their traces.
"""

import os
from collections import deque
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from itertools import chain
from threading import Event
from time import perf_counter
from types import MappingProxyType

from fcl_sim.envelope.envelope import Envelope, PointRun
from fcl_sim.envelope.plan import Family, Plan
from fcl_sim.judge.envelope import AtPoint, judge_envelope, kept
from fcl_sim.judge.judge import definition, judge
from fcl_sim.loop.run import run_tape

TOGETHER = 4
"""Points that a thread takes at a time."""
AHEAD = 4
"""Such shares that wait for each thread, at most: no more of the points is in memory."""

FEW = 8
"""Points of which all traces are kept in memory, at most."""


@dataclass(frozen=True, slots=True)
class Found:
    """What came of each requirement at a point; the whole run, where the points are few."""

    kept: tuple[AtPoint, ...]
    run: PointRun | None


def execute(plan: Plan, workers: int | None = None, halt: Event | None = None) -> Envelope:
    """Run and judge every point; `workers` threads, else one for each processor.

    InputFault where a function of the user's fails, or the values of a point do not go together.
    Halted soon after another thread sets `halt`.
    """
    begun = perf_counter()
    count = workers or os.cpu_count() or 1
    pool = ThreadPoolExecutor(count)
    try:
        found = list(_every_point(plan, pool, count, halt))
        columns = list(zip(*(each.kept for each in found), strict=True))
        verdicts = tuple(
            judge_envelope(asked, column, definition(asked, plan.units.signals), plan.grid.told)
            for asked, column in zip(plan.requirements, columns, strict=True)
        )
        wanted = sorted({each.worst for each in verdicts if each.worst is not None})
        runs = {each.run.index: each.run for each in found if each.run is not None}
        again = [index for index in wanted if index not in runs]
        runs |= {each.index: each for each in _whole(plan, again, pool, halt)}
    finally:
        pool.shutdown(cancel_futures=True)
    return Envelope(
        grid=plan.grid,
        verdicts=verdicts,
        worst_runs=MappingProxyType({index: runs[index] for index in wanted}),
        seconds=perf_counter() - begun,
    )


def _every_point(plan: Plan, pool: ThreadPoolExecutor, workers: int, halt: Event | None) -> Iterator[Found]:
    under_way: deque[Future[list[Found]]] = deque()
    for family, points in plan.families(range(len(plan.grid))):
        for first in range(0, len(points), TOGETHER):
            share = points[first : first + TOGETHER]
            under_way.append(pool.submit(_judged, plan, family, share, halt))
            if len(under_way) > AHEAD * workers:
                yield from under_way.popleft().result()
    yield from chain.from_iterable(each.result() for each in under_way)


def _judged(plan: Plan, family: Family, share: Sequence[int], halt: Event | None) -> list[Found]:
    return [_found(plan, _run(plan, family, index, halt)) for index in share]


def _found(plan: Plan, run: PointRun) -> Found:
    return Found(tuple(map(kept, run.verdicts)), run if len(plan.grid) <= FEW else None)


def _run(plan: Plan, family: Family, index: int, halt: Event | None) -> PointRun:
    tape, others = family.at(plan.steps(index))
    trace = run_tape(tape, halt)
    runs = {name: run_tape(each, halt) for name, each in others.items()}
    return PointRun(
        index=index,
        label=plan.grid.told(index),
        diagram=tape.wiring.diagram,
        trace=trace,
        verdicts=judge(trace, family.requirements, runs),
    )


def _whole(
    plan: Plan, points: Sequence[int], pool: ThreadPoolExecutor, halt: Event | None
) -> Iterator[PointRun]:
    """Yield the runs of some points with all that came of them."""
    for family, members in plan.families(points):
        yield from pool.map(lambda index, family=family: _run(plan, family, index, halt), members)

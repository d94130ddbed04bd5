"""Plan → Envelope: every point run and judged on as many threads as the machine has.

The compiled loop leaves Python to the other threads while it runs. What comes
of a point depends on the point alone, and the points are gathered in their
order, so the number of threads changes nothing. Of a point a few numbers are
kept; the worst ones are run once more for their traces.
"""

import os
from collections import deque
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from itertools import chain
from threading import Event
from time import perf_counter
from types import MappingProxyType

from fcl_sim.envelope.envelope import Envelope, PointRun
from fcl_sim.envelope.plan import Family, Plan
from fcl_sim.judge.envelope import AtPoint, judge_envelope, kept
from fcl_sim.judge.judge import definition, judge
from fcl_sim.judge.verdict import Verdict
from fcl_sim.loop.run import run_tape
from fcl_sim.loop.tape import Tape
from fcl_sim.loop.trace import Trace

TOGETHER = 4
"""Points that a thread takes at a time."""
AHEAD = 4
"""Such shares that wait for each thread, at most: no more of the points is in memory."""

Found = tuple[AtPoint, ...]
"""What came of each requirement at a point."""


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
        columns = list(zip(*found, strict=True))
        verdicts = tuple(
            judge_envelope(asked, column, definition(asked, plan.units.signals), plan.grid.told)
            for asked, column in zip(plan.requirements, columns, strict=True)
        )
        wanted = sorted({each.worst for each in verdicts if each.worst is not None})
        worst_runs = {each.index: each for each in _whole(plan, wanted, pool, halt)}
    finally:
        pool.shutdown(cancel_futures=True)
    return Envelope(
        grid=plan.grid,
        verdicts=verdicts,
        worst_runs=MappingProxyType(worst_runs),
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
    return [tuple(kept(each) for each in _run(plan, family, index, halt)[2]) for index in share]


def _run(
    plan: Plan, family: Family, index: int, halt: Event | None
) -> tuple[Tape, Trace, tuple[Verdict, ...]]:
    tape, others = family.at(plan.steps(index))
    trace = run_tape(tape, halt)
    runs = {name: run_tape(each, halt) for name, each in others.items()}
    return tape, trace, judge(trace, family.requirements, runs)


def _whole(
    plan: Plan, points: Sequence[int], pool: ThreadPoolExecutor, halt: Event | None
) -> Iterator[PointRun]:
    """Yield the runs of some points with all that came of them."""
    for family, members in plan.families(points):
        ran = pool.map(lambda index, family=family: (index, *_run(plan, family, index, halt)), members)
        for index, tape, trace, verdicts in ran:
            yield PointRun(
                index=index,
                label=plan.grid.told(index),
                diagram=tape.wiring.diagram,
                trace=trace,
                verdicts=verdicts,
            )

"""Formula + Trace → verdict: three-valued, with its margin, its reason and its first violation."""

from dataclasses import dataclass, replace
from enum import Enum

import numpy as np

from fcl_sim.judge.temporal import explain
from fcl_sim.judge.temporal.evaluate import HIGH, LOW, POSSIBLE, SURE, evaluate
from fcl_sim.judge.temporal.formula import Formula
from fcl_sim.judge.temporal.tree import Comparison
from fcl_sim.judge.temporal.violation import blamed, violation
from fcl_sim.judge.temporal.write import written
from fcl_sim.loop.trace import Trace


class Truth(Enum):
    """What a trace says of a formula."""

    HOLDS = "it holds"
    FAILS = "it does not hold"
    OPEN = "the trace ends before it is decided"
    UNTESTED = "what would put it to the test never comes"
    BROKEN = "a number that it looks at is not finite"


@dataclass(frozen=True, slots=True, kw_only=True)
class Judgement:
    """What came of a formula.

    `robustness` is how far the numbers are from the other verdict, negative
    where it does not hold; `decided_by` the comparison and the scan whose
    margin that is. `violation` are the first and last scan of what first makes
    it fail, `blamed` the signals that do so there. `about` is the text of the
    comparison that is broken, or of the trigger that never comes, `scan` when.
    """

    truth: Truth
    robustness: float | None = None
    decided_by: tuple[Comparison, int] | None = None
    violation: tuple[int, int] | None = None
    blamed: tuple[str, ...] = ()
    about: str = ""
    scan: int = 0


def consider(formula: Formula, trace: Trace) -> Judgement:
    """Return what a trace of one scan or more says of a formula at its first scan.

    Times in the formula count from there. Takes time n log n for n scans.
    """
    course = evaluate(formula.tree, trace)
    where = np.zeros(trace.ticks.size, np.bool_)
    where[0] = True
    found = list(explain.looks(course, where))
    broken = explain.broken(found)
    if broken is not None:
        return Judgement(truth=Truth.BROKEN, about=written(broken[1]), scan=broken[0])
    rows = course.rows[:, 0]
    if rows[POSSIBLE] < 0:
        where_from, where_to = violation(course)
        failed = _decided(Truth.FAILS, found, float(rows[HIGH]), (where_from, where_to))
        return replace(failed, blamed=blamed(course, where_from, where_to))
    if rows[SURE] < 0:
        return Judgement(truth=Truth.OPEN)
    trigger = explain.untested(found)
    if trigger is not None:
        return Judgement(truth=Truth.UNTESTED, about=written(trigger.left))
    return _decided(Truth.HOLDS, found, float(rows[LOW]))


def _decided(
    truth: Truth, found: list[explain.Look], robustness: float, where: tuple[int, int] | None = None
) -> Judgement:
    if not np.isfinite(robustness):
        return Judgement(truth=truth, violation=where)
    return Judgement(
        truth=truth,
        robustness=robustness + 0.0,
        decided_by=explain.deciding(found, robustness, where),
        violation=where,
    )

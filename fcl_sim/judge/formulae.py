"""Trace and formula → finding, with the sentence that tells it."""

import re

from fcl_sim.judge import wording
from fcl_sim.judge.finding import Finding
from fcl_sim.judge.temporal.formula import Formula
from fcl_sim.judge.temporal.tree import signals
from fcl_sim.judge.temporal.verdict import Judgement, Truth
from fcl_sim.judge.temporal.verdict import consider as judged
from fcl_sim.judge.temporal.write import written
from fcl_sim.judge.verdict import Status
from fcl_sim.loop.trace import Trace

MARGIN = "by a margin of {}, that of"
"""How a sentence tells the margin of the comparison that decides."""

TOLD = re.compile(MARGIN.format(r"(\S+(?: [^\s,]+)?)"))


def consider(trace: Trace, formula: Formula) -> Finding:
    """Return what a trace came to; its value is the robustness, where that has one unit."""
    if not trace.ticks.size:
        return Finding(status=Status.INCONCLUSIVE, reason="the trace has no scan")
    found = judged(formula, trace)
    match found.truth:
        case Truth.BROKEN:
            at = _at(trace, found.scan)
            reason = f"a number in `{found.about}` is not finite at {at}"
            return Finding(status=Status.FAULT, reason=reason)
        case Truth.OPEN:
            reason = f"the trace ends at {_at(trace, -1)}, before it is decided whether the formula holds"
            return Finding(status=Status.INCONCLUSIVE, reason=reason)
        case Truth.UNTESTED:
            reason = (
                f"`{found.about}` is never true where the formula looks at it, so nothing is put to the test"
            )
            return Finding(status=Status.UNTESTED, reason=reason)
    value = None if formula.unit is None else found.robustness
    if found.truth is Truth.HOLDS:
        return Finding(status=Status.PASS, reason=f"the formula holds{_margin(trace, found)}", value=value)
    return Finding(
        status=Status.FAIL,
        reason=f"the formula does not hold{_margin(trace, found)}{_first(trace, found)}",
        value=value,
        violation=_violation(trace, found),
        blamed=found.blamed,
    )


def _margin(trace: Trace, found: Judgement) -> str:
    """Return the margin with what decides it, or, where that is not to blame, what is."""
    if found.robustness is None or found.decided_by is None:
        return ""
    comparison, scan = found.decided_by
    if found.blamed and set(found.blamed).isdisjoint(signals(comparison)):
        return f" for {' and '.join(found.blamed)}"
    margin = wording.number(found.robustness, wording.apart(comparison.unit), 0.0)
    return f", {MARGIN.format(margin)} `{written(comparison)}` at {_at(trace, scan)}"


def margin_told(reason: str) -> str:
    """Return the margin that the sentence of a finding tells, with its unit, or nothing.

    A formula over several units has no robustness in one, but the comparison that decides has.
    """
    found = TOLD.search(reason)
    return "" if found is None else found[1]


def _first(trace: Trace, found: Judgement) -> str:
    if found.violation is None:
        return ""
    first, last = found.violation
    if first == last:
        return f", first violated at {_at(trace, first)}"
    return f", first violated from {_at(trace, first)} to {_at(trace, last)}"


def _violation(trace: Trace, found: Judgement) -> tuple[float, float] | None:
    if found.violation is None:
        return None
    first, last = found.violation
    return int(trace.ticks[first]) / 1e9, int(trace.ticks[last]) / 1e9


def _at(trace: Trace, scan: int) -> str:
    return wording.seconds(int(trace.ticks[scan]) / 1e9)

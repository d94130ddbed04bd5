"""Trace and requirements → verdicts."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from fcl_sim.diagnostics import Diagnostic, InputFault, Place, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.judge import corridor as corridors
from fcl_sim.judge import wording
from fcl_sim.judge.finding import Finding
from fcl_sim.judge.formulae import consider
from fcl_sim.judge.measure import measure
from fcl_sim.judge.metric import Limits
from fcl_sim.judge.metrics import METRICS
from fcl_sim.judge.relative import compare
from fcl_sim.judge.verdict import Band, Requirement, Status, Verdict
from fcl_sim.loop.trace import Trace

NO_RUNS: Mapping[str, Trace] = MappingProxyType({})


def judge(
    trace: Trace, requirements: Sequence[Requirement], runs: Mapping[str, Trace] = NO_RUNS
) -> tuple[Verdict, ...]:
    """Return the verdict on each requirement, in their order.

    `runs` are the traces of the runs by variant, for requirements that are
    relative to one of them. The metric and the signals of every requirement must exist: a signal that
    the trace lacks is an InputFault that names the nearest.
    """
    missing = [(each, name) for each in requirements for name in each.signals if name not in trace]
    if missing:
        raise InputFault(_no_signal(trace, each, name) for each, name in missing)
    return tuple(_judge_one(trace, each, runs) for each in requirements)


def _no_signal(trace: Trace, requirement: Requirement, name: str) -> Diagnostic:
    near = nearest(name, trace.names)
    hint = f"did you mean `{near}`?" if near else f"it has {listed(trace.names)}"
    message = f"{requirement.id} asks for `{name}`, which the trace does not have"
    places = (Place(span=requirement.span),) if requirement.span else ()
    return Diagnostic(code="JDG101", message=message, places=places, hint=hint)


def _judge_one(trace: Trace, requirement: Requirement, runs: Mapping[str, Trace]) -> Verdict:
    found = _find(trace, requirement, runs)
    status, reason = after_expectation(found.status, found.reason, requirement)
    return Verdict(
        requirement=requirement,
        status=status,
        measured=found.status,
        value=found.value,
        definition=definition(requirement, trace.units),
        reason=reason,
        band=_band(requirement, found.limits),
        violation=found.violation,
        blamed=found.blamed,
    )


def _find(trace: Trace, requirement: Requirement, runs: Mapping[str, Trace]) -> Finding:
    if trace.fault is not None:
        at = wording.seconds(trace.fault.tick / 1e9)
        return Finding(status=Status.FAULT, reason=f"the run ended at {at}: {trace.fault.reason}")
    if requirement.formula is not None:
        return consider(trace, requirement.formula)
    if requirement.corridor is not None:
        return corridors.consider(trace, requirement.corridor)
    metric, relative = METRICS[requirement.metric], requirement.relative_to
    if relative is not None:
        return compare(trace, runs.get(relative.variant), requirement, metric, relative)
    return measure(trace, requirement, metric)


def definition(requirement: Requirement, units: Mapping[str, str]) -> str:
    """Return what a requirement is judged by, in words; `units` has the unit of its signals."""
    if requirement.formula is not None:
        return str(requirement.formula)
    if requirement.corridor is not None:
        return wording.corridor(requirement.corridor)
    unit = units[requirement.signal]
    alone = wording.definition(METRICS[requirement.metric], requirement, unit)
    if requirement.relative_to is None:
        return alone
    return f"{wording.relation(requirement.relative_to)}: {alone}"


def after_expectation(measured: Status, reason: str, requirement: Requirement) -> tuple[Status, str]:
    """Return verdict and sentence: an expected FAIL is a PASS, an unexpected PASS a FAIL."""
    sentence = wording.as_sentence(reason, requirement)
    if not requirement.expect_fail:
        return measured, sentence
    if measured is Status.FAIL:
        return Status.PASS, f"{sentence} This miss is expected."
    if measured is Status.PASS:
        return Status.FAIL, f"{sentence} A miss was expected: the expectation no longer holds."
    return measured, f"{sentence} That is not the expected miss."


def _band(requirement: Requirement, limits: Limits | None) -> Band | None:
    if limits is None:
        return None
    return Band(
        signal=requirement.signal, low=limits.low, high=limits.high, start=limits.start, end=limits.end
    )

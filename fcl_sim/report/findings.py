"""Verdicts that are not green as findings: what is missed, where that is asked, by how much."""

import shlex
from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType

from fcl_sim.diagnostics import Diagnostic, Place
from fcl_sim.judge.envelope import EnvelopeVerdict
from fcl_sim.judge.verdict import Requirement, Status, Verdict
from fcl_sim.report import baselines
from fcl_sim.report.words import figure, value
from fcl_sim.scenario.document import shown
from fcl_sim.scenario.model import Scenario
from fcl_sim.testbench import Outcome, Run

CODES: Mapping[Status, str] = MappingProxyType(
    {
        Status.FAULT: "JDG401",
        Status.FAIL: "JDG402",
        Status.INCONCLUSIVE: "JDG403",
        Status.UNTESTED: "JDG404",
    }
)
NOTHING_ASKED, NO_BASELINE, CHANGED = "JDG405", "JDG406", "JDG407"


def findings(outcomes: Sequence[Outcome]) -> Iterator[Diagnostic]:
    """Yield a finding for everything that keeps the outcomes from being green, in their order."""
    for outcome in outcomes:
        for run in outcome.variants.values():
            if not run.verdicts and run.compared is None and run.envelope is None:
                yield nothing_asked(outcome.scenario, run.variant)
            for verdict in run.verdicts:
                if verdict.status is not Status.PASS:
                    yield of_verdict(verdict, run.variant, outcome.scenario)
            for over in run.envelope.verdicts if run.envelope else ():
                if over.status is not Status.PASS:
                    yield of_envelope(over, run.variant, outcome.scenario)
            if run.compared and run.compared.status is not Status.PASS:
                yield of_baseline(run, outcome.scenario)


def of_verdict(verdict: Verdict, variant: str, scenario: Scenario) -> Diagnostic:
    """Return the finding of a verdict other than PASS.

    It stands where the requirement has its id; further places are where its
    bounds, its formula or its corridor are written.
    """
    told = f"is {verdict.status} in the run `{variant}`: {verdict.reason}"
    measured = "" if verdict.value is None else value(verdict)
    return _of_requirement(CODES[verdict.status], verdict.requirement, told, measured, scenario)


def of_envelope(verdict: EnvelopeVerdict, variant: str, scenario: Scenario) -> Diagnostic:
    """Return the finding of a verdict over an envelope, at the same places."""
    told = f"is {verdict.status} over the envelope of the run `{variant}`: {verdict.reason}"
    measured = "" if verdict.value is None else figure(verdict.requirement, verdict.value)
    return _of_requirement(CODES[verdict.status], verdict.requirement, told, measured, scenario)


def _of_requirement(
    code: str, asked: Requirement, told: str, measured: str, scenario: Scenario
) -> Diagnostic:
    label = f"measured {measured}" if measured else "asked here"
    first = Place(span=asked.span) if asked.span else Place(file=name_of(scenario))
    return Diagnostic(
        code=code,
        message=f"{asked.id} {told}",
        places=(first, *(Place(span=each, label=label) for each in asked.asked)),
    )


def of_baseline(run: Run, scenario: Scenario) -> Diagnostic:
    """Return the finding of a run that leaves its baseline, or has none.

    It stands where the requirements have their ids whose figures changed, else at the scenario's file.
    """
    accepted = run.compared.baseline if run.compared else None
    hint = f'if that is meant: fcl-sim baseline update {shlex.quote(shown(scenario.path))} --reason "..."'
    whole = Place(file=name_of(scenario))
    if run.compared is None or accepted is None:
        message = f"the run `{run.variant}` has NO BASELINE"
        return Diagnostic(code=NO_BASELINE, message=message, places=(whole,), hint=hint)
    changed = {each.id for each in run.compared.changed_metrics}
    asked = [each.requirement for each in run.verdicts if each.requirement.id in changed]
    first, *others = baselines.lines(run)
    more = f"; and {len(others)} more" if others else ""
    return Diagnostic(
        code=CHANGED,
        message=f"the run `{run.variant}` leaves its baseline of {accepted.date}: {first}{more}",
        places=tuple(Place(span=each.span) for each in asked if each.span) or (whole,),
        hint=hint,
    )


def nothing_asked(scenario: Scenario, variant: str) -> Diagnostic:
    """Return the finding of a run without a requirement."""
    return Diagnostic(
        code=NOTHING_ASKED,
        message=f"nothing is required of the run `{variant}`",
        places=(Place(file=name_of(scenario)),),
        hint="write a [[require]]",
    )


def name_of(scenario: Scenario) -> str:
    """Return the scenario's file, as the user calls it."""
    return scenario.files[0].name

"""The verdicts of a run as data: rows of a table, and a sentence."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from fcl_sim.judge.verdict import Status, Verdict, worst
from fcl_sim.report.words import bound, counted, ending, expectation, value
from fcl_sim.testbench import Outcome, Run


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """One verdict as a table shows it; `note` says how an expected miss came out."""

    scenario: str
    variant: str
    id: str
    text: str
    bound: str
    value: str
    status: Status
    note: str


def rows(outcomes: Sequence[Outcome]) -> Iterator[Row]:
    """Yield the verdicts of all runs, in the order of scenarios, variants and requirements."""
    for outcome in outcomes:
        for run in outcome.variants.values():
            yield from rows_of(outcome.scenario.name, run.variant, run.verdicts)


def rows_of(scenario: str, variant: str, verdicts: Sequence[Verdict]) -> Iterator[Row]:
    """Yield the verdicts of one run."""
    for verdict in verdicts:
        yield Row(
            scenario=scenario,
            variant=variant,
            id=verdict.requirement.id,
            text=verdict.requirement.text,
            bound=bound(verdict.requirement),
            value=value(verdict),
            status=verdict.status,
            note=expectation(verdict),
        )


def endings(outcomes: Sequence[Outcome]) -> Iterator[str]:
    """Yield a sentence for each run that ended early: which, when, at what signal, why."""
    for outcome in outcomes:
        for run in outcome.variants.values():
            if run.trace.fault is not None:
                yield f"{outcome.scenario.name} {run.variant}: {ending(run.trace.fault)}."


def overall(outcomes: Sequence[Outcome]) -> Status:
    """Return the gravest verdict; UNTESTED where nothing was run."""
    return worst([outcome.verdict for outcome in outcomes])


def sentence(outcomes: Sequence[Outcome]) -> str:
    """Return what was judged and how it came out, as a reader says it."""
    runs = [run for outcome in outcomes for run in outcome.variants.values()]
    verdicts = [verdict for run in runs for verdict in run.verdicts]
    if not runs:
        return "Nothing was run."
    parts = [counted(len(outcomes), "scenario"), counted(len(runs), "run"), counted(len(verdicts), "verdict")]
    return sentence_of(", ".join(parts), verdicts)


def sentence_of(judged: str, verdicts: Sequence[Verdict]) -> str:
    """Return how what was judged came out."""
    if not verdicts:
        return f"{judged}: nothing was asked of them."
    return f"{judged}: {tally(verdicts)}.{_misses(verdicts)}"


def tally(verdicts: Sequence[Verdict]) -> str:
    """Return verdicts counted, the gravest first: `1 FAIL, 12 PASS`."""
    statuses = [verdict.status for verdict in verdicts]
    return (
        ", ".join(f"{statuses.count(each)} {each}" for each in Status if each in statuses)
        or "no requirements"
    )


def run_tally(run: Run) -> str:
    """Return how many of a run's requirements came out as they should."""
    good = sum(verdict.status is Status.PASS for verdict in run.verdicts)
    if not run.verdicts:
        return "none"
    missed = sum(expected_miss(verdict) for verdict in run.verdicts)
    return f"{good} of {len(run.verdicts)}" + (
        f", {counted(missed, 'expected miss', 'expected misses')}" if missed else ""
    )


def expected_miss(verdict: Verdict) -> bool:
    """Return whether a requirement is missed, as it is expected to be."""
    return verdict.requirement.expect_fail and verdict.status is Status.PASS


def _misses(verdicts: Sequence[Verdict]) -> str:
    missed = sum(expected_miss(verdict) for verdict in verdicts)
    if not missed:
        return ""
    if missed == 1:
        return " One of those that pass is expected to miss its bound, and does."
    return f" Of those that pass, {missed} are expected to miss their bounds, and do."

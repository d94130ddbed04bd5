"""The verdicts of a run as data: rows of a table, and a sentence."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from fcl_sim.envelope.envelope import Envelope
from fcl_sim.judge.envelope import EnvelopeVerdict, without_figure
from fcl_sim.judge.verdict import Over, Status, Verdict, worst
from fcl_sim.report.words import bound, counted, ending, expectation, figure, joined, one_line, value
from fcl_sim.testbench import Outcome, Run

EXPECTED_MISS = "EXPECTED MISS"

MOST_ENVELOPES = 5
"""Envelopes whose numbers of points a sentence lists; of more it tells the least and the largest."""

AnyVerdict = Verdict | EnvelopeVerdict


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """One verdict as a table shows it.

    `shown` is its word for a reader, `note` says how a miss that was expected and
    did not come came out, or why there is no figure.
    """

    scenario: str
    variant: str
    id: str
    text: str
    bound: str
    value: str
    status: Status
    shown: str
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
            shown=shown(verdict),
            note=expectation(verdict) or _why(verdict),
        )


def _why(verdict: Verdict) -> str:
    """Return why there is no figure, where there is none and the verdict is not green."""
    missing = verdict.status is not Status.PASS and verdict.value is None
    return one_line(verdict.reason).partition(";")[0].rstrip(".") if missing else ""


@dataclass(frozen=True, slots=True, kw_only=True)
class RunRow:
    """A run as one line: how many of its requirements, and of its envelope's, came out as they should."""

    scenario: str
    variant: str
    requirements: str
    envelope: str
    status: Status


def run_rows(outcomes: Sequence[Outcome]) -> Iterator[RunRow]:
    """Yield every run, in the order of scenarios and variants."""
    for outcome in outcomes:
        for run in outcome.variants.values():
            over = run.envelope
            yield RunRow(
                scenario=outcome.scenario.name,
                variant=run.variant,
                requirements=counts(run.verdicts),
                envelope="" if over is None else f"{_good(over.verdicts)} at {counted(len(over), 'point')}",
                status=run.verdict,
            )


@dataclass(frozen=True, slots=True, kw_only=True)
class EnvelopeRow:
    """One verdict over an envelope as a table shows it.

    `passed` says at how many points it came out as it should, or what the mean is;
    `worst` the figure that decides and where it lies, empty where there is none.
    """

    scenario: str
    variant: str
    points: int
    id: str
    text: str
    bound: str
    passed: str
    worst: str
    status: Status
    shown: str


def envelope_rows(outcomes: Sequence[Outcome]) -> Iterator[EnvelopeRow]:
    """Yield the verdicts over all envelopes, in the order of scenarios, variants and requirements."""
    for outcome in outcomes:
        for run in outcome.variants.values():
            if run.envelope is not None:
                yield from _over(outcome.scenario.name, run.variant, run.envelope)


def _over(scenario: str, variant: str, envelope: Envelope) -> Iterator[EnvelopeRow]:
    for verdict in envelope.verdicts:
        asked = verdict.requirement
        yield EnvelopeRow(
            scenario=scenario,
            variant=variant,
            points=len(envelope),
            id=asked.id,
            text=asked.text,
            bound=envelope_bound(verdict),
            passed=passed(verdict),
            worst=""
            if verdict.worst is None
            else f"{at_worst(verdict)} at {envelope.grid.told(verdict.worst)}",
            status=verdict.status,
            shown=shown(verdict),
        )


def envelope_bound(verdict: EnvelopeVerdict) -> str:
    """Return what a requirement asks over an envelope: its bound, and at how many points."""
    asked = bound(verdict.requirement)
    if verdict.requirement.over is Over.MEAN:
        return f"mean {asked}"
    meant = ["to be missed"] if verdict.requirement.expect_fail else []
    least = [f"at {verdict.needed} of {verdict.points} or more"] if verdict.needed < verdict.points else []
    return ", ".join([asked, " ".join([*meant, *least])] if meant or least else [asked])


def passed(verdict: EnvelopeVerdict) -> str:
    """Return at how many points a requirement came out as it should; of a mean, the mean."""
    if verdict.requirement.over is Over.MEAN:
        if verdict.value is None:
            return f"no mean: {verdict.passed} of {verdict.points} have a figure"
        return f"mean {figure(verdict.requirement, verdict.value)}"
    count = f"{verdict.passed} of {verdict.points}"
    return f"{count} miss it" if verdict.requirement.expect_fail else count


def at_worst(verdict: EnvelopeVerdict) -> str:
    """Return the figure at the worst point, or what came of it there."""
    if verdict.worst is None:
        return ""
    there = float(verdict.values[verdict.worst])
    if not math.isnan(there):
        return figure(verdict.requirement, there)
    return without_figure(verdict.requirement, verdict.statuses[verdict.worst])


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
    verdicts = [verdict for run in runs for verdict in verdicts_of(run)]
    if not runs:
        return "Nothing was run."
    parts = [counted(len(outcomes), "scenario"), counted(len(runs), "run")]
    points = [len(run.envelope) for run in runs if run.envelope is not None]
    if points:
        sizes = [str(each) for each in points]
        if len(points) > MOST_ENVELOPES:
            sizes = [f"{min(points)} to {max(points)}"]
        parts.append(f"{counted(len(points), 'envelope')} of {joined(sizes)} points")
    return sentence_of(", ".join([*parts, counted(len(verdicts), "verdict")]), verdicts)


def verdicts_of(run: Run) -> list[AnyVerdict]:
    """Return the verdicts on a run, then those over its envelope."""
    return [*run.verdicts, *(run.envelope.verdicts if run.envelope is not None else ())]


def sentence_of_runs(runs: Sequence[Run]) -> str:
    """Return how what was judged of the runs of a scenario came out."""
    verdicts = [verdict for run in runs for verdict in verdicts_of(run)]
    return sentence_of(counted(len(runs), "run"), verdicts)


def sentence_of(judged: str, verdicts: Sequence[AnyVerdict]) -> str:
    """Return how what was judged came out."""
    if not verdicts:
        return f"{judged}: nothing was asked of them."
    return f"{judged}: {tally(verdicts)}.{_misses(verdicts)}"


def tally(verdicts: Sequence[AnyVerdict]) -> str:
    """Return verdicts counted, the gravest first: `1 FAIL, 12 PASS`."""
    statuses = [verdict.status for verdict in verdicts]
    return (
        ", ".join(f"{statuses.count(each)} {each}" for each in Status if each in statuses)
        or "no requirements"
    )


def run_tally(run: Run) -> str:
    """Return how many of a run's requirements came out as they should."""
    return counts(verdicts_of(run))


def shortcomings(run: Run) -> str:
    """Return why a run is not green: what it misses or leaves open, by ids, and how it keeps its baseline."""
    told = []
    for status, words in OPEN.items():
        alone = [each.requirement.id for each in run.verdicts if each.status is status]
        over = run.envelope.verdicts if run.envelope is not None else ()
        ids = [*alone, *(each.requirement.id for each in over if each.status is status)]
        if ids:
            told.append(words.format(joined([one_line(each) for each in dict.fromkeys(ids)])))
    if run.compared is not None and run.compared.status is Status.FAIL:
        told.append("leaves its baseline")
    elif run.compared is not None and run.compared.status is Status.NO_BASELINE:
        told.append("has no baseline" if run.compared.baseline is None else "has no baseline of everything")
    return "; ".join(told)


OPEN: Mapping[Status, str] = MappingProxyType(
    {
        Status.FAIL: "misses {}",
        Status.FAULT: "breaks down before {}",
        Status.INCONCLUSIVE: "leaves {} open",
        Status.UNTESTED: "puts {} to no test",
    }
)
"""How requirements come out that do not pass, in words."""


def counts(verdicts: Sequence[AnyVerdict]) -> str:
    """Return how many verdicts came out as they should, and how many of these are expected misses."""
    if not verdicts:
        return "none"
    missed = sum(expected_miss(verdict) for verdict in verdicts)
    return _good(verdicts) + (f", {counted(missed, 'expected miss', 'expected misses')}" if missed else "")


def _good(verdicts: Sequence[AnyVerdict]) -> str:
    return f"{sum(verdict.status is Status.PASS for verdict in verdicts)} of {len(verdicts)}"


def expected_miss(verdict: AnyVerdict) -> bool:
    """Return whether a requirement is missed, as it is expected to be."""
    return verdict.requirement.expect_fail and verdict.status is Status.PASS


def shown(verdict: AnyVerdict) -> str:
    """Return the verdict as a table shows it: a miss does not look like a success, be it ever so expected."""
    return EXPECTED_MISS if expected_miss(verdict) else str(verdict.status)


def _misses(verdicts: Sequence[AnyVerdict]) -> str:
    missed = sum(expected_miss(verdict) for verdict in verdicts)
    if not missed:
        return ""
    if missed == 1:
        return " One of those that pass is expected to miss its bound, and does."
    return f" Of those that pass, {missed} are expected to miss their bounds, and do."

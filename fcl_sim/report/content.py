"""What the PDF says, as the data that its template lays out: words and order, no layout."""

from collections.abc import Sequence
from dataclasses import asdict
from itertools import groupby
from typing import Any

from fcl_sim import __version__
from fcl_sim.judge.verdict import Requirement, Status, Verdict
from fcl_sim.judge.wording import relation
from fcl_sim.loop.wiring import wire
from fcl_sim.report import activation, baselines, beside, characteristics, pictures, summary
from fcl_sim.report.archive import Stored
from fcl_sim.report.constant_rows import block_rows, plant_rows
from fcl_sim.report.envelopes import envelope_pictures, envelope_rows, envelope_text
from fcl_sim.report.pictures import Picture
from fcl_sim.report.placed import Register, placed
from fcl_sim.report.requirement_matrix import legend, matrix_rows, untested
from fcl_sim.report.rule_bases import rule_base_data, rule_bases
from fcl_sim.report.rules_there import rules_there
from fcl_sim.report.setting import accuracy, milliseconds, setup_of, unlike_base
from fcl_sim.report.sign_off import computed, fact, files, sign_off
from fcl_sim.report.stills import stills_of
from fcl_sim.report.story import story_data
from fcl_sim.report.wiring import pictures as wired
from fcl_sim.report.words import (
    bound,
    counted,
    ending,
    joined,
    metric_name,
    one_line,
    plain,
    together,
    value,
    with_unit,
)
from fcl_sim.testbench import Outcome, Run

Data = dict[str, Any]

MOST_ENTRIES = 60
"""Lines of the contents; where there would be more, they name sections of the first order alone."""

KIND = "Closed-loop test report"

MOST_SUBJECTS = 3
"""Plants that a title names; of more it gives the number of scenarios."""


def report_data(stored: Stored, register: Register) -> Data:
    """Return the report's data; every picture in it goes through `register`."""
    outcomes = stored.outcomes
    status = summary.overall(outcomes)
    return {
        "title": one_line(title_of(outcomes)),
        "kind": KIND,
        "version": __version__,
        "description": f"{status}: {summary.sentence(outcomes)}",
        "keywords": ["fuzzy control", "FCL", "IEC 61131-7"],
        "status": str(status),
        "sentence": sentence(outcomes),
        "footer": f"fcl_sim {__version__}",
        "overview": [_overview(outcome, f"s{index}") for index, outcome in enumerate(outcomes)],
        "signed": sign_off(stored),
        "matrix": {
            "tables": matrix_rows(outcomes),
            "legend": legend(),
            "untested": untested(outcomes),
        },
        "scenarios": [
            _scenario(outcome, f"s{index}", register)
            | {"before": story_data(stored.stories, outcome, outcomes[:index])}
            for index, outcome in enumerate(outcomes)
        ],
        "depth": 2 if sum(len(each.variants) + 3 for each in outcomes) < MOST_ENTRIES else 1,
        "rule_bases": rule_base_data(rule_bases(outcomes), register, stored.covered, stored.proofs),
    }


def title_of(outcomes: Sequence[Outcome]) -> str:
    """Return the scenario's title, or what the scenarios are about."""
    if len(outcomes) == 1:
        return outcomes[0].scenario.title
    plants = [
        run.diagram.plant.model.declaration.title for each in outcomes for run in each.variants.values()
    ]
    subjects = list(dict.fromkeys(plants))
    about = joined(subjects) if 0 < len(subjects) <= MOST_SUBJECTS else counted(len(outcomes), "scenario")
    return f"{about}: closed-loop tests"


def _overview(outcome: Outcome, anchor: str) -> Data:
    runs = list(outcome.variants.values())
    verdicts = [verdict for run in runs for verdict in summary.verdicts_of(run)]
    return {
        "title": one_line(outcome.scenario.title),
        "anchor": anchor,
        "runs": str(len(runs)),
        "counts": summary.counts(verdicts),
        "status": str(outcome.verdict),
        "open": [
            {
                "label": one_line(run.variant),
                "counts": summary.run_tally(run),
                "why": summary.shortcomings(run),
                "status": str(run.verdict),
            }
            for run in runs
            if run.verdict is not Status.PASS
        ],
    }


def sentence(outcomes: Sequence[Outcome]) -> str:
    """Return how the verdicts came out, and how the runs did beside their baselines, if they have any."""
    return f"{summary.sentence(outcomes)} {baselines.sentence(outcomes)}".rstrip()


def provenance_of(outcomes: Sequence[Outcome]) -> list[Data]:
    """Return what was run: the files with their hashes, scans, arithmetics, versions."""
    rows = []
    for role, group in groupby(files(outcomes), key=lambda each: each["role"]):
        mine = list(group)
        lines = [line for each in mine for line in (each["name"], f"  {each['digest']}")]
        rows.append(fact(f"{role}{'s' if len(mine) > 1 else ''}, SHA-256", *lines, mono=True))
    return [*rows, *computed([run for outcome in outcomes for run in outcome.variants.values()])]


def _scenario(outcome: Outcome, anchor: str, register: Register) -> Data:
    scenario, runs = outcome.scenario, list(outcome.variants.values())
    return {
        "title": one_line(scenario.title),
        "anchor": anchor,
        "status": str(outcome.verdict),
        "sentence": summary.sentence_of_runs(runs),
        "story": paragraphs(scenario.description),
        "facts": facts_of(outcome),
        "requirements": requirement_rows(outcome),
        "plant": plant_rows(outcome.base.diagram.plant, setup_of(outcome, outcome.base)),
        "blocks": block_rows(outcome.base.diagram),
        "sections": _sections(outcome, register),
    }


def _sections(outcome: Outcome, register: Register) -> list[Data]:
    runs = list(outcome.variants.values())
    stills = stills_of(outcome.base)
    spread = [(run, run.envelope) for run in runs if run.envelope is not None]
    parts = [
        ("Loop and plant", "", [*wired(wire(outcome.base.diagram), outcome.scenario.title), *stills]),
        ("All runs", "", pictures.all_runs(outcome)),
    ]
    for run in runs:
        base = None if run is outcome.base else outcome.base
        parts.append((run_title(outcome, run), run_text(outcome, run), pictures.over_time(run, base)))
    users = activation.telling_runs(runs)
    fires = [each for run in users for each in activation.over_time(run)]
    parts.append(("Which rules fire when", FIRST_USERS if len(users) < len(runs) else "", fires))
    shown = _on_characteristic(runs)
    maps = [each for run in shown for each in characteristics.over_inputs(run)]
    others = [one_line(run.variant) for run in runs if run not in shown]
    rest = f" {CHOSEN} {ELSEWHERE}: {joined(others)}." if others else ""
    parts.append(("The runs on the characteristic", CHARACTERISTIC + rest, maps))
    over = [
        _section(
            outcome,
            register,
            f"Envelope of run {run.variant}",
            envelope_text(run, each),
            envelope_pictures(run, each),
        )
        | {"rows": envelope_rows(each)}
        for run, each in spread
    ]
    sections = [_section(outcome, register, *part) for part in parts if part[2]]
    return [*_beside(outcome, register), *over, *sections]


def _on_characteristic(runs: Sequence[Run]) -> list[Run]:
    """Return the first run of each rule base, that which misses most, and all that are undefined anywhere."""
    telling = [*activation.first_users(runs), max(runs, key=_missed)]
    telling += [run for run in runs if any(not each.active.all() for each in run.trace.fuzzy.values())]
    return [run for run in runs if any(run is each for each in telling)]


def _missed(run: Run) -> tuple[int, int]:
    """Return how many requirements a run misses: of those that it is to meet, and of all."""
    meant = sum(each.status is not Status.PASS for each in run.verdicts)
    return meant, sum(each.measured is not Status.PASS for each in run.verdicts)


def _section(
    outcome: Outcome,
    register: Register,
    title: str,
    text: str,
    shown: Sequence[Picture],
    changes: Sequence[beside.Beside] = (),
) -> Data:
    return {
        "title": one_line(title),
        "text": text,
        "rows": [],
        "changes": _by_run(changes),
        "pictures": [placed(each, outcome.scenario.name, register) for each in shown],
    }


def _by_run(changes: Sequence[beside.Beside]) -> list[Data]:
    """Return what changed, run by run."""
    return [
        {
            "run": one_line(run),
            "rows": [{key: one_line(each) for key, each in asdict(row).items()} for row in rows],
        }
        for run, rows in groupby(changes, key=lambda row: row.run)
    ]


def _beside(outcome: Outcome, register: Register) -> list[Data]:
    """Return what is told of an outcome beside its baselines, and beside an older version."""
    found, runs = [], outcome.variants.values()
    rows = list(beside.baseline_rows(outcome))
    if rows:
        causes = list(baselines.cause_texts(runs))
        shown = [each for run in runs for each in beside.baseline_pictures(run)]
        found.append(_section(outcome, register, "Beside the baselines", "\n".join(causes), shown, rows))
    if outcome.against is not None:
        title = f"Against {outcome.against.label}"
        shown = beside.against_pictures(outcome)
        text = "" if shown else "Every signal of every run is what it was."
        found.append(_section(outcome, register, title, text, shown, list(beside.against_rows(outcome))))
    return found


FIRST_USERS = (
    "Drawn is of each rule base the first run that uses it, and each run that misses something unexpectedly. "
    "How often each rule fired in all runs stands with the rule base, under Coverage by the runs."
)
CHOSEN = (
    "Drawn are the first run of each rule base, that which misses most requirements, "
    "and each in which anywhere no rule is active."
)
ELSEWHERE = "In the others a rule is active in every scan; the page for a browser draws them"
CHARACTERISTIC = (
    "What a rule base gives wherever its inputs are, and the way of each run over it, "
    "from the circle to the square, the darker the later; round times are marked. "
    "Where the map is hatched, the way orange or its end an open square, no rule is active."
)


def paragraphs(text: str) -> list[str]:
    """Return the paragraphs of a text, parted by empty lines, each on one line."""
    return [one_line(each) for each in plain(text).split("\n\n") if each.strip()]


def run_title(outcome: Outcome, run: Run) -> str:
    """Return the heading of a run."""
    named = run.title not in {"", run.variant, outcome.scenario.title}
    return f"Run {run.variant}: {run.title}" if named else f"Run {run.variant}"


def run_text(outcome: Outcome, run: Run) -> str:
    """Return what sets a run apart from the base run, what blocks reported, why it ended early if it did."""
    sentences = []
    unlike = [] if run is outcome.base else unlike_base(outcome, run)
    if unlike:
        sentences.append(f"Unlike the base run: {'; '.join(unlike)}.")
    elif run is not outcome.base and run.envelope is not None:
        sentences.append("The same as the base run; its envelope is another.")
    for first, *more in run.trace.events_by_kind:
        times = f"{len(more) + 1} times, first" if more else "once,"
        at = with_unit(first.tick / 1e9, "s", 9)
        sentences.append(f"{one_line(first.block)} reported {first.name} {times} at {at}.")
    fault = run.trace.fault
    if fault is not None:
        sentences.append(f"{ending(fault)}.".replace("`", ""))
    return " ".join(sentences)


def facts_of(outcome: Outcome) -> list[Data]:
    """Return how a scenario is set up: plant, timing, accuracy, envelopes."""
    diagram = outcome.base.diagram
    plant, timing = diagram.plant, diagram.timing
    declared = plant.model.declaration
    rows = [fact("Plant", f"{declared.title} ({declared.name})" if declared.title else declared.name)]
    times = f"{with_unit(timing.duration / 1e9, 's', 9)}, scan {milliseconds(timing.scan)}"
    if timing.latency:
        times += f", latency {milliseconds(timing.latency)}"
    if timing.jitter:
        times += f", jitter up to {milliseconds(timing.jitter)}, seed {timing.seed}"
    rows.append(fact("Duration", times))
    if outcome.scenario.overrides:
        rows.append(
            fact("Overrides", *(f"{key} = {each}" for key, each in outcome.scenario.overrides.items()))
        )
    told = "exact, the plant is linear" if diagram.exact else accuracy(diagram.integration)
    return [*rows, fact("Integration", told), _envelopes(outcome)]


def _envelopes(outcome: Outcome) -> Data:
    """Return at how many points each run was judged besides: a worst case is the worst of these."""
    varied = [run for run in outcome.variants.values() if run.envelope is not None]
    told = [f"{run.variant} at {counted(len(run.envelope), 'point')}" for run in varied if run.envelope]
    return fact("Envelopes", joined(told) if told else "none: each run is judged as it stands")


def requirement_rows(outcome: Outcome) -> list[Data]:
    """Return each requirement once, with the results of all runs that were held to it as it stands.

    They stand in the order of the scenario.
    """
    grouped: dict[tuple[str, str, str, str], list[tuple[Run, Verdict]]] = {}
    for run in outcome.variants.values():
        for verdict in run.verdicts:
            asked = verdict.requirement
            key = (asked.id, asked.text, bound(asked), verdict.definition)
            grouped.setdefault(key, []).append((run, verdict))
    order = [each.id for each in outcome.scenario.requirements]
    places = {key: order.index(key[0]) if key[0] in order else len(order) for key in grouped}
    return [_requirement(grouped[key]) for key in sorted(grouped, key=lambda key: places[key])]


def _requirement(results: Sequence[tuple[Run, Verdict]]) -> Data:
    first = results[0][1]
    told = [_result(run, verdict) for run, verdict in results]
    return {
        "id": one_line(first.requirement.id),
        "text": one_line(first.requirement.text),
        "signal": joined([one_line(each) for each in first.requirement.signals]),
        "metric": _metric_name(first.requirement),
        "bound": bound(first.requirement),
        "definition": one_line(first.definition),
        "results": told,
    }


def _metric_name(requirement: Requirement) -> str:
    if requirement.formula is not None:
        return "robustness"
    if requirement.corridor is not None:
        return "corridor"
    name = one_line(metric_name(requirement.metric))
    if requirement.relative_to is None:
        return name
    return f"{name} ({one_line(relation(requirement.relative_to))})"


def _result(run: Run, verdict: Verdict) -> Data:
    plainly_met = verdict.status is Status.PASS and not verdict.requirement.expect_fail
    reason = together(one_line(verdict.reason)).removesuffix(" This miss is expected.")
    return {
        "run": one_line(run.variant),
        "value": value(verdict),
        "status": summary.shown(verdict),
        "from": None if verdict.violation is None else verdict.violation[0],
        "note": "" if plainly_met else f"{reason} {rules_there(run, verdict)}".rstrip(),
    }

"""What the PDF says, as the data that its template lays out: words and order, no layout."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from itertools import groupby
from typing import Any

from fcl_sim import __version__
from fcl_sim.judge.verdict import Requirement, Status, Verdict
from fcl_sim.judge.wording import relation
from fcl_sim.loop.diagram import FuzzyNode
from fcl_sim.loop.trace import FuzzyRecord
from fcl_sim.model import Defuzzification, RuleBlock
from fcl_sim.report import baselines, beside, characteristics, pictures, summary
from fcl_sim.report.coverage_matrix import matrix
from fcl_sim.report.envelopes import envelope_pictures, envelope_rows, envelope_text
from fcl_sim.report.pictures import Picture
from fcl_sim.report.proved import Proved
from fcl_sim.report.provenance import InputFile, Origin, fuzzy_nodes, origin_of, rule_base
from fcl_sim.report.requirement_matrix import legend, matrix_rows, untested
from fcl_sim.report.rule_words import conformance, finding_rows
from fcl_sim.report.setting import differences, milliseconds, parameters, starts
from fcl_sim.report.sign_off import computed, fact, files, sign_off
from fcl_sim.report.words import (
    bound,
    counted,
    ending,
    exactly,
    joined,
    number,
    one_line,
    plain,
    value,
    with_unit,
)
from fcl_sim.testbench import Outcome, Run
from fcl_sim.verify.coverage import Coverage

Data = dict[str, Any]

MOST_ENTRIES = 60
"""Lines of the contents; where there would be more, they name sections of the first order alone."""

Register = Callable[[str, Picture], str]
"""Takes the folder and a picture, returns the SVG file's name that will hold it."""

KIND = "Closed-loop test report"

MOST_SUBJECTS = 3
"""Plants that a title names; of more it gives the number of scenarios."""


def report_data(
    outcomes: Sequence[Outcome],
    register: Register,
    covered: Sequence[Coverage] = (),
    proofs: Sequence[Proved] = (),
    origin: Origin | None = None,
) -> Data:
    """Return the report's data; every picture in it goes through `register`.

    `covered` is how far the runs have exercised the rule bases, `proofs` what
    is proved of these; `origin` says where all of it comes from.
    """
    status = summary.overall(outcomes)
    return {
        "title": one_line(title_of(outcomes)),
        "kind": KIND,
        "version": __version__,
        "description": f"{status}: {summary.sentence(outcomes)}",
        "keywords": ["fuzzy control", "FCL", "IEC 61131-7"],
        "status": str(status),
        "sentence": summary.sentence(outcomes),
        "footer": f"fcl_sim {__version__}",
        "overview": [_overview(outcome, f"s{index}") for index, outcome in enumerate(outcomes)],
        "signed": sign_off(outcomes, origin or origin_of(outcomes), covered, proofs),
        "matrix": {
            "tables": matrix_rows(outcomes),
            "legend": legend(),
            "untested": untested(outcomes),
        },
        "scenarios": [_scenario(outcome, f"s{index}", register) for index, outcome in enumerate(outcomes)],
        "depth": 2 if sum(len(each.variants) + 3 for each in outcomes) < MOST_ENTRIES else 1,
        "rule_bases": _rule_bases(rule_bases(outcomes), register, covered, proofs),
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
            {"label": one_line(run.variant), "counts": summary.run_tally(run), "status": str(run.verdict)}
            for run in runs
            if run.verdict is not Status.PASS
        ],
    }


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
        "sentence": f"{counted(len(runs), 'run')}: "
        + summary.tally([verdict for run in runs for verdict in summary.verdicts_of(run)])
        + ".",
        "story": paragraphs(scenario.description),
        "facts": facts_of(outcome),
        "requirements": requirement_rows(runs),
        "sections": _sections(outcome, register),
    }


def _sections(outcome: Outcome, register: Register) -> list[Data]:
    runs = list(outcome.variants.values())
    spread = [(run, run.envelope) for run in runs if run.envelope is not None]
    parts = [("All runs", "", pictures.all_runs(outcome))]
    parts += [(run_title(outcome, run), run_text(outcome, run), pictures.over_time(run)) for run in runs]
    maps = [each for run in runs for each in characteristics.over_inputs(run)]
    parts.append(("The runs on the characteristic", CHARACTERISTIC, maps))
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
        "changes": [{key: one_line(each) for key, each in asdict(row).items()} for row in changes],
        "pictures": [_picture(each, outcome.scenario.name, register) for each in shown],
    }


def _beside(outcome: Outcome, register: Register) -> list[Data]:
    """Return what is told of an outcome beside its baselines, and beside an older version."""
    found, runs = [], outcome.variants.values()
    rows = list(beside.baseline_rows(outcome))
    if rows:
        causes = [
            f"Run {one_line(run.variant)}: {'; '.join(baselines.cause_lines(run.cause))}"
            for run in runs
            if run.cause is not None
        ]
        shown = [each for run in runs for each in beside.baseline_pictures(run)]
        found.append(_section(outcome, register, "Beside the baselines", "\n".join(causes), shown, rows))
    if outcome.against is not None:
        title = f"Against {outcome.against.label}"
        shown = beside.against_pictures(outcome)
        text = "" if shown else "Every signal of every run is what it was."
        found.append(_section(outcome, register, title, text, shown, list(beside.against_rows(outcome))))
    return found


CHARACTERISTIC = (
    "What a rule base gives for every pair of inputs, and the way of each run over it, "
    "from the circle to the square. Where the map is hatched or the way orange, no rule is active."
)


def paragraphs(text: str) -> list[str]:
    """Return the paragraphs of a text, parted by empty lines, each on one line."""
    return [one_line(each) for each in plain(text).split("\n\n") if each.strip()]


def _picture(picture: Picture, folder: str, register: Register) -> Data:
    return {"file": register(folder, picture), "caption": picture.caption, "alt": picture.alt}


def run_title(outcome: Outcome, run: Run) -> str:
    """Return the heading of a run."""
    named = run.title not in {"", run.variant, outcome.scenario.title}
    return f"Run {run.variant}: {run.title}" if named else f"Run {run.variant}"


def run_text(outcome: Outcome, run: Run) -> str:
    """Return what sets a run apart from the base run, what blocks reported, why it ended early if it did."""
    sentences = []
    unlike = [] if run is outcome.base else differences(outcome.base.diagram, run.diagram)
    if unlike:
        sentences.append(f"Unlike the base run: {'; '.join(unlike)}.")
    for first, *more in run.trace.events_by_kind:
        times = f"{len(more) + 1} times, first" if more else "once,"
        at = with_unit(first.tick / 1e9, "s", 9)
        sentences.append(f"{one_line(first.block)} reported {first.name} {times} at {at}.")
    fault = run.trace.fault
    if fault is not None:
        sentences.append(f"{ending(fault)}.")
    return " ".join(sentences)


def facts_of(outcome: Outcome) -> list[Data]:
    """Return how a scenario is set up: plant, parameters, timing, accuracy."""
    diagram = outcome.base.diagram
    plant, timing, integration = diagram.plant, diagram.timing, diagram.integration
    declared = plant.model.declaration
    rows = [fact("Plant", f"{declared.title} ({declared.name})" if declared.title else declared.name)]
    for label, given in (("Parameters", parameters(plant)), ("Start", starts(plant))):
        if given:
            rows.append(fact(label, ", ".join(f"{name} = {value}" for name, value in given.items())))
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
    accuracy = f"{integration.scheme}, relative tolerance {number(integration.rtol)}"
    rows.append(fact("Integration", "exact, the plant is linear" if diagram.exact else accuracy))
    return rows


def requirement_rows(runs: Sequence[Run]) -> list[Data]:
    """Return each requirement once, with the results of all runs that were held to it as it stands."""
    grouped: dict[tuple[str, str, str, str], list[tuple[Run, Verdict]]] = {}
    for run in runs:
        for verdict in run.verdicts:
            asked = verdict.requirement
            key = (asked.id, asked.text, bound(asked), verdict.definition)
            grouped.setdefault(key, []).append((run, verdict))
    return [_requirement(results) for results in grouped.values()]


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
        "rows": 1 + len(told),
    }


def _metric_name(requirement: Requirement) -> str:
    if requirement.formula is not None:
        return "robustness"
    if requirement.corridor is not None:
        return "corridor"
    name = one_line(requirement.metric.replace("_", " "))
    if requirement.relative_to is None:
        return name
    return f"{name} ({one_line(relation(requirement.relative_to))})"


def _result(run: Run, verdict: Verdict) -> Data:
    plainly_met = verdict.status is Status.PASS and not verdict.requirement.expect_fail
    return {
        "run": one_line(run.variant),
        "value": value(verdict),
        "status": str(verdict.status),
        "expected": summary.expected_miss(verdict),
        "note": "" if plainly_met else one_line(verdict.reason).removesuffix(" This miss is expected."),
    }


@dataclass(frozen=True, slots=True, kw_only=True)
class Base:
    """A rule base: its file, a block that holds it, the runs that use it by label."""

    file: InputFile
    node: FuzzyNode
    records: Mapping[str, FuzzyRecord]


def rule_bases(outcomes: Sequence[Outcome]) -> list[Base]:
    """Return each rule base once, in the order of its first use."""
    found: dict[tuple[str, str], tuple[InputFile, FuzzyNode, dict[str, FuzzyRecord]]] = {}
    for outcome in outcomes:
        for run in outcome.variants.values():
            label = f"{outcome.scenario.name} {run.variant}" if len(outcomes) > 1 else run.variant
            for node in fuzzy_nodes(run):
                file = rule_base(outcome, run, node)
                key = (node.block.function_block.name, file.digest)
                _, _, records = found.setdefault(key, (file, node, {}))
                records[label] = run.trace.fuzzy[node.name]
    return [Base(file=file, node=node, records=records) for file, node, records in found.values()]


def _rule_bases(
    bases: Sequence[Base], register: Register, covered: Sequence[Coverage], proofs: Sequence[Proved]
) -> list[Data]:
    names = [base.node.block.name for base in bases]
    by_file = {(each.name, each.file): each for each in covered}
    proved = {(each.name, each.file): each for each in proofs}
    parts = []
    for index, base in enumerate(bases):
        part = _rule_base(base, f"r{index}", register, namesakes=names.count(base.node.block.name) > 1)
        own = by_file.get((base.node.block.name, base.file.name))
        parts.append(
            part
            | {
                "coverage": None if own is None else matrix(own),
                "findings": finding_rows(proved.get((base.node.block.name, base.file.name))),
            }
        )
    return parts


def _rule_base(base: Base, anchor: str, register: Register, *, namesakes: bool) -> Data:
    block = base.node.block.function_block
    shown = characteristics.memberships(base.node.block, base.node.units, f"{block.name}-terms", base.records)
    rules = sum(len(each.rules) for each in block.rule_blocks)
    operators = [_operators(each) for each in block.rule_blocks]
    where = f" in {one_line(base.file.name)}" if namesakes else ""
    outputs = [f"{each.variable}: {each.method}, {_undefined(each)}" for each in block.defuzzifications]
    return {
        "title": f"Rule base {one_line(block.name)}{where}",
        "anchor": anchor,
        "facts": [
            fact("File", base.file.name, mono=True),
            fact("SHA-256", base.file.digest, mono=True),
            fact("Rules", ", ".join([str(rules), *dict.fromkeys(operators)])),
            fact("Outputs", *outputs),
            fact("Conformance", *conformance(block)),
            fact("Used by", joined(list(base.records))),
        ],
        "pictures": [_picture(each, "rule-bases", register) for each in shown],
        "source": plain(base.file.text).rstrip(),
    }


def _operators(block: RuleBlock) -> str:
    return f"AND {block.and_operator}, OR {block.or_operator}, ACCU {block.accumulation}"


def _undefined(output: Defuzzification) -> str:
    """Return what an output does where no rule is active (S30)."""
    return "NC, no change" if output.default is None else f"DEFAULT {exactly(output.default, '')}"

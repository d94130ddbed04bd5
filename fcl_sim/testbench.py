"""The one sequence: read, bind, wire, run, judge, compare with the baseline."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from time import perf_counter
from types import MappingProxyType
from typing import Any

from fcl_sim.block import Block, load
from fcl_sim.diagnostics import Diagnostic, InputFault
from fcl_sim.envelope.envelope import Envelope
from fcl_sim.envelope.execute import execute
from fcl_sim.envelope.plan import Plan, plan
from fcl_sim.judge.baseline import Baseline, Comparison
from fcl_sim.judge.compare import compare
from fcl_sim.judge.judge import judge
from fcl_sim.judge.verdict import Requirement, Status, Verdict, worst
from fcl_sim.loop.diagram import Diagram, FuzzyNode
from fcl_sim.loop.open import OpenLoop
from fcl_sim.loop.run import run as simulate
from fcl_sim.loop.trace import Trace
from fcl_sim.loop.wiring import wire
from fcl_sim.scenario import baseline_file
from fcl_sim.scenario.bench import bench_of
from fcl_sim.scenario.binder import (
    LoadBlock,
    bind,
    check_inputs,
    plant_of,
    requirements,
    setup_called,
    units_of,
)
from fcl_sim.scenario.document import shown
from fcl_sim.scenario.model import BASE, Scenario
from fcl_sim.scenario.reader import read
from fcl_sim.scenario.references import reference_signals
from fcl_sim.scenario.requirements import Units
from fcl_sim.verify.cause import Cause, cause_of, with_rule_bases
from fcl_sim.verify.cover import LEAST, Visit, cover
from fcl_sim.verify.coverage import Coverage, Item, merged, waived
from fcl_sim.verify.record import Acceptance, record, unfit
from fcl_sim.verify.subject import of_node
from fcl_sim.verify.waivers import Waiver, waivers_of

__all__ = [
    "BASE",
    "Against",
    "OpenLoop",
    "Outcome",
    "Prepared",
    "Run",
    "Update",
    "against_rule_bases",
    "against_scenario",
    "bench_of",
    "coverage",
    "judge_trace",
    "new_baseline",
    "open_loop",
    "prepare",
    "run",
    "run_prepared",
    "run_scenario",
    "run_together",
    "update_baseline",
]


@dataclass(frozen=True, slots=True, kw_only=True)
class Run:
    """One variant of a scenario, run and judged. `seconds` is the time the simulation took.

    `compared` is the run beside its baseline; None where it was not compared,
    as one with overrides is not. `cause` is why it left its baseline, where it did.
    `verdicts` are those on the nominal run, `envelope` has those over the points of
    its grid, where it has one; `verdict` is the gravest of both.
    """

    variant: str
    title: str
    diagram: Diagram
    trace: Trace
    verdicts: tuple[Verdict, ...]
    verdict: Status
    seconds: float
    compared: Comparison | None = None
    cause: Cause | None = None
    envelope: Envelope | None = None

    @property
    def metrics(self) -> Mapping[str, float | None]:
        """Measured value of each requirement, by its id."""
        return {each.requirement.id: each.value for each in self.verdicts}


@dataclass(frozen=True, slots=True, kw_only=True)
class Against:
    """An older version of a scenario: what it is called, and its runs by variant."""

    label: str
    runs: Mapping[str, Run]


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """A scenario with all its variants, run and judged; the base run stands first.

    `against` is the older version beside which it is shown, where one was named.
    """

    scenario: Scenario
    variants: Mapping[str, Run]
    verdict: Status
    against: Against | None = None

    @property
    def base(self) -> Run:
        """The run without a variant."""
        return self.variants[BASE]

    @property
    def trace(self) -> Trace:
        """The base run's trace."""
        return self.base.trace

    @property
    def metrics(self) -> Mapping[str, float | None]:
        """The base run's measured values, by requirement."""
        return self.base.metrics


@dataclass(frozen=True, slots=True, kw_only=True)
class Prepared:
    """A variant that is ready to run: everything that could be wrong with its texts was looked at.

    `baseline` is what it was when somebody last accepted it, `references` the
    signals that a baseline of it is told to keep. Unless `is_compared`, it is
    not held against its baseline.
    """

    variant: str
    title: str
    diagram: Diagram
    requirements: tuple[Requirement, ...]
    baseline: Baseline | None = None
    references: tuple[str, ...] | None = None
    is_compared: bool = False
    envelope: Plan | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Update:
    """The baseline of a run: its file, what it was before, and what it is now."""

    path: Path
    before: Baseline | None
    after: Baseline


def run(path: Path | str, overrides: Mapping[str, Any] | None = None, workers: int | None = None) -> Outcome:
    """Return what comes of a scenario file: every variant simulated and judged, with its envelope.

    `overrides` by dotted key are laid over the file:
    `{"plant.parameters.load_mass": "10 t"}`. InputFault carries every fault of
    the scenario and the files it names, before anything is simulated. An
    envelope is run on `workers` threads, else on one for each processor.
    """
    return run_scenario(read(path, overrides), workers)


def open_loop(
    scenario: Scenario | Path | str, variant: str = BASE, overrides: Mapping[str, Any] | None = None
) -> OpenLoop:
    """Return the loop of a variant before its first scan, to be run scan by scan from Python.

    `overrides` by dotted key are laid over a scenario file that is named, not over
    one that was read. InputFault carries every fault of the scenario.
    """
    found = scenario if isinstance(scenario, Scenario) else read(scenario, overrides)
    setup_called(found, variant)
    return OpenLoop(wire(_prepare(found, variant, load).diagram))


def run_scenario(scenario: Scenario, workers: int | None = None) -> Outcome:
    """Return what comes of a scenario that was read."""
    runs = run_together(prepare(scenario), workers)
    verdict = worst([each.verdict for each in runs.values()])
    return Outcome(scenario=scenario, variants=runs, verdict=verdict)


def run_together(prepared: Sequence[Prepared], workers: int | None = None) -> Mapping[str, Run]:
    """Return what comes of the variants of a scenario by name, each judged beside the others."""
    simulated = {each.variant: (each, *_simulated(each)) for each in prepared}
    traces = {variant: trace for variant, (_, trace, _) in simulated.items()}
    runs = {
        variant: _with_envelope(_judged(*each, traces), each[0].envelope, workers)
        for variant, each in simulated.items()
    }
    return MappingProxyType(runs)


def against_scenario(outcome: Outcome, older: Scenario, label: str) -> Outcome:
    """Return an outcome beside an older version of its scenario, which is run for it."""
    return replace(
        outcome, against=Against(label=label, runs=run_together(prepare(older, is_compared=False)))
    )


def against_rule_bases(outcome: Outcome, blocks: Mapping[str, Block], label: str) -> Outcome:
    """Return an outcome beside its own scenario with other function blocks, by the name of each in FCL.

    It is as it was where its scenario has none of them. InputFault where one
    does not fit the loop.
    """
    others = {name.casefold(): block for name, block in blocks.items()}
    prepared, is_other = [], False
    for each in prepare(outcome.scenario, is_compared=False):
        changed = {
            node.name: others[node.block.name.casefold()]
            for node in each.diagram.nodes
            if isinstance(node, FuzzyNode) and node.block.name.casefold() in others
        }
        is_other = is_other or bool(changed)
        diagram = with_rule_bases(each.diagram, changed)
        wire(diagram)
        prepared.append(replace(each, diagram=diagram))
    if not is_other:
        return outcome
    return replace(outcome, against=Against(label=label, runs=run_together(prepared)))


def prepare(scenario: Scenario, *, is_compared: bool = True) -> tuple[Prepared, ...]:
    """Return every variant, bound and wired; InputFault with the faults of all, each once.

    They come with their baselines, unless they are not to be compared with
    them; overrides make other runs of them, which no baseline is of.
    """
    is_compared = is_compared and not scenario.overrides
    prepared, faults = [], dict[Diagnostic, None]()
    load_once = cache(load)
    for variant in scenario.variants:
        try:
            found = _prepare(scenario, variant, load_once)
            kept = baseline_file.read(scenario.path, variant) if is_compared else None
            prepared.append(replace(found, baseline=kept, is_compared=is_compared))
        except InputFault as fault:
            faults.update(dict.fromkeys(fault.diagnostics))
    if faults:
        raise InputFault(faults)
    return tuple(prepared)


def _prepare(scenario: Scenario, variant: str, load_block: LoadBlock) -> Prepared:
    setup = scenario.variants[variant]
    diagram = bind(scenario, variant, load_block)
    units = units_of(wire(diagram))
    check_inputs(setup, units)
    return Prepared(
        variant=variant,
        title=setup.title,
        diagram=diagram,
        requirements=requirements(scenario, variant, units),
        references=reference_signals(scenario, variant, units.signals),
        envelope=plan(scenario, setup, load_block) if setup.vary else None,
    )


def judge_trace(trace: Trace, scenario: Scenario, variant: str = BASE) -> tuple[Verdict, ...]:
    """Return what comes of a recorded trace by the requirements on a run; nothing is simulated.

    Parameters of the plant that it does not tell are those of the scenario.
    InputFault where the trace lacks a signal that is asked for, or has it in a
    unit that does not fit.
    """
    units = Units(trace.units)
    plant = plant_of(scenario, variant) if _lacks(trace, scenario) else None
    if plant is not None:
        trace = replace(trace, constants={**plant.constants, **trace.constants})
        units = Units(trace.units, plant.constant_units)
    return judge(trace, requirements(scenario, variant, units))


def _lacks(trace: Trace, scenario: Scenario) -> bool:
    return any(name not in trace for each in scenario.requirements for name in each.names)


def run_prepared(prepared: Prepared) -> Run:
    """Return what comes of one variant alone: simulated, judged; nothing is held against other runs."""
    return _judged(prepared, *_simulated(prepared), {})


def _with_envelope(run: Run, planned: Plan | None, workers: int | None) -> Run:
    if planned is None:
        return run
    envelope = execute(planned, workers)
    judged = (*run.verdicts, *envelope.verdicts, *((run.compared,) if run.compared else ()))
    return replace(run, envelope=envelope, verdict=worst([each.status for each in judged]))


def _simulated(prepared: Prepared) -> tuple[Trace, float]:
    begun = perf_counter()
    trace = simulate(prepared.diagram)
    return trace, perf_counter() - begun


def _judged(prepared: Prepared, trace: Trace, seconds: float, runs: Mapping[str, Trace]) -> Run:
    verdicts = judge(trace, prepared.requirements, runs)
    statuses = [each.status for each in verdicts]
    compared = cause = None
    if prepared.is_compared:
        compared = compare(trace, verdicts, prepared.baseline, prepared.references or ())
        statuses.append(compared.status)
    if compared is not None and compared.baseline is not None and compared.status is Status.FAIL:
        cause = cause_of(prepared.diagram, trace, compared.baseline, prepared.requirements, runs)
    return Run(
        variant=prepared.variant,
        title=prepared.title,
        diagram=prepared.diagram,
        trace=trace,
        verdicts=verdicts,
        verdict=worst(statuses),
        seconds=seconds,
        compared=compared,
        cause=cause,
    )


def update_baseline(outcome: Outcome, variant: str, *, reason: str, date: str) -> Update:
    """Write what `new_baseline` returns."""
    made = new_baseline(outcome, variant, reason=reason, date=date)
    baseline_file.write(made.after, made.path)
    return made


def new_baseline(outcome: Outcome, variant: str, *, reason: str, date: str) -> Update:
    """Return the baseline of a run as it came out beside the former one; nothing is written.

    `date` is the day, as 2026-01-31. Tolerances of the former baseline are
    kept. InputFault where the scenario was run with overrides, where the run
    ended in a fault, or where a signal that is kept is not finite.
    """
    scenario, run = outcome.scenario, outcome.variants[variant]
    _acceptable(scenario, run)
    path = baseline_file.path_of(scenario.path, variant)
    before = baseline_file.read(scenario.path, variant)
    after = record(
        Acceptance(scenario=scenario.name, variant=variant, date=date, reason=reason),
        run.diagram,
        run.trace,
        run.verdicts,
        signals=reference_signals(scenario, variant, run.trace.units),
        former=before,
    )
    return Update(path=path, before=before, after=after)


def _acceptable(scenario: Scenario, run: Run) -> None:
    """Raise InputFault where a run is nothing to hold others against."""
    file, name = str(scenario.path), f"the run `{run.variant}`"
    told = unfit(run.trace, reference_signals(scenario, run.variant, run.trace.units) or run.trace.names)
    if scenario.overrides:
        hint = "write what differs as a variant, which has a baseline of its own"
        raise InputFault.at_file("RUN108", file, f"{name} has overrides, and a baseline is of none", hint)
    if told:
        raise InputFault.at_file("RUN108", file, f"{name}: {told}", "mend the run before it is accepted")


def coverage(outcomes: Iterable[Outcome], least: float = LEAST) -> tuple[Coverage, ...]:
    """Return how far runs have exercised each rule base, with its waivers, in the order of their first use.

    `least` is the part of an output's range by which a decisive rule changes
    it. InputFault with every fault of the files of waivers.
    """
    parts: dict[tuple[Path, str], list[Coverage]] = {}
    benches: dict[Path, Path] = {}
    for outcome in outcomes:
        for run in outcome.variants.values():
            for node in [each for each in run.diagram.nodes if isinstance(each, FuzzyNode)]:
                file = outcome.scenario.variants[run.variant].rule_bases[node.name]
                benches.setdefault(file, outcome.scenario.bench)
                label = f"{outcome.scenario.name}/{run.variant}"
                visit = Visit(run=label, ticks=run.trace.ticks, record=run.trace.fuzzy[node.name])
                found = cover(of_node(node), visit, least, shown(file))
                parts.setdefault((file, found.name), []).append(found)
    faults: dict[Diagnostic, None] = {}
    waivers: dict[Path, tuple[Waiver, ...]] = {}
    for file, bench in benches.items():
        try:
            waivers[file] = waivers_of(file, bench, [*Item])
        except InputFault as fault:
            faults.update(dict.fromkeys(fault.diagnostics))
    if faults:
        raise InputFault(faults)
    return tuple(waived(merged(own), waivers[file]) for (file, _), own in parts.items())

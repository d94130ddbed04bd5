"""Run, judge, compare with the baseline."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from threading import Event
from time import perf_counter
from types import MappingProxyType
from typing import Any

from fcl_sim.block import Block
from fcl_sim.envelope.execute import execute
from fcl_sim.envelope.plan import Plan
from fcl_sim.judge.compare import compare
from fcl_sim.judge.judge import judge
from fcl_sim.judge.verdict import Status, Verdict, worst
from fcl_sim.loop.diagram import FuzzyNode
from fcl_sim.loop.run import run as simulate
from fcl_sim.loop.trace import Trace
from fcl_sim.loop.wiring import wire
from fcl_sim.scenario.asked_runs import asked_of
from fcl_sim.scenario.binder import plant_of, requirements
from fcl_sim.scenario.model import BASE, Scenario
from fcl_sim.scenario.reader import read
from fcl_sim.scenario.requirements import Units
from fcl_sim.testbench.outcome import Against, Outcome, Prepared, Run
from fcl_sim.testbench.preparing import prepare
from fcl_sim.verify.cause import cause_of, with_rule_bases


def run(path: Path | str, overrides: Mapping[str, Any] | None = None, workers: int | None = None) -> Outcome:
    """Return what comes of a scenario file: every variant simulated and judged, with its envelope.

    `overrides` by dotted key are laid over the file:
    `{"plant.parameters.load_mass": "10 t"}`. InputFault carries every fault of
    the scenario and the files it names, before anything is simulated. An
    envelope is run on `workers` threads, else on one for each processor.
    """
    return run_scenario(read(path, overrides), workers)


def run_scenario(scenario: Scenario, workers: int | None = None) -> Outcome:
    """Return what comes of a scenario that was read."""
    return outcome_of(scenario, run_together(prepare(scenario), workers))


def outcome_of(scenario: Scenario, runs: Mapping[str, Run]) -> Outcome:
    """Return what comes of a scenario, of all its runs."""
    verdict = worst([each.verdict for each in runs.values()])
    return Outcome(scenario=scenario, variants=runs, verdict=verdict)


def run_together(
    prepared: Sequence[Prepared], workers: int | None = None, halt: Event | None = None
) -> Mapping[str, Run]:
    """Return what comes of the variants of a scenario by name, each judged beside the others.

    Halted soon after another thread sets `halt`.
    """
    simulated = {each.variant: (each, *_simulated(each, halt)) for each in prepared}
    traces = {variant: trace for variant, (_, trace, _) in simulated.items()}
    runs = {
        variant: _with_envelope(_judged(*each, traces), each[0].envelope, workers, halt)
        for variant, each in simulated.items()
    }
    return MappingProxyType(runs)


def run_prepared(prepared: Prepared) -> Run:
    """Return what comes of one variant alone: simulated, judged; nothing is held against other runs."""
    return _judged(prepared, *_simulated(prepared), {})


def _with_envelope(run: Run, planned: Plan | None, workers: int | None, halt: Event | None) -> Run:
    if planned is None:
        return run
    envelope = execute(planned, workers, halt)
    judged = (*run.verdicts, *envelope.verdicts, *((run.compared,) if run.compared else ()))
    return replace(run, envelope=envelope, verdict=worst([each.status for each in judged]))


def _simulated(prepared: Prepared, halt: Event | None = None) -> tuple[Trace, float]:
    begun = perf_counter()
    trace = simulate(prepared.diagram, halt)
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


def judge_trace(trace: Trace, scenario: Scenario, variant: str = BASE) -> tuple[Verdict, ...]:
    """Return what comes of a recorded trace by the requirements on a run; nothing is simulated.

    Parameters of the plant that it does not tell are those of the scenario.
    InputFault where the trace lacks a signal that is asked for, or has it in a
    unit that does not fit.
    """
    units = Units(trace.units)
    plant = plant_of(scenario, variant) if _lacks(trace, scenario, variant) else None
    if plant is not None:
        trace = replace(trace, constants={**plant.constants, **trace.constants})
        units = Units(trace.units, plant.constant_units)
    return judge(trace, requirements(scenario, variant, units))


def _lacks(trace: Trace, scenario: Scenario, variant: str) -> bool:
    return any(name not in trace for each in asked_of(scenario.requirements, variant) for name in each.names)

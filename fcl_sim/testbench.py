"""The one sequence: read, bind, wire, run, judge."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from time import perf_counter
from types import MappingProxyType
from typing import Any

from fcl_sim.block import load
from fcl_sim.diagnostics import Diagnostic, InputFault
from fcl_sim.judge.judge import judge
from fcl_sim.judge.verdict import Requirement, Status, Verdict, worst
from fcl_sim.loop.diagram import Diagram
from fcl_sim.loop.open import OpenLoop
from fcl_sim.loop.run import run as simulate
from fcl_sim.loop.trace import Trace
from fcl_sim.loop.wiring import wire
from fcl_sim.scenario.bench import bench_of
from fcl_sim.scenario.binder import LoadBlock, bind, check_inputs, requirements, setup_called
from fcl_sim.scenario.model import BASE, Scenario
from fcl_sim.scenario.reader import read

__all__ = [
    "BASE",
    "OpenLoop",
    "Outcome",
    "Prepared",
    "Run",
    "bench_of",
    "judge_trace",
    "open_loop",
    "prepare",
    "run",
    "run_prepared",
    "run_scenario",
]


@dataclass(frozen=True, slots=True, kw_only=True)
class Run:
    """One variant of a scenario, run and judged. `seconds` is the time the simulation took."""

    variant: str
    title: str
    diagram: Diagram
    trace: Trace
    verdicts: tuple[Verdict, ...]
    verdict: Status
    seconds: float

    @property
    def metrics(self) -> Mapping[str, float | None]:
        """Measured value of each requirement, by its id."""
        return {each.requirement.id: each.value for each in self.verdicts}


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """A scenario with all its variants, run and judged; the base run stands first."""

    scenario: Scenario
    variants: Mapping[str, Run]
    verdict: Status

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
    """A variant that is ready to run: everything that could be wrong with its texts was looked at."""

    variant: str
    title: str
    diagram: Diagram
    requirements: tuple[Requirement, ...]


def run(path: Path | str, overrides: Mapping[str, Any] | None = None) -> Outcome:
    """Return what comes of a scenario file: every variant simulated and judged.

    `overrides` by dotted key are laid over the file:
    `{"plant.parameters.load_mass": "10 t"}`. InputFault carries every fault of
    the scenario and the files it names, before anything is simulated.
    """
    return run_scenario(read(path, overrides))


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


def run_scenario(scenario: Scenario) -> Outcome:
    """Return what comes of a scenario that was read."""
    simulated = {each.variant: (each, *_simulated(each)) for each in prepare(scenario)}
    traces = {variant: trace for variant, (_, trace, _) in simulated.items()}
    runs = {variant: _judged(*each, traces) for variant, each in simulated.items()}
    verdict = worst([each.verdict for each in runs.values()])
    return Outcome(scenario=scenario, variants=MappingProxyType(runs), verdict=verdict)


def prepare(scenario: Scenario) -> tuple[Prepared, ...]:
    """Return every variant, bound and wired; InputFault with the faults of all, each once."""
    prepared, faults = [], dict[Diagnostic, None]()
    load_once = cache(load)
    for variant in scenario.variants:
        try:
            prepared.append(_prepare(scenario, variant, load_once))
        except InputFault as fault:
            faults.update(dict.fromkeys(fault.diagnostics))
    if faults:
        raise InputFault(faults)
    return tuple(prepared)


def _prepare(scenario: Scenario, variant: str, load_block: LoadBlock) -> Prepared:
    diagram = bind(scenario, variant, load_block)
    units = {name: unit.symbol for name, unit in wire(diagram).units.items()}
    check_inputs(scenario, variant, units)
    return Prepared(
        variant=variant,
        title=scenario.variants[variant].title,
        diagram=diagram,
        requirements=requirements(scenario, variant, units),
    )


def judge_trace(trace: Trace, scenario: Scenario, variant: str = BASE) -> tuple[Verdict, ...]:
    """Return what comes of a recorded trace by the requirements on a run; nothing is simulated.

    InputFault where the trace lacks a signal that is asked for, or has it in a
    unit that does not fit.
    """
    return judge(trace, requirements(scenario, variant, trace.units))


def run_prepared(prepared: Prepared) -> Run:
    """Return what comes of one variant alone: simulated, judged; nothing is held against other runs."""
    return _judged(prepared, *_simulated(prepared), {})


def _simulated(prepared: Prepared) -> tuple[Trace, float]:
    begun = perf_counter()
    trace = simulate(prepared.diagram)
    return trace, perf_counter() - begun


def _judged(prepared: Prepared, trace: Trace, seconds: float, runs: Mapping[str, Trace]) -> Run:
    verdicts = judge(trace, prepared.requirements, runs)
    return Run(
        variant=prepared.variant,
        title=prepared.title,
        diagram=prepared.diagram,
        trace=trace,
        verdicts=verdicts,
        verdict=worst([each.status for each in verdicts]),
        seconds=seconds,
    )

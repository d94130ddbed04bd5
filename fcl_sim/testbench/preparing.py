"""Read, bind, wire: everything that can be wrong with the texts is found before anything is simulated."""

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

from fcl_sim.block import load
from fcl_sim.diagnostics import Diagnostic, InputFault
from fcl_sim.envelope.plan import plan
from fcl_sim.loop.open import OpenLoop
from fcl_sim.loop.wiring import wire
from fcl_sim.scenario import baseline_file
from fcl_sim.scenario.binder import LoadBlock, bind, check_inputs, requirements, setup_called, units_of
from fcl_sim.scenario.model import BASE, Scenario
from fcl_sim.scenario.reader import read
from fcl_sim.scenario.references import reference_signals
from fcl_sim.testbench.outcome import Prepared


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

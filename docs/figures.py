"""The pictures of the page on reports: those of the shipped crane's report, drawn as they are there."""

from collections.abc import Iterator
from dataclasses import replace

from fcl_sim import testbench
from fcl_sim.judge.verdict import worst
from fcl_sim.plant.catalog import shipped_bench
from fcl_sim.report import activation, characteristics, pictures, telling
from fcl_sim.report.pictures import Picture
from fcl_sim.report.provenance import fuzzy_nodes
from fcl_sim.report.stills import stills_of
from fcl_sim.report.vector import svg
from fcl_sim.scenario.reader import read
from fcl_sim.testbench import Outcome

IMAGES = "images/report"


def images() -> dict[str, str]:
    """Return the figures by their path below docs/."""
    return {f"{IMAGES}/{name}.svg": svg(each.draw(), alone=True).decode() for name, each in _pictures()}


def _pictures() -> Iterator[tuple[str, Picture]]:
    crane, printed = _outcome("transfer"), _outcome("printed")
    base = crane.base
    (node,) = fuzzy_nodes(base)
    yield "stills", stills_of(base)[0]
    yield "all-runs", pictures.all_runs(crane)[0]
    yield "activation", activation.over_time(base)[0]
    yield "way", characteristics.over_inputs(printed.base)[0]
    yield "steps", telling.step_by_step(node, {"base": base.trace.fuzzy[node.name]}, base.trace.time)[0]
    yield "surface", characteristics.characteristic(node.block, node.units, "surface")[0]


def _outcome(name: str) -> Outcome:
    """Return what comes of a scenario of the crane without its envelopes."""
    scenario = read(shipped_bench() / "scenarios" / "crane" / f"{name}.toml")
    prepared = testbench.prepare(scenario, is_compared=False)
    runs = testbench.run_together([replace(each, envelope=None) for each in prepared])
    return Outcome(scenario=scenario, variants=runs, verdict=worst([each.verdict for each in runs.values()]))

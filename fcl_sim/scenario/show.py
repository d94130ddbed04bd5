"""A scenario as text: what was read, each run spelled out or told apart from the base, the requirements."""

from collections.abc import Iterator, Mapping, Sequence
from math import prod
from textwrap import wrap
from typing import Any

from fcl_sim.judge.verdict import Over
from fcl_sim.loop.diagram import Timing
from fcl_sim.loop.schemes import SCHEMES
from fcl_sim.scenario.linear import is_linear, output_names
from fcl_sim.scenario.model import BASE, Entries, RequirementText, Scenario, Setup
from fcl_sim.toml.tree import Entry

WIDTH = 100
DIGEST = 12


def show_scenario(scenario: Scenario) -> str:
    """Return a scenario for a reader: files, runs, requirements; a variant by what differs from the base."""
    return "\n".join(_lines(scenario))


def _lines(scenario: Scenario) -> Iterator[str]:
    yield f"{scenario.name}: {scenario.title}"
    for paragraph in scenario.description.splitlines():
        yield from wrap(paragraph, WIDTH, initial_indent="  ", subsequent_indent="  ")
    yield ""
    yield "files"
    for file in scenario.files:
        yield f"  {file.role}: {file.name} (sha256 {file.digest[:DIGEST]}...)"
    for key, value in scenario.overrides.items():
        yield f"  override: {key} = {value}"
    base = list(_run(scenario.base))
    for name, setup in scenario.variants.items():
        yield ""
        yield f"run {name}: {setup.title}"
        lines = base if name == BASE else [each for each in _run(setup) if each not in base]
        yield from (f"  {each}" for each in lines)
        yield from (f"  {each}" for each in _grid(setup))
    yield ""
    yield "requirements"
    for requirement in scenario.requirements:
        yield from _requirement(requirement, list(scenario.variants))


def _run(setup: Setup) -> Iterator[str]:
    timing, integration = setup.timing, setup.integration
    yield f"duration = {_time(timing.duration)}"
    yield f"scan = {_time(timing.scan)}"
    for name in ("latency", "jitter"):
        if getattr(timing, name):
            yield f"{name} = {_time(getattr(timing, name))}"
    if timing.jitter or timing.overruns.chance:
        yield f"seed = {timing.seed}"
    if timing.measured:
        yield "blocks take the measured cycle time"
    yield from _disturbed(timing)
    controlled = bool(SCHEMES[integration.scheme].error)
    accuracy = f"rtol {integration.rtol:g}" if controlled else f"step {integration.step:g} s"
    plant, linear = setup.plant, is_linear(setup.plant)
    yield "integration exact" if linear else f"integration by {integration.scheme}, {accuracy}"
    yield f"plant {plant.name} = {'' if linear else 'plants/'}{plant.model.value}"
    for name in output_names(plant) if linear else ():
        yield f"{plant.name}.{name} is an output"
    yield from _values(f"{plant.name} unit of ", plant.units)
    yield from _values(f"{plant.name} parameter ", plant.parameters)
    yield from _values(f"{plant.name} starts at ", plant.start)
    yield from _wires(f"{plant.name}.", plant.inputs)
    if setup.controller is not None:
        for name, unit in setup.controller.inputs.items():
            wire = setup.controller.wires[name]
            yield f"controller.{name} [{unit.value or '1'}] <- {wire.value}"
        yield from _wires("controller.", setup.controller.outputs)
    for name, block in setup.blocks.items():
        yield f"{name} = {_block(block)}"


def _grid(setup: Setup) -> Iterator[str]:
    if setup.vary:
        points = prod(len(each.values) for each in setup.vary)
        yield f"envelope of {points} points"
        for axis in setup.vary:
            yield f"  {axis.key}: {', '.join(_inline(each.plain()) for each in axis.values)}"


def _disturbed(timing: Timing) -> Iterator[str]:
    """Yield what keeps the PLC from its scans."""
    overruns = timing.overruns
    for number, length in overruns.listed:
        yield f"scan {number} takes {_time(length)}"
    if overruns.chance:
        yield f"{overruns.chance:.3%} of the scans take up to {_time(overruns.longest)}"
    if overruns.listed or overruns.chance:
        yield f"overruns: {overruns.policy}"
    for each in timing.restarts:
        yield f"{each.kind} restart at {_time(each.at)}" + (f" of {_time(each.lasts)}" if each.lasts else "")


def _values(prefix: str, entries: Entries) -> Iterator[str]:
    for name, entry in entries.items():
        yield f"{prefix}{name} = {_inline(entry.plain())}"


def _wires(prefix: str, entries: Entries) -> Iterator[str]:
    for name, entry in entries.items():
        yield f"{prefix}{name} <- {entry.value}"


def _block(block: Entry) -> str:
    kind = block.table["type"].value
    parts = [f"{key} = {_inline(each.plain())}" for key, each in block.table.items() if key != "type"]
    return f"{kind}({', '.join(parts)})"


def _inline(value: Any) -> str:
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{key} = {_inline(each)}" for key, each in value.items()) + "}"
    if isinstance(value, list):
        return f"[{', '.join(_inline(each) for each in value)}]"
    return str(value)


def _requirement(requirement: RequirementText, runs: Sequence[str]) -> Iterator[str]:
    yield f"  {requirement.id}: {_asked(requirement)}"
    if len(requirement.runs) < len(runs):
        yield f"    asked of: {', '.join(each for each in runs if each in requirement.runs)}"
    if requirement.over is not Over.BOTH:
        yield f"    over: {requirement.over}"
    if requirement.at_least is not None:
        yield f"    at least: {_inline(requirement.at_least.plain())}"
    if requirement.expect:
        yield f"    expected to fail: {', '.join(sorted(requirement.expect))}"
    yield from wrap(requirement.text, WIDTH, initial_indent="    ", subsequent_indent="    ")


def _asked(requirement: RequirementText) -> str:
    if requirement.statement is not None:
        return requirement.statement.formula
    if requirement.corridor is not None:
        return f"{requirement.corridor.signal.value} stays within {requirement.corridor.file.value}"
    return _measured(requirement)


def _measured(requirement: RequirementText) -> str:
    arguments = "".join(
        f", {name} = {_inline(entry.plain())}" for name, entry in requirement.arguments.items()
    )
    bounds = [
        f"{word} {entry.value}"
        for word, entry in (("at least", requirement.minimum), ("at most", requirement.maximum))
        if entry is not None
    ]
    signal = requirement.signal.value if requirement.signal else ""
    relative = requirement.relative_to
    beside = f" as a {relative.form} to {relative.variant}" if relative else ""
    return f"{requirement.metric}({signal}{arguments}){beside} {', '.join(bounds)}"


def _time(ticks: int) -> str:
    return f"{ticks / 1e9:.9g} s"

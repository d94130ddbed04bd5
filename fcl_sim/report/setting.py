"""How a run is set up, in words, and what sets it apart from another."""

from collections.abc import Iterable, Iterator, Sequence
from pathlib import PurePath
from typing import Any

from fcl_sim.loop.diagram import Diagram, FuzzyNode, Integration, Overruns, PlantNode, Restart
from fcl_sim.loop.schemes import SCHEMES
from fcl_sim.loop.settings import AnyNode
from fcl_sim.report.constants import (
    Constant,
    Settings,
    changes,
    parameters_of,
    settings_of,
    source_of,
    starts_of,
    told,
)
from fcl_sim.report.words import number, one_line, with_unit
from fcl_sim.scenario.model import PlantSetup
from fcl_sim.testbench import Outcome, Run

ARROW = "\N{RIGHTWARDS ARROW}"


def milliseconds(ticks: int) -> str:
    """Return a time of the PLC."""
    return with_unit(ticks / 1e6, "ms", 9)


def unlike_base(outcome: Outcome, run: Run) -> list[str]:
    """Return what sets a run apart from the base run of its scenario, values as the scenario writes them."""
    setups = setup_of(outcome, outcome.base), setup_of(outcome, run)
    return differences(outcome.base.diagram, run.diagram, setups)


def setup_of(outcome: Outcome, run: Run) -> PlantSetup | None:
    """Return what the scenario says of a run's plant."""
    setup = outcome.scenario.variants.get(run.variant)
    return None if setup is None else setup.plant


def differences(
    base: Diagram, other: Diagram, setups: tuple[PlantSetup | None, PlantSetup | None] = (None, None)
) -> list[str]:
    """Return what sets a diagram apart from the base, old and new: plant, start, timing, blocks, wires.

    Values of the plants are in the units of `setups`, which they were bound from.
    """
    return [
        *_plant((base.plant, setups[0]), (other.plant, setups[1])),
        *_timing(base, other),
        *_blocks(base, other),
        *_wires(base, other),
    ]


def _plant(*sides: tuple[PlantNode, PlantSetup | None]) -> Iterator[str]:
    base, other = (node for node, _ in sides)
    names = [each.model.declaration.name for each in (base, other)]
    if other.model.digest != base.model.digest:
        same = "the plant's file is another" if names[0] == names[1] else ""
        yield same or f"the plant {_changed(*names)}"
    yield from _constants(*(parameters_of(*each) for each in sides))
    yield from (f"start {each}" for each in _constants(*(starts_of(*each) for each in sides)))


def _constants(base: Sequence[Constant], other: Sequence[Constant]) -> Iterator[str]:
    before, after = ({each.name: each for each in side} for side in (base, other))
    for name in dict.fromkeys((*before, *after)):
        old, new = before.get(name), after.get(name)
        if old is None or new is None or (old.value, old.unit) != (new.value, new.unit):
            yield f"{one_line(name)} {_changed(*('' if each is None else each.told for each in (old, new)))}"


def _named(found: Iterable[tuple[str, str, str]]) -> Iterator[str]:
    for name, old, new in found:
        yield f"{one_line(name)} {_changed(old, new)}"


def _changed(old: str, new: str) -> str:
    return f"{one_line(old) or 'none'} {ARROW} {one_line(new) or 'none'}"


def accuracy(integration: Integration) -> str:
    """Return the scheme that integrates a plant, and what bounds its error: a tolerance, or the step."""
    if SCHEMES[integration.scheme].error:
        return f"{integration.scheme}, relative tolerance {number(integration.rtol)}"
    return f"{integration.scheme}, step {milliseconds(round(integration.step * 1e9))}"


def _timing(base: Diagram, other: Diagram) -> Iterator[str]:
    before, after = (dict(_times(each)) for each in (base, other))
    yield from _named(changes(before, after))


def _times(diagram: Diagram) -> Iterator[tuple[str, str]]:
    """Yield what the clock and the integration are set to."""
    timing, integration = diagram.timing, diagram.integration
    for word in ("scan", "duration", "latency", "jitter"):
        yield word, milliseconds(getattr(timing, word))
    yield "seed", str(timing.seed)
    yield "cycle time", "measured" if timing.measured else "nominal"
    yield "overruns", _overruns(timing.overruns)
    yield "restarts", ", ".join(_restart(each) for each in timing.restarts)
    if not diagram.exact:
        yield "integration", integration.scheme
        yield "relative tolerance", number(integration.rtol)
        yield "step", with_unit(integration.step, "s", 9)


def _overruns(given: Overruns) -> str:
    parts = [f"scan {scan} takes {milliseconds(each)}" for scan, each in given.listed]
    if given.chance:
        parts.append(f"{number(given.chance)} of the scans take up to {milliseconds(given.longest)}")
    return ", ".join([*parts, f"policy {given.policy}"]) if parts else ""


def _restart(given: Restart) -> str:
    lasts = f" of {with_unit(given.lasts / 1e9, 's', 9)}" if given.lasts else ""
    return f"{given.kind} at {with_unit(given.at / 1e9, 's', 9)}{lasts}"


def _blocks(base: Diagram, other: Diagram) -> Iterator[str]:
    before, after = ({node.name: node for node in each.nodes} for each in (base, other))
    for name in before:
        if name not in after:
            yield f"without {one_line(name)}"
    for name, node in after.items():
        if name in before:
            yield from (f"{one_line(name)}: {each}" for each in _block(before[name], node))
        else:
            yield f"with {one_line(name)} ({_described(node)})"


def _described(node: AnyNode) -> str:
    own = settings_of(node)
    return one_line(", ".join([own.type, *_given(own)]))


def _given(own: Settings) -> list[str]:
    return [f"{name} = {told(each)}" for name, each in own.given.items()]


def _block(base: AnyNode, other: AnyNode) -> Iterator[str]:
    """Yield what is unlike in a block of the same name; of another type, what it is set to and reads."""
    before, after = settings_of(base), settings_of(other)
    if before.type != after.type:
        reads = [f"{port} from {source}" for port, source in after.wired.items()]
        described = one_line(", ".join([*_given(after), *reads]))
        yield _changed(before.type, after.type) + (f" ({described})" if described else "")
        return
    for name, old, new in changes(*_values(before, after)):
        yield _set(name, old, new)
    if isinstance(base, FuzzyNode) and isinstance(other, FuzzyNode):
        yield from _rules(base, other)
    for port, old, new in changes(before.wired, after.wired):
        if port not in _swapped(before, after):
            yield _wired(port, old, new)


def _set(name: str, old: str, new: str) -> str:
    """Return what a parameter is set to, and what it was, as far as it is or was set to anything."""
    if not new:
        return f"without {one_line(name)}"
    return f"{one_line(name)} {_changed(old, new)}" if old else f"{one_line(name)} = {one_line(new)}"


def _swapped(before: Settings, after: Settings) -> set[str]:
    """Return the parameters that are a value on one side and a signal on the other."""
    return {
        name
        for one, two in ((before, after), (after, before))
        for name in one.wired
        if name in two.values and name not in one.values
    }


def _values(before: Settings, after: Settings) -> list[dict[str, Any]]:
    """Return the parameters of both sides; of one that is a signal, its name."""
    swapped = _swapped(before, after)
    return [
        {**{name: f"from {each.wired[name]}" for name in each.wired if name in swapped}, **each.values}
        for each in (before, after)
    ]


def _rules(base: FuzzyNode, other: FuzzyNode) -> Iterator[str]:
    """Yield that the rule base is another, by the names of its files where they tell it."""
    mine, theirs = base.block.function_block, other.block.function_block
    if mine == theirs:
        return
    old, new = (each.span.source.name if each.span else "" for each in (mine, theirs))
    names = PurePath(old).name, PurePath(new).name
    apart = names if names[0] != names[1] else (old, new)
    yield f"rule base {_changed(*apart)}" if old != new else "the rule base is another"


def _wires(base: Diagram, other: Diagram) -> Iterator[str]:
    for owner, before, after in (
        (f"{other.plant.name}.", base.plant.inputs, other.plant.inputs),
        ("", base.aliases, other.aliases),
    ):
        ends = ({name: source_of(each) for name, each in side.items()} for side in (before, after))
        for name, old, new in changes(*ends):
            yield _wired(owner + name, old, new)


def _wired(port: str, old: str, new: str) -> str:
    """Return from where a port comes, and from where it came, as far as it comes from anywhere."""
    if not new:
        return f"{one_line(port)} from nothing"
    return f"{one_line(port)} from {_changed(old, new) if old else one_line(new)}"

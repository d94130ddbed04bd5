"""A run and its axes → tapes of its points, each bound as cheaply as what its axes move allows.

Axes of a plant's parameters and start values change two arrays of a tape. So
the points that differ in those alone share one tape; each other combination is
bound, wired and lowered once.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import groupby
from types import MappingProxyType

from fcl_sim.diagnostics import Diagnostic, InputFault
from fcl_sim.envelope.grid import Grid
from fcl_sim.judge.envelope import at_points
from fcl_sim.judge.verdict import Over, Requirement
from fcl_sim.loop.diagram import Diagram
from fcl_sim.loop.tape import Tape, lower, with_plant
from fcl_sim.loop.wiring import wire
from fcl_sim.scenario.binder import LoadBlock, axis_values, bind_setup, check_inputs, requirements, units_of
from fcl_sim.scenario.model import Scenario, Setup
from fcl_sim.scenario.points import moves_plant, setup_at
from fcl_sim.scenario.requirements import Units
from fcl_sim.toml.tree import Entry

POINTS = (Over.BOTH, Over.POINTS, Over.MEAN)
"""What requirements on points are over."""

REMEMBERED = 16
"""Families that a plan remembers, at most: each has its loop's random numbers."""

Outer = Mapping[str, tuple[int, Entry]]
"""Of each axis that moves more than the plant, by its key, the number of a value, and the value."""

Numbers = Mapping[str, Sequence[float]]
"""Of each axis that moves the plant alone, by its key, the numbers that its values are."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Family:
    """The points that share a tape: of the run itself, and of those its requirements compare it with.

    `requirements` are as they are asked at each point, `units` those of the signals.
    """

    tape: Tape
    numbers: Numbers
    requirements: tuple[Requirement, ...]
    units: Units
    others: Mapping[str, Tape]

    def at(self, steps: Mapping[str, int]) -> tuple[Tape, dict[str, Tape]]:
        """Return the tapes of one of its points, by the number of the value on each axis."""
        moved = {key: numbers[steps[key]] for key, numbers in self.numbers.items()}
        return _moved(self.tape, moved), {name: _moved(each, moved) for name, each in self.others.items()}


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """The envelope of a run, checked: what is asked of it, and how to come by its tapes.

    `bound` remembers the families of the first few combinations, by axis and
    number of the value: what was bound to check it is run, too.
    """

    scenario: Scenario
    setup: Setup
    grid: Grid
    requirements: tuple[Requirement, ...]
    units: Units
    load_block: LoadBlock
    inner: frozenset[str]
    bound: dict[tuple[tuple[str, int], ...], Family] = field(default_factory=dict, compare=False)

    def families(self, points: Sequence[int]) -> Iterator[tuple[Family, list[int]]]:
        """Yield points in their order, those of one tape together; InputFault where one does not fit."""
        for _, group in groupby(points, key=self._outer_steps):
            members = list(group)
            entries, steps = self.grid.entries(members[0]), self.steps(members[0])
            yield (
                _family(self, {key: (steps[key], entries[key]) for key in steps.keys() - self.inner}),
                members,
            )

    def steps(self, index: int) -> dict[str, int]:
        """Return which value each axis has at a point, by its key."""
        return {axis.key: step for axis, step in zip(self.grid.axes, self.grid.steps(index), strict=True)}

    def _outer_steps(self, index: int) -> tuple[int, ...]:
        return tuple(step for key, step in self.steps(index).items() if key not in self.inner)


def plan(scenario: Scenario, setup: Setup, load_block: LoadBlock) -> Plan:
    """Return the plan of the envelope of a run; InputFault with what is wrong with the values of its axes.

    What only several values together make wrong is found when their turn comes.
    """
    faults: dict[Diagnostic, None] = {}
    asked_here = [each for each in scenario.requirements if setup.variant in each.runs]
    related = {each.relative_to.variant for each in asked_here if each.relative_to} - {setup.variant}
    setups = [setup, *(scenario.variants[name] for name in sorted(related))]
    inner = frozenset(axis.key for axis in setup.vary if all(moves_plant(axis, each) for each in setups))
    made = Plan(
        scenario=scenario,
        setup=setup,
        grid=Grid(setup.vary),
        requirements=(),
        units=Units({}),
        load_block=load_block,
        inner=inner,
    )
    for axis in setup.vary:
        for step, entry in enumerate(axis.values if axis.key not in inner else ()):
            _noting(faults, made, {axis.key: (step, entry)})
    family = _noting(faults, made, {})
    if faults or family is None:
        raise InputFault(faults)
    asked = requirements(scenario, setup.variant, family.units, POINTS)
    return replace(made, requirements=asked, units=family.units)


def _noting(faults: dict[Diagnostic, None], made: Plan, outer: Outer) -> Family | None:
    try:
        return _family(made, outer)
    except InputFault as fault:
        faults.update(dict.fromkeys(fault.diagnostics))
    return None


def _family(made: Plan, outer: Outer) -> Family:
    key = tuple(sorted((name, step) for name, (step, _) in outer.items()))
    found = made.bound.get(key)
    if found is None:
        found = _new_family(made, {name: entry for name, (_, entry) in outer.items()})
        if len(made.bound) < REMEMBERED:
            made.bound[key] = found
    return found


def _new_family(made: Plan, outer: Mapping[str, Entry]) -> Family:
    scenario, name = made.scenario, made.setup.variant
    diagram, units = _bound(made, made.setup, outer)
    faults: list[Diagnostic] = []
    numbers = {
        axis.key: axis_values(diagram.plant, axis, faults)
        for axis in made.setup.vary
        if axis.key in made.inner
    }
    if faults:
        raise InputFault(dict.fromkeys(faults))
    asked = requirements(scenario, name, units, POINTS)
    related = dict.fromkeys(each.relative_to.variant for each in asked if each.relative_to)
    others = {other: lower(wire(_bound(made, scenario.variants[other], outer)[0])) for other in related}
    return Family(
        tape=lower(wire(diagram)),
        numbers=MappingProxyType(numbers),
        requirements=tuple(at_points(each) for each in asked),
        units=units,
        others=MappingProxyType(others),
    )


def _bound(made: Plan, setup: Setup, outer: Mapping[str, Entry]) -> tuple[Diagram, Units]:
    found = setup_at(made.scenario, setup, outer)
    diagram = bind_setup(made.scenario, found, made.load_block)
    units = units_of(wire(diagram))
    check_inputs(found, units)
    return diagram, units


def _moved(tape: Tape, numbers: Mapping[str, float]) -> Tape:
    if not numbers:
        return tape
    plant = tape.wiring.diagram.plant
    parameters, start = dict(plant.parameters), dict(plant.start)
    for key, number in numbers.items():
        _, group, name = key.split(".")
        (parameters if group == "parameters" else start)[name] = number
    return with_plant(tape, replace(plant, parameters=parameters, start=start))

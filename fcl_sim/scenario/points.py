"""Points of an envelope: values of its axes laid over what a run says."""

from collections.abc import Mapping
from dataclasses import replace

from fcl_sim.diagnostics import InputFault
from fcl_sim.scenario.linear import is_linear
from fcl_sim.scenario.model import Axis, Scenario, Setup
from fcl_sim.scenario.reading import Reading
from fcl_sim.scenario.schema import PlantTable
from fcl_sim.scenario.setup import setup_of
from fcl_sim.scenario.shape import shape_faults
from fcl_sim.scenario.variants import without_unknown_blocks
from fcl_sim.toml.tree import Entry, overlaid

PLANT = "plant"
OF_PLANT = ("parameters", "start")


def moves_plant(axis: Axis, setup: Setup) -> bool:
    """Return whether an axis sets a number of the plant and leaves all else as it is.

    A linear plant is made from its numbers, so they are no such.
    """
    first, *rest = axis.key.split(".")
    return first == PLANT and len(rest) == 2 and rest[0] in OF_PLANT and not is_linear(setup.plant)


def setup_at(scenario: Scenario, setup: Setup, values: Mapping[str, Entry]) -> Setup:
    """Return what a run says at a point of an envelope: `values` by dotted key laid over it.

    InputFault where the values of a point contradict each other.
    """
    if not values:
        return setup
    reading = Reading(scenario.path, {each.path: each for each in scenario.files})
    found = _laid(reading, setup, values)
    if found is None:
        raise InputFault(reading.faults_in_order())
    return found


def check_values(reading: Reading, setup: Setup) -> None:
    """Note the faults of each value of each axis, laid alone over the run; read the files they name."""
    for axis in setup.vary:
        for value in axis.values:
            if moves_plant(axis, setup):
                _, group, name = axis.key.split(".")
                numbers = setup.plant.model, Entry({name: value}, axis.span, axis.span)
                plant = Entry(dict(zip(("model", group), numbers, strict=True)), axis.span, axis.span)
                reading.note(shape_faults(PlantTable, plant, f"`{PLANT}`"))
            else:
                _laid(reading, setup, {axis.key: value})


def _laid(reading: Reading, setup: Setup, values: Mapping[str, Entry]) -> Setup | None:
    tree = setup.tree
    for key, value in values.items():
        over, unknown = without_unknown_blocks(tree.get("blocks"), _grown(key, value), "the scenario")
        reading.note(unknown)
        tree = overlaid(tree, over)
    found = setup_of(reading, setup.variant, tree)
    return None if found is None else replace(found, title=setup.title, vary=setup.vary)


def _grown(key: str, value: Entry) -> Entry:
    """Return the tree that has one entry, at a dotted key."""
    for name in reversed(key.split(".")):
        value = Entry({name: value}, value.key, value.span)
    return value

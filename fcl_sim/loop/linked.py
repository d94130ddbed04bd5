"""The functions that a run calls, linked once and handed over as one."""

from functools import lru_cache
from typing import Protocol

from fcl_sim.jit import Entry, entry, links_type, new_links, signature
from fcl_sim.loop.blocks.fuzzy import FUZZY_TYPE, Fuzzy
from fcl_sim.loop.execute import FURTHER_TYPE, Further
from fcl_sim.plant.functions import FUNCTION_TYPES, PARTS, PlantFunction, PlantFunctions

_PLANT = dict(zip(PARTS, FUNCTION_TYPES, strict=True))

LINKED = links_type(**_PLANT, further=FURTHER_TYPE, long=FUZZY_TYPE, real=FUZZY_TYPE)
"""Signature part of `Linked`."""


class Linked(Protocol):
    """A plant's functions, the one that executes block rows of the further families, and fuzzy blocks.

    `long` calls those in LREAL, `real` those in REAL.
    """

    dynamics: PlantFunction
    outputs: PlantFunction
    events: PlantFunction
    transition: PlantFunction
    sample: PlantFunction
    further: Further
    long: Fuzzy
    real: Fuzzy


@entry(signature(LINKED, *FUNCTION_TYPES, FURTHER_TYPE, FUZZY_TYPE, FUZZY_TYPE))
def link(
    dynamics: PlantFunction,
    outputs: PlantFunction,
    events: PlantFunction,
    transition: PlantFunction,
    sample: PlantFunction,
    further: Further,
    long: Fuzzy,
    real: Fuzzy,
) -> Linked:
    """Return the functions as one object."""
    functions: Linked = new_links(LINKED)
    functions.dynamics = dynamics
    functions.outputs = outputs
    functions.events = events
    functions.transition = transition
    functions.sample = sample
    functions.further = further
    functions.long = long
    functions.real = real
    return functions


@lru_cache(maxsize=32)
def linked(plant: PlantFunctions, further: Entry, long: Entry, real: Entry) -> Linked:
    """Return the compiled functions of a plant, and the others, as one object.

    InputFault for plant code that cannot be compiled.
    """
    functions: Linked = link(*plant.ready(), *(each.compile() for each in (further, long, real)))
    return functions

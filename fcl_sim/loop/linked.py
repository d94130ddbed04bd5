"""The functions that a run calls, linked once and handed over as one."""

from functools import lru_cache
from typing import Protocol

from fcl_sim.jit import Entry, entry, links_type, new_links, signature
from fcl_sim.loop.execute import FURTHER_TYPE, Further
from fcl_sim.plant.functions import FUNCTION_TYPES, PARTS, PlantFunction, PlantFunctions

LINKED = links_type(**dict(zip(PARTS, FUNCTION_TYPES, strict=True)), further=FURTHER_TYPE)
"""Signature part of `Linked`."""


class Linked(Protocol):
    """A plant's functions, and the one that executes block rows of the further families."""

    dynamics: PlantFunction
    outputs: PlantFunction
    events: PlantFunction
    transition: PlantFunction
    sample: PlantFunction
    further: Further


@entry(signature(LINKED, *FUNCTION_TYPES, FURTHER_TYPE))
def link(
    dynamics: PlantFunction,
    outputs: PlantFunction,
    events: PlantFunction,
    transition: PlantFunction,
    sample: PlantFunction,
    further: Further,
) -> Linked:
    """Return the functions as one object."""
    functions: Linked = new_links(LINKED)
    functions.dynamics = dynamics
    functions.outputs = outputs
    functions.events = events
    functions.transition = transition
    functions.sample = sample
    functions.further = further
    return functions


@lru_cache(maxsize=32)
def linked(plant: PlantFunctions, further: Entry) -> Linked:
    """Return the compiled functions of a plant, and `further`, as one object.

    InputFault for plant code that cannot be compiled.
    """
    functions: Linked = link(*plant.ready(), further.compile())
    return functions

"""The functions that a run calls, linked once and handed over as one."""

from functools import lru_cache
from typing import Protocol

from fcl_sim.jit import Entry, entry, function_type, links_type, new_links, signature
from fcl_sim.loop.blocks.fuzzy import FUZZY_TYPE, Fuzzy
from fcl_sim.loop.called import LOOK_TYPE, OUTPUTS_TYPE, STEP_TYPE, ready
from fcl_sim.loop.execute import FURTHER_TYPE, Further
from fcl_sim.loop.stages import Shape
from fcl_sim.loop.work import Called
from fcl_sim.plant.functions import PARTS, PlantFunction, PlantFunctions

_TYPES = {
    "step": STEP_TYPE,
    "outputs": OUTPUTS_TYPE,
    "look": LOOK_TYPE,
    "transition": function_type(*PARTS["transition"]),
    "sample": function_type(*PARTS["sample"]),
    "further": FURTHER_TYPE,
    "long": FUZZY_TYPE,
    "real": FUZZY_TYPE,
}
LINKED = links_type(**_TYPES)
"""Signature part of `Linked`."""


class Linked(Protocol):
    """A plant's functions, the one that executes block rows of the further families, and fuzzy blocks.

    `long` calls those in LREAL, `real` those in REAL.
    """

    step: Called
    outputs: Called
    look: Called
    transition: PlantFunction
    sample: PlantFunction
    further: Further
    long: Fuzzy
    real: Fuzzy


@entry(signature(LINKED, *_TYPES.values()))
def link(
    step: Called,
    outputs: Called,
    look: Called,
    transition: PlantFunction,
    sample: PlantFunction,
    further: Further,
    long: Fuzzy,
    real: Fuzzy,
) -> Linked:
    """Return the functions as one object."""
    functions: Linked = new_links(LINKED)
    functions.step = step
    functions.outputs = outputs
    functions.look = look
    functions.transition = transition
    functions.sample = sample
    functions.further = further
    functions.long = long
    functions.real = real
    return functions


@lru_cache(maxsize=32)
def linked(plant: PlantFunctions, shape: Shape, further: Entry, long: Entry, real: Entry) -> Linked:
    """Return the compiled functions of a plant in a run of that shape, and the others.

    InputFault for plant code that cannot be compiled.
    """
    functions: Linked = link(
        *ready(plant, shape),
        *map(plant.compiled, ("transition", "sample")),
        *(each.compile() for each in (further, long, real)),
    )
    return functions

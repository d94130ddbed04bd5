"""What a plant is: its declaration, the contract its functions keep, and the catalog that finds it.

In: a Python file with PLANT and its functions, or the matrices of a linear plant.
Out: a PlantModel whose functions are compiled to one fixed signature, so that one
loop drives every plant.
May import jit, units and diagnostics. A plant file imports its vocabulary from here.
Tests: tests/plant.
"""

from fcl_sim.jit import kernel
from fcl_sim.plant.declaration import (
    START,
    Direction,
    Event,
    Input,
    Mode,
    Output,
    Parameter,
    Plant,
    State,
)

FALLING = Direction.FALLING
RISING = Direction.RISING

__all__ = [
    "FALLING",
    "RISING",
    "START",
    "Direction",
    "Event",
    "Input",
    "Mode",
    "Output",
    "Parameter",
    "Plant",
    "State",
    "kernel",
]

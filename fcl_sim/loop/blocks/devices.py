"""The family of devices beside the PLC: what they measure, what they move, how they fail."""

from fcl_sim.jit import flat
from fcl_sim.loop.blocks.actuator import ACTUATOR, actuator
from fcl_sim.loop.blocks.fault import FAULT, fault
from fcl_sim.loop.blocks.sensor import SENSOR, sensor
from fcl_sim.loop.row import Row

TABLE = (SENSOR, ACTUATOR, FAULT)


@flat
def execute(code: int, row: Row) -> None:
    """Execute a block of this family by its row in TABLE."""
    if code == 0:
        sensor(row)
    elif code == 1:
        actuator(row)
    elif code == 2:
        fault(row)

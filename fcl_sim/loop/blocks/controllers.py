"""The family of controllers beside the fuzzy block (B.1, B.2)."""

from fcl_sim.jit import flat
from fcl_sim.loop.blocks.pid import PID, pid
from fcl_sim.loop.blocks.pid_velocity import PID_VELOCITY, pid_velocity
from fcl_sim.loop.row import Row

TABLE = (PID, PID_VELOCITY)


@flat
def execute(code: int, row: Row) -> None:
    """Execute a block of this family by its row in TABLE."""
    if code == 0:
        pid(row)
    elif code == 1:
        pid_velocity(row)

"""Execute the blocks of a tape once, in wiring order.

The commonest blocks are copied into the loop. All others are behind one
function, called through a first-class function. It is compiled when a tape
first needs it, for the families that the tape has, so that blocks cost a loop
without them neither time nor compilation.
"""

from collections.abc import Callable
from functools import cache

from fcl_sim.jit import Entry, F, I, f8, function_type, i8, inlined, signature, u, void
from fcl_sim.loop.blocks import (
    calculation,
    concept,
    controllers,
    delays,
    devices,
    dynamics,
    expression,
    nonlinear,
    routing,
    sources,
)
from fcl_sim.loop.blocks.differentiator import differentiate
from fcl_sim.loop.blocks.fuzzy import INSTANCE, Fuzzy, Singles, call_jointly
from fcl_sim.loop.blocks.integrator import integrate
from fcl_sim.loop.blocks.limiter import limit
from fcl_sim.loop.blocks.linear import gain, weighted_sum
from fcl_sim.loop.layout import FIRST_INPUT, INPUTS, KEEPS, KEEPS_AT, OPCODE, ROW_LENGTH, ROWS_END
from fcl_sim.loop.row import Row
from fcl_sim.loop.work import Floats, Ints

Further = Callable[[int, Ints, Floats, Floats, int, float, float, int], None]
"""A function that executes one row: opcode, tape, memory, where the row begins, cycle, time, scan."""

_FURTHER = (void, i8, I, F, F, i8, f8, f8, i8)

FURTHER_TYPE = function_type(*_FURTHER)

PYTHON_OPCODE, JOINT_OPCODE = 6, 7
FAMILY_SHIFT, CODE_MASK = 5, 31


@inlined
def execute(
    row: Row, further: Further, long: Fuzzy, real: Fuzzy, constants: Singles, singles: Singles
) -> int:
    """Execute the block rows from `row` on; return where the rows end.

    A block in Python ends it before: then it is where that block's row begins.
    """
    ints, floats, memory, at, cycle, time, scan = row
    end = ints[u(ROWS_END)]
    while at != end:
        opcode = ints[u(at + OPCODE)]
        here = Row(ints, floats, memory, at, cycle, time, scan)
        if opcode == 0:
            weighted_sum(here)
        elif opcode == 1:
            gain(here)
        elif opcode == 2:
            differentiate(here)
        elif opcode == 3:
            if ints[u(at + FIRST_INPUT + ints[u(at + INPUTS)] + INSTANCE)] < 0:
                long(ints, floats, memory, constants, singles, at)
            else:
                real(ints, floats, memory, constants, singles, at)
        elif opcode == 4:
            limit(here)
        elif opcode == 5:
            integrate(here)
        elif opcode == JOINT_OPCODE:
            call_jointly(ints, floats, memory, at)
        elif opcode == PYTHON_OPCODE:
            return at
        else:
            further(opcode, ints, floats, memory, at, cycle, time, scan)
        at += ints[u(at + ROW_LENGTH)]
    keep_late(ints, floats, memory)
    return at


@inlined
def keep_late(ints: Ints, floats: Floats, memory: Floats) -> None:
    """Keep for the next scan what late inputs read: three words each, slot, where the sign stands, keeper."""
    at = ints[u(KEEPS_AT)]
    for _ in range(ints[u(KEEPS)]):
        memory[u(ints[u(at + 2)])] = floats[u(ints[u(at + 1)])] * memory[u(ints[u(at)])]
        at += 3


FIRST_FAMILY, FAMILIES = 1, 10


@cache
def further_with(families: frozenset[int]) -> Entry:
    """Return what executes rows of these families and of no other.

    numba leaves out what a False that is known before excludes, so that only
    these families are compiled.
    """
    has = [number in families for number in range(FIRST_FAMILY, FIRST_FAMILY + FAMILIES)]
    has_calculation, has_nonlinear, has_delays, has_sources = has[:4]
    has_dynamics, has_controllers, has_routing, has_expression, has_concept, has_devices = has[4:]

    def execute_further(
        opcode: int,
        ints: Ints,
        floats: Floats,
        memory: Floats,
        at: int,
        cycle: float,
        time: float,
        scan: int,
    ) -> None:
        """Execute a row of any family but the first, by its opcode."""
        row = Row(ints, floats, memory, at, cycle, time, scan)
        family, code = opcode >> FAMILY_SHIFT, opcode & CODE_MASK
        if has_calculation and family == 1:
            calculation.execute(code, row)
        elif has_nonlinear and family == 2:
            nonlinear.execute(code, row)
        elif has_delays and family == 3:
            delays.execute(code, row)
        elif has_sources and family == 4:
            sources.execute(code, row)
        elif has_dynamics and family == 5:
            dynamics.execute(code, row)
        elif has_controllers and family == 6:
            controllers.execute(code, row)
        elif has_routing and family == 7:
            routing.execute(code, row)
        elif has_expression and family == 8:
            expression.execute(code, row)
        elif has_concept and family == 9:
            concept.execute(code, row)
        elif has_devices and family == 10:
            devices.execute(code, row)

    # Two that were compiled by two processes may have one symbol: numba makes it of the qualified name and
    # a count within the process. Loaded from the cache into one process, one would be taken for the other.
    execute_further.__qualname__ += "".join(f"_{number}" for number in sorted(families))
    return Entry(execute_further, signature(*_FURTHER), flat=True)


def further_for(opcodes: list[int]) -> Entry:
    """Return what executes the rows of a tape that the loop does not execute itself."""
    return further_with(frozenset(opcode >> FAMILY_SHIFT for opcode in opcodes if opcode > CODE_MASK))

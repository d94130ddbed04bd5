"""The blocks that stand around a fuzzy block (A.3): equation, kernel and declaration side by side.

In: signals in the loop's memory. Out: signals. A block's opcode is the place of
its family in FAMILIES and its row in the family's table; `loop.execute`
dispatches on it. May import engine, concept, units, jit and the loop's layout and row.
Tests: tests/loop/blocks, tests/loop/test_blocks.py, which walks the tables.
"""

from collections.abc import Mapping
from types import MappingProxyType

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
from fcl_sim.loop.blocks.declaration import BlockParameter, BlockType, Family
from fcl_sim.loop.blocks.differentiator import DIFFERENTIATOR
from fcl_sim.loop.blocks.fuzzy import FUZZY
from fcl_sim.loop.blocks.integrator import INTEGRATOR
from fcl_sim.loop.blocks.limiter import LIMITER
from fcl_sim.loop.blocks.linear import GAIN, SUM
from fcl_sim.loop.blocks.python import PYTHON

CORE = (SUM, GAIN, DIFFERENTIATOR, FUZZY, LIMITER, INTEGRATOR, PYTHON)
"""Blocks that the loop executes itself; the others are reached by a call."""

FAMILIES = (
    Family(name="core", title="The basic blocks", table=CORE, execute=None),
    Family(name="calculation", title="Calculation", table=calculation.TABLE, execute=calculation.execute),
    Family(name="nonlinear", title="Nonlinear elements", table=nonlinear.TABLE, execute=nonlinear.execute),
    Family(name="delays", title="Delays", table=delays.TABLE, execute=delays.execute),
    Family(name="sources", title="Sources", table=sources.TABLE, execute=sources.execute),
    Family(name="dynamics", title="Lags", table=dynamics.TABLE, execute=dynamics.execute),
    Family(name="controllers", title="Controllers", table=controllers.TABLE, execute=controllers.execute),
    Family(name="routing", title="Choosing and sharing out", table=routing.TABLE, execute=routing.execute),
    Family(name="expression", title="Formulae", table=expression.TABLE, execute=expression.execute),
    Family(name="concept", title="Concept's FUZZY library", table=concept.TABLE, execute=concept.execute),
    Family(name="devices", title="Sensors, actuators, faults", table=devices.TABLE, execute=devices.execute),
)
"""Block types by family; the opcode of a block is CODES times the row of its family, plus its own."""

CODES = 32
"""Codes of a family."""

BLOCKS: Mapping[str, BlockType] = MappingProxyType(
    {each.name: each for family in FAMILIES for each in family.table}
)
"""Block types by the name that a scenario writes."""

OPCODES: Mapping[str, int] = MappingProxyType(
    {
        each.name: CODES * number + code
        for number, family in enumerate(FAMILIES)
        for code, each in enumerate(family.table)
    }
)
"""Opcodes by the same name."""

__all__ = ["BLOCKS", "CODES", "FAMILIES", "OPCODES", "BlockParameter", "BlockType", "Family"]

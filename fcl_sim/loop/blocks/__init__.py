"""The blocks that stand around a fuzzy block (A.3): declaration, equation and kernel side by side.

In: signals in the loop's memory. Out: signals. A block's opcode is its row in
BLOCKS; `loop.execute` dispatches on it. May import engine, units, jit and the
loop's layout. Tests: tests/loop/test_blocks.py, which walks the table.
"""

from collections.abc import Mapping
from types import MappingProxyType

from fcl_sim.loop.blocks.declaration import BlockParameter, BlockType
from fcl_sim.loop.blocks.differentiator import DIFFERENTIATOR
from fcl_sim.loop.blocks.fuzzy import FUZZY
from fcl_sim.loop.blocks.linear import GAIN, SUM

TABLE = (SUM, GAIN, DIFFERENTIATOR, FUZZY)
"""Block types by opcode."""

BLOCKS: Mapping[str, BlockType] = MappingProxyType({each.name: each for each in TABLE})
"""Block types by the name that a scenario writes."""

__all__ = ["BLOCKS", "TABLE", "BlockParameter", "BlockType"]

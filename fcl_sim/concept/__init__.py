"""The function blocks of Concept's FUZZY library, in INT, REAL and with structures.

In: numbers. Out: degrees and numbers, and the run-time errors by their names.
A function block of FCL becomes a network of them (translate, function_block).
May import arithmetic, model, jit and diagnostics. A block's declaration, equation and
kernel stand side by side; its opcode is its row in TABLE. A name of the
manual, called, makes an instance. Tests: tests/concept.
"""

from collections.abc import Mapping
from functools import partial
from types import MappingProxyType

from fcl_sim.concept import aterm, defuz, operators, sterm
from fcl_sim.concept.declaration import BlockType
from fcl_sim.concept.events import Event
from fcl_sim.concept.execute import TABLE
from fcl_sim.concept.instance import Instance, Rounding
from fcl_sim.concept.values import FUZ_MD_INT, FUZ_MD_REAL

BLOCKS: Mapping[str, BlockType] = MappingProxyType({each.name: each for each in TABLE})
"""Block types by their names."""

FUZ_ATERM_INT = partial(Instance, aterm.ATERM_INT)
FUZ_ATERM_REAL = partial(Instance, aterm.ATERM_REAL)
FUZ_ATERM_STI = partial(Instance, aterm.ATERM_STI)
FUZ_ATERM_STR = partial(Instance, aterm.ATERM_STR)
FUZ_STERM_INT = partial(Instance, sterm.STERM_INT)
FUZ_STERM_REAL = partial(Instance, sterm.STERM_REAL)
FUZ_MIN_INT = partial(Instance, operators.MIN_INT)
FUZ_MIN_REAL = partial(Instance, operators.MIN_REAL)
FUZ_MAX_INT = partial(Instance, operators.MAX_INT)
FUZ_MAX_REAL = partial(Instance, operators.MAX_REAL)
FUZ_PROD_INT = partial(Instance, operators.PROD_INT)
FUZ_PROD_REAL = partial(Instance, operators.PROD_REAL)
FUZ_SUM_INT = partial(Instance, operators.SUM_INT)
FUZ_SUM_REAL = partial(Instance, operators.SUM_REAL)
DEFUZ_INT = partial(Instance, defuz.DEFUZ_INT)
DEFUZ_REAL = partial(Instance, defuz.DEFUZ_REAL)
DEFUZ_STI = partial(Instance, defuz.DEFUZ_STI)
DEFUZ_STR = partial(Instance, defuz.DEFUZ_STR)

__all__ = [
    "BLOCKS",
    "DEFUZ_INT",
    "DEFUZ_REAL",
    "DEFUZ_STI",
    "DEFUZ_STR",
    "FUZ_ATERM_INT",
    "FUZ_ATERM_REAL",
    "FUZ_ATERM_STI",
    "FUZ_ATERM_STR",
    "FUZ_MAX_INT",
    "FUZ_MAX_REAL",
    "FUZ_MD_INT",
    "FUZ_MD_REAL",
    "FUZ_MIN_INT",
    "FUZ_MIN_REAL",
    "FUZ_PROD_INT",
    "FUZ_PROD_REAL",
    "FUZ_STERM_INT",
    "FUZ_STERM_REAL",
    "FUZ_SUM_INT",
    "FUZ_SUM_REAL",
    "TABLE",
    "BlockType",
    "Event",
    "Instance",
    "Rounding",
]

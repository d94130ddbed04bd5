"""What a block type declares of itself."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from fcl_sim.units import Quantity, Unit


@dataclass(frozen=True, slots=True, kw_only=True)
class BlockParameter:
    """A constant of a block, required where it has no default.

    `unit` is what it must be commensurate with, None for any.
    """

    name: str
    unit: str | None
    meaning: str
    default: str | float | None = None


UnitRule = Callable[[Mapping[str, Unit], Mapping[str, Quantity]], Unit]
"""From the units of the inputs, by port, and the parameters to the output's; UnitError if they clash."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BlockType:
    """A kind of block.

    `ports` are its inputs. With `terms` it has any inputs, each with a gain,
    under that key. `equation` is the law, then the initial value. `states`
    counts its words of memory besides the output. `feedthrough` says whether
    the output of a scan depends on the inputs of that scan. `unit` is
    None where the node itself declares units, as a fuzzy block does.
    """

    name: str
    summary: str
    equation: str
    source: str
    ports: tuple[str, ...] = ()
    terms: str | None = None
    parameters: tuple[BlockParameter, ...] = ()
    states: int = 0
    feedthrough: bool = True
    unit: UnitRule | None

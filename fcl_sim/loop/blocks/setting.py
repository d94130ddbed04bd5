"""What a block in a loop is set up with: parameters as numbers, units, scan, and its own random numbers."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from hashlib import blake2b
from typing import Any

import numpy as np

from fcl_sim.units import Unit


@dataclass(frozen=True, slots=True, kw_only=True)
class Setting:
    """A block's surroundings, once its wires and units are known.

    `values` by parameter: quantities as numbers in their declared unit, lists
    as arrays (n,) and tables as arrays (n, columns) of such numbers, words,
    truths, counts and texts as they are, files as `Text`. `connected` are the ports
    that carry signals; `units` has the unit of each of them. `scan` is the nominal
    cycle time in nanoseconds, `scans` their number, the one at the end not counted.
    """

    name: str
    values: Mapping[str, Any]
    connected: tuple[str, ...] = ()
    units: Mapping[str, Unit] = field(default_factory=dict)
    scan: int = 0
    scans: int = 0
    seed: int = 0
    run: int = 0

    @property
    def cycle(self) -> float:
        """Nominal cycle time in seconds."""
        return self.scan / 1e9

    def random(self, stream: int = 0) -> np.random.Generator:
        """Return the block's own random numbers, Philox from (seed, run).

        They depend on the block's name and `stream`, not on the other blocks.
        """
        own = int.from_bytes(blake2b(self.name.encode(), digest_size=8).digest(), "little")
        key = np.array([self.seed, self.run], dtype=np.uint64)
        counter = np.array([0, 0, stream, own], dtype=np.uint64)
        return np.random.Generator(np.random.Philox(key=key, counter=counter))


@dataclass(frozen=True, slots=True)
class Text:
    """A file that a parameter names: its name for a reader and its content."""

    name: str
    text: str = field(repr=False)

    def __str__(self) -> str:
        return self.name

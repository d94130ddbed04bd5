"""Points of few digits around one that was found: what a person reads, and types in again."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product
from math import ceil, floor, log10

from fcl_sim.block import Block
from fcl_sim.proof.universe import Stretch, Universe

DIGITS = 7
"""Digits of the reach of an input from which on a point is taken as it was found."""
FEW = 3
"""Significant digits of numbers that are few as they stand."""


MOST = 0.99
"""The part of a difference that a point of few digits shows."""


@dataclass(frozen=True, slots=True)
class Shown:
    """A point of few digits at which most of a difference is to be seen: `old` became `new`."""

    at: Mapping[str, float] = field(default_factory=dict)
    old: float = 0.0
    new: float = 0.0


def shown(
    blocks: tuple[Block, Block],
    output: str,
    at: Mapping[str, float],
    reach: Sequence[float],
    universe: Universe,
) -> Shown:
    """Return the first point near `at` that shows most of how far two blocks are apart there.

    `reach` is how far each input goes, in the order of `at`.
    """

    def seen(point: Mapping[str, float]) -> Shown:
        values = []
        for block in blocks:
            own = {name.casefold(): each for name, each in block.evaluate(point).items()}
            values.append(float(own[output.casefold()]))
        return Shown(point, *values)

    there = seen(at)
    for point in points_near(at, dict(zip(at, reach, strict=True)), universe):
        found = seen(point)
        if abs(found.new - found.old) >= MOST * abs(there.new - there.old):
            return found
    return there


def points_near(
    at: Mapping[str, float], reach: Mapping[str, float], universe: Universe
) -> Iterator[dict[str, float]]:
    """Yield points of the universe around one, those of the fewest digits first, and at last itself.

    `reach` is how far each input goes.
    """
    if all(float(f"{each:.{FEW}g}") == each for each in at.values()):
        yield dict(at)
    for digits in range(1, DIGITS):
        for values in product(*(_rounded(value, reach[name], digits) for name, value in at.items())):
            point = dict(zip(at, values, strict=True))
            if all(_is_within(value, universe.of(name)) for name, value in point.items()):
                yield point
    yield dict(at)


def _is_within(value: float, stretch: Stretch | None) -> bool:
    return stretch is None or stretch[0] <= value <= stretch[1]


def _rounded(value: float, reach: float, digits: int) -> Iterable[float]:
    """Return a number to so many digits of a reach, downwards and upwards."""
    step = 10.0 ** (floor(log10(reach)) + 1 - digits) if reach > 0.0 else 1.0
    return dict.fromkeys(float(f"{end(value / step) * step:.12g}") for end in (floor, ceil))

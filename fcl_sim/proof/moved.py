"""Terms whose points variables move, over the ranges of these: where they hold surely, and where possibly.

Each point lies between two ends; so does the largest so far (S22). A degree is 0 at `x`
only if a point of degree 0 can lie there, a stretch between two such points can contain
it, or it can lie beyond an outermost one. That it is 1 is told likewise.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from fcl_sim.model import Points
from fcl_sim.proof.universe import Stretch
from fcl_sim.units import exact

End = Fraction | None
ZERO, ONE = Fraction(0), Fraction(1)
Reach = Callable[[str], Stretch | None]
"""From where to where a variable goes, if that is known."""


def nowhere(name: str) -> Stretch | None:
    """Return that nothing is known of how far a variable goes."""
    del name
    return None


@dataclass(frozen=True, slots=True)
class Spot:
    """A point of a term: from where to where it may lie, None for no end, and its degree."""

    low: End
    high: End
    degree: Fraction


def spots_of(shape: Points, reach: Reach) -> tuple[Spot, ...]:
    """Return the points of a term, each the largest so far."""
    found: list[Spot] = []
    for each in shape.points:
        if isinstance(each.x, str):
            stretch = reach(each.x)
            low, high = stretch or (None, None)
        else:
            low = high = exact(float(each.x))
        if found:
            before = found[-1]
            low = before.low if low is None else low if before.low is None else max(low, before.low)
            high = None if high is None or before.high is None else max(high, before.high)
        found.append(Spot(low, high, exact(each.degree)))
    return tuple(found)


def ends_of(spots: Sequence[Spot]) -> Iterator[Fraction]:
    """Yield every end of where a point may lie."""
    for each in spots:
        yield from (end for end in (each.low, each.high) if end is not None)


def may_be(spots: Sequence[Spot], degree: Fraction, low: End, high: End) -> bool:
    """Return whether a term may have the degree 0, or 1, anywhere between two ends, which are open.

    Where both ends are the same, at that point.
    """
    flags = [each.degree == degree for each in spots]
    return (
        (flags[0] and _may_lie_up_to(low, spots[0].high, low == high))
        or (flags[-1] and _may_lie_up_to(spots[-1].low, high, low == high))
        or any(flag and _meets(each, each, low, high) for flag, each in zip(flags, spots, strict=True))
        or any(
            one and other and _meets(a, b, low, high)
            for (one, a), (other, b) in pairwise(zip(flags, spots, strict=True))
        )
    )


def may_differ(spots: Sequence[Spot], degree: Fraction, low: End, high: End) -> bool:
    """Return whether a term may have another degree than 0, or 1, anywhere there."""
    others = [each.degree != degree for each in spots]
    return (
        (others[0] and _may_lie_up_to(low, spots[0].high, low == high))
        or (others[-1] and _may_lie_up_to(spots[-1].low, high, low == high))
        or any(flag and _meets(each, each, low, high) for flag, each in zip(others, spots, strict=True))
        or any(
            (one or other) and _meets(a, b, low, high, strictly=not (one and other))
            for (one, a), (other, b) in pairwise(zip(others, spots, strict=True))
        )
    )


def _meets(first: Spot, last: Spot, low: End, high: End, *, strictly: bool = False) -> bool:
    """Return whether what lies between two spots, `strictly`, may meet what lies between two ends."""
    closed = low == high and not strictly
    return _may_lie_up_to(first.low, high, closed) and _may_lie_up_to(low, last.high, closed)


def _may_lie_up_to(low: End, high: End, closed: bool) -> bool:  # noqa: FBT001  as an operator
    return low is None or high is None or (low <= high if closed else low < high)

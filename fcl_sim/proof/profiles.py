"""Functions of one number that are straight between knots, in fractions, with their edges.

A profile has at each knot a value of its own and one on either side of it: an edge
is there, and a place of no width.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from itertools import pairwise

from fcl_sim.engine.grid import Base

Change = Callable[[Fraction], Fraction]


@dataclass(frozen=True, slots=True)
class Knot:
    """What a profile is at `x`, and what it comes from and goes to there."""

    x: Fraction
    before: Fraction
    at: Fraction
    after: Fraction


Profile = tuple[Knot, ...]
"""Knots from the one end to the other, rising."""


def constant(value: Fraction, low: Fraction, high: Fraction) -> Profile:
    """Return the same everywhere."""
    return tuple(Knot(x, value, value, value) for x in sorted({low, high}))


def of_base(base: Base, low: Fraction, high: Fraction) -> Profile:
    """Return base points between two ends (S20, S21)."""
    inner = [x for x, _ in base if low < x < high]
    return tuple(_knot(base, x) for x in sorted({low, high, *inner}))


def _knot(base: Base, x: Fraction) -> Knot:
    here = [degree for place, degree in base if place == x]
    if here:
        return Knot(x, here[0], max(here), here[-1])
    for (left, low), (right, high) in pairwise(base):
        if left < x < right:
            value = low + (high - low) * (x - left) / (right - left)
            return Knot(x, value, value, value)
    value = base[0][1] if x < base[0][0] else base[-1][1]
    return Knot(x, value, value, value)


def changed(own: Profile, change: Change) -> Profile:
    """Return a profile with each value changed; where that bends, it must have a knot."""
    return tuple(Knot(each.x, change(each.before), change(each.at), change(each.after)) for each in own)


def cut(own: Profile, level: Fraction) -> Profile:
    """Return a profile with a knot more wherever it crosses a level."""
    crossings = [
        a.x + (b.x - a.x) * (level - a.after) / (b.before - a.after)
        for a, b in pairwise(own)
        if min(a.after, b.before) < level < max(a.after, b.before)
    ]
    return refined(own, crossings)


def refined(own: Profile, xs: Iterable[Fraction]) -> Profile:
    """Return a profile with knots at all of `xs`, which lie between its ends."""
    known = {each.x for each in own}
    waiting = sorted({x for x in xs if x not in known}, reverse=True)
    found = [own[0]]
    for a, b in pairwise(own):
        while waiting and waiting[-1] < b.x:
            x = waiting.pop()
            value = a.after + (b.before - a.after) * (x - a.x) / (b.x - a.x)
            found.append(Knot(x, value, value, value))
        found.append(b)
    return tuple(found)


def summed(profiles: Sequence[Profile]) -> Profile:
    """Return the sum of several profiles."""
    return reduce(_sum, profiles)


def largest(profiles: Sequence[Profile]) -> Profile:
    """Return the largest of several profiles everywhere."""
    return reduce(_maximum, profiles)


def crossings(one: Profile, other: Profile) -> list[Fraction]:
    """Return where two profiles cross between their knots."""
    found = []
    for (a, b), (next_a, next_b) in pairwise(_together(one, other)):
        first, last = a.after - b.after, next_a.before - next_b.before
        if first * last < 0:
            found.append(a.x + (next_a.x - a.x) * first / (first - last))
    return found


def _together(one: Profile, other: Profile) -> Iterator[tuple[Knot, Knot]]:
    """Yield the knots of two profiles at the places of both."""
    yield from zip(
        refined(one, (each.x for each in other)), refined(other, (each.x for each in one)), strict=True
    )


def _sum(one: Profile, other: Profile) -> Profile:
    return tuple(
        Knot(a.x, a.before + b.before, a.at + b.at, a.after + b.after) for a, b in _together(one, other)
    )


def _maximum(one: Profile, other: Profile) -> Profile:
    places = crossings(one, other)
    return tuple(
        Knot(a.x, max(a.before, b.before), max(a.at, b.at), max(a.after, b.after))
        for a, b in _together(refined(one, places), refined(other, places))
    )

"""Accumulated membership functions in fractions, and the number that is made of one (Tables 1 and 2).

A profile is straight between its knots, and has at each knot a value of its own
and one on either side of it: an edge is there, and a place of no width.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from itertools import pairwise

from fcl_sim.engine.grid import Base
from fcl_sim.model import Accumulation, Activation, Method
from fcl_sim.proof.rationals import ONE, ZERO, NotExact, root

Change = Callable[[Fraction], Fraction]


@dataclass(frozen=True, slots=True)
class Knot:
    """What a profile is at `x`, and what it comes from and goes to there."""

    x: Fraction
    before: Fraction
    at: Fraction
    after: Fraction


Profile = tuple[Knot, ...]
"""Knots from the one limit of the output to the other, rising."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Piece:
    """What a conclusion of a rule that fires gives: a term with its points, activated and then weighted."""

    activation: Activation
    degree: Fraction
    weight: Fraction
    base: Base


def profile(piece: Piece, low: Fraction, high: Fraction) -> Profile:
    """Return what one conclusion gives between limits (Table 4, A.15)."""
    inner = [x for x, _ in piece.base if low < x < high]
    own = tuple(_knot(piece.base, x) for x in sorted({low, high, *inner}))
    degree = piece.degree
    match piece.activation:
        case Activation.MIN:
            return _changed(_cut(own, degree), lambda value: piece.weight * min(degree, value))
        case Activation.PROD:
            return _changed(own, lambda value: piece.weight * degree * value)
        case Activation.BDIF:
            return _changed(_cut(own, 1 - degree), lambda value: piece.weight * max(ZERO, degree + value - 1))
    raise NotExact(f"ACT {piece.activation} makes areas that are not followed in fractions")


def accumulated(kind: Accumulation, profiles: Sequence[Profile]) -> Profile:
    """Return the accumulation of one rule block, or of several that agree (Table 5, S25)."""
    if kind is Accumulation.MAX:
        return largest(profiles)
    total = reduce(_sum, profiles)
    match kind:
        case Accumulation.SUM:
            return total
        case Accumulation.BSUM:
            return _changed(_cut(total, ONE), lambda value: min(ONE, value))
        case Accumulation.NSUM:
            divisor = max(ONE, height(total))
            return _changed(total, lambda value: value / divisor)
    raise NotExact(f"ACCU {kind} makes areas that are not followed in fractions")


def largest(profiles: Sequence[Profile]) -> Profile:
    """Return the largest of several profiles everywhere."""
    return reduce(_maximum, profiles)


def height(own: Profile) -> Fraction:
    """Return the largest value."""
    return max(each.at for each in own)


def content(own: Profile) -> Fraction:
    """Return the area."""
    return sum(((b.x - a.x) * (a.after + b.before) / 2 for a, b in pairwise(own)), ZERO)


def defuzzified(method: Method, own: Profile) -> tuple[Fraction, bool]:
    """Return the number that is made of an area that is not 0, and whether it is exact."""
    match method:
        case Method.COG:
            moments = (
                (b.x - a.x) * (a.x * (2 * a.after + b.before) + b.x * (a.after + 2 * b.before)) / 6
                for a, b in pairwise(own)
            )
            return sum(moments, ZERO) / content(own), True
        case Method.COA:
            return _halving(own)
    tops = [each.x for each in own if each.at == height(own)]
    ends = {Method.LM: tops[0], Method.RM: tops[-1]}
    return ends.get(method, (tops[0] + tops[-1]) / 2), True


def _halving(own: Profile) -> tuple[Fraction, bool]:
    """Return where the area is halved; the middle of the gap where that is at one (S33a)."""
    half, before = content(own) / 2, ZERO
    reached = []
    for a, b in pairwise(own):
        part = (b.x - a.x) * (a.after + b.before) / 2
        if before < half < before + part:
            slope = (b.before - a.after) / (b.x - a.x)
            steep, is_exact = root(a.after**2 + 2 * slope * (half - before))
            return a.x + 2 * (half - before) / (a.after + steep), is_exact
        before += part
        if before == half:
            reached.append(b.x)
    return (reached[0] + reached[-1]) / 2, True


def _knot(base: Base, x: Fraction) -> Knot:
    """Return a term at `x`: the largest degree of the points that lie there (S20, S21)."""
    here = [degree for place, degree in base if place == x]
    if here:
        return Knot(x, here[0], max(here), here[-1])
    for (left, low), (right, high) in pairwise(base):
        if left < x < right:
            value = low + (high - low) * (x - left) / (right - left)
            return Knot(x, value, value, value)
    value = base[0][1] if x < base[0][0] else base[-1][1]
    return Knot(x, value, value, value)


def _changed(own: Profile, change: Change) -> Profile:
    return tuple(Knot(each.x, change(each.before), change(each.at), change(each.after)) for each in own)


def _cut(own: Profile, level: Fraction) -> Profile:
    """Return a profile with a knot more wherever it crosses a level."""
    crossings = [
        a.x + (b.x - a.x) * (level - a.after) / (b.before - a.after)
        for a, b in pairwise(own)
        if min(a.after, b.before) < level < max(a.after, b.before)
    ]
    return _refined(own, crossings)


def _refined(own: Profile, xs: Iterable[Fraction]) -> Profile:
    """Return a profile with knots at all of `xs`, which lie within it."""
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


def _together(one: Profile, other: Profile) -> Iterator[tuple[Knot, Knot]]:
    """Yield the knots of two profiles at the places of both."""
    yield from zip(
        _refined(one, (each.x for each in other)), _refined(other, (each.x for each in one)), strict=True
    )


def _sum(one: Profile, other: Profile) -> Profile:
    return tuple(
        Knot(a.x, a.before + b.before, a.at + b.at, a.after + b.after) for a, b in _together(one, other)
    )


def _maximum(one: Profile, other: Profile) -> Profile:
    pairs = list(_together(one, other))
    crossings = []
    for (a, b), (next_a, next_b) in pairwise(pairs):
        first, last = a.after - b.after, next_a.before - next_b.before
        if first * last < 0:
            crossings.append(a.x + (next_a.x - a.x) * first / (first - last))
    return tuple(
        Knot(a.x, max(a.before, b.before), max(a.at, b.at), max(a.after, b.after))
        for a, b in _together(_refined(one, crossings), _refined(other, crossings))
    )

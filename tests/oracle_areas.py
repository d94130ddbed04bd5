"""The second opinion on outputs with areas: literal, exact, in fractions.

An accumulated membership function is a function of u here, evaluated rule by
rule. Between its breakpoints it is a straight line; the breakpoints are found
by crossing every line with every other. Nothing is merged, nothing is sorted
by height, nothing is shared with the engine.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, pairwise
from math import isqrt

from fcl_sim.model import Accumulation, Activation, Method

ZERO, ONE = Fraction(0), Fraction(1)
Points = tuple[tuple[Fraction, Fraction], ...]
Function = Callable[[Fraction], Fraction]
Line = tuple[Fraction, Fraction]
"""Its values at the two ends of an interval, as limits from within."""


@dataclass(frozen=True)
class Contribution:
    """A conclusion of a rule that fired: activated, then weighted (A.15)."""

    block: int
    activation: Activation
    degree: Fraction
    weight: Fraction
    points: Points

    def __call__(self, u: Fraction) -> Fraction:
        mu = degree_at(self.points, u)
        return self.weight * (min(self.degree, mu) if self.activation is Activation.MIN else self.degree * mu)


@dataclass(frozen=True)
class Area:
    """An accumulated membership function: straight pieces (a, value, b, value), and values at knots."""

    low: Fraction
    high: Fraction
    pieces: tuple[tuple[Fraction, Fraction, Fraction, Fraction], ...]
    values: tuple[tuple[Fraction, Fraction], ...]

    @property
    def height(self) -> Fraction:
        return max((value for _, value in self.values), default=ZERO)

    @property
    def content(self) -> Fraction:
        return sum(((b - a) * (left + right) / 2 for a, left, b, right in self.pieces), ZERO)


def degree_at(points: Points, x: Fraction) -> Fraction:
    """Return the degree of `x` (5.2.2)."""
    here = [degree for at, degree in points if at == x]
    if here:
        return max(here)  # S21
    if x < points[0][0]:
        return points[0][1]  # S20
    if x > points[-1][0]:
        return points[-1][1]
    (left, low), (right, high) = next((a, b) for a, b in pairwise(points) if a[0] < x < b[0])
    return low + (high - low) * (x - left) / (right - left)


def accumulated_area(
    contributions: Sequence[Contribution],
    algorithms: dict[int, Accumulation],
    limits: tuple[Fraction, Fraction],
) -> Area:
    """Return what the contributions accumulate to within the limits.

    `algorithms` are those of the rule blocks that conclude on the output: one
    group where they agree, else a group for each (S26).
    """
    low, high = limits
    if len(set(algorithms.values())) == 1:
        groups = [(next(iter(algorithms.values())), list(contributions))]
    else:
        groups = [
            (algorithm, [each for each in contributions if each.block == number])
            for number, algorithm in algorithms.items()
        ]
    groups = [(algorithm, members) for algorithm, members in groups if members]
    knots = first_knots(contributions, low, high)
    divisors = [largest_sum(members, knots) for _, members in groups]
    lines: list[Function] = [lambda u: ONE]
    for (algorithm, members), divisor in zip(groups, divisors, strict=True):
        lines += members if algorithm is Accumulation.MAX else [summed(members, divisor, algorithm)]
    knots = crossed(lines, knots)

    def total(u: Fraction) -> Fraction:
        return max(
            (
                max(member(u) for member in members)
                if algorithm is Accumulation.MAX
                else min(ONE, summed(members, divisor, algorithm)(u))
                for (algorithm, members), divisor in zip(groups, divisors, strict=True)
            ),
            default=ZERO,
        )

    pieces = []
    for a, b in pairwise(knots):
        left, right = limits_within(total, a, b)
        pieces.append((a, left, b, right))
    return Area(low, high, tuple(pieces), tuple((u, total(u)) for u in knots))


def summed(members: list[Contribution], divisor: Fraction, algorithm: Accumulation) -> Function:
    """Return the sum of BSUM before its bound, or that of NSUM (Table 5)."""
    by = divisor if algorithm is Accumulation.NSUM else ONE
    return lambda u: sum((member(u) for member in members), ZERO) / by


def largest_sum(members: list[Contribution], knots: list[Fraction]) -> Fraction:
    """Return what NSUM divides by (S25): between knots the sum is straight, so one of them has it."""
    return max(ONE, *(sum(member(u) for member in members) for u in knots))


def first_knots(contributions: Sequence[Contribution], low: Fraction, high: Fraction) -> list[Fraction]:
    """Return the limits, and all base points and places between them where a contribution is clipped."""
    knots = {low, high}
    for each in contributions:
        knots |= {x for x, _ in each.points}
        for (left, a), (right, b) in pairwise(each.points):
            if min(a, b) < each.degree < max(a, b):
                knots.add(left + (right - left) * (each.degree - a) / (b - a))
    return sorted(knot for knot in knots if low <= knot <= high)


def limits_within(function: Function, a: Fraction, b: Fraction) -> Line:
    """Return the limits at both ends of an interval of a function that is straight inside it."""
    first, second = function(a + (b - a) / 3), function(b - (b - a) / 3)
    return 2 * first - second, 2 * second - first


def crossed(lines: list[Function], knots: list[Fraction]) -> list[Fraction]:
    """Return the knots and all places between them where two lines cross."""
    found = set(knots)
    for a, b in pairwise(knots):
        ends = {limits_within(line, a, b) for line in lines}
        for (left, right), (other_left, other_right) in combinations(ends, 2):
            before, after = left - other_left, right - other_right
            if before * after < 0:
                found.add(a + (b - a) * before / (before - after))
    return sorted(found)


def defuzzified(method: Method, area: Area) -> Fraction:
    """Return the output (Table 2) of an area that is not 0."""
    if method is Method.COG:
        return centre_of_gravity(area)
    if method is Method.COA:
        return centre_of_area(area)
    places = [u for u, value in area.values if value == area.height]
    if method is Method.LM:
        return places[0]
    if method is Method.RM:
        return places[-1]
    assert method is Method.MM
    return (places[0] + places[-1]) / 2


def centre_of_gravity(area: Area) -> Fraction:
    moment = sum(
        (b - a) * (a * (2 * left + right) + b * (left + 2 * right)) / 6 for a, left, b, right in area.pieces
    )
    return moment / area.content


def centre_of_area(area: Area) -> Fraction:
    """Return u' with equal areas on both sides; the middle of the gap where there is one (S33a)."""
    half = area.content / 2
    before = ZERO
    reached = []
    for a, left, b, right in area.pieces:
        own = (b - a) * (left + right) / 2
        if before == half:
            reached.append(a)
        if before < half < before + own:
            return solved(a, left, (right - left) / (b - a), half - before)
        before += own
        if before == half:
            reached.append(b)
    return (reached[0] + reached[-1]) / 2


def solved(a: Fraction, value: Fraction, slope: Fraction, rest: Fraction) -> Fraction:
    """Return where value t + slope t² / 2 reaches the rest."""
    return a + 2 * rest / (value + root(value * value + 2 * slope * rest))


def root(square: Fraction) -> Fraction:
    """Return a square root to 10**-60 of itself and better."""
    bits = max(0, 400 - square.numerator.bit_length() + square.denominator.bit_length())
    bits += bits % 2
    return Fraction(isqrt((square.numerator << bits) // square.denominator), 1 << bits // 2)

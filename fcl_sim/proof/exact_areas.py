"""Accumulated membership functions in fractions, and the number that is made of one (Tables 1 and 2)."""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from fcl_sim.engine.grid import Base
from fcl_sim.model import Accumulation, Activation, Method
from fcl_sim.proof.profiles import Profile, changed, cut, largest, of_base, summed
from fcl_sim.proof.rationals import ONE, ZERO, NotExact, root


@dataclass(frozen=True, slots=True, kw_only=True)
class Piece:
    """What a conclusion of a rule that fires gives: a term with its points, activated and then weighted."""

    activation: Activation
    degree: Fraction
    weight: Fraction
    base: Base


def profile(piece: Piece, low: Fraction, high: Fraction) -> Profile:
    """Return what one conclusion gives between limits (Table 4, A.15)."""
    own, degree = of_base(piece.base, low, high), piece.degree
    match piece.activation:
        case Activation.MIN:
            return changed(cut(own, degree), lambda value: piece.weight * min(degree, value))
        case Activation.PROD:
            return changed(own, lambda value: piece.weight * degree * value)
        case Activation.BDIF:
            return changed(cut(own, 1 - degree), lambda value: piece.weight * max(ZERO, degree + value - 1))
    raise NotExact(f"ACT {piece.activation} makes areas that are not followed in fractions")


def accumulated(kind: Accumulation, profiles: Sequence[Profile]) -> Profile:
    """Return the accumulation of one rule block, or of several that agree (Table 5, S25)."""
    if kind is Accumulation.MAX:
        return largest(profiles)
    total = summed(profiles)
    match kind:
        case Accumulation.SUM:
            return total
        case Accumulation.BSUM:
            return changed(cut(total, ONE), lambda value: min(ONE, value))
        case Accumulation.NSUM:
            divisor = max(ONE, height(total))
            return changed(total, lambda value: value / divisor)
    raise NotExact(f"ACCU {kind} makes areas that are not followed in fractions")


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

"""Linear inequalities in fractions: a point that keeps to all of them, or that there is none.

Variables are eliminated one by one (Fourier and Motzkin): each lower bound of a
variable is to lie below each upper one. Meant for the few of a cell.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

MOST = 4000
"""Inequalities that are kept in mind; with more nothing is told."""


@dataclass(frozen=True, slots=True)
class Inequality:
    """`constant` plus the sum of `factors` times variables, by number, is above 0, or 0 unless `strict`."""

    factors: tuple[tuple[int, Fraction], ...]
    constant: Fraction
    strict: bool

    def factor(self, variable: int) -> Fraction:
        """Return the factor of a variable."""
        return next((factor for own, factor in self.factors if own == variable), Fraction(0))


class TooMany(ValueError):
    """There are more inequalities than are kept in mind."""


def solution(inequalities: Sequence[Inequality], variables: int) -> list[Fraction] | None:
    """Return numbers from 0 to 1 that keep to all inequalities, in their midst; None where there are none."""
    stages = [list(inequalities)]
    for variable in range(variables - 1, -1, -1):
        stages.append(_eliminated(stages[-1], variable))
    if not all(_holds(each) for each in stages[-1]):
        return None
    found: list[Fraction] = []
    for variable in range(variables):
        found.append(_between(stages[variables - 1 - variable], variable, found))
    return found


def _holds(own: Inequality) -> bool:
    return own.constant > 0 if own.strict else own.constant >= 0


def _eliminated(inequalities: Sequence[Inequality], variable: int) -> list[Inequality]:
    rest = [each for each in inequalities if each.factor(variable) == 0]
    lower = [each for each in inequalities if each.factor(variable) > 0]
    upper = [each for each in inequalities if each.factor(variable) < 0]
    if len(rest) + len(lower) * len(upper) > MOST:
        raise TooMany
    both = {_added(one, other, variable) for one in lower for other in upper}
    return [*rest, *both]


def _added(one: Inequality, other: Inequality, variable: int) -> Inequality:
    """Return what follows from two inequalities without a variable of which they bound either side."""
    first, second = -other.factor(variable), one.factor(variable)
    factors: dict[int, Fraction] = {}
    for weight, each in ((first, one), (second, other)):
        for own, factor in each.factors:
            factors[own] = factors.get(own, Fraction(0)) + weight * factor
    return Inequality(
        tuple(sorted((own, factor) for own, factor in factors.items() if factor != 0)),
        first * one.constant + second * other.constant,
        one.strict or other.strict,
    )


def _between(inequalities: Sequence[Inequality], variable: int, before: Sequence[Fraction]) -> Fraction:
    """Return a value of a variable, those before it being chosen; those behind it do not occur."""
    lows, highs = [Fraction(0)], [Fraction(1)]
    for each in inequalities:
        factor = each.factor(variable)
        if factor != 0:
            rest = sum((own * before[name] for name, own in each.factors if name != variable), each.constant)
            (lows if factor > 0 else highs).append(-rest / factor)
    return (max(lows) + min(highs)) / 2

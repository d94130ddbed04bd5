"""Operators, hedges and formulae of rule bases in fractions; what is no fraction is said to be rounded."""

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import reduce
from math import isqrt

from fcl_sim.model import Accumulation, AndOperator, Hedge, Number, Operation, Operator, OrOperator, Reference
from fcl_sim.model.expressions import Call, Expression
from fcl_sim.proof.spans import OPPOSITES
from fcl_sim.units import exact

ZERO, ONE = Fraction(0), Fraction(1)
Norm = Callable[[Fraction, Fraction], Fraction]

DIGITS = 40
"""Decimal digits of a root that is no fraction."""


class NotExact(ValueError):
    """An evaluation is none in fractions: the message says what is not."""


NORMS: dict[AndOperator, Norm] = {
    AndOperator.MIN: min,
    AndOperator.PROD: lambda a, b: a * b,
    AndOperator.BDIF: lambda a, b: max(ZERO, a + b - 1),
    AndOperator.HPROD: lambda a, b: a * b / (a + b - a * b) if a or b else ZERO,
    AndOperator.EPROD: lambda a, b: a * b / (2 - (a + b - a * b)),
    AndOperator.DPROD: lambda a, b: min(a, b) if max(a, b) == 1 else ZERO,
    AndOperator.NMIN: lambda a, b: min(a, b) if a + b > 1 else ZERO,
}


def conjunction(operator: AndOperator, degrees: Sequence[Fraction]) -> Fraction:
    """Return AND of degrees (Table 3)."""
    return reduce(NORMS[operator], degrees)


def disjunction(operator: OrOperator | Accumulation, degrees: Sequence[Fraction]) -> Fraction:
    """Return OR of degrees, or an accumulation that is one, by de Morgan's law; 0 of none."""
    return 1 - reduce(NORMS[OPPOSITES[operator]], (1 - each for each in degrees), ONE)


def clamped(value: Fraction) -> Fraction:
    """Return a number taken into [0, 1] (S27)."""
    return min(ONE, max(ZERO, value))


def root(square: Fraction) -> tuple[Fraction, bool]:
    """Return a square root, and whether it is exact; else it has DIGITS digits behind its first."""
    above, below = isqrt(square.numerator), isqrt(square.denominator)
    if above * above == square.numerator and below * below == square.denominator:
        return Fraction(above, below), True
    scale = 10 ** (DIGITS + len(str(square.denominator)))
    return Fraction(isqrt(square.numerator * scale * scale // square.denominator), scale), False


def hedged(hedge: Hedge, degree: Fraction) -> tuple[Fraction, bool]:
    """Return what a hedge makes of a degree, and whether that is exact."""
    match hedge:
        case Hedge.ANY:
            return ONE, True
        case Hedge.NOT:
            return 1 - degree, True
        case Hedge.VERY:
            return degree * degree, True
        case Hedge.SOMEWHAT:
            return root(degree)
        case Hedge.EXTREMELY:
            return (2 * degree**2 if degree <= Fraction(1, 2) else 1 - 2 * (1 - degree) ** 2), True
    found, is_exact = root(min(degree, 1 - degree) / 2)
    return (found if degree <= Fraction(1, 2) else 1 - found), is_exact


def calculated(expression: Expression, value_of: Callable[[str], Fraction]) -> Fraction:
    """Return the value of a formula (Open Level); raises NotExact where it calls a function."""
    match expression:
        case Number(value):
            return exact(value)
        case Reference(variable):
            return value_of(variable)
        case Operation(operator, arguments):
            return _operated(operator, [calculated(each, value_of) for each in arguments])
        case Call(function):
            raise NotExact(f"a formula calls `{function}`")


def _operated(operator: Operator, values: Sequence[Fraction]) -> Fraction:
    match operator:
        case Operator.PLUS:
            return sum(values, ZERO)
        case Operator.TIMES:
            return reduce(lambda a, b: a * b, values, ONE)
        case Operator.MINUS:
            return -values[0] if len(values) == 1 else values[0] - values[1]
        case Operator.OVER if values[1] != 0:
            return values[0] / values[1]
        case Operator.POWER if values[1].denominator == 1 and (values[0] != 0 or values[1] >= 0):
            return values[0] ** int(values[1])
    raise NotExact(f"a formula has `{operator}` of {' and '.join(map(str, values))}")

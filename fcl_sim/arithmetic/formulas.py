"""Operators and functions of formulae (Open Level), on numbers.

Where there is no number, as for the root of -1 or 0 / 0, the result is NaN;
what is too large is infinite.
"""

from math import inf, nan

from numpy import fmod

from fcl_sim.arithmetic import functions
from fcl_sim.arithmetic.functions import (
    acos,
    acosh,
    asin,
    asinh,
    atan,
    atan2,
    atanh,
    ceil,
    cos,
    cosh,
    exp,
    floor,
    log,
    log1p,
    log10,
    sin,
    sinh,
    sqrt,
    tan,
    tanh,
)
from fcl_sim.jit import flat, inlined

POWER, MODULUS, TIMES, OVER, PLUS, MINUS, ATAN2, MAX, MIN = range(9)
EQ, NEQ, LT, LE, GT, GE = range(9, 15)
OPPOSITE, ABS, ACOS, ASIN, ATAN, CEIL, COS, COSH, EXP, FLOOR, LN, LOG10 = range(15, 27)
ROUND, SIN, SINH, SQRT, TAN, TANH, ACOSH, ASINH, ATANH, LOG1P = range(27, 37)

BINARY = OPPOSITE
"""Below this code, operators and functions have two numbers; from it on, one."""
LARGEST_EXPONENT = 709.78
"""Up to here the exponential function is a number."""
HALF = 0.69
"""And so much farther half of it."""
WHOLE = 2.0**52
"""From here on, all numbers are whole."""


@inlined
def is_number(a: float) -> bool:
    """Return whether a number is finite."""
    return a - a == 0.0


@flat
def power(a: float, b: float) -> float:
    """Return a to the power of b; real numbers only."""
    if b == 0.0:
        return 1.0
    if a == 0.0:
        return 0.0 if b > 0.0 else inf
    if not (is_number(a) and is_number(b)) or (a < 0.0 and abs(b) < WHOLE and b != floor(b)):
        return nan
    size = inf if b * log(abs(a)) > LARGEST_EXPONENT else functions.power(abs(a), b)
    return -size if a < 0.0 and fmod(b, 2.0) != 0.0 else size


@flat
def over(a: float, b: float) -> float:
    """Return a / b."""
    if b != 0.0:
        return a / b
    return inf if a > 0.0 else -inf if a < 0.0 else nan


@flat
def of_two(code: int, a: float, b: float) -> float:
    """Return the result of an operator or function of two numbers."""
    if code == POWER:
        value = power(a, b)
    elif code == MODULUS:
        value = fmod(a, b) if b != 0.0 and is_number(a) and b == b else nan  # noqa: PLR0124  NaN is not itself
    elif code == TIMES:
        value = a * b
    elif code == OVER:
        value = over(a, b)
    elif code == PLUS:
        value = a + b
    elif code == MINUS:
        value = a - b
    elif code == ATAN2:
        value = atan2(a, b)
    elif code == MAX:
        value = a if a > b or a != a else b  # noqa: PLR0124
    elif code == MIN:
        value = a if a < b or a != a else b  # noqa: PLR0124
    else:
        value = compared(code, a, b)
    return value


@flat
def compared(code: int, a: float, b: float) -> float:
    """Return 1 where a comparison holds, else 0."""
    if a != a or b != b:  # noqa: PLR0124
        return nan
    if code == EQ:
        holds = a == b
    elif code == NEQ:
        holds = a != b
    elif code == LT:
        holds = a < b
    elif code == LE:
        holds = a <= b
    elif code == GT:
        holds = a > b
    else:
        holds = a >= b
    return 1.0 if holds else 0.0


@flat
def of_one(code: int, a: float) -> float:
    """Return the result of an operator or function of one number."""
    if code == OPPOSITE:
        value = -a
    elif code == ABS:
        value = abs(a)
    elif not is_number(a):
        value = nan
    elif code in (CEIL, FLOOR, ROUND):
        value = whole(code, a)
    elif code in (ACOS, ASIN, LN, LOG10, SQRT):
        value = bounded(code, a)
    elif code in (EXP, COSH, SINH):
        value = growing(code, a)
    elif code in (ACOSH, ASINH, ATANH, LOG1P):
        value = inverse(code, a)
    else:
        value = circular(code, a)
    return value


@flat
def whole(code: int, a: float) -> float:
    """Return a whole number near `a`; of two equally near ones, ROUND takes the one farther from 0."""
    size = abs(a)
    if size >= WHOLE:
        return a
    if code == CEIL:
        return ceil(a)
    if code == FLOOR:
        return floor(a)
    below = floor(size)
    rounded = below + 1.0 if size - below >= 0.5 else below
    return rounded if a >= 0.0 else -rounded


@flat
def bounded(code: int, a: float) -> float:
    """Return a function that not every number has a result of."""
    if code in (ACOS, ASIN):
        if abs(a) > 1.0:
            return nan
        return acos(a) if code == ACOS else asin(a)
    if a < 0.0:
        return nan
    if code == SQRT:
        return sqrt(a)
    if a == 0.0:
        return -inf
    return log(a) if code == LN else log10(a)


@flat
def growing(code: int, a: float) -> float:
    """Return a function that grows beyond all numbers."""
    if code == EXP:
        return inf if a > LARGEST_EXPONENT else exp(a)
    if abs(a) > LARGEST_EXPONENT + HALF:
        return -inf if code == SINH and a < 0.0 else inf
    return cosh(a) if code == COSH else sinh(a)


@flat
def inverse(code: int, a: float) -> float:
    """Return the inverse of a hyperbolic function, or that of the exponential less 1."""
    if code == ASINH:
        return asinh(a)
    if code == ACOSH:
        return nan if a < 1.0 else acosh(a)
    if code == LOG1P:
        return nan if a < -1.0 else -inf if a == -1.0 else log1p(a)
    if abs(a) >= 1.0:
        return inf if a == 1.0 else -inf if a == -1.0 else nan
    return atanh(a)


@flat
def circular(code: int, a: float) -> float:
    """Return a function of an angle, or an angle, or the hyperbolic tangent."""
    if code == SIN:
        value = sin(a)
    elif code == COS:
        value = cos(a)
    elif code == TAN:
        value = tan(a)
    elif code == ATAN:
        value = atan(a)
    else:
        value = tanh(a)
    return value

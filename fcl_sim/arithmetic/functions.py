"""Elementary functions in the precision of their argument: computed in binary64, and rounded once.

The libraries of binary32 differ from machine to machine in the last digit; of
these results only the rounding is seen.
"""

import math

from numpy import float64

from fcl_sim.jit import rounded


@rounded
def sqrt(x: float) -> float:
    """Return the square root."""
    return type(x)(math.sqrt(float64(x)))


@rounded
def exp(x: float) -> float:
    """Return the exponential function."""
    return type(x)(math.exp(float64(x)))


@rounded
def expm1(x: float) -> float:
    """Return the exponential function less 1."""
    return type(x)(math.expm1(float64(x)))


@rounded
def log(x: float) -> float:
    """Return the natural logarithm."""
    return type(x)(math.log(float64(x)))


@rounded
def log10(x: float) -> float:
    """Return the decimal logarithm."""
    return type(x)(math.log10(float64(x)))


@rounded
def power(x: float, exponent: float) -> float:
    """Return a power of a number from 0 on."""
    return type(x)(float64(x) ** float64(exponent))


@rounded
def sin(x: float) -> float:
    """Return the sine."""
    return type(x)(math.sin(float64(x)))


@rounded
def cos(x: float) -> float:
    """Return the cosine."""
    return type(x)(math.cos(float64(x)))


@rounded
def tan(x: float) -> float:
    """Return the tangent."""
    return type(x)(math.tan(float64(x)))


@rounded
def asin(x: float) -> float:
    """Return the angle of a sine."""
    return type(x)(math.asin(float64(x)))


@rounded
def acos(x: float) -> float:
    """Return the angle of a cosine."""
    return type(x)(math.acos(float64(x)))


@rounded
def atan(x: float) -> float:
    """Return the angle of a tangent."""
    return type(x)(math.atan(float64(x)))


@rounded
def atan2(y: float, x: float) -> float:
    """Return the angle of a point."""
    return type(x)(math.atan2(float64(y), float64(x)))


@rounded
def sinh(x: float) -> float:
    """Return the hyperbolic sine."""
    return type(x)(math.sinh(float64(x)))


@rounded
def cosh(x: float) -> float:
    """Return the hyperbolic cosine."""
    return type(x)(math.cosh(float64(x)))


@rounded
def tanh(x: float) -> float:
    """Return the hyperbolic tangent."""
    return type(x)(math.tanh(float64(x)))


@rounded
def floor(x: float) -> float:
    """Return the largest whole number up to `x`, whose magnitude is below 2^53."""
    return type(x)(math.floor(float64(x)))


@rounded
def ceil(x: float) -> float:
    """Return the smallest whole number from `x` on, whose magnitude is below 2^53."""
    return type(x)(math.ceil(float64(x)))


@rounded
def acosh(x: float) -> float:
    """Return the inverse of the hyperbolic cosine, from 0 on."""
    return type(x)(math.acosh(float64(x)))


@rounded
def asinh(x: float) -> float:
    """Return the inverse of the hyperbolic sine."""
    return type(x)(math.asinh(float64(x)))


@rounded
def atanh(x: float) -> float:
    """Return the inverse of the hyperbolic tangent."""
    return type(x)(math.atanh(float64(x)))


@rounded
def log1p(x: float) -> float:
    """Return the natural logarithm of 1 + x."""
    return type(x)(math.log1p(float64(x)))

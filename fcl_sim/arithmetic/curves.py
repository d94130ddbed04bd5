"""Smooth membership functions (Open Level): the formulae that model.curves states.

Each comes as a degree and 1 minus it, both to their own digits. Parameters may
be moved by variables: what they make of no meaning, such as a deviation of 0
at the mean itself, has the degree 0.
"""

from math import inf, pi

from fcl_sim.arithmetic.functions import cos, exp, expm1, log, sin
from fcl_sim.arithmetic.operators import maximum
from fcl_sim.jit import flat, inlined
from fcl_sim.model.curves import CurveKind

Pair = tuple[float, float]
"""A degree and its complement."""

CODES = {kind: code for code, kind in enumerate(CurveKind)}
"""The number of each kind."""
PARAMETERS = 4
"""As many as any kind has."""
ARITIES = (2, 4, 3, 2, 4, 4, 4, 2, 2, 2, 4, 2, 2)
"""How many each has."""
(
    GAUSSIAN,
    GAUSSIAN_PRODUCT,
    BELL,
    SIGMOID,
    SIGMOID_DIFFERENCE,
    SIGMOID_DISTANCE,
    SIGMOID_PRODUCT,
    COSINE,
    Z_SHAPE,
    S_SHAPE,
    PI_SHAPE,
    SPIKE,
    CONCAVE,
) = range(13)


@inlined
def ratio(a: float, b: float) -> float:
    """Return a / b; infinite for b = 0, and 0 for 0 / 0."""
    if b == 0.0:
        return 0.0 if a == 0.0 else inf if a > 0.0 else -inf
    return a / b


@inlined
def decay(z: float) -> Pair:
    """Return exp(-z) for z from 0 on."""
    return exp(-z), -expm1(-z)


@inlined
def logistic(y: float) -> Pair:
    """Return 1 / (1 + exp(-y))."""
    small = exp(-abs(y))
    low, high = small / (1.0 + small), 1.0 / (1.0 + small)
    return (high, low) if y >= 0.0 else (low, high)


@inlined
def half_square(x: float, mean: float, deviation: float) -> float:
    """Return the exponent of the Gaussian function, without its sign."""
    z = ratio(x - mean, deviation)
    return 0.5 * z * z


@flat
def bell(x: float, width: float, slope: float, centre: float) -> Pair:
    """Return the generalised bell: the logistic function of a logarithm."""
    distance = abs(ratio(x - centre, width))
    if distance == 0.0:
        return (1.0, 0.0) if slope > 0.0 else (0.5, 0.5) if slope == 0.0 else (0.0, 1.0)
    return logistic(-2.0 * slope * log(distance))


@flat
def two_sigmoids(kind: int, first: Pair, second: Pair) -> Pair:
    """Return difference, distance or product of two logistic functions."""
    a, not_a = first
    b, not_b = second
    if kind == SIGMOID_PRODUCT:
        return a * b, not_a + a * not_b
    above = not_b - not_a if a > 0.5 and b > 0.5 else a - b
    if above >= 0.0:
        return above, not_a + b
    return (0.0, 1.0) if kind == SIGMOID_DIFFERENCE else (-above, not_b + a)


@flat
def z_shape(x: float, start: float, end: float) -> Pair:
    """Return the Z shape: two parabolas from 1 down to 0."""
    if x <= start:
        return 1.0, 0.0
    if x >= end:
        return 0.0, 1.0
    gone, left = (x - start) / (end - start), (end - x) / (end - start)
    if gone <= left:
        return 1.0 - 2.0 * gone * gone, 2.0 * gone * gone
    return 2.0 * left * left, 1.0 - 2.0 * left * left


@flat
def pi_shape(x: float, a: float, b: float, c: float, d: float) -> Pair:
    """Return the S shape of a and b times the Z shape of c and d."""
    not_rising, rising = z_shape(x, a, b)
    falling, not_falling = z_shape(x, c, d)
    return rising * falling, not_rising + rising * not_falling


@flat
def cosine(x: float, width: float, centre: float) -> Pair:
    """Return half of 1 plus the cosine, written as the square of that of half the angle."""
    if abs(x - centre) > width:
        return 0.0, 1.0
    angle = 0.5 * pi * ratio(x - centre, width)
    return cos(angle) ** 2, sin(angle) ** 2


@flat
def concave(x: float, inflection: float, end: float) -> Pair:
    """Return the hyperbola that reaches 1 at its end, rising or falling."""
    beyond = end - x if inflection <= end else x - end
    if beyond <= 0.0:
        return 1.0, 0.0
    run = abs(end - inflection)
    return run / (run + beyond), beyond / (run + beyond)


@flat
def formula(kind: int, x: float, a: float, b: float, c: float, d: float) -> Pair:
    """Return the degree at `x` of a curve without its height."""
    if kind == GAUSSIAN:
        pair = decay(half_square(x, a, b))
    elif kind == GAUSSIAN_PRODUCT:
        before = half_square(x, a, b) if x < a else 0.0
        behind = half_square(x, c, d) if x > c else 0.0
        pair = decay(before + behind)
    elif kind == BELL:
        pair = bell(x, a, b, c)
    elif kind == SIGMOID:
        pair = logistic(a * (x - b))
    elif kind <= SIGMOID_PRODUCT:
        pair = two_sigmoids(kind, logistic(a * (x - b)), logistic(c * (x - d)))
    elif kind == COSINE:
        pair = cosine(x, a, b)
    elif kind == Z_SHAPE:
        pair = z_shape(x, a, b)
    elif kind == S_SHAPE:
        falling, rising = z_shape(x, a, b)
        pair = rising, falling
    elif kind == PI_SHAPE:
        pair = pi_shape(x, a, b, c, d)
    elif kind == SPIKE:
        pair = decay(abs(10.0 * ratio(x - a, b)))
    else:
        pair = concave(x, a, b)
    return pair


@flat
def curve_degree(kind: int, x: float, a: float, b: float, c: float, d: float, height: float) -> Pair:
    """Return the degree of a curve at `x`, and 1 minus it."""
    degree, complement = formula(kind, x, a, b, c, d)
    if not degree <= 1.0:  # not a number
        return 0.0, 1.0
    return height * degree, maximum(0.0, 1.0 - height) + height * complement

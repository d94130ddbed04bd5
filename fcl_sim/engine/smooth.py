"""Smooth curves as polylines within 1e-6 of them (S33), for areas and for pictures."""

from collections.abc import Sequence

import numpy as np
from numpy import float64
from numpy.typing import NDArray

from fcl_sim.arithmetic.curves import CODES, PARAMETERS, curve_degree
from fcl_sim.jit import F, entry, f8, i8, signature, u, void
from fcl_sim.model import Curve, CurveKind, Point

Floats = NDArray[float64]

TOLERANCE = 1e-6
"""Largest distance of a polyline from its curve."""
TAKEN = 0.8 * TOLERANCE
"""What is allowed at the places that are looked at: between them it may be a little more."""
LOOKED = (0.2, 0.35, 0.5, 0.65, 0.8)
"""Those places, in parts of a stretch."""


@entry(signature(void, i8, F, f8, F, F))
def write_degrees(kind: int, parameters: Floats, height: float, xs: Floats, degrees: Floats) -> None:
    """Write the degrees of a curve at `xs`."""
    a, b, c, d = parameters[u(0)], parameters[u(1)], parameters[u(2)], parameters[u(3)]
    for place in range(xs.size):
        degrees[u(place)] = curve_degree(kind, xs[u(place)], a, b, c, d, height)[0]


def numbers(parameters: Sequence[float | str]) -> list[float]:
    """Return constant parameters, filled up to as many as the kernels take."""
    constant = [float(each) for each in parameters]
    return constant + [0.0] * (PARAMETERS - len(constant))


def degrees_at(curve: Curve, xs: Floats) -> Floats:
    """Return the degrees at `xs` of a curve with constant parameters."""
    degrees = np.empty_like(xs)
    write_degrees(CODES[curve.kind], np.array(numbers(curve.parameters)), float(curve.height), xs, degrees)
    return degrees


def polyline(curve: Curve, low: float, high: float) -> tuple[Point, ...]:
    """Return base points from `low` to `high` whose polyline keeps within TOLERANCE of the curve.

    Stretches between the places where the curve bends or turns are halved
    until they are straight enough.
    """
    ends = np.array([low, *sorted({x for x in turns(curve) if low < x < high}), high])
    left, right = ends[:-1], ends[1:]
    xs = [ends]
    while left.size:
        middle = 0.5 * left + 0.5 * right
        bent = (left < middle) & (middle < right) & (_distance(curve, left, right) > TAKEN)
        left, middle, right = left[bent], middle[bent], right[bent]
        xs.append(middle)
        left, right = np.concatenate((left, middle)), np.concatenate((middle, right))
    places = np.unique(np.concatenate(xs))
    degrees = np.clip(degrees_at(curve, places), 0.0, 1.0)
    return tuple(Point(x, degree) for x, degree in zip(places.tolist(), degrees.tolist(), strict=True))


def _distance(curve: Curve, left: Floats, right: Floats) -> Floats:
    """Return how far the curve lies from the straight line over each stretch, where it is looked at."""
    low, high = degrees_at(curve, left), degrees_at(curve, right)
    farthest = np.zeros_like(left)
    for part in LOOKED:
        degrees = degrees_at(curve, left + part * (right - left))
        farthest = np.maximum(farthest, np.abs(degrees - (low + part * (high - low))))
    return farthest


def turns(curve: Curve) -> list[float]:
    """Return where a curve may turn, bend or be steep: no narrow part of it lies between two of these."""
    a, b, c, d = numbers(curve.parameters)
    match curve.kind:
        case CurveKind.GAUSSIAN | CurveKind.SPIKE:
            places = [a - b, a, a + b]
        case CurveKind.GAUSSIAN_PRODUCT:
            places = [a - b, a, c, c + d]
        case CurveKind.BELL:
            places = [c - a, c, c + a]
        case CurveKind.SIGMOID:
            places = [b]
        case CurveKind.COSINE:
            places = [b - a, b, b + a]
        case CurveKind.Z_SHAPE | CurveKind.S_SHAPE:
            places = [a, 0.5 * a + 0.5 * b, b]
        case CurveKind.PI_SHAPE:
            places = [a, 0.5 * a + 0.5 * b, b, c, 0.5 * c + 0.5 * d, d]
        case CurveKind.CONCAVE:
            places = [a, b]
        case _:
            crossing = [(a * b - c * d) / (a - c)] if a != c else []
            places = [b, 0.5 * b + 0.5 * d, d, *crossing]
    return places


def sight(curve: Curve) -> tuple[float, float]:
    """Return the ends of where a curve is to be seen: what lies beyond is flat, or nearly so."""
    places = turns(curve)
    low, high = min(places), max(places)
    match curve.kind:
        case CurveKind.COSINE | CurveKind.Z_SHAPE | CurveKind.S_SHAPE | CurveKind.PI_SHAPE:
            room = 0.0
        case CurveKind.GAUSSIAN | CurveKind.GAUSSIAN_PRODUCT | CurveKind.BELL:
            room = 2.0 * max(abs(each) for each in (places[0] - places[1], places[-1] - places[-2]))
        case CurveKind.SPIKE | CurveKind.CONCAVE:
            room = high - low
        case _:
            gains = [abs(each) for each in numbers(curve.parameters)[::2] if each != 0.0]
            room = 6.0 / min(gains, default=1.0)
    return low - room, high + room

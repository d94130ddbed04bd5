"""Margins of a loop in discrete time, from its frequency response.

The response is python-control's, of the state space. Its `stability_margins`
are not asked: they take the roots of polynomials, which are far off for a delay
of some scans, and for a pole and a zero that cancel, as those of a
differentiator and an integrator on the unit circle do in any fuzzy PI.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import inf, nan, pi, radians

import control
import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, minimize_scalar

Values = NDArray[np.float64]
Responses = NDArray[np.complex128]

LOWEST = 1e-7
"""Lowest frequency that is looked at, as a part of the Nyquist frequency."""
REAL = 1e-6
"""A response is real where its imaginary part is a smaller part of it; on a pole it never is."""


@dataclass(frozen=True, kw_only=True)
class Margins:
    """How far a loop that is cut open at one signal is from its limit of stability.

    `gain_margin` is a factor, not decibels, at `phase_crossover`: the gain
    nearest to 1, larger or smaller, that makes the loop oscillate.
    `phase_margin` is in degrees, at `gain_crossover`. `modulus_margin` is the
    least distance of the Nyquist curve from -1, the inverse of the largest
    sensitivity. Frequencies are in rad/s, up to pi / dt, and NaN where the loop
    does not cross; the margin is then infinite.
    """

    gain_margin: float
    phase_margin: float
    modulus_margin: float
    phase_crossover: float
    gain_crossover: float

    @property
    def delay_margin(self) -> float:
        """Delay in seconds that uses up the phase margin."""
        return radians(self.phase_margin) / self.gain_crossover if self.gain_crossover > 0 else inf


def margins_of(opened: control.StateSpace) -> Margins:
    """Return the margins of a loop of one signal, opened, that closes with the sign -1."""
    nyquist = pi / opened.dt

    def response(frequency: float) -> complex:
        z = {0.0: 1.0, nyquist: -1.0}.get(frequency, np.exp(1j * frequency * opened.dt))
        return complex(opened(z, warn_infinite=False))

    def imaginary(frequency: float) -> float:
        return response(frequency).imag

    def excess(frequency: float) -> float:
        return abs(response(frequency)) - 1.0

    frequencies = _frequencies(opened)
    responses = np.array([response(each) for each in frequencies])
    usable = np.isfinite(responses)
    frequencies, responses = frequencies[usable], responses[usable]
    ends = [each for each in (0.0, nyquist) if np.isfinite(response(each))]
    real = [*_crossings(imaginary, frequencies, responses.imag), *ends]
    gains = {each: 1 / abs(response(each)) for each in real if _is_negative(response(each))}
    ones = _crossings(excess, frequencies, np.abs(responses) - 1.0)
    phases = {each: _from_minus_one(response(each)) for each in ones}
    phase_crossover = min(gains, key=lambda each: abs(np.log(gains[each])), default=nan)
    gain_crossover = min(phases, key=lambda each: abs(phases[each]), default=nan)
    return Margins(
        gain_margin=gains.get(phase_crossover, inf),
        phase_margin=phases.get(gain_crossover, inf),
        modulus_margin=_least(lambda each: abs(1.0 + response(each)), frequencies, responses, ends),
        phase_crossover=phase_crossover,
        gain_crossover=gain_crossover,
    )


def _frequencies(opened: control.StateSpace) -> Values:
    """Return frequencies in rad/s between 0 and the Nyquist frequency, dense where a pole is near."""
    nyquist = pi / opened.dt
    parts = [np.geomspace(LOWEST, 1.0, 1500) * nyquist, np.linspace(0.0, 1.0, 700) * nyquist]
    for pole in opened.poles():
        if abs(pole) > 0.0:
            centre = np.log(complex(pole)) / opened.dt
            parts.append(abs(centre.imag) + abs(centre.real) * np.linspace(-4.0, 4.0, 81))
    every: Values = np.unique(np.concatenate(parts))
    inside: Values = every[(every > 0.0) & (every < nyquist * (1.0 - 1e-9))]
    return inside


def _crossings(function: Callable[[float], float], frequencies: Values, values: Values) -> list[float]:
    """Return where `function`, whose `values` are given, changes its sign."""
    changes = np.flatnonzero(values[:-1] * values[1:] < 0.0)
    pairs = [(float(frequencies[i]), float(frequencies[i + 1])) for i in changes]
    found = [float(brentq(function, *pair, xtol=1e-15 * pair[1], rtol=1e-14)) for pair in pairs]
    return found + [float(each) for each in frequencies[values == 0.0]]


def _is_negative(response: complex) -> bool:
    return response.real < 0.0 and abs(response.imag) <= REAL * abs(response)


def _from_minus_one(response: complex) -> float:
    """Return the angle from -1 to a response, in degrees within ±180."""
    return float(np.degrees(np.angle(-response)))


def _least(
    distance: Callable[[float], float], frequencies: Values, responses: Responses, ends: list[float]
) -> float:
    """Return the least distance from -1, refined about the nearest of the responses."""
    distances = np.abs(1.0 + responses)
    best = int(np.argmin(distances))
    low, high = frequencies[max(best - 1, 0)], frequencies[min(best + 1, len(frequencies) - 1)]
    refined = minimize_scalar(distance, bounds=(low, high), method="bounded", options={"xatol": 1e-12 * high})
    return min(float(distances[best]), float(refined.fun), *map(distance, ends))

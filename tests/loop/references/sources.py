"""Sources once more, in plain Python."""

from fractions import Fraction
from hashlib import blake2b
from math import exp, log, pi, sin, sqrt

import numpy as np

from fcl_sim.loop.blocks.setting import Text
from fcl_sim.units import parse_quantity
from tests.loop.block_bench import Case

CSV = "time [min],speed [m/s],power [kW]\n0,1,7\n0.01,-2.5,8\n\n0.0201,4e0,9\n0.05,4,-1\n"
TIMES, SPEEDS = [0.0, 0.6, 1.206, 3.0], [1.0, -2.5, 4.0, 4.0]


def staircase(samples, times, cycle):
    return [next(y for at, y in ((2.5, -3.0), (0.5, 2.5), (-1.0, 1.0)) if t >= at) for t in times]


def ramp(samples, times, cycle):
    return [float(np.interp(t, [0.5, 2.0], [1.0, -2.0])) for t in times]


def pulses(period, duty, at):
    """Return pulses by exact times of scans of 20 ms."""

    def law(samples, times, cycle):
        exact = [Fraction(k, 50) - Fraction(at) for k in range(len(times))]
        return [3.0 if t >= 0 and t % Fraction(period) < duty * Fraction(period) else -1.0 for t in exact]

    return law


def swinging(amplitude, offset, frequency, phase):
    return lambda samples, times, cycle: [
        offset + amplitude * sin(2.0 * pi * frequency * t + phase) for t in times
    ]


def swept(frequency, duration):
    """Return a sine whose turns are the integral of `frequency(t)`, by Simpson's rule in fine steps."""

    def turns(t):
        edges = np.linspace(0.0, t, 401)
        middles = 0.5 * (edges[1:] + edges[:-1])
        f = [frequency(min(each, duration)) for each in edges]
        g = [frequency(min(each, duration)) for each in middles]
        return sum((a + 4.0 * m + b) for a, m, b in zip(f, g, f[1:], strict=False)) * t / 400 / 6

    def law(samples, times, cycle):
        whole = turns(duration)
        counted = [turns(t) if t <= duration else whole + (t - duration) * frequency(duration) for t in times]
        return [0.5 + 2.0 * sin(2.0 * pi * each + 0.25) for each in counted]

    return law


def from_file(samples, times, cycle):
    return [float(np.interp(t, TIMES, SPEEDS)) for t in times]


def held_from_file(samples, times, cycle):
    return [SPEEDS[max(i for i, at in enumerate(TIMES) if at <= t)] for t in times]


def numbers_of(name, count):
    """Return the normal numbers of a block, as its page says they are drawn: seed 0, run 0."""
    own = int.from_bytes(blake2b(name.encode(), digest_size=8).digest(), "little")
    key = np.array([0, 0], dtype=np.uint64)
    philox = np.random.Philox(key=key, counter=np.array([0, 0, 0, own], dtype=np.uint64))
    return np.random.Generator(philox).standard_normal(count)


def white(samples, times, cycle):
    return 1.0 + 0.5 * numbers_of("block", len(times))


def coloured(time):
    def law(samples, times, cycle):
        a, w = exp(-cycle / time), []
        for each in numbers_of("block", len(times)):
            w.append(a * w[-1] + sqrt(1.0 - a**2) * each if w else each)
        return [2.0 * each for each in w]

    return law


STEPS = tuple(
    tuple(parse_quantity(each) for each in row)
    for row in (("-1 s", "1 m"), ("500 ms", "250 cm"), ("2.5 s", "-3 m"))
)
SWEEP = {"amplitude": "2 m", "offset": "50 cm", "phase": "0.25 rad"}
FILE = Text("speed.csv", CSV)


def chirp(law, **parameters):
    return Case(block="chirp", parameters={**SWEEP, **parameters}, law=law, tolerance=1e-9)


CASES = [
    Case(
        block="constant",
        parameters={"value": "3 kW"},
        law=lambda samples, times, cycle: [3.0 for _ in times],
    ),
    Case(
        block="step",
        parameters={"before": "1 m", "after": "250 cm", "at": "1.5 s"},
        law=lambda samples, times, cycle: [100.0 if t < 1.5 else 250.0 for t in times],
    ),
    Case(block="staircase", parameters={"steps": STEPS}, law=staircase),
    Case(
        block="ramp",
        parameters={"before": "100 cm", "after": "-2 m", "at": "0.5 s", "duration": "1.5 s"},
        law=ramp,
        tolerance=1e-14,
    ),
    Case(
        block="pulse",
        parameters={"low": "-1 m", "high": "3 m", "period": "100 ms", "duty": "20 %"},
        law=pulses("0.1", Fraction(1, 5), "0"),
    ),
    Case(
        block="pulse",
        parameters={"low": "-1 m", "high": "3 m", "period": "0.3 s", "duty": 0.7, "at": "0.42 s"},
        law=pulses("0.3", Fraction(7, 10), "0.42"),
    ),
    Case(
        block="pulse",
        parameters={"low": "-1 m", "high": "3 m", "period": "1 s", "duty": 1.0, "at": "2 s"},
        law=pulses("1", 1, "2"),
    ),
    Case(
        block="sine",
        parameters={"amplitude": "2 m", "offset": "50 cm", "frequency": "90 1/min", "phase": "30 deg"},
        law=swinging(2.0, 0.5, 1.5, pi / 6),
        tolerance=1e-13,
    ),
    chirp(swept(lambda t: 0.5 + t, 3.0), start="0.5 Hz", end="3.5 Hz", duration="3 s"),
    chirp(
        swept(lambda t: 4.0 * exp(log(0.25) * t / 6.0), 6.0),
        start="4 Hz",
        end="1 Hz",
        duration="6 s",
        sweep="exponential",
    ),
    chirp(swept(lambda t: 2.0, 3.0), start="2 Hz", end="2 Hz", duration="3 s", sweep="exponential"),
    Case(block="table", parameters={"file": FILE, "column": "speed"}, law=from_file, tolerance=1e-13),
    Case(
        block="table",
        parameters={"file": FILE, "column": "speed", "between": "hold"},
        law=held_from_file,
    ),
    Case(block="noise", parameters={"mean": "100 cm", "sigma": "0.5 m"}, law=white),
    Case(
        block="noise",
        parameters={"sigma": "2 kW", "correlation_time": "300 ms"},
        law=coloured(0.3),
        tolerance=1e-15,
    ),
]

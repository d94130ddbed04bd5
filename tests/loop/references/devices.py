"""Sensors, actuators and faults once more, in plain Python."""

from fractions import Fraction
from itertools import pairwise
from math import ceil, exp, floor, inf

from fcl_sim.loop.blocks.setting import Setting
from tests.loop.block_bench import Case

WAVE = {"input": "wave"}


def white(sigma, count):
    """Return the noise of a block called `block` in run 0 of seed 0."""
    random = Setting(name="block", values={}).random()
    return [sigma * each for each in random.standard_normal(count)]


def behind(tau, values, times):
    """Return what lags behind a polyline: its own line later, and what is left of the first distance."""
    x, found = values[0], [values[0]]
    for (t, u), (later, after) in pairwise(zip(times, values, strict=True)):
        shift = tau * (after - u) / (later - t)
        x = after - shift + (x - u + shift) * exp(-(later - t) / tau)
        found.append(x)
    return found


def wrong(bias=0.0, drift=0.0, sigma=0.0):
    def law(samples, times, cycle):
        noise = white(sigma, 251)
        return [u + bias + drift * t + n for u, t, n in zip(samples["input"], times, noise, strict=False)]

    return law


def converted(low, high, bits):
    """Return the law of a converter in exact numbers."""

    def law(samples, times, cycle):
        step = (Fraction(high) - Fraction(low)) / 2**bits
        codes = [floor((min(max(Fraction(u), low), high) - low) / step + Fraction(1, 2)) for u in samples]
        return [float(low + step * min(code, 2**bits - 1)) for code in codes]

    return lambda samples, times, cycle: law(samples["input"], times, cycle)


def display(resolution, low=None, high=None):
    """Return the law of a resolution in exact numbers: of all the values there are, the nearest one."""

    def law(samples, times, cycle):
        found = []
        for u in samples["input"]:
            origin = Fraction(low or 0)
            within = min(
                max(Fraction(u), low if low is not None else -1000), high if high is not None else 1000
            )
            last = floor(((high if high is not None else 1000) - origin) / resolution)
            code = min(ceil((within - origin) / resolution - Fraction(1, 2)), last)
            up = (within - origin) / resolution - code == Fraction(1, 2) and code < last
            found.append(float(origin + resolution * (code + up)))
        return found

    return law


def sensor(law, tolerance=0.0, inputs=WAVE, **parameters):
    return Case(block="sensor", inputs=inputs, parameters=parameters, law=law, tolerance=tolerance)


def stuck_valve(stiction):
    """Return the law of Stenman's valve: the last command that was far enough from the one before."""

    def law(samples, times, cycle):
        found, stands = [], 0.0
        for u in samples["input"]:
            stands = stands if abs(u - stands) <= stiction else u
            found.append(stands)
        return found

    return law


def play(width):
    """Return the law of play by the turning points: the output is where the extremes since have pushed it."""

    def law(samples, times, cycle):
        found, y = [], 0.0
        for m in samples["input"]:
            if m - y > width / 2:
                y = m - width / 2
            elif y - m > width / 2:
                y = m + width / 2
            found.append(y)
        return found

    return law


def motor(rate, low, high, width, initial=0.0):
    def law(samples, times, cycle):
        found, m = [], initial
        for before, (t, u) in zip([-cycle, *times], zip(times, samples["input"], strict=True), strict=False):
            goal = 0.0 if abs(u) <= width else u - width if u > 0 else u + width
            goal = low if goal < low else min(goal, high)
            reach = rate * (t - before)
            m = goal if abs(goal - m) <= reach else m + reach if goal > m else m - reach
            found.append(m)
        return found

    return law


def sticky_and_slow(stiction, rate):
    def law(samples, times, cycle):
        found, m, going = [], 0.0, False
        for u in samples["input"]:
            going = going or abs(u - m) > stiction
            if going:
                m += min(max(u - m, -rate * cycle), rate * cycle)
                going = abs(m - u) > 1e-12
            found.append(m)
        return found

    return law


def actuator(law, tolerance=0.0, inputs=WAVE, **parameters):
    return Case(block="actuator", inputs=inputs, parameters=parameters, law=law, tolerance=tolerance)


def failing(begin, end, fails):
    """Return the law of a fault that turns the inputs up to scan k, in scan k, into what is read."""

    def law(samples, times, cycle):
        u = samples["input"]
        return [fails(u[: k + 1], times[: k + 1]) if begin <= t < end else u[k] for k, t in enumerate(times)]

    return law


def before(begin):
    return lambda u, times: [u[0], *(each for each, t in zip(u, times, strict=True) if t < begin)][-1]


def lost(chance, replacement):
    def law(samples, times, cycle):
        drawn = Setting(name="block", values={}).random().random(251)
        found, held = [], samples["input"][0]
        for k, (u, t) in enumerate(zip(samples["input"], times, strict=True)):
            gone = 1.0 <= t < 3.0 and drawn[k] < chance
            held = held if gone and replacement is None else replacement if gone else u
            found.append(held)
        return found

    return law


def spikes(value, *scans):
    return lambda samples, times, cycle: [
        u + value if k in scans else u for k, u in enumerate(samples["input"])
    ]


def fault(kind, law, tolerance=0.0, **parameters):
    given = {name.removesuffix("_"): each for name, each in parameters.items()}
    return Case(block="fault", inputs=WAVE, parameters={"kind": kind, **given}, law=law, tolerance=tolerance)


LOSS = {"from": "1 s", "to": "3 s"}

CASES = [
    sensor(lambda samples, times, cycle: samples["input"]),
    sensor(lambda samples, times, cycle: behind(0.3, samples["input"], times), 1e-12, lag="300 ms"),
    sensor(lambda samples, times, cycle: behind(1e-4, samples["input"], times), 1e-12, lag="100 us"),
    sensor(wrong(0.25, -0.1), 1e-14, bias="25 cm", drift="-6 m/min"),
    sensor(wrong(sigma=0.02), 1e-15, {"input": "-stairs"}, noise="2 cm"),
    sensor(converted(-2, 2, 4), low="-2 m", high="2 m", bits=4),
    sensor(converted(-1, 3, 12), low="-1 m", high="3 m", bits=12),
    sensor(display(Fraction(1, 4)), resolution="25 cm"),
    sensor(display(Fraction(1, 4), -1, Fraction(9, 10)), low="-1 m", high="0.9 m", resolution="25 cm"),
    sensor(display(Fraction(1, 2), None, 1), high="1 m", resolution="50 cm"),
    actuator(lambda samples, times, cycle: samples["input"]),
    actuator(stuck_valve(0.6), stiction="60 cm"),
    actuator(stuck_valve(1.5), inputs={"input": "-stairs"}, stiction="1.5 m"),
    actuator(play(1.0), backlash="1 m"),
    actuator(motor(5.0, -1.0, 1.5, 0.25), 1e-12, dead_band="25 cm", low="-1 m", high="1.5 m", rate="5 m/s"),
    actuator(motor(inf, -1.0, 0.5, 0.0, 0.25), low="-1 m", high="50 cm", initial="25 cm"),
    actuator(sticky_and_slow(0.31, 3.7), 1e-11, stiction="31 cm", rate="3.7 m/s"),
    fault("stuck", failing(1.0, 3.0, before(1.0)), **LOSS),
    fault("stuck", failing(0.0, inf, before(0.0))),
    fault("wire_break", failing(0.5, inf, lambda u, times: -3.0), from_="500 ms", value="-3 m"),
    fault("offset", failing(1.0, 3.0, lambda u, times: u[-1] + 0.5), value="50 cm", **LOSS),
    fault("delayed", failing(1.0, 3.0, lambda u, times: u[max(0, len(u) - 16)]), delay="300 ms", **LOSS),
    fault("delayed", failing(0.0, inf, lambda u, times: u[max(0, len(u) - 16)]), delay="300 ms"),
    fault("spike", spikes(2.0, 15), value="2 m", from_="290 ms"),
    fault("spike", spikes(-1.0, 5, 20, 35, 50), value="-1 m", from_="0.1 s", every="0.3 s", to="1.1 s"),
    fault("dropout", lost(1.0, None), **LOSS),
    fault("dropout", lost(0.4, None), chance="40 %", **LOSS),
    fault("dropout", lost(0.4, 0.0), chance=0.4, during="zero", **LOSS),
]

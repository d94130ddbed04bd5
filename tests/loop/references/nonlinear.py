"""Nonlinear elements once more, in plain Python."""

from fractions import Fraction
from itertools import pairwise
from math import floor

from fcl_sim.units import parse_quantity
from tests.loop.block_bench import Case


def dead_band(width):
    def law(samples, times, cycle):
        return [u - width if u > width else u + width if u < -width else 0.0 for u in samples["input"]]

    return law


def limited_rate(rising, falling, initial):
    def law(samples, times, cycle):
        y, outputs = initial, []
        for u in samples["input"]:
            if u - y > rising * cycle:
                y = y + rising * cycle
            elif y - u > falling * cycle:
                y = y - falling * cycle
            else:
                y = u
            outputs.append(y)
        return outputs

    return law


def relay(lower, upper, off, on, is_on):
    def law(samples, times, cycle):
        crossings = [(u >= upper, u <= lower) for u in samples["input"]]
        outputs = []
        for k in range(len(crossings)):
            crossed = [up for up, down in crossings[: k + 1] if up or down]
            outputs.append(on if (crossed[-1] if crossed else is_on) else off)
        return outputs

    return law


def stairs(step, offset, *, half):
    """Return the law in exact numbers; `half` is 1/2 for the nearest step, 0 for the one below."""

    def law(samples, times, cycle):
        exact = [(Fraction(u) - Fraction(offset)) / Fraction(step) + half for u in samples["input"]]
        return [offset + step * floor(each) for each in exact]

    return law


def lines(points, *, extrapolated=False):
    def at(u):
        if not extrapolated:
            u = min(max(u, points[0][0]), points[-1][0])
        for (left, low), (right, high) in pairwise(points):
            if u <= right or (right, high) == points[-1]:
                return (low * (right - u) + high * (u - left)) / (right - left)
        return None

    return lambda samples, times, cycle: [at(u) for u in samples["input"]]


def table(*rows):
    return tuple(tuple(parse_quantity(each) for each in row) for row in rows)


POINTS = [(-2.0, 1.0), (-0.5, 3.0), (0.0, -1.0), (1.5, 2.0)]
WRITTEN = table(("-2 m", "1 kW"), ("-50 cm", "3000 W"), ("0 m", "-1 kW"), ("150 cm", "2 kW"))
WAVE = {"input": "wave"}


def rate_limiter(law, **parameters):
    return Case(block="rate_limiter", inputs=WAVE, parameters=parameters, law=law)


def quantiser(law, source="wave", tolerance=1e-15, **parameters):
    return Case(
        block="quantiser", inputs={"input": source}, parameters=parameters, law=law, tolerance=tolerance
    )


def characteristic(law, source="wave", **parameters):
    return Case(
        block="characteristic", inputs={"input": source}, parameters=parameters, law=law, tolerance=1e-14
    )


CASES = [
    Case(block="dead_band", inputs={"input": "wave"}, parameters={"width": "30 cm"}, law=dead_band(0.3)),
    Case(block="dead_band", inputs={"input": "stairs"}, parameters={"width": "1 m"}, law=dead_band(1.0)),
    rate_limiter(limited_rate(float("inf"), float("inf"), 0.0)),
    rate_limiter(limited_rate(5.0, 0.5, 1.5), rising="500 cm/s", falling="0.5 m/s", initial="1.5 m"),
    rate_limiter(limited_rate(0.0, 1.0, 0.0), rising="0 m/s", falling="1 m/s"),
    Case(
        block="hysteresis_relay",
        inputs={"input": "wave"},
        parameters={"lower": "-50 cm", "upper": "1 m", "on": "8 kW", "off": "-300 W"},
        law=relay(-0.5, 1.0, -0.3, 8.0, False),
    ),
    Case(
        block="hysteresis_relay",
        inputs={"input": "-stairs"},
        parameters={"lower": "-2 m", "upper": "-2 m", "initial": True},
        law=relay(-2.0, -2.0, 0.0, 1.0, True),
    ),
    Case(
        block="hysteresis_relay",
        inputs={"input": "ratio"},
        parameters={"lower": "-7", "upper": "7", "initial": True},
        law=relay(-7.0, 7.0, 0.0, 1.0, True),
    ),
    quantiser(stairs(0.25, 0.0, half=Fraction(1, 2)), step="25 cm"),
    quantiser(stairs(0.25, 0.1, half=0), step="25 cm", offset="0.1 m", rounding="down"),
    quantiser(stairs(2.0, 0.0, half=Fraction(1, 2)), "stairs", 0.0, step="2 m"),
    characteristic(lines(POINTS), points=WRITTEN),
    characteristic(lines(POINTS, extrapolated=True), points=WRITTEN, ends="extrapolate"),
    characteristic(lines(POINTS, extrapolated=True), "-ramp", points=WRITTEN, ends="extrapolate"),
    characteristic(
        lines([(0.0, 1.0), (1.0, 3.0)]), "-stairs", points=table(("0 m", "1 kW"), ("1 m", "3 kW"))
    ),
]

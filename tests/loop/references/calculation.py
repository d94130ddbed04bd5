"""Calculations once more, in plain Python."""

from math import atan2, cos, exp, pi

from fcl_sim.formula.text import plain
from tests.loop.block_bench import Case


def product(samples, times, cycle):
    return [a * b * c for a, b, c in zip(samples["1"], samples["2"], samples["3"], strict=True)]


def quotient(least, otherwise):
    def law(samples, times, cycle):
        pairs = zip(samples["input"], samples["by"], strict=True)
        return [above / below if abs(below) > least else otherwise for above, below in pairs]

    return law


def formula(calculated, text, **inputs):
    def law(samples, times, cycle):
        return [calculated(*row) for row in zip(*(samples[name] for name in inputs), strict=True)]

    return Case(
        block="expression", inputs=inputs, parameters={"formula": plain(text)}, law=law, tolerance=1e-12
    )


CASES = [
    Case(block="product", inputs={"1": "wave", "2": "-ratio", "3": "wave"}, law=product),
    Case(block="division", inputs={"input": "wave", "by": "ratio"}, law=quotient(0.0, 0.0)),
    Case(block="division", inputs={"input": "wave", "by": "stairs"}, law=quotient(0.0, 0.0)),
    Case(
        block="division",
        inputs={"input": "wave", "by": "-stairs"},
        parameters={"least": "100 cm", "otherwise": "50 %"},
        law=quotient(1.0, 0.5),
    ),
    formula(lambda x: 7.25, "3 + 4.25", x="wave"),
    formula(
        lambda x, y, t: x - 6.0 * (y / max(t, 0.5)) * 2.0,
        "x - 6 s * (y / max(500 ms, t)) * 2",
        x="wave",
        y="-stairs",
        t="moment",
    ),
    formula(
        lambda x, y: 100.0 + x - (y - (1.0 - x)) * 1.0,
        "10000 cm + x - (y - (1 m - x)) * 1",
        x="wave",
        y="ramp",
    ),
    formula(
        lambda x, r: cos(x * pi / 2.0) * exp(-r) - atan2(x, 2.0) * 180.0 / pi,
        "cos(x / 1 m * 90 deg) * exp(-r) - atan2(x, 200 cm) / 1 deg",
        x="wave",
        r="ratio",
    ),
    formula(
        lambda x, y: min(abs(x), abs(y), 0.7) ** 2 + (x * x) ** 0.5 * y**3,
        "pow(min(abs(x), abs(y), 0.7 m), 2) + sqrt(x * x) * pow(y, 3) / 1 m2",
        x="wave",
        y="stairs",
    ),
]

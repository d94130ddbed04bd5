"""Nonlinear elements once more, in plain Python."""

from tests.loop.block_bench import Case


def dead_band(width):
    def law(samples, times, cycle):
        return [u - width if u > width else u + width if u < -width else 0.0 for u in samples["input"]]

    return law


CASES = [
    Case(block="dead_band", inputs={"input": "wave"}, parameters={"width": "30 cm"}, law=dead_band(0.3)),
    Case(block="dead_band", inputs={"input": "stairs"}, parameters={"width": "1 m"}, law=dead_band(1.0)),
]

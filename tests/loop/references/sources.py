"""Sources once more, in plain Python."""

from tests.loop.block_bench import Case

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
]

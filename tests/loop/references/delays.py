"""Delays once more, in plain Python."""

from tests.loop.block_bench import Case


def one_scan_late(initial):
    return lambda samples, times, cycle: [initial, *samples["input"][:-1]]


CASES = [
    Case(block="unit_delay", inputs={"input": "-wave"}, law=one_scan_late(0.0)),
    Case(
        block="unit_delay", inputs={"input": "wave"}, parameters={"initial": "250 cm"}, law=one_scan_late(2.5)
    ),
]

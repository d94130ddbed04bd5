"""When each scan starts, in integer nanoseconds."""

import numpy as np
from numpy.typing import NDArray

from fcl_sim.diagnostics import InputFault
from fcl_sim.loop.diagram import Timing


def scan_starts(timing: Timing, run: int = 0) -> NDArray[np.int64]:
    """Return the nanosecond at which each scan reads its inputs, (scans + 1,), the end included.

    Scan n is due at n times the scan time. Jitter, uniform in [0, jitter), is
    drawn by Philox from (seed, run), so it is the same alone and in a batch;
    the end is not late.
    """
    check(timing)
    due = np.arange(timing.duration // timing.scan + 1, dtype=np.int64) * timing.scan
    if timing.jitter:
        key = np.array([timing.seed, run], dtype=np.uint64)
        late = np.random.Generator(np.random.Philox(key=key)).integers(0, timing.jitter, due.size - 1)
        due[:-1] += late
    return due


def most_under_way(timing: Timing, delay: int) -> int:
    """Return how many writes can be on their way at once, where each takes `delay` nanoseconds."""
    return (delay + timing.jitter) // timing.scan + 2


def check(timing: Timing) -> None:
    """Raise InputFault where the times of a loop contradict each other."""
    if timing.scan <= 0:
        _refuse("the scan time must be greater than 0")
    if timing.duration <= 0 or timing.duration % timing.scan:
        scan, duration = seconds(timing.scan), seconds(timing.duration)
        whole = max(1, round(timing.duration / timing.scan)) * timing.scan
        _refuse(
            f"the duration of {duration} is not a whole number of scans of {scan}",
            f"a run ends with a scan; {seconds(whole)} would do",
        )
    if not 0 <= timing.latency <= timing.scan:
        _refuse(f"the latency must lie between 0 and the scan time, {seconds(timing.scan)}")
    if not 0 <= timing.jitter <= timing.scan - timing.latency:
        _refuse(
            "latency and jitter together must not exceed the scan time",
            "the outputs are written before the next scan begins",
        )


def seconds(ticks: int) -> str:
    """Return nanoseconds as seconds, for a reader."""
    return f"{ticks / 1e9:.9g} s"


def _refuse(message: str, hint: str = "") -> None:
    raise InputFault.at_file("WIR401", "", message, hint)

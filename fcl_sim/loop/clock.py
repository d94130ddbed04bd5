"""When each scan reads and writes, in integer nanoseconds: on time, late, too long, or cut off."""

from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from fcl_sim.diagnostics import InputFault
from fcl_sim.loop.diagram import COLD, LATE, Overruns, Timing
from fcl_sim.loop.trace import Incident

Ticks = NDArray[np.int64]

NEVER = int(np.iinfo(np.int64).max)
"""When a scan writes whose outputs are lost."""

OVERRUNS = 1
"""Stream of random numbers; jitter has 0."""


@dataclass(frozen=True, slots=True, eq=False)
class Schedule:
    """When the scans of a run read and write.

    `starts` (scans + 1,) are the nanoseconds at which they read their inputs, the
    end included; `writes` (scans + 1,) those at which they write their outputs,
    NEVER where they are lost. `cold` are the scans that begin with a cold
    restart; `incidents` tell of restarts and overruns.
    """

    starts: Ticks
    writes: Ticks
    cold: tuple[int, ...] = ()
    incidents: tuple[Incident, ...] = ()


def scan_starts(timing: Timing, run: int = 0) -> Ticks:
    """Return the nanosecond at which each scan is due to read its inputs, (scans + 1,), the end included.

    Scan n is due at n times the scan time. Jitter, uniform in [0, jitter), is
    drawn by Philox from (seed, run), so it is the same alone and in a batch;
    the end is not late.
    """
    check(timing)
    due = np.arange(timing.duration // timing.scan + 1, dtype=np.int64) * timing.scan
    if timing.jitter:
        due[:-1] += _random(timing, run, 0).integers(0, timing.jitter, due.size - 1)
    return due


def most_under_way(timing: Timing, delay: int) -> int:
    """Return how many writes can be on their way at once, where each takes `delay` nanoseconds."""
    crowded = 2 if timing.overruns != Overruns() else 0  # a long scan and the late one behind it
    return (delay + timing.jitter) // timing.scan + 2 + crowded


def schedule(timing: Timing, run: int = 0) -> Schedule:
    """Return when the scans of run number `run` read and write.

    A scan writes its outputs after the latency. One that overruns takes longer
    than the scan time, and writes when it ends. Scans that fall due meanwhile are
    left out, and the next one begins when it is due; with the policy LATE the last
    of them is run as soon as the long one ends, and so on until none is due.

    A restart cuts off a scan that has not written: its outputs are lost, what
    was written is held. The PLC is back with the first scan that is due at the
    restart or later, where it `lasts` that much later.
    """
    due = scan_starts(timing, run)
    lengths = overruns(timing, run)
    if not lengths and not timing.restarts:
        return Schedule(due, due + timing.latency)
    return _walked(timing, due, lengths)


def overruns(timing: Timing, run: int = 0) -> dict[int, int]:
    """Return how many nanoseconds each scan takes that overruns, by its number.

    Each scan with the `chance`, for a time uniform in (scan time, longest],
    drawn as jitter is; scans that are listed take what is listed.
    """
    given = timing.overruns
    found: dict[int, int] = {}
    if given.chance > 0.0:
        random = _random(timing, run, OVERRUNS)
        count = timing.duration // timing.scan
        drawn = random.random(count) < given.chance
        lengths = random.integers(timing.scan, given.longest, count) + 1
        found = {int(number): int(lengths[number]) for number in np.flatnonzero(drawn)}
    return found | dict(given.listed)


def _walked(timing: Timing, due: Ticks, lengths: Mapping[int, int]) -> Schedule:
    """Return a schedule scan by scan; `number` counts multiples of the scan time."""
    scans, end = due.size - 1, int(due[-1])
    waiting = deque(sorted(timing.restarts, key=lambda each: each.at))
    starts: list[int] = []
    writes: list[int] = []
    cold: list[int] = []
    incidents: list[Incident] = []
    number, start, busy = 0, int(due[0]), 0
    while True:
        while waiting and waiting[0].at <= start:
            restart = waiting.popleft()
            busy = restart.at + restart.lasts
            if busy > start:
                number = min(int(np.searchsorted(due, busy)), scans)
                start = int(due[number])
            if restart.kind == COLD:
                cold.append(len(starts))
            incidents.append(Incident(restart.at, "restart", _restarted(restart.kind, restart.lasts)))
        if number == scans:
            break
        length = lengths.get(number, timing.latency)
        busy = start + length
        broken = bool(waiting) and waiting[0].at < busy
        if broken:
            busy = waiting[0].at
        starts.append(start)
        writes.append(NEVER if broken else busy)
        following = min(max(int(np.searchsorted(due, busy)), number + 1), scans)
        if length > timing.scan:
            incidents.append(Incident(start, "overrun", f"a scan of {seconds(length)}"))
        late = (
            timing.overruns.policy == LATE and following > number + 1 and not broken and busy < due[following]
        )
        number, start = (following - 1, busy) if late else (following, int(due[following]))
    starts.append(end)
    writes.append(end + timing.latency if busy <= end else NEVER)
    return Schedule(np.array(starts), np.array(writes), tuple(dict.fromkeys(cold)), tuple(incidents))


def _restarted(kind: str, lasts: int) -> str:
    return f"{kind} restart" + (f" of {seconds(lasts)}" if lasts else "")


def _random(timing: Timing, run: int, stream: int) -> np.random.Generator:
    key = np.array([timing.seed, run], dtype=np.uint64)
    counter = np.array([0, 0, stream, 0], dtype=np.uint64)
    return np.random.Generator(np.random.Philox(key=key, counter=counter))


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
    _check_overruns(timing)
    _check_restarts(timing)


def _check_overruns(timing: Timing) -> None:
    given = timing.overruns
    hint = f"one that overruns takes longer than the scan time, {seconds(timing.scan)}"
    for number, length in given.listed:
        if length <= timing.scan:
            _refuse(f"scan {number} does not overrun in {seconds(length)}", hint)
    if given.chance > 0.0 and given.longest <= timing.scan:
        _refuse("the longest of the scans that overrun does not overrun", hint)


def _check_restarts(timing: Timing) -> None:
    if any(each.at <= 0 or each.at < timing.jitter for each in timing.restarts):
        _refuse("a restart comes after the start", "a run begins with a cold start, at the first scan")
    for first, second in pairwise(sorted(timing.restarts, key=lambda each: each.at)):
        if second.at < first.at + max(first.lasts, 1):
            _refuse(
                f"the restart at {seconds(second.at)} comes before that at {seconds(first.at)} is over",
                "let it be later, or take it away",
            )


def seconds(ticks: int) -> str:
    """Return nanoseconds as seconds, for a reader."""
    return f"{ticks / 1e9:.9g} s"


def _refuse(message: str, hint: str = "") -> None:
    raise InputFault.at_file("WIR401", "", message, hint)

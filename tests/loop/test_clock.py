"""Scans start on whole nanoseconds, and jitter is the same wherever it is drawn."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.diagnostics import InputFault
from fcl_sim.loop.clock import scan_starts
from fcl_sim.loop.diagram import Timing


@given(st.integers(1, 10**9), st.integers(1, 1000))
def test_without_jitter_scans_are_exact_multiples_of_the_scan_time(scan, count):
    starts = scan_starts(Timing(scan=scan, duration=scan * count))
    assert starts.tolist() == [scan * n for n in range(count + 1)]


@given(st.integers(2, 10**9), st.integers(0, 2**63 - 1), st.integers(0, 1000))
def test_jitter_makes_scans_late_by_less_than_it_says_and_never_the_end(scan, seed, run):
    timing = Timing(scan=scan, duration=scan * 50, jitter=scan // 2, seed=seed)
    late = scan_starts(timing, run) - np.arange(51) * scan
    assert late[-1] == 0
    assert np.all((late >= 0) & (late < max(1, scan // 2)))
    assert np.array_equal(scan_starts(timing, run), scan_starts(timing, run))


def test_runs_of_one_seed_draw_different_jitter():
    timing = Timing(scan=10**7, duration=10**9, jitter=10**6, seed=7)
    assert not np.array_equal(scan_starts(timing, 0), scan_starts(timing, 1))


@pytest.mark.parametrize(
    ("timing", "message"),
    [
        (Timing(scan=0, duration=1), "the scan time must be greater than 0"),
        (Timing(scan=30_000_000, duration=10**9), "not a whole number of scans of 0.03 s"),
        (Timing(scan=10, duration=100, latency=11), "the latency must lie between 0 and the scan time"),
        (Timing(scan=10, duration=100, latency=5, jitter=6), "latency and jitter together"),
    ],
)
def test_times_that_contradict_each_other_are_refused(timing, message):
    with pytest.raises(InputFault, match=message):
        scan_starts(timing)

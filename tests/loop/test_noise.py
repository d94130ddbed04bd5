"""Noise: its law, by fixed seeds, and that a run has its own whatever else runs."""

from concurrent.futures import ThreadPoolExecutor
from math import exp

import numpy as np
import pytest

from fcl_sim.loop.blocks.noise import drawn
from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.loop.diagram import Diagram, Timing
from fcl_sim.loop.run import run_tape
from fcl_sim.loop.tape import lower
from fcl_sim.loop.wiring import wire
from tests.loop.block_bench import diagram
from tests.loop.block_loops import node

SCANS = 200_000


def samples(time=0.0, scan=10**7, **further):
    values = {"mean": 1.5, "sigma": 2.0, "correlation_time": time}
    given = {"name": "noise", "scans": SCANS, "seed": 11, **further}
    return np.array(drawn(Setting(values=values, scan=scan, **given)))


def correlation(values, lag):
    left, right = values[:-lag] - 1.5, values[lag:] - 1.5
    return np.mean(left * right) / 4.0


def test_white_noise_is_normal_with_its_mean_and_sigma():
    values = samples()
    assert values.size == SCANS + 1
    error = 1.0 / np.sqrt(SCANS)
    scaled = (values - 1.5) / 2.0
    assert abs(scaled.mean()) < 4 * error
    assert abs(scaled.std() - 1.0) < 4 * error
    assert abs(np.mean(scaled**3)) < 4 * error * np.sqrt(15)
    assert abs(np.mean(np.abs(scaled) < 1.0) - 0.682689) < 2 * error


def test_white_noise_has_no_memory():
    values = samples()
    for lag in (1, 2, 7, 100):
        assert abs(correlation(values, lag)) < 4 / np.sqrt(SCANS)


@pytest.mark.parametrize("scan", [2 * 10**6, 10**7, 4 * 10**7])
def test_an_ornstein_uhlenbeck_process_forgets_exponentially_whatever_the_cycle_time(scan):
    time, cycle = 0.05, scan / 1e9
    values = samples(time, scan)
    independent = SCANS * cycle / (2 * time) if cycle < time else SCANS
    error = 1.0 / np.sqrt(independent)
    assert abs(values.mean() - 1.5) < 4 * 2.0 * error
    assert abs(values.var() / 4.0 - 1.0) < 4 * np.sqrt(2) * error
    for lag in (1, 3, 10):
        assert abs(correlation(values, lag) - exp(-lag * cycle / time)) < 4 * error


def test_an_ornstein_uhlenbeck_process_is_stationary_from_its_first_scan():
    values = np.array([samples(1.0, run=number, scans=3)[[0, 3]] for number in range(4000)])
    assert np.abs(values.std(axis=0) / 2.0 - 1.0).max() < 4 / np.sqrt(2 * 4000)
    assert np.abs(values.mean(axis=0) - 1.5).max() < 4 * 2.0 / np.sqrt(4000)


def test_a_longer_run_begins_as_a_shorter_one():
    assert np.array_equal(samples(0.1, scans=100), samples(0.1, scans=500)[:101])


@pytest.fixture
def loop(tmp_path) -> Diagram:
    noise = node("noise", "noise", sigma="1 m", correlation_time="0.2 s")
    other = node("other", "noise", sigma="1 m", correlation_time="0.2 s")
    found = diagram(tmp_path, noise, other)
    assert isinstance(found.timing, Timing)
    return found


def test_a_run_has_the_same_noise_alone_and_among_others_on_several_threads(loop):
    wiring = wire(loop)
    alone = [run_tape(lower(wiring, number))["noise"] for number in range(6)]
    with ThreadPoolExecutor(3) as workers:
        together = list(workers.map(lambda number: run_tape(lower(wiring, number))["noise"], range(6)))
    assert np.array_equal(alone, together)
    assert len({values.tobytes() for values in alone}) == 6


def test_two_blocks_have_noise_of_their_own_and_a_third_changes_neither(loop, tmp_path):
    trace = run_tape(lower(wire(loop)))
    assert not np.isclose(trace["noise"], trace["other"]).any()
    more = diagram(tmp_path, node("a_third", "noise", sigma="1 kW"), *reversed(loop.nodes))
    again = run_tape(lower(wire(more)))
    for name in ("noise", "other"):
        assert np.array_equal(again[name], trace[name])

"""Annex C in closed loop: what the printed and the completed rule base come to over a field of cranes."""

from dataclasses import dataclass
from itertools import product

import numpy as np
import pytest

from fcl_sim.loop.run import run
from tests.loop.diagrams import crane, timing

FULL = tuple(product((10, 14, 20, 28, 40), (5.0, 7.5, 10.0, 12.5, 15.0), range(10, 41, 5)))
SMALL = tuple(product((10, 20, 40), (5.0, 10.0, 15.0), (10, 20, 30, 40)))


@dataclass(frozen=True)
class Landing:
    """How one transfer ended; load in t, distances in m, angles in degrees, times in s."""

    load: int
    start: int
    end: float
    overshoot: float
    largest_angle: float
    residual_sway: float
    settled: dict[float, float]


def settled_by(trace, tolerance):
    outside = (np.abs(trace["crane.distance"]) >= tolerance) | (trace["crane.sway"] >= 0.5)
    last = np.nonzero(outside)[0]
    if last.size == 0:
        return 0.0
    return np.inf if last[-1] == outside.size - 1 else trace.time[last[-1] + 1]


def land(cases, rules, seconds, prediction, **parameters):
    landings = []
    for load, cable, start in cases:
        given = {"load_mass": 1000.0 * load, "cable_length": cable, **parameters}
        diagram = crane(
            rules,
            timing=timing(50.0, seconds),
            parameters=given,
            position=-float(start),
            prediction=prediction,
        )
        trace = run(diagram)
        assert trace.fault is None
        landings.append(
            Landing(
                load=load,
                start=start,
                end=trace["crane.distance"][-1],
                overshoot=max(0.0, -trace["crane.distance"].min()),
                largest_angle=np.abs(trace["crane.angle"]).max(),
                residual_sway=trace["crane.sway"][trace.time >= seconds - 10.0].max(),
                settled={each: settled_by(trace, each) for each in (0.1, 0.55, 1.0)},
            )
        )
    return landings


@pytest.fixture(scope="module")
def printed():
    return land(FULL, "crane_printed.fcl", 120.0, None)


@pytest.fixture(scope="module")
def completed():
    return land(FULL, "crane_completed.fcl", 90.0, 6.0)


def test_the_printed_rules_land_no_crane(printed):
    assert [each for each in printed if np.isfinite(each.settled[1.0])] == []


def test_the_printed_rules_never_start_ten_metres_before_the_target(printed):
    assert {each.end for each in printed if each.start == 10} == {10.0}


def test_the_printed_rules_run_far_beyond_the_target(printed):
    assert max(each.end for each in printed if each.start >= 20) < -10.0
    trace = run(crane("crane_printed.fcl", timing=timing(50.0, 120.0), prediction=None))
    assert trace["crane.distance"][-1] == pytest.approx(-34.8, abs=0.5)


def test_ten_metres_before_the_target_the_printed_rules_ask_for_no_power_at_all():
    trace = run(crane("crane_printed.fcl", timing=timing(50.0, 120.0), position=-10.0, prediction=None))
    assert np.all(trace["crane.power"] == 0.0)
    assert np.all(trace["crane.position"] == -10.0)


def test_the_completed_rules_land_every_crane(completed):
    assert max(each.settled[0.55] for each in completed) <= 35.0
    assert len(completed) == 175


def test_the_completed_rules_land_without_overshoot_or_sway(completed):
    assert max(each.overshoot for each in completed) <= 0.1
    assert max(each.largest_angle for each in completed) <= 9.0
    assert max(each.residual_sway for each in completed) <= 0.35


def test_every_crane_stops_where_friction_holds_what_the_rules_ask_for(completed):
    # The power near the target is 27 kW / 5 m, which is 5400 N per metre at the base speed of 1 m/s.
    for each in completed:
        stall = 0.005 * (15_000 + 1000 * each.load) * 9.81 / 5400
        assert abs(each.end) <= stall + 0.005


def test_the_completed_rules_without_the_predicted_distance_do_not_settle():
    landings = land(SMALL, "crane_completed.fcl", 90.0, None)
    assert sum(not np.isfinite(each.settled[1.0]) for each in landings) >= 30


def test_without_friction_the_completed_rules_reach_the_target_itself():
    landings = land(SMALL, "crane_completed.fcl", 90.0, 6.0, rolling_resistance=0.0)
    assert max(each.settled[0.1] for each in landings) <= 45.0

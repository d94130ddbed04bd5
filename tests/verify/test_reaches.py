"""How far signals go by what blocks bound, against what runs did, and for each kind of block."""

from math import inf

import pytest

from fcl_sim.loop.wiring import wire
from fcl_sim.scenario.binder import bind
from fcl_sim.scenario.reader import read
from fcl_sim.testbench import prepare, run_prepared
from fcl_sim.verify.reaches import reaches
from tests.house.places import ROOT

SCENARIOS = ROOT / "scenarios"


def ends_of(name, variant="base"):
    return dict(reaches(wire(bind(read(SCENARIOS / name), variant))).ends)


def test_what_sources_sums_and_limits_bound_is_known_and_nothing_else():
    found = ends_of("vessel/adapted.toml")
    assert found["surroundings"] == (12.0, 25.0)
    assert found["controller.bp_warm1"] == (3.0, 16.0)
    assert found["controller.weight"] == (0.0, 1.0)
    assert "controller.trim" not in found  # of the plant's pressure
    assert ends_of("oven/shift.toml")["controller.classes.brown"] == (0.0, 1.0)
    assert ends_of("pi/velocity.toml", "nine_rules")["held_rate"] == (-0.2, 0.2)
    assert ends_of("exchanger/plane.toml")["setpoint"] == (41.0, 59.0)


@pytest.mark.parametrize("name", ["pi/velocity.toml", "exchanger/disturbances.toml", "vessel/direct.toml"])
def test_no_run_leaves_them(name):
    for each in prepare(read(SCENARIOS / name)):
        ends = reaches(wire(each.diagram)).ends
        trace = run_prepared(each).trace
        for signal, (low, high) in ends.items():
            if signal in trace.names:
                slack = 1e-9 * max(1.0, *(abs(end) for end in (low, high) if abs(end) < inf))
                assert low - slack <= trace[signal].min()
                assert trace[signal].max() <= high + slack

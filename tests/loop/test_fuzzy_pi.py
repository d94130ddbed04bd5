"""A fuzzy block in velocity form (A.3, figure A.13b) against the PI controller that it equals, in a loop."""

import numpy as np
import pytest

from fcl_sim.block import Block
from fcl_sim.engine.assemble import assemble
from fcl_sim.loop.diagram import FuzzyNode, Wire
from fcl_sim.model import Accumulation, AndOperator
from fcl_sim.plant.linear import first_order
from tests.engine.bases import tabulated
from tests.loop.block_loops import node
from tests.loop.diagrams import timing
from tests.loop.linear_loops import simulated

KC, TI = 1.25, 10.0
LINEAR = {"e": KC / TI, "de": KC}
FOUR = {"e": (-2.0, 2.0), "de": (-4.0, 4.0)}
NINE = {"e": (-2.0, 0.0, 2.0), "de": (-0.2, 0.0, 0.2)}
TWENTY_FIVE = {"e": (-2.0, -0.7, 0.0, 0.3, 2.0), "de": (-4.0, -0.9, 0.1, 1.0, 4.0)}
WIDE = {"e": (-1e9, 1e9), "de": (-1e9, 1e9)}
PROD, MIN = AndOperator.PROD, AndOperator.MIN
MAX, BSUM, NSUM = Accumulation.MAX, Accumulation.BSUM, Accumulation.NSUM


def manipulated(*law):
    """Return u of the loop with a controller that turns `e` and `de` into the rate `y` of its output."""
    setpoint = node("setpoint", "step", before=0.0, after=1.0, at="0.5 s")
    load = node("load", "step", before=0.0, after=0.5, at="40.5 s")
    error = node("e", "sum", {"setpoint": "setpoint", "y": "plant.y"}, setpoint=1.0, y=-1.0)
    rate = node("de", "differentiator", {"input": "e"}, filter="0 s")
    output = node("u", "integrator", {"input": "y"}, method="backward")
    disturbed = node("disturbed", "sum", {"u": "u", "load": "load"}, u=1.0, load=1.0)
    nodes = (setpoint, load, error, rate, *law, output, disturbed)
    plant = first_order(2.0, 10.0)
    return simulated(plant, timing(500.0, 80.5), *nodes, source="disturbed", delay=2.0)["u"]


def fuzzy(peaks, and_operator=PROD, accumulation=MAX, *, shared=False):
    base = tabulated(
        peaks, lambda e, de: LINEAR["e"] * e + LINEAR["de"] * de, and_operator, accumulation, shared
    )
    block = Block(base, assemble(base))
    units = {"e": "1", "de": "1/s", "y": "1/s"}
    rules = FuzzyNode(name="rules", block=block, inputs={"e": Wire("e"), "de": Wire("de")}, units=units)
    return manipulated(rules, node("y", "gain", {"input": "rules.y"}, gain=1.0))


def linear(peaks):
    """The law itself, its inputs held at the first and the last peak."""
    held = [
        node(
            f"held_{name}",
            "limiter",
            {"input": name},
            low=f"{each[0]!r} {unit}",
            high=f"{each[-1]!r} {unit}",
        )
        for (name, each), unit in zip(peaks.items(), ("", "1/s"), strict=True)
    ]
    gains = {"e": f"{LINEAR['e']!r} 1/s", "de": LINEAR["de"]}
    return manipulated(*held, node("y", "sum", {"e": "held_e", "de": "held_de"}, **gains))


def apart(one, other):
    return np.abs(one - other).max()


def test_the_linear_law_is_the_pi_controller_in_increments():
    setpoint = node("setpoint", "step", before=0.0, after=1.0, at="0.5 s")
    load = node("load", "step", before=0.0, after=0.5, at="40.5 s")
    wires = {"setpoint": "setpoint", "measurement": "plant.y"}
    control = node("u", "pid_velocity", wires, Kc=KC, Ti=f"{TI} s")
    disturbed = node("disturbed", "sum", {"u": "u", "load": "load"}, u=1.0, load=1.0)
    trace = simulated(
        first_order(2.0, 10.0), timing(500.0, 80.5), setpoint, load, control, disturbed,
        source="disturbed", delay=2.0,
    )  # fmt: skip
    assert apart(trace["u"], linear(WIDE)) <= 2e-14
    overshoot = trace["plant.y"][trace.time < 40.0].max() - 1.0
    assert overshoot == pytest.approx(0.09, abs=0.005)


@pytest.mark.parametrize("accumulation", [MAX, BSUM, NSUM])
@pytest.mark.parametrize("peaks", [FOUR, NINE, TWENTY_FIVE], ids=["4", "9", "25"])
def test_prod_and_a_singleton_for_each_rule_close_the_loop_as_the_linear_law_does(peaks, accumulation):
    assert apart(fuzzy(peaks, accumulation=accumulation), linear(peaks)) <= 2e-14


@pytest.mark.parametrize("accumulation", [BSUM, NSUM])
def test_rules_may_share_their_singletons_under_a_sum(accumulation):
    assert apart(fuzzy(NINE, accumulation=accumulation, shared=True), linear(NINE)) <= 2e-14


def test_max_loses_one_of_two_rules_that_share_a_singleton_by_the_known_amount():
    assert apart(fuzzy(NINE, shared=True), linear(NINE)) == pytest.approx(0.0469, abs=0.001)


def test_min_is_no_linear_law_by_the_known_amount():
    assert apart(fuzzy(FOUR, MIN), linear(FOUR)) == pytest.approx(0.52, abs=0.005)

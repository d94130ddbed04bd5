"""Rule bases that equal a formula: multilinear interpolation on a grid (A.3).

Terms that sum to 1, AND by PROD, one rule per node of the grid: the law is the
interpolation of its values at the nodes, and a linear one is reproduced.
"""

import numpy as np
import pytest

from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.evaluate import evaluate
from fcl_sim.model import Accumulation, AndOperator
from tests.engine.bases import tabulated

GRIDS = {
    "4 rules": ({"e": (-2.0, 2.0), "de": (-4.0, 4.0)}, (0.125, 1.25)),
    "9 rules": ({"e": (-2.0, 0.0, 2.0), "de": (-0.2, 0.0, 0.2)}, (0.125, 1.25)),
    "25 rules": ({"e": (-2.0, -0.7, 0.0, 0.3, 2.0), "de": (-4.0, -0.9, 0.1, 1.0, 4.0)}, (0.125, 1.25)),
    "3 inputs": ({"e": (-2.0, 2.0), "ie": (-30.0, 30.0), "de": (-4.0, 4.0)}, (1.2, 0.12, 1.5)),
}
SUMS = (Accumulation.BSUM, Accumulation.NSUM)


def linear(grid, and_operator=AndOperator.PROD, accumulation=Accumulation.MAX, *, shared=False):
    peaks, gains = GRIDS[grid]

    def law(*values):
        return sum(gain * value for gain, value in zip(gains, values, strict=True))

    return tabulated(peaks, law, and_operator, accumulation, shared)


def saturated(grid, values):
    """Return the linear law with each input held at its first and its last peak."""
    peaks, gains = GRIDS[grid]
    return sum(
        gain * np.clip(values[name], each[0], each[-1])
        for gain, (name, each) in zip(gains, peaks.items(), strict=True)
    )


def deviation(base, grid):
    """Return the largest difference from the linear law, on the grid and beyond its ends."""
    random = np.random.default_rng(6)
    peaks, _ = GRIDS[grid]
    values = {name: random.uniform(1.2 * each[0], 1.2 * each[-1], 2000) for name, each in peaks.items()}
    ours = evaluate(assemble(base), values).outputs["y"]
    return np.abs(ours - saturated(grid, values)).max()


@pytest.mark.parametrize("accumulation", [Accumulation.MAX, Accumulation.BSUM, Accumulation.NSUM])
@pytest.mark.parametrize("grid", GRIDS)
def test_prod_and_a_singleton_for_every_rule_make_a_linear_law(grid, accumulation):
    assert deviation(linear(grid, accumulation=accumulation), grid) <= 1e-12


@pytest.mark.parametrize("accumulation", SUMS)
def test_rules_may_share_singletons_under_a_sum(accumulation):
    assert deviation(linear("9 rules", accumulation=accumulation, shared=True), "9 rules") <= 1e-12


def test_rules_that_share_a_singleton_under_max_lose_one_of_them():
    assert deviation(linear("9 rules", shared=True), "9 rules") > 0.01


@pytest.mark.parametrize("grid", ["4 rules", "25 rules"])
def test_min_makes_no_linear_law(grid):
    assert deviation(linear(grid, AndOperator.MIN), grid) > 0.05


@pytest.mark.parametrize("accumulation", [Accumulation.MAX, Accumulation.BSUM, Accumulation.NSUM])
def test_dyadic_numbers_give_the_law_bit_by_bit(accumulation):
    random = np.random.default_rng(7)
    values = {name: random.integers(-640, 641, 5000) / 128 for name in ("e", "de")}
    ours = evaluate(assemble(linear("4 rules", accumulation=accumulation)), values).outputs["y"]
    assert ours.tolist() == saturated("4 rules", values).tolist()


def test_a_bilinear_law_is_reproduced_from_its_four_corners():
    def feedforward(setpoint, flow):  # steam heated exchanger: valve in percent (B.1)
        return 100 * 4186 * (flow * (setpoint - 15) - 35) / 300e3

    base = tabulated({"setpoint": (30.0, 70.0), "flow": (0.4, 1.8)}, feedforward)
    random = np.random.default_rng(8)
    setpoint = random.uniform(30, 70, 5000)
    flow = random.uniform(0.4, 1.8, 5000)
    ours = evaluate(assemble(base), {"setpoint": setpoint, "flow": flow}).outputs["y"]
    assert np.abs(ours - feedforward(setpoint, flow)).max() <= 1e-12 * 130

"""The manual's example on its tank: integers against binary numbers over a whole run."""

import numpy as np
import pytest

from fcl_sim import testbench
from fcl_sim.plant.catalog import shipped_bench


@pytest.fixture(scope="module")
def outcome():
    return testbench.run(shipped_bench() / "scenarios" / "bath" / "bath.toml")


@pytest.mark.parametrize("variant", ["base", "rounded"])
def test_integers_stay_within_a_twentieth_of_a_degree_of_binary_numbers(outcome, variant):
    apart = outcome.variants[variant].trace["bath.water"] - outcome.variants["real"].trace["bath.water"]
    assert np.abs(apart).max() <= 0.05


def test_the_valve_moves_in_steps_that_the_counts_of_the_pressure_make(outcome):
    apart = outcome.base.trace["rules.valve"] - outcome.variants["real"].trace["rules.valve"]
    assert 0.0 < np.abs(apart).max() <= 1.0


def test_with_and_the_tank_ends_two_degrees_warmer(outcome):
    ends = [outcome.variants[name].trace["bath.water"][-1] for name in ("as_text", "base")]
    assert ends[0] - ends[1] == pytest.approx(2.1, abs=0.1)

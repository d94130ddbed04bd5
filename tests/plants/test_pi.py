"""The loops of A.3: two closed loops that must differ, by how much."""

import numpy as np
import pytest

from fcl_sim import testbench
from fcl_sim.plant.catalog import shipped_bench


@pytest.fixture(scope="module")
def outcome():
    return testbench.run(shipped_bench() / "scenarios" / "pi" / "velocity.toml")


def test_shared_singletons_under_max_move_the_closed_loop_by_as_much_as_is_known(outcome):
    lost, kept = (outcome.variants[name].trace["control"] for name in ("nine_rules_max", "nine_rules"))
    assert np.abs(lost - kept).max() == pytest.approx(0.0469, abs=0.001)


def test_min_in_place_of_prod_is_off_by_half_a_unit(outcome):
    assert outcome.variants["minimum"].metrics["PI-1"] == pytest.approx(0.52, abs=0.01)

"""Temperatures in degC have a zero of their own: a sum of them is one again, or a difference in K."""

import pytest

from fcl_sim.loop.blocks.linear import SUM
from fcl_sim.units import UnitError, parse_quantity, parse_unit


def unit_of_sum(**terms: tuple[str, float]) -> str:
    inputs = {name: parse_unit(unit) for name, (unit, _) in terms.items()}
    gains = {name: parse_quantity(gain) for name, (_, gain) in terms.items()}
    return SUM.outputs[0].unit(inputs, gains).symbol


def test_gains_that_add_up_to_0_give_a_difference():
    assert unit_of_sum(setpoint=("degC", 1.0), measured=("degC", -1.0)) == "K"
    assert unit_of_sum(a=("degC", 0.1), b=("degC", 0.2), c=("degC", -0.3)) == "K"


def test_gains_that_add_up_to_1_give_a_temperature():
    assert unit_of_sum(a=("degC", 0.5), b=("degC", 0.5)) == "degC"
    assert unit_of_sum(offset=("K", 3.0), base=("degC", 1.0)) == "degC"


def test_other_gains_give_neither():
    with pytest.raises(UnitError, match="the gains of the temperatures in degC add up to 2"):
        unit_of_sum(a=("degC", 1.0), b=("degC", 1.0))

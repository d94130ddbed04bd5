"""A rule base may have no inputs: it gives the same for ever, and all that is asked of it can be told."""

import pytest

from fcl_sim.block import loads
from fcl_sim.proof.apart import apart
from fcl_sim.proof.prove import prove
from fcl_sim.proof.universe import Universe


def block(place="1", accumulation="ACCU: MAX;"):
    return loads(f"""FUNCTION_BLOCK none
VAR_OUTPUT u: REAL; END_VAR
DEFUZZIFY u TERM a := {place}; METHOD: COGS; DEFAULT := {place}; END_DEFUZZIFY
RULEBLOCK r AND: MIN; {accumulation} END_RULEBLOCK
END_FUNCTION_BLOCK""")


@pytest.mark.parametrize("accumulation", ["ACCU: MAX;", ""])
def test_there_is_nothing_to_find_in_it(accumulation):
    assert prove(block(accumulation=accumulation).function_block) == ()


def test_it_can_be_compared():
    (found,) = apart(block("1"), block("3"), Universe())
    assert (found.largest.reached, found.old, found.new) == (2.0, 1.0, 3.0)

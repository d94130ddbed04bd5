"""A section of the law along one input is what is evaluated on it, at its knots, beside them and between."""

from fractions import Fraction

import pytest

from fcl_sim.engine.explain import Origin
from fcl_sim.model import Method
from fcl_sim.proof.exact import exactly
from fcl_sim.proof.section import NotStraight, section
from tests.house.places import ROOT
from tests.proof.bases import ANY, HIGH, LOW, block_of, random_points, random_text

ENDS = (Fraction(LOW), Fraction(HIGH))
TINY = Fraction(1, 10**15)
NEAR = Fraction(1, 10**9)
METHODS = (Method.COGS, Method.LM, Method.RM, Method.MM)


def cases(seed):
    """Yield sections of a random rule base with the points on which they were made."""
    text = random_text(seed, ANY).replace("METHOD: CoGS", f"METHOD: {METHODS[seed % 3]}")
    block = block_of(text)
    names = [each.name for each in block.inputs if each.name != "d"]
    for point in random_points([each.name for each in block.inputs], seed, 2):
        for name in names:
            try:
                yield block, point, section(block, "y", name, point, ENDS)
            except NotStraight:
                continue


def value(block, point, name, x):
    (found,) = exactly(block, {**point, name: x}).outputs
    return found.value, found.origin is Origin.RULES


@pytest.mark.parametrize("seed", range(9))
def test_at_its_knots_it_is_what_is_evaluated_there(seed):
    for block, point, own in cases(seed):
        assert point[own.variable] in [each.x for each in own.knots]
        for knot in own.knots:
            assert (knot.values[1], knot.active[1]) == value(block, point, own.variable, knot.x)


@pytest.mark.parametrize("seed", range(9))
def test_beside_its_knots_it_is_what_is_evaluated_near(seed):
    for block, point, own in cases(seed):
        for before, after in zip(own.knots, own.knots[1:], strict=False):
            for knot, side, x in ((before, 2, before.x + TINY), (after, 0, after.x - TINY)):
                near, active = value(block, point, own.variable, x)
                assert knot.active[side] == active
                assert abs(knot.values[side] - near) < NEAR


@pytest.mark.parametrize("seed", range(9))
def test_between_its_knots_it_only_rises_or_falls(seed):
    for block, point, own in cases(seed):
        for before, after in zip(own.knots, own.knots[1:], strict=False):
            ends = sorted((before.values[2], after.values[0]))
            for part in (Fraction(1, 5), Fraction(2, 3)):
                x = before.x + part * (after.x - before.x)
                assert ends[0] <= value(block, point, own.variable, x)[0] <= ends[1]


def test_where_it_stays_the_same_has_exact_ends():
    block = block_of((ROOT / "scenarios/bath/valve_and.fcl").read_text("utf-8"))
    at = {"ipress": Fraction(3950), "itemp": Fraction(20)}
    own = section(block, "valve", "itemp", at, (Fraction(0), Fraction(120)))
    assert own.same_around(Fraction(20)) == (0, 50)


def test_degrees_that_change_together_are_no_straight_lines():
    block = block_of(PRODUCT)
    with pytest.raises(NotStraight, match="degrees that change together are multiplied"):
        section(block, "y", "a", {"a": Fraction(1)}, ENDS)


PRODUCT = """
FUNCTION_BLOCK curved
VAR_INPUT a: REAL; END_VAR
VAR_OUTPUT y: REAL; END_VAR
FUZZIFY a TERM low := (0, 1) (4, 0); TERM high := (0, 0) (4, 1); END_FUZZIFY
DEFUZZIFY y TERM one := 1; TERM two := 2; METHOD: CoGS; DEFAULT := 0; END_DEFUZZIFY
RULEBLOCK r
    AND: PROD;
    RULE 1: IF a IS low AND a IS high THEN y IS one;
    RULE 2: IF a IS low THEN y IS two;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""

"""Rule bases whose points and weights variables move, proved over the ranges of these."""

from fractions import Fraction
from random import Random

import numpy as np
import pytest

from fcl_sim.block import load
from fcl_sim.model import Point, Points
from fcl_sim.proof.degrees import Boxes
from fcl_sim.proof.enclosure import Enclosure
from fcl_sim.proof.exact import exactly
from fcl_sim.proof.law import law_of
from fcl_sim.proof.moved import may_be, may_differ, spots_of
from fcl_sim.proof.points import membership
from fcl_sim.proof.prove import prove
from fcl_sim.proof.universe import universe_of
from tests.house.places import ROOT

ADAPTED = ROOT / "scenarios" / "vessel" / "adapted.fcl"
MOVED = ("temp=0..40", "pressure=0..110", "bp_warm1=3..16", "bp_warm2=27..40")


def findings(*stretches):
    block = load(ADAPTED).function_block
    return block, prove(block, universe_of(block, stretches))


def test_moved_points_within_their_ranges_leave_nothing_open():
    assert findings(*MOVED, "w_myrule1=0.1..1")[1] == ()


def test_points_that_may_go_anywhere_leave_it_open():
    assert [each.diagnostic.code for each in findings()[1]] == ["FCL615"]


def test_points_that_may_change_places_leave_it_open():
    _, found = findings("temp=0..40", "bp_warm1=3..30", "bp_warm2=20..40", "w_myrule1=0.1..1")
    assert [each.diagnostic.code for each in found] == ["FCL615"]


def test_a_weight_of_0_leaves_a_gap_where_nothing_else_holds_wherever_the_points_are():
    block, (gap,) = findings(*MOVED)
    (box,) = gap.boxes
    assert {name: (side.low, side.high) for name, side in box.sides.items()} == {
        "temp": (0, 3),
        "pressure": (0, 55),
        "w_myrule1": (0, 0),
    }
    assert 3 <= gap.witness["bp_warm1"] <= 16
    assert 27 <= gap.witness["bp_warm2"] <= 40
    (output,) = exactly(block, gap.witness).outputs
    assert str(output.origin) == "DEFAULT"


@pytest.mark.parametrize("seed", range(10))
def test_what_is_said_of_a_moved_term_holds_wherever_its_points_are(seed):
    random = Random(seed)  # noqa: S311  nothing secret
    shape = Points(tuple(Point(f"m{place}", random.choice((0.0, 0.0, 0.5, 1.0, 1.0))) for place in range(3)))
    reach = {}
    for name in ("m0", "m1", "m2"):
        low = random.randint(0, 8)
        reach[name] = (Fraction(low), Fraction(low + random.randint(0, 4)))
    spots = spots_of(shape, reach.get)
    for low, high in [(x, x) for x in range(14)] + [(x, x + 1) for x in range(14)]:
        xs = [Fraction(low)] if low == high else [low + Fraction(part, 5) for part in range(1, 5)]
        seen = {
            membership(at(shape, {key: value(random, ends) for key, ends in reach.items()}), x)
            for x in xs
            for _ in range(12)
        }
        for bound in (Fraction(0), Fraction(1)):
            if bound in seen:
                assert may_be(spots, bound, Fraction(low), Fraction(high))
            if seen - {bound}:
                assert may_differ(spots, bound, Fraction(low), Fraction(high))


def value(random, ends):
    low, high = ends
    return random.choice((low, high, low + (high - low) * Fraction(random.randint(0, 8), 8)))


def at(shape, movers):
    found = []
    for each in shape.points:
        x = movers[each.x]
        found.append((max(x, found[-1][0]) if found else x, Fraction(each.degree)))
    return tuple(found)


def test_the_output_stays_within_its_bounds_wherever_the_points_are():
    block = load(ADAPTED)
    random = np.random.default_rng(5)
    low = random.uniform([0, 40, 3, 20, 0], [40, 110, 30, 40, 1], (400, 5))
    high = low + random.choice([0.0, 0.1, 5.0], (400, 1)) * random.random((400, 5)) * [1, 1, 1, 1, 0.1]
    law = Enclosure(block.function_block, "valve").law(Boxes(low, high))
    assert np.isfinite(law.rises[:, :2]).any()
    for _ in range(20):
        points = low + random.random(low.shape) * (high - low)
        values = block.evaluate(dict(zip(block.inputs, points.T, strict=True)))["valve"]
        assert (values >= law.low - 1e-9).all()
        assert (values <= law.high + 1e-9).all()


def test_a_law_without_ranges_of_what_moves_says_what_is_missing():
    block = load(ADAPTED)
    (law,) = law_of(block, universe_of(block.function_block))
    assert law.unknown == "`bp_warm1` moves terms and may go anywhere: give its range by --universe"

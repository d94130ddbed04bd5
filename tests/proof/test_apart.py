"""How far two rule bases are apart: not at all with the same law, else where and by which rules."""

import numpy as np
import pytest

from fcl_sim.block import load, loads
from fcl_sim.proof.apart import apart
from fcl_sim.proof.universe import universe_of
from tests.house.places import ROOT

CRANE = "crane/crane_completed.fcl"


def text_of(name):
    return (ROOT / "scenarios" / name).read_text("utf-8")


def compared(old, new, *stretches, threshold=None):
    first, second = loads(old), loads(new)
    return apart(first, second, universe_of(first.function_block, stretches), threshold)


@pytest.mark.parametrize("name", [CRANE, "oven/oven_completed.fcl", "pi/linear9.fcl"])
def test_a_rule_base_is_not_apart_from_itself_in_any_order_of_its_rules(name):
    text = text_of(name)
    lines = text.splitlines()
    rules = [each for each in lines if each.strip().startswith("RULE ")]
    turned = iter(reversed(rules))
    other = "\n".join(next(turned) if each in rules else each for each in lines)
    for found in compared(text, other):
        assert found.largest.bound == 0.0
        assert (found.share_at_most, found.rules, found.differs) == (0.0, (), False)


def test_another_conclusion_tells_most_where_that_rule_stands_alone():
    old = text_of(CRANE)
    new = old.replace(
        "distance IS close AND angle IS zero THEN power IS pos_high",
        "distance IS close AND angle IS zero THEN power IS pos_medium",
    )
    (found,) = compared(old, new)
    assert (found.largest.reached, found.old, found.new) == (18.0, 27.0, 9.0)
    assert (found.largest.at, found.largest.is_exact) == ({"distance": 5.0, "angle": 0.0}, True)
    assert [(each.side, each.label, each.degree) for each in found.rules] == [
        ("old", "18", 1.0),
        ("new", "18", 1.0),
    ]
    assert 0.02 < found.share_at_least <= found.share_at_most < 0.04


def test_accumulation_by_max_loses_the_rules_that_share_a_singleton():
    (found,) = compared(text_of("pi/linear9.fcl"), text_of("pi/linear9_max.fcl"))
    assert found.largest.reached == pytest.approx(0.0290, abs=2e-4)
    assert found.largest.bound < 0.0292


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("pi/linear9.fcl", "pi/linear9_max.fcl"),
        (CRANE, "crane/crane_printed.fcl"),
        ("pi/linear4.fcl", "pi/linear4_min.fcl"),
    ],
)
def test_no_point_differs_by_more_than_the_bound(old, new):
    first, second = load(ROOT / "scenarios" / old), load(ROOT / "scenarios" / new)
    (found,) = apart(first, second, universe_of(first.function_block))
    random = np.random.default_rng(9)
    points = {name: random.uniform(-30, 60, 50_000) for name in first.inputs}
    differences = np.abs(first.evaluate(points)[found.output] - second.evaluate(points)[found.output])
    assert differences.max() <= found.largest.bound + 1e-6
    at = found.largest.at
    assert abs(float(second.evaluate(at)[found.output] - first.evaluate(at)[found.output])) == pytest.approx(
        found.largest.reached
    )


def test_a_threshold_says_from_where_on_they_differ():
    old = text_of(CRANE)
    new = old.replace("TERM pos_medium := 9;", "TERM pos_medium := 9.1;")
    assert new != old
    assert [each.differs for each in compared(old, new, threshold=0.2)] == [False]
    assert [each.differs for each in compared(old, new, threshold=0.05)] == [True]

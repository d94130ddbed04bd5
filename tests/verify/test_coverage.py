"""Coverage is what calling the block again without each rule tells, run by run and all together."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fcl_sim.block import Block
from fcl_sim.engine.assemble import assemble
from fcl_sim.verify.cover import Visit, cover, ranges
from fcl_sim.verify.coverage import Item, Scan, merged
from fcl_sim.verify.subject import Subject, less_a_rule
from tests.verify.rule_bases import RULES, heating, recorded

TICKS = np.arange(1000, dtype=np.int64) * 50_000_000


def visit(record, run="a/base", first=0):
    return Visit(run=run, ticks=TICKS[first : first + len(record.inputs)], record=record)


def covered(block, points, arithmetic="LREAL", least=0.01, cold=()):
    record = recorded(block, arithmetic, points, cold)
    return cover(Subject(block=block, arithmetic=arithmetic), visit(record), least)


def scans_of(coverage, item):
    return [rule.seen(item).scans for rule in coverage.rules]


points = st.lists(st.tuples(st.integers(-2, 44), st.integers(-2, 24)), min_size=1, max_size=12)


@pytest.mark.parametrize(("arithmetic", "kind"), [("LREAL", "LREAL"), ("REAL", "REAL"), ("INT", "INT")])
@pytest.mark.parametrize("default", ["NC", "0"])
@given(points=points, least=st.sampled_from([0.0, 0.01, 0.3]))
@settings(max_examples=15, deadline=None)
def test_a_rule_is_decisive_where_an_instance_without_it_gives_another_output(
    arithmetic, kind, default, points, least
):
    block = heating(default=default, kind=kind)
    record = recorded(block, arithmetic, points)
    found = cover(Subject(block=block, arithmetic=arithmetic), visit(record), least)
    for rule in range(4):
        model = less_a_rule(block.function_block, rule)
        other = Block(model, assemble(model))
        expected = 0
        for row, point in enumerate(points):
            instance = other.instance(arithmetic)
            if row:
                instance.resume(valve=float(record.outputs[row - 1, 0]))
            instance(room=float(point[0]), wind=float(point[1]))
            expected += abs(instance.valve - record.outputs[row, 0]) / 100.0 > least
        assert found.rules[rule].decisive.scans == expected


@pytest.mark.parametrize("arithmetic", ["LREAL", "REAL", "INT"])
@pytest.mark.parametrize("default", ["NC", "0"])
def test_many_points_together_give_what_each_gives_alone(arithmetic, default):
    block = heating(default=default, kind=arithmetic)
    inputs = np.array([[float(room), float(wind)] for room in range(-2, 45) for wind in range(-2, 25)])
    previous = np.arange(len(inputs), dtype=float)[:, None] % 50
    subject = Subject(block=block, arithmetic=arithmetic)
    together = subject.outputs(inputs, previous)
    one_by_one = np.vstack(
        [subject.outputs(inputs[i : i + 1], previous[i : i + 1]) for i in range(0, 900, 7)]
    )
    assert np.array_equal(together[:900:7], one_by_one)


@given(points=points, at=st.integers(1, 11))
@settings(max_examples=30, deadline=None)
def test_the_coverage_of_two_runs_is_that_of_one_with_a_cold_restart_between_them(points, at):
    block, at = heating(), min(at, len(points))
    cold = (at,) if at < len(points) else ()
    whole = covered(block, points, cold=cold)
    subject = Subject(block=block)
    runs = [recorded(block, "LREAL", each) for each in (points[:at], points[at:]) if each]
    firsts = [0, at]
    parts = [cover(subject, visit(each, first=first)) for each, first in zip(runs, firsts, strict=False)]
    both = merged(parts)
    assert both.scans == whole.scans == len(points)
    for part in ("rules", "inputs", "grid", "outputs"):
        assert getattr(both, part) == getattr(whole, part)


def test_a_rule_that_holds_up_an_output_is_decisive_once_what_nc_keeps_is_another():
    found = covered(heating(), [(10, 20), (10, 20), (0, 10), (10, 0)])
    # At (0, 10) no rule fires, and the valve stays; the first sample would keep the initial 0 without rule 2.
    assert found.outputs[0].undefined.scans == 1
    assert found.outputs[0].undefined.first == Scan("a/base", 100_000_000)
    assert scans_of(found, Item.FIRED) == [1, 2, 1, 2]
    assert found.rules[0].decisive.first == Scan("a/base", 150_000_000)


def test_of_two_rules_that_say_the_same_both_are_dominant_and_none_is_decisive():
    rules = """
    RULE 1: IF room IS cold THEN valve IS open;
    RULE 2: IF room IS cold THEN valve IS open;
    RULE 3: IF room IS cold AND wind IS calm THEN valve IS open WITH 0;
    """
    found = covered(heating(rules), [(0, 0), (5, 0), (10, 5)])
    assert scans_of(found, Item.FIRED) == [3, 3, 3]
    assert scans_of(found, Item.DOMINANT) == [3, 3, 0]
    assert scans_of(found, Item.DECISIVE) == [0, 0, 0]


def test_the_weight_of_a_conclusion_counts_for_which_one_is_dominant():
    rules = """
    RULE 1: IF room IS cold THEN valve IS open WITH 0.25;
    RULE 2: IF room IS warm THEN valve IS closed;
    """
    found = covered(heating(rules), [(4, 0), (8, 0), (1, 0)])
    # 0.2 and 0.2 at 4, 0.15 and 0.4 at 8, 0.2375 and 0.05 at 1
    assert scans_of(found, Item.DOMINANT) == [2, 2]


@given(points=points)
@settings(max_examples=30, deadline=None)
def test_who_is_dominant_or_decisive_fires_and_a_larger_part_is_changed_less_often(points):
    block = heating()
    small, large = (covered(block, points, least=least) for least in (0.01, 0.2))
    for one, other in zip(small.rules, large.rules, strict=True):
        assert one.fired.scans >= max(one.dominant.scans, one.decisive.scans)
        assert other.decisive.scans <= one.decisive.scans
        assert (one.change > 0.01) == bool(one.decisive.scans)


def test_cells_end_at_the_breakpoints_and_combinations_are_those_whose_terms_hold_together():
    found = covered(heating(), [(-1, 0), (20, 9.5), (20, 15), (50, 25)])
    room, wind = found.inputs
    assert [(each.low, each.high) for each in room.cells] == [
        (-np.inf, 0.0),
        (0.0, 20.0),
        (20.0, 40.0),
        (40.0, np.inf),
    ]
    assert [each.scans for each in room.cells] == [1, 0, 2, 1]
    assert (wind.visited, len(wind.cells)) == (3, 4)
    assert found.grid.inputs == ("room", "wind")
    assert found.grid.visited == {(0, 0), (1, 0), (1, 1)}
    assert list(found.grid.missing()) == [("cold", "gale")]
    assert found.grid.size == 4


@pytest.mark.parametrize(("default", "width"), [("NC", 100.0), ("-20", 120.0), ("200", 200.0)])
def test_the_range_of_an_output_is_that_of_its_terms_and_its_default(default, width):
    block = heating(default=default)
    record = recorded(block, "LREAL", [(10, 0)])
    assert ranges(block.function_block, record) == {"valve": width}


def test_a_program_without_a_rule_is_that_of_the_text_without_it():
    block = heating(RULES * 10)  # more rules than a word of the mask has bits
    xs, ys = (each.ravel() for each in np.meshgrid(np.linspace(-1, 41, 9), np.linspace(-1, 21, 9)))
    inputs, before = np.column_stack([xs, ys]), np.full((81, 1), 7.0)
    subject = Subject(block=block)
    for rule in (0, 1, 31, 32, 39):
        model = less_a_rule(block.function_block, rule)
        other = Subject(block=Block(model, assemble(model)))
        assert np.array_equal(subject.outputs(inputs, before, rule), other.outputs(inputs, before))
    assert np.array_equal(
        subject.outputs(inputs, before)[:, 0],
        block.evaluate({"room": xs, "wind": ys}, {"valve": 7.0})["valve"],
    )

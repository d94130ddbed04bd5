"""Vectors that certify a translation: the reference passes them, and what is not the same law does not."""

import numpy as np
import pytest

from fcl_sim.block import load, loads
from fcl_sim.loop import trace_file
from fcl_sim.loop.trace_reader import read
from fcl_sim.proof.prove import prove
from fcl_sim.proof.universe import universe_of
from fcl_sim.verify.replay import replay
from fcl_sim.verify.vectors import vectors
from tests.house.places import ROOT

SHIPPED = [
    "bath/valve_and.fcl",
    "cone/schedule.fcl",
    "crane/crane_printed.fcl",
    "oven/oven_printed.fcl",
    "pi/draft8.fcl",
]


def made(name, *stretches, **options):
    block = load(ROOT / "scenarios" / name)
    universe = universe_of(block.function_block, stretches)
    return block, vectors(block, universe, prove(block.function_block, universe), **options)


@pytest.mark.parametrize("name", SHIPPED)
@pytest.mark.parametrize("arithmetic", ["LREAL", "REAL"])
def test_what_gave_them_passes_them_from_a_file(name, arithmetic, tmp_path):
    block, table = made(name, arithmetic=arithmetic)
    trace_file.write(table, tmp_path / "vectors.csv")
    found = replay(block, read(tmp_path / "vectors.csv"), arithmetic)
    assert found.first is None
    assert all(each.compared == len(table.ticks) for each in found.comparisons)


@pytest.mark.parametrize("label", range(1, 26))
def test_one_other_conclusion_does_not_pass_them(label):
    _, table = made("crane/crane_completed.fcl")
    text = (ROOT / "scenarios/crane/crane_completed.fcl").read_text("utf-8")
    lines = text.splitlines()
    at = next(place for place, line in enumerate(lines) if line.strip().startswith(f"RULE {label}:"))
    head, _, term = lines[at].rpartition(" ")
    lines[at] = f"{head} {'zero' if term != 'zero;' else 'pos_medium'};"
    other = loads("\n".join(lines))
    found = replay(other, table, "REAL")
    assert found.first is not None
    assert str(label) in {each.label for each in found.rules}


def test_every_breakpoint_is_visited_and_both_sides_of_it():
    _, table = made("crane/crane_completed.fcl", arithmetic="LREAL")
    for name, knots in (("distance", (-5, 0, 5, 10, 22)), ("angle", (-50, -5, 0, 5, 50))):
        values = table[name]
        for knot in knots:
            assert (values == knot).any()
            near = values[np.abs(values - knot) < 0.05]
            assert near.min() < knot < near.max()


def test_a_gap_is_entered_from_where_a_rule_is_active_and_left_again():
    block, table = made("bath/valve_and.fcl", arithmetic="LREAL")
    active = replay(block, table, "LREAL").record.active[-3:, 0]
    assert active.tolist() == [True, False, True]


def test_there_are_no_more_than_are_wanted_and_all_lie_in_the_universe():
    _, table = made(
        "crane/crane_completed.fcl", "distance=-2..7", "angle=-60..1", most=100, arithmetic="LREAL"
    )
    assert len(table.ticks) <= 100
    assert (table["distance"].min(), table["distance"].max()) == (-2, 7)
    assert (table["angle"].min(), table["angle"].max()) == (-60, 1)

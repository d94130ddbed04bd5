"""A signal stays between edges that change with time, or it is said where and by how much it does not."""

import math

import numpy as np
import pytest

from fcl_sim.judge.judge import judge
from fcl_sim.judge.verdict import Corridor, Requirement, Status
from fcl_sim.loop.trace import Trace

SECOND = 10**9
NONE = math.nan


def trace(*values) -> Trace:
    found = np.array(values, dtype=float)
    return Trace(np.arange(len(values)) * SECOND, ("y",), {"y": "m"}, found[:, None])


def verdict(run, ticks, low, high, *, expect_fail=False):
    corridor = Corridor(name="corridor.csv", signal="y", ticks=ticks, low=low, high=high)
    requirement = Requirement(id="K", text="as told", corridor=corridor, unit="m", expect_fail=expect_fail)
    (found,) = judge(run, [requirement])
    return found


FUNNEL = ((0, 4 * SECOND), (-10.0, -2.0), (10.0, 2.0))


def test_the_margin_is_the_distance_from_the_nearer_edge_between_two_rows():
    found = verdict(trace(9, 7, -5.5, 3, 1), *FUNNEL)
    assert (found.status, found.value, found.violation) == (Status.PASS, 0.5, None)
    assert found.reason == "y stays in its corridor, 0.5 m from its edge at 2 s."
    assert found.definition == (
        "smallest distance of the signal from the edges in corridor.csv, negative outside of them, "
        "at the scans from 0 s to 4 s; the edges are linear between the rows of the table"
    )


def test_what_leaves_the_corridor_is_told_with_its_first_stretch():
    found = verdict(trace(0, 8.5, 6.25, 0, -7), *FUNNEL)
    assert (found.status, found.value, found.violation) == (Status.FAIL, -5.0, (1.0, 2.0))
    assert found.reason == "y leaves its corridor, by 5 m at 4 s, first violated from 1 s to 2 s."


def test_the_edge_belongs_to_the_corridor():
    assert verdict(trace(10, 8, 6, 4, 2), *FUNNEL).value == 0.0
    assert verdict(trace(10, 8, 6, 4, 2), *FUNNEL).status is Status.PASS
    assert verdict(trace(10, 8, 6, 4, 2.0000001), *FUNNEL).status is Status.FAIL


def test_where_there_is_no_edge_anything_goes():
    ticks = tuple(range(0, 4 * SECOND, SECOND))
    found = verdict(trace(99, 99, 1, 99), ticks, (0.0,) * 4, (NONE, NONE, 2.0, NONE))
    assert found.status is Status.PASS
    nothing = verdict(trace(1, 2), (0, SECOND), (NONE, NONE), (NONE, NONE))
    assert nothing.status is Status.UNTESTED


def test_the_corridor_asks_only_from_its_first_row_to_its_last():
    ticks, low, high = (SECOND, 2 * SECOND), (-1.0, -1.0), (1.0, 1.0)
    assert verdict(trace(99, 0, 0, 99), ticks, low, high).status is Status.PASS
    assert verdict(trace(math.nan, 0, 0), ticks, low, high).status is Status.PASS


@pytest.mark.parametrize("expect_fail", [False, True])
def test_a_trace_that_ends_in_the_corridor_is_inconclusive_unless_it_has_left_it(expect_fail):
    found = verdict(trace(0, 0), *FUNNEL, expect_fail=expect_fail)
    assert found.status is Status.INCONCLUSIVE
    assert found.reason.startswith("The trace ends at 1 s, and the corridor at 4 s.")
    assert verdict(trace(0, 20), *FUNNEL).status is Status.FAIL
    assert verdict(trace(0), (SECOND, 2 * SECOND), (0.0, 0.0), (1.0, 1.0)).status is Status.INCONCLUSIVE
    between = (SECOND // 4, SECOND // 2)
    assert verdict(trace(0, 0), between, (0.0, 0.0), (1.0, 1.0)).status is Status.UNTESTED


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_nan_never_passes_a_corridor(bad):
    assert verdict(trace(0, bad, 0, 0, 0), *FUNNEL).status is Status.FAULT


def test_how_far_a_temperature_is_from_its_edge_is_told_in_kelvin():
    warm = Trace(np.arange(2) * SECOND, ("y",), {"y": "degC"}, np.array([[20.0], [28.0]]))
    told = [verdict(warm, (0, SECOND), (10.0, 10.0), (high, high)).reason for high in (30.0, 27.0)]
    assert told[0] == "y stays in its corridor, 2 K from its edge at 1 s."
    assert told[1] == "y leaves its corridor, by 1 K at 1 s, first violated at 1 s."

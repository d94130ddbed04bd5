"""Scans that take too long, and restarts: when the PLC reads and writes, and what it remembers."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.diagnostics import InputFault
from fcl_sim.loop.blocks.setting import Text
from fcl_sim.loop.clock import NEVER, overruns, scan_starts, schedule
from fcl_sim.loop.diagram import (
    LATE,
    POLICIES,
    SKIP,
    Diagram,
    Node,
    Overruns,
    PlantNode,
    Restart,
    Timing,
    Wire,
)
from fcl_sim.loop.run import run
from fcl_sim.units import parse_quantity
from tests.loop.diagrams import crane, plant_of, timing

MS = 10**6

FOLLOWER = """
PLANT = Plant(
    name="thing", title="What is written, as the plant has it",
    states=(State("x", "1", 0.0, "integral"),),
    inputs=(Input("u", "1", "written", start=7.0),),
    outputs=(Output("t", "s", "time"), Output("x", "1", "integral of what was written")),
    parameters=(),
)


def dynamics(t, x, u, p, mode, dx):
    dx[0] = u[0]


def outputs(t, x, u, p, mode, y):
    y[0] = t
    y[1] = x[0]
"""


def of(*listed, policy=SKIP, seconds=1.0, restarts=(), **further):
    """Return a timing of 10 ms with scans, by number, that take so many milliseconds."""
    found = Overruns(policy=policy, listed=tuple((number, round(length * MS)) for number, length in listed))
    return timing(10.0, seconds, overruns=found, restarts=tuple(restarts), **further)


def starts(given):
    """Return the milliseconds at which scans read."""
    return (schedule(given).starts / MS).tolist()


def restart(at, kind="warm", lasts=0.0):
    return Restart(at=round(at * MS), kind=kind, lasts=round(lasts * MS))


def test_without_overruns_scans_are_on_time_and_write_after_the_latency():
    found = schedule(timing(10.0, 1.0, latency=3 * MS, jitter=2 * MS, seed=5))
    assert np.array_equal(found.starts, scan_starts(timing(10.0, 1.0, latency=3 * MS, jitter=2 * MS, seed=5)))
    assert np.all(found.writes - found.starts == 3 * MS)
    assert (found.cold, found.incidents) == ((), ())


def test_scans_that_fall_due_in_a_long_one_are_left_out_or_the_last_of_them_is_run_late():
    assert starts(of((2, 13), seconds=0.06)) == [0, 10, 20, 40, 50, 60]
    assert starts(of((2, 13), seconds=0.06, policy=LATE)) == [0, 10, 20, 33, 40, 50, 60]
    assert starts(of((2, 35), seconds=0.08)) == [0, 10, 20, 60, 70, 80]
    assert starts(of((2, 35), seconds=0.08, policy=LATE)) == [0, 10, 20, 55, 60, 70, 80]


@pytest.mark.parametrize("policy", POLICIES)
def test_a_scan_that_is_due_as_the_long_one_ends_is_on_time(policy):
    assert starts(of((2, 20), seconds=0.05, policy=policy)) == [0, 10, 20, 40, 50]


def test_a_late_scan_that_is_not_done_when_the_next_is_due_makes_that_late_too():
    given = of((1, 14), seconds=0.06, policy=LATE, latency=8 * MS)
    assert starts(given) == [0, 10, 24, 32, 40, 50, 60]
    assert (schedule(given).writes / MS).tolist() == [8, 24, 32, 40, 48, 58, 68]


def test_numbers_count_multiples_of_the_scan_time_and_a_scan_that_is_left_out_cannot_overrun():
    assert starts(of((2, 15), (3, 25), (4, 12), seconds=0.08)) == [0, 10, 20, 40, 60, 70, 80]
    assert starts(of((2, 15), (3, 25), seconds=0.08, policy=LATE)) == [0, 10, 20, 35, 60, 70, 80]


@pytest.mark.parametrize("policy", POLICIES)
def test_a_run_ends_at_its_end_even_in_a_long_scan_whose_outputs_come_too_late(policy):
    found = schedule(of((4, 70), seconds=0.06, policy=policy))
    assert (found.starts / MS).tolist() == [0, 10, 20, 30, 40, 60]
    assert found.writes[-1] == NEVER


times = st.integers(11, 60)
lists = st.lists(st.tuples(st.integers(0, 99), times), max_size=12, unique_by=lambda each: each[0])
pauses = st.lists(st.tuples(st.integers(5, 990), st.integers(0, 40)), max_size=4)


@given(lists, st.sampled_from(POLICIES), st.integers(0, 5), st.integers(0, 5), pauses)
def test_a_scan_begins_after_the_one_before_has_written_or_lost_its_outputs(
    listed, policy, latency, jitter, pauses
):
    restarts, free = [], 0
    for at, lasts in sorted(pauses):
        if at > free:
            restarts.append(restart(at, "cold", lasts))
            free = at + lasts
    plan = of(*listed, policy=policy, restarts=restarts, latency=latency * MS, jitter=jitter * MS, seed=3)
    found = schedule(plan)
    assert np.all(np.diff(found.starts) > 0)
    assert (found.starts[0] < 10 * MS, found.starts[-1]) == (True, 1000 * MS)
    written = found.writes[:-1] != NEVER
    assert np.all((found.writes[:-1] <= found.starts[1:]) | ~written | (found.starts[1:] == 1000 * MS))
    for each in restarts:
        assert not np.any((found.starts[:-1] >= each.at) & (found.starts[:-1] < each.at + each.lasts))
        assert not np.any((found.starts[:-1] < each.at) & (found.writes[:-1] > each.at) & written)
    told = [each.tick for each in found.incidents if each.kind == "restart"]
    assert told == [each.at for each in restarts]
    assert len(found.cold) <= len(restarts)


def test_overruns_are_drawn_with_their_chance_and_length_from_the_seed_and_the_run():
    given = Overruns(chance=0.1, longest=25 * MS)
    plan = timing(10.0, 1000.0, seed=4, overruns=given)
    drawn = overruns(plan)
    assert overruns(plan) == drawn
    assert overruns(plan, 1) != drawn
    assert abs(len(drawn) / 100_000 - 0.1) < 4 * np.sqrt(0.09 / 100_000)
    lengths = np.array(list(drawn.values())) / MS
    assert np.all((lengths > 10) & (lengths <= 25))
    assert abs(lengths.mean() - 17.5) < 4 * 15 / np.sqrt(12 * lengths.size)
    both = replace(plan, overruns=replace(given, listed=((3, 99 * MS),)))
    assert overruns(both) == drawn | {3: 99 * MS}


def test_jitter_is_the_same_with_overruns_drawn_from_the_same_seed():
    plain = timing(10.0, 1.0, jitter=2 * MS, seed=9)
    drawn = replace(plain, overruns=Overruns(chance=0.2, longest=15 * MS))
    assert set(schedule(drawn).starts) < set(schedule(plain).starts)


@pytest.mark.parametrize(
    ("plan", "message"),
    [
        (of((3, 10)), "scan 3 does not overrun in 0.01 s"),
        (timing(overruns=Overruns(chance=0.1)), "the longest of the scans that overrun does not"),
        (of(restarts=[restart(0)]), "a restart comes after the start"),
        (of(restarts=[restart(2)], jitter=3 * MS), "a restart comes after the start"),
        (
            of(restarts=[restart(300), restart(300)]),
            "at 0.3 s comes before that at 0.3 s is over",
        ),
        (of(restarts=[restart(350), restart(300, lasts=60)]), "at 0.35 s comes before that at 0.3 s is over"),
    ],
)
def test_overruns_and_restarts_that_contradict_themselves_are_refused(plan, message):
    with pytest.raises(InputFault, match=message):
        schedule(plan)


def loop(folder, plan: Timing, *nodes: Node, plc="") -> Diagram:
    """Return a plant that is written the number of the scan: the time at which it was read, in scans."""
    number = Node(
        name="number",
        type="gain",
        inputs={"input": Wire("plant.t")},
        parameters={"gain": parse_quantity("100 1/s")},
    )
    plant = PlantNode(name="plant", model=plant_of(folder, FOLLOWER), inputs={"u": Wire("number")})
    return Diagram(plant=plant, nodes=(number, *nodes), timing=plan, plc=plc)


def test_a_long_scan_writes_when_it_ends_and_until_then_the_last_outputs_are_held(tmp_path):
    skipped = run(loop(tmp_path, of((1, 25), seconds=0.06, latency=4 * MS)))
    # 7 is held for 4 ms, what scan 0 read until the long scan ends at 35 ms, then what that read
    assert (skipped.ticks / MS).tolist() == [0, 10, 40, 50, 60]
    assert skipped["plant.u"] == pytest.approx([7, 0, 1, 4, 5])
    assert skipped["plant.x"] == pytest.approx([0, 0.028, 0.033, 0.037 + 0.024, 0.077 + 0.03])
    late = run(loop(tmp_path, of((1, 25), seconds=0.06, latency=4 * MS, policy=LATE)))
    assert (late.ticks / MS).tolist() == [0, 10, 35, 40, 50, 60]
    assert late["plant.u"] == pytest.approx([7, 0, 1, 3.5, 4, 5])
    assert late["plant.x"] == pytest.approx([0, 0.028, 0.028, 0.032 + 0.0035, 0.0495 + 0.024, 0.0895 + 0.03])


def test_traces_tell_of_overruns_and_restarts(tmp_path):
    plan = of((1, 25), seconds=0.2, restarts=[restart(63, "cold", 20)])
    trace = run(loop(tmp_path, plan))
    assert [(each.tick / MS, each.kind, each.text) for each in trace.incidents] == [
        (10, "overrun", "a scan of 0.025 s"),
        (63, "restart", "cold restart of 0.02 s"),
    ]
    assert (trace.ticks / MS).tolist() == [0, 10, 40, 50, 60, 90, *range(100, 201, 10)]


def test_outputs_that_a_restart_cuts_off_are_lost(tmp_path):
    plan = of(seconds=0.06, latency=5 * MS, restarts=[restart(23, "warm")])
    trace = run(loop(tmp_path, plan))
    assert (trace.ticks / MS).tolist() == [0, 10, 20, 30, 40, 50, 60]
    assert trace["plant.u"].tolist() == pytest.approx([7, 0, 1, 1, 3, 4, 5])


COUNTER = "def step(inputs, state, t):\n    state['n'] = state.get('n', 0) + 1\n    return state['n']\n"


def counters():
    """Return an integrator, a unit delay, a block in Python, a sensor with a lag."""
    own, second = Text("own.py", COUNTER), parse_quantity("1 s")
    return (
        Node(
            name="plc.sum",
            type="integrator",
            inputs={"input": Wire("number")},
            parameters={"initial": parse_quantity("3 s"), "method": "forward"},
        ),
        Node(name="plc.late", type="unit_delay", inputs={"input": Wire("plc.sum")}),
        Node(name="plc.own", type="python", parameters={"file": own, "outputs": {"n": "1"}}),
        Node(
            name="plc.lag",
            type="sensor",
            inputs={"input": Wire("number")},
            parameters={"lag": second},
        ),
        Node(name="beside", type="unit_delay", inputs={"input": Wire("plc.sum")}),
    )


def test_after_a_cold_restart_the_blocks_of_the_plc_begin_anew_and_all_else_goes_on(tmp_path):
    plan = of(seconds=0.2, restarts=[restart(95, "cold")])
    cold = run(loop(tmp_path, plan, *counters(), plc="plc."))
    warm = run(loop(tmp_path, of(seconds=0.2), *counters(), plc="plc."))
    for name in cold.names:
        assert np.array_equal(cold[name][:10], warm[name][:10])
    own = next(name for name in cold.names if name.startswith("plc.own"))
    assert cold[own].tolist() == [*range(1, 11), *range(1, 12)]
    assert (cold["plc.sum"][0], cold["plc.sum"][10]) == (3.0, 3.0)
    assert cold["plc.late"][10] == 0.0
    assert cold["beside"][10] == cold["plc.sum"][9]
    for name in ("plc.lag", "number", "plant.x"):
        assert np.array_equal(cold[name], warm[name])


def test_without_a_controller_a_cold_restart_reaches_every_block_but_devices(tmp_path):
    cold = run(loop(tmp_path, of(seconds=0.2, restarts=[restart(100, "cold")]), *counters()))
    assert cold["beside"][10] == 0.0
    assert cold["plc.lag"][10] > 0.0


def test_a_warm_restart_keeps_every_memory():
    plan = timing(50.0, 3.0)
    plain = run(crane(timing=plan))
    warm = run(crane(timing=replace(plan, restarts=(Restart(at=1010 * MS),))))
    assert np.array_equal(warm.values, plain.values)
    assert len(warm.incidents) == 1


def test_a_cold_restart_of_a_fuzzy_block_and_a_differentiator_shows_in_their_signals():
    plan = timing(50.0, 3.0)
    plain = run(crane(timing=plan))
    cold = run(crane(timing=replace(plan, restarts=(Restart(at=1000 * MS, kind="cold"),))))
    assert cold["controller.speed"][20] == 0.0
    assert plain["controller.speed"][20] != 0.0
    assert np.array_equal(cold["crane.distance"][:21], plain["crane.distance"][:21])

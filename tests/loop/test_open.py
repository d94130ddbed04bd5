"""A loop in the hand is the loop that runs, and a signal that is forced stays what it is forced to."""

from dataclasses import replace
from math import isnan

import numpy as np
import pytest

from fcl_sim.diagnostics import InputFault
from fcl_sim.loop.blocks.setting import Text
from fcl_sim.loop.diagram import Node, Wire
from fcl_sim.loop.open import OpenLoop
from fcl_sim.loop.run import run
from fcl_sim.loop.tape import lower
from fcl_sim.loop.wiring import wire
from tests.loop.block_loops import node
from tests.loop.diagrams import crane, timing


def diagram(**further):
    loop = crane(timing=timing(50.0, 3.0, **further))
    nodes = (
        node("seen", "unit_delay", {"input": "crane.distance"}),
        node("sum", "integrator", {"input": "seen"}, method="forward"),
    )
    return replace(loop, nodes=(*loop.nodes, *nodes), aliases={"away": Wire("crane.distance", -1.0)})


def opened(**further):
    return OpenLoop(wire(diagram(**further)))


def test_scan_by_scan_a_loop_gives_the_trace_of_its_run():
    loop, whole = opened(latency=10**7), run(diagram(latency=10**7))
    assert isnan(loop.time)
    for n in range(whole.ticks.size):
        assert not loop.over
        assert loop.scan() == 1
        assert loop.time == whole.time[n]
        found = {name: whole[name][n] for name in whole.names if name != "crane.power"}
        assert {name: each for name, each in loop.values.items() if name in found} == found
        if n < whole.ticks.size - 1:  # since the sample was taken it has been written
            assert loop["crane.power"] == whole["crane.power"][n + 1]
    assert loop.over
    assert loop.scan(5) == 0
    assert np.array_equal(loop.trace.values, whole.values)
    assert loop.units["crane.angle"] == "deg"
    assert loop.names == whole.names


def test_a_forced_output_of_the_plant_is_what_the_blocks_see_and_the_plant_goes_on():
    loop = opened()
    loop.scan(10)
    loop.force("crane.distance", "3000 mm")
    assert loop.forced == {"crane.distance": 3.0}
    loop.scan(10)
    trace = loop.trace
    assert np.all(trace["crane.distance"][10:] == 3.0)
    assert np.all(trace["away"][10:] == -3.0)
    assert trace["seen"][11:].tolist() == [3.0] * 9
    assert np.all(trace["controller.speed"][15:] > -0.5)
    loop.release("crane.distance")
    loop.scan()
    assert loop["crane.distance"] != 3.0
    assert loop.forced == {}


@pytest.mark.parametrize("name", ["controller.predicted", "controller.rules.power", "sum"])
def test_a_forced_block_executes_and_its_value_goes_on_to_all_that_read_it(name):
    loop, plain = opened(), run(diagram())
    loop.scan(5)
    loop.force(name, 4.0)
    loop.scan(5)
    assert np.all(loop.trace[name][5:] == 4.0)
    if name == "controller.rules.power":
        assert np.all(loop.trace["crane.power"][5:] == 4.0)
    if name == "sum":
        loop.release()
        loop.scan()
        assert loop["sum"] == plain["sum"][10]


@pytest.mark.parametrize("latency", [0, 10**7, 5 * 10**7])
def test_a_forced_input_of_the_plant_is_what_moves_it_at_once(latency):
    loop = opened(latency=latency)
    loop.scan(10)
    loop.force("crane.power", 0.0)
    assert loop["crane.power"] == 0.0
    loop.scan(10)
    assert np.all(loop.trace["crane.power"][10:] == 0.0)
    assert np.all(loop.trace["controller.rules.power"][10:] != 0.0)
    loop.release()
    loop.scan(2)
    assert loop["crane.power"] != 0.0


def test_a_name_that_stands_for_a_signal_forces_that_one_with_its_sign():
    loop = opened()
    loop.force("away", -2.0)
    loop.scan(3)
    assert (loop["crane.distance"], loop["away"]) == (2.0, -2.0)
    loop.release("away")
    assert loop.forced == {}


def test_what_a_block_in_python_gives_can_be_forced():
    own = {"file": Text("own.py", "def step(inputs, state, t):\n    return t\n"), "outputs": {"t": "s"}}
    plain = diagram()
    loop = OpenLoop(
        wire(replace(plain, nodes=(Node(name="own", type="python", parameters=own), *plain.nodes)))
    )
    name = next(each for each in loop.names if each.startswith("own"))
    loop.scan(2)
    loop.force(name, 7.0)
    loop.force("crane.distance", 1.0)
    loop.scan(2)
    loop.release(name)
    loop.scan()
    assert loop.trace[name] == pytest.approx([0.0, 0.05, 7.0, 7.0, 0.2])


def test_a_loop_goes_back_to_what_was_saved_and_goes_on_from_there_as_before():
    loop = opened()
    loop.scan(20)
    loop.force("sum", 1.0)
    saved = loop.state
    loop.scan(20)
    first = loop.trace
    loop.release()
    loop.force("crane.distance", 0.0)
    loop.scan(5)
    loop.restore(saved)
    assert (loop.time, dict(loop.forced)) == (0.95, {"sum": 1.0})
    loop.scan(20)
    assert np.array_equal(loop.trace.values, first.values)
    other = opened()
    other.restore(saved)
    other.scan(20)
    assert np.array_equal(other.trace.values, first.values)


def test_a_loop_in_which_nothing_is_forced_has_no_row_for_it():
    wiring = wire(diagram())
    plain, forced = lower(wiring), lower(wiring, 0, {"sum": 1.0, "crane.angle": 0.0, "crane.power": 2.0})
    assert np.array_equal(lower(wiring, 0, {}).ints, plain.ints)
    assert forced.ints.size > plain.ints.size
    assert np.array_equal(forced.memory, plain.memory)
    assert forced.slots == plain.slots


def test_a_run_that_cannot_go_on_stays_where_it_is():
    plain = diagram()
    broken = node("broken", "fault", {"input": "sum"}, kind="dropout", during="nan", **{"from": "1 s"})
    loop = OpenLoop(wire(replace(plain, nodes=(*plain.nodes, broken))))
    assert loop.scan(100) == 20
    assert loop.over
    assert (loop.trace.fault.tick, loop.trace.fault.signal) == (10**9, "broken")
    assert loop.scan() == 0


def test_what_cannot_be_forced_is_told_with_what_would_be_right():
    loop = opened()
    with pytest.raises(InputFault, match=r"did you mean `crane\.angle`"):
        loop.force("crane.angel", 1.0)
    with pytest.raises(InputFault, match="did you mean `sum`"):
        loop["sun"]
    with pytest.raises(InputFault, match=r"`crane\.angle` cannot be forced to 3 m"):
        loop.force("crane.angle", "3 m")
    with pytest.raises(ValueError, match="nan"):
        loop.force("crane.angle", float("nan"))
    with pytest.raises(ValueError, match="-1 scans"):
        loop.scan(-1)

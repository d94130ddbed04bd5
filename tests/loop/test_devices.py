"""Sensors, actuators and faults by what is known of them in closed form, and in a scenario."""

from math import exp

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.diagnostics import InputFault
from fcl_sim.loop.run import run
from fcl_sim.loop.wiring import wire
from tests.loop.block_bench import diagram
from tests.loop.block_loops import CYCLE, node, outputs_of


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("signals")


def gives(folder, values, kind, /, **parameters):
    """Return what a device gives, fed with values."""
    block = node("device", kind, {"input": "signals.wave"}, **parameters)
    return np.array(outputs_of(folder, block, [[each] for each in values]))


def test_a_sensor_follows_a_ramp_late_by_its_time_constant(folder):
    t = CYCLE * np.arange(200)
    found = gives(folder, 2.0 * t, "sensor", lag="0.4 s")
    assert found == pytest.approx(2.0 * (t - 0.4 * (1.0 - np.exp(-t / 0.4))), abs=1e-12)


def test_the_lag_of_a_sensor_takes_the_true_time_between_scans(folder):
    plan = {"jitter": 8 * 10**6, "seed": 3}
    loop = diagram(folder, node("device", "sensor", {"input": "signals.ramp"}, lag="0.1 s"), **plan)
    trace = run(loop)
    assert np.ptp(np.diff(trace.ticks)) > 0
    t = trace.time - trace.time[0]
    late = 0.1 * (1.0 - np.exp(-t / 0.1))
    assert trace["device"] == pytest.approx(trace["signals.ramp"] - late, abs=1e-12)


@given(st.floats(-3, 3), st.integers(1, 16))
def test_a_converter_is_off_by_half_a_step_within_its_range_and_gives_so_many_values(
    tmp_path_factory, u, bits
):
    folder = tmp_path_factory.getbasetemp()
    step = 4.0 / 2**bits
    (found,) = gives(folder, [u], "sensor", low="-2 m", high="2 m", bits=bits)
    assert found == -2.0 + step * round((found + 2.0) / step)
    assert -2.0 <= found <= 2.0 - step
    if -2.0 <= u <= 2.0 - step:
        assert abs(found - u) <= step / 2


def test_noise_of_a_sensor_is_that_of_a_noise_block_of_its_name(folder):
    bare = run(diagram(folder, node("device", "noise", sigma="3 cm", correlation_time="0.2 s"), seed=7))
    seen = {"input": "signals.stairs"}
    loop = diagram(folder, node("device", "sensor", seen, noise="3 cm", correlation_time="0.2 s"), seed=7)
    trace = run(loop)
    assert trace["device"] == pytest.approx(trace["signals.stairs"] + bare["device"] / 100, abs=1e-15)


def test_a_play_turns_a_triangle_into_one_that_is_flat_for_its_width(folder):
    up = np.arange(0.0, 3.0, 0.125)
    values = np.concatenate([up, up[::-1], up])
    found = gives(folder, values, "actuator", backlash="1 m")
    assert found.max() == up.max() - 0.5
    assert found[24:].min() == 0.5
    flat = np.flatnonzero(np.diff(found[24:48]) == 0.0).size
    assert flat == 1.0 / 0.125 - 1 + 1


def test_a_sticky_valve_that_is_cycled_within_its_stiction_does_not_move(folder):
    values = 0.3 * np.sin(np.arange(100))
    assert np.all(gives(folder, values, "actuator", stiction="30 cm") == 0.0)
    assert np.ptp(gives(folder, values, "actuator", stiction="29 cm")) > 0.0


def test_a_motor_reaches_a_step_with_its_rate(folder):
    found = gives(folder, [1.0] * 60, "actuator", rate="2 m/s")
    assert found == pytest.approx(np.minimum(1.0, 2.0 * CYCLE * np.arange(1, 61)), abs=1e-14)
    assert found[-1] == 1.0


def test_scans_are_lost_with_their_chance(folder):
    values = np.arange(1.0, 251.0)
    given = {"kind": "dropout", "during": "zero", "chance": "25 %"}
    found = gives(folder, values, "fault", **given)
    assert np.all((found == values) | (found == 0.0))
    assert abs(np.mean(found == 0.0) - 0.25) < 4 * np.sqrt(0.25 * 0.75 / 250)
    held = gives(folder, values, "fault", **given | {"during": "hold"})
    assert held == pytest.approx(np.maximum.accumulate(np.maximum(found, 1.0)))


@pytest.mark.parametrize(
    ("kind", "parameters", "message"),
    [
        ("sensor", {"bits": 12}, "`bits` divide a range that is not given"),
        ("sensor", {"bits": 12, "resolution": "1 m", "low": "0 m", "high": "1 m"}, "both `bits` and"),
        ("sensor", {"bits": 33, "low": "0 m", "high": "1 m"}, "no converter has more than 32 bits"),
        ("sensor", {"low": "1 m", "high": "1 m"}, "`low` does not lie below `high`"),
        ("sensor", {"correlation_time": "1 s"}, "there is no noise to correlate"),
        ("sensor", {"bias": "1 s"}, "1 s does not convert to m"),
        ("actuator", {"low": "1 m", "high": "0 m"}, "`low` lies above `high`"),
        ("actuator", {"low": "1 m"}, "it starts at a value beyond"),
        ("actuator", {"rate": "0 m/s"}, "it must be greater than 0"),
        ("fault", {"kind": "stuck", "value": "1 m"}, "a fault of kind `stuck` has no `value`"),
        ("fault", {"kind": "spike"}, "nothing is added"),
        ("fault", {"kind": "delayed"}, "0 s is not a whole number of scans"),
        ("fault", {"kind": "delayed", "delay": "30 ms"}, "give a `delay` of 0.04 s"),
        ("fault", {"kind": "stuck", "from": "2 s", "to": "2 s"}, "`to` does not lie behind `from`"),
        ("fault", {"kind": "dropout", "chance": 1.5}, "at most 1"),
    ],
)
def test_a_device_that_cannot_be_is_refused(folder, kind, parameters, message):
    with pytest.raises(InputFault, match=message):
        wire(diagram(folder, node("device", kind, {"input": "signals.wave"}, **parameters)))


def test_a_sensor_at_rest_starts_where_its_input_is(folder):
    assert gives(folder, [1.5] * 5, "sensor", lag="1 s") == pytest.approx([1.5] * 5, abs=0)
    assert gives(folder, [1.5, 2.5], "sensor", lag="1 s")[1] == pytest.approx(
        2.5 - 1.0 / CYCLE + (1.0 / CYCLE) * exp(-CYCLE), abs=1e-12
    )

"""PID controllers: closed forms of linear loops, limits without windup, transfers without a bump."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.diagnostics import InputFault
from fcl_sim.loop.run import run
from fcl_sim.loop.wiring import wire
from tests.loop.block_bench import diagram
from tests.loop.block_loops import CYCLE, fopdt, node, outputs_of

LAG, GAIN = 0.4, 2.0
A = math.exp(-CYCLE / LAG)
FORMS = ["pid", "pid_velocity"]
WIRES = {"setpoint": "signals.wave", "measurement": "signals.ramp"}
ADAPTED = WIRES | {"Kc": "signals.ratio", "Ti": "signals.moment"}
signals = st.lists(st.tuples(st.floats(-10, 10), st.floats(-10, 10)), min_size=5, max_size=40)
sizes = st.floats(0.1, 10.0)
weights = st.floats(0.0, 1.0)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("controllers")


def loop(folder, kind, delay=0.0, **parameters):
    """Run a controller on first order plus dead time, setpoint 1 from scan 0 on."""
    control = node("control", kind, {"setpoint": "one", "measurement": "process"}, **parameters)
    nodes = (node("one", "constant", value=1.0), control, *fopdt(LAG, GAIN, delay, "control"))
    return run(diagram(folder, *nodes))


@pytest.mark.parametrize("beta", [0.1, 0.7, 1.0, 1.6])
def test_a_pi_that_cancels_the_pole_approaches_by_a_factor_each_scan_and_at_1_at_once(folder, beta):
    gain, time = beta * A / ((1 - A) * GAIN), CYCLE * A / (1 - A)
    y = loop(folder, "pid", Kc=gain, Ti=f"{time!r} s")["process"]
    assert y == pytest.approx(1 - (1 - beta) ** np.arange(y.size), abs=2e-15)


@pytest.mark.parametrize(("gain", "time"), [(0.5, 0.3), (3.0, 0.2), (6.0, 5.0)])
def test_a_pi_on_a_first_order_lag_moves_by_the_poles_of_the_loop(folder, gain, time):
    q0, q1, b = gain * (1 + CYCLE / time), -gain, GAIN * (1 - A)
    y = loop(folder, "pid", Kc=gain, Ti=f"{time!r} s")["process"]
    p, q = np.roots([1.0, -(1 + A - b * q0), A + b * q1]).astype(complex)
    share = (b * q0 - 1 + q) / (p - q)  # of p, so that y_0 = 0 and y_1 = b q0
    k = np.arange(y.size)
    assert y == pytest.approx((1 + share * p**k - (1 + share) * q**k).real, abs=3e-14)


@pytest.mark.parametrize("delay", [0.0, 0.1, 0.15])
def test_a_pi_in_increments_moves_a_loop_as_the_positional_one_does(folder, delay):
    tuned = {"Kc": 0.8, "Ti": "0.4 s"}
    positional = loop(folder, "pid", delay, **tuned)
    # the first increment lacks the proportional part, for it begins where the signals are
    velocity = loop(folder, "pid_velocity", delay, **tuned, initial=0.8)
    assert velocity["process"] == pytest.approx(positional["process"], abs=1e-13)
    assert positional["process"][-1] == pytest.approx(1.0, abs=1e-3)


def test_a_step_of_the_error_is_answered_in_the_isa_form(folder):
    gain, ti, td, n, b, c = 2.0, 0.5, 0.3, 4.0, 0.6, 0.8
    block = node("it", "pid", WIRES, Kc=gain, Ti="0.5 s", Td="0.3 s", N=n, b=b, c=c)
    answer = outputs_of(folder, block, [(0.0, 0.0)] * 3 + [(1.0, 0.0)] * 100)
    k, filter_time = np.arange(100), td / n
    fading = (filter_time / (filter_time + CYCLE)) ** k
    expected = gain * (b + (k + 1) * CYCLE / ti + c * td / (filter_time + CYCLE) * fading)
    assert answer[:3] == [0.0] * 3
    assert answer[3:] == pytest.approx(expected, rel=1e-13)
    # and in the limit of short scans the continuous one, with the error of a first-order rule
    continuous = gain * (b + k * CYCLE / ti + c * n * np.exp(-n / td * k * CYCLE))
    assert np.abs(answer[3:] - continuous).max() < gain * (CYCLE / ti + c * n * CYCLE / filter_time)


@given(signals, sizes, st.tuples(sizes, st.floats(0.0, 2.0)), st.tuples(weights, weights))
def test_without_limits_the_increments_add_up_to_the_positional_form(folder, rows, gain, times, weighted):
    (ti, td), (b, c) = times, weighted
    tuned = {"Kc": gain, "Ti": f"{ti!r} s", "Td": f"{td!r} s", "b": b, "c": c}
    position = outputs_of(folder, node("it", "pid", WIRES, **tuned), rows)
    velocity = outputs_of(folder, node("it", "pid_velocity", WIRES, **tuned), rows)
    steps = outputs_of(folder, node("it", "pid_velocity", WIRES, **tuned, gives="increment"), rows)
    start = gain * (b * rows[0][0] - rows[0][1])
    size = 1e-9 * (1.0 + max(map(abs, position)))
    assert [start + each for each in velocity] == pytest.approx(position, abs=size)
    assert np.cumsum(steps) == pytest.approx(velocity, abs=size)


@given(st.floats(-3, 3), st.floats(-3, 3), st.floats(-5, 5), sizes, sizes)
def test_automatic_goes_on_from_what_was_given_by_hand(folder, setpoint, measurement, manual, gain, ti):
    wires = WIRES | {"manual": "signals.stairs", "automatic": "signals.flag"}
    rows = [(setpoint, measurement, manual, float(k >= 10)) for k in range(20)]
    tuned = {"Kc": gain, "Ti": f"{ti!r} s", "Td": "1 s", "b": 0.3, "low": "-4 m", "high": "4 m"}
    back = {"anti_windup": "back_calculation"}
    step = CYCLE * gain / ti * (setpoint - measurement)
    held = min(max(manual, -4.0), 4.0)
    for kind, further in (("pid", {}), ("pid", back), ("pid_velocity", {})):
        given = outputs_of(folder, node("it", kind, wires, **tuned, **further), rows)
        assert given[:10] == [held] * 10
        assert given[10] == pytest.approx(min(max(held + step, -4.0), 4.0), abs=1e-12)
        assert abs(given[11] - given[10]) <= abs(step) + 1e-12


@pytest.mark.parametrize("kind", FORMS)
def test_by_hand_without_a_value_the_output_stays_and_goes_on_from_there(folder, kind):
    block = node("it", kind, WIRES | {"automatic": "signals.flag"}, Kc=2.0, Ti="1 s")
    rows = [(1.0, 0.1 * min(k, 20), float(not 10 <= k < 30)) for k in range(40)]
    given = outputs_of(folder, block, rows)
    assert given[10:30] == [given[9]] * 20
    assert given[30] == pytest.approx(given[9] + 2.0 * CYCLE * (1.0 - 2.0), abs=1e-13)


@given(signals, sizes, sizes, sizes)
def test_a_change_of_the_integral_time_moves_the_output_no_more_than_an_integral_step(
    folder, rows, gain, before, after
):
    half = len(rows) // 2
    for kind in FORMS:
        wires = WIRES | {"Ti": "signals.moment"}
        adapted = [(*row, before if k < half else after) for k, row in enumerate(rows)]
        changed = outputs_of(folder, node("it", kind, wires, Kc=gain), adapted)
        kept = outputs_of(folder, node("it", kind, WIRES, Kc=gain, Ti=f"{before!r} s"), rows)
        error = rows[half][0] - rows[half][1]
        moved = CYCLE * gain * error * (1 / after - 1 / before)
        assert changed[half] - kept[half] == pytest.approx(moved, abs=1e-10)


@given(st.floats(-5, 5), st.floats(-5, 5), sizes, sizes, weights)
def test_a_change_of_the_gain_moves_nothing_where_there_is_no_error(folder, start, setpoint, old, new, b):
    """After a disturbance the loop settles; then the gain changes, whatever the weight of the setpoint."""
    rows = [(setpoint, start, old, 0.5)] * 10 + [(setpoint, setpoint, old, 0.5)] * 10
    rows += [(setpoint, setpoint, new, 0.5)] * 10
    for kind in FORMS:
        given = outputs_of(folder, node("it", kind, ADAPTED, b=b), rows)
        assert given[20:] == pytest.approx([given[19]] * 10, abs=1e-12)


@given(st.floats(-5, 5), sizes, sizes)
def test_under_an_error_a_change_of_the_gain_moves_the_proportional_part_alone(folder, error, old, new):
    rows = [(error, 0.0, old if k < 10 else new, 0.5) for k in range(11)]
    given = outputs_of(folder, node("it", "pid", ADAPTED), rows)
    step = CYCLE * new / 0.5 * error
    assert given[10] - given[9] == pytest.approx((new - old) * error + step, abs=1e-11)
    velocity = outputs_of(folder, node("it", "pid_velocity", ADAPTED), rows)
    assert velocity[10] - velocity[9] == pytest.approx(step, abs=1e-11)


@pytest.mark.parametrize(
    ("kind", "further"),
    [("pid", {}), ("pid", {"anti_windup": "back_calculation", "Tt": "0.1 s"}), ("pid_velocity", {})],
)
def test_how_long_a_limit_was_held_makes_no_difference_afterwards(folder, kind, further):
    def after(scans):
        block = node("it", kind, WIRES, Kc=2.0, Ti="0.3 s", high="1 m", low="-1 m", **further)
        rows = [(3.0, 0.0)] * scans + [(0.2 - 0.01 * k, 0.0) for k in range(60)]
        return outputs_of(folder, block, rows)[-61:]

    brief, long = after(100), after(3000)
    assert long == pytest.approx(brief, abs=1e-12)
    assert long[0] == 1.0
    assert long[1] < 1.0


def test_with_its_limits_elsewhere_it_winds_up(folder):
    block = node("it", "pid", WIRES, Kc=2.0, Ti="0.3 s")
    given = outputs_of(folder, block, [(3.0, 0.0)] * 3000 + [(-0.2, 0.0)] * 60)
    assert min(given[-60:]) > 1.0


def test_back_calculation_settles_beyond_the_limit_by_the_tracking_time(folder):
    """There the integral step is what tracking takes away: v - high = Tt Kc/Ti e."""
    gain, ti, tt, error = 2.0, 0.5, 0.2, 3.0
    block = node(
        "it", "pid", WIRES, Kc=gain, Ti="0.5 s", high="1 m", anti_windup="back_calculation", Tt="0.2 s"
    )
    beyond = tt * gain / ti * error
    fall = (beyond + 0.3) / gain  # of the setpoint: brings v a little below the limit
    given = outputs_of(folder, block, [(error, 0.0)] * 500 + [(error - fall, 0.0)])
    step = CYCLE * gain / ti * (error - fall)
    assert given[-2] == 1.0
    assert given[-1] == pytest.approx(1.0 - 0.3 - CYCLE / tt * beyond + step, abs=1e-12)


def test_tracking_follows_an_actuator_that_does_less_than_the_controller_says(folder):
    control = {"setpoint": "two", "measurement": "nothing", "tracked": "actuator"}
    nodes = (
        node("two", "constant", value=2.0),
        node("nothing", "constant", value=0.0),
        node("actuator", "limiter", {"input": "control"}, high=0.5),
        node(
            "control",
            "pid",
            control,
            Kc=1.0,
            Ti="0.5 s",
            anti_windup="back_calculation",
            Tt="0.1 s",
            initial="0",
        ),
    )
    trace = run(diagram(folder, *nodes))
    # what the actuator lacks settles where Kc/Ti e = (v - tracked)/Tt
    assert trace["control"][-1] == pytest.approx(0.5 + 0.1 * 1.0 / 0.5 * 2.0, abs=1e-12)
    assert trace["actuator"][-1] == 0.5


def test_feedforward_acts_before_the_limits_and_is_taken_over_by_hand(folder):
    wires = WIRES | {"feedforward": "signals.stairs", "automatic": "signals.flag"}
    rows = [(0.0, 0.0, 3.0, 1.0), (0.0, 0.0, 0.7, 1.0), (0.0, 0.0, 0.7, 0.0), (0.0, 0.0, 0.4, 1.0)]
    given = outputs_of(folder, node("it", "pid", wires, Kc=1.0, high="1 m"), rows)
    assert given == pytest.approx([1.0, 0.7, 0.7, 0.4], abs=1e-15)


@pytest.mark.parametrize("kind", FORMS)
def test_a_reset_makes_it_begin_anew(folder, kind):
    block = node(
        "it", kind, WIRES | {"reset": "signals.flag"}, Kc=1.5, Ti="1 s", Td="0.2 s", c=1.0, initial="2 m"
    )
    random = np.random.default_rng(3).normal(size=(40, 2))
    rows = [(*row, float(k == 20)) for k, row in enumerate(random)]
    given = outputs_of(folder, block, rows)
    assert given[20:] == outputs_of(folder, block, rows[20:])
    assert given[20] != outputs_of(folder, block, [(*row, 0.0) for row in random])[20]


def refusal(folder, *nodes):
    with pytest.raises(InputFault) as caught:
        wire(diagram(folder, *nodes))
    return str(caught.value)


def test_the_unit_of_the_output_follows_from_gain_and_measurement(folder):
    block = node("it", "pid", WIRES, Kc="3 kW/m", low="-200 W", high="4 kW")
    assert wire(diagram(folder, block)).units["it"].symbol == "kW"
    adapted = node("it", "pid_velocity", ADAPTED)
    assert wire(diagram(folder, adapted)).units["it"].symbol == "m"
    wrong = node("it", "pid", WIRES, Kc="3 kW/m", high="4 m")
    assert "`high` of `it`: 4 m does not convert to kW" in refusal(folder, wrong)
    mixed = node("it", "pid", WIRES | {"setpoint": "signals.ratio"}, Kc="3 kW/m")
    assert "`setpoint` of `it` is in m, and `signals.ratio` is in" in refusal(folder, mixed)


def test_what_belongs_to_back_calculation_is_refused_with_clamping(folder):
    text = refusal(folder, node("it", "pid", WIRES, Kc=1.0, Tt="1 s"))
    assert "`Tt` is for back calculation" in text
    assert 'set anti_windup = "back_calculation"' in text
    tracked = node("it", "pid", WIRES | {"tracked": "signals.stairs"}, Kc=1.0)
    assert "`tracked` is for back calculation" in refusal(folder, tracked)
    crossed = node("it", "pid_velocity", WIRES, Kc=1.0, low="2 m", high="1 m")
    assert "`low` lies above `high`" in refusal(folder, crossed)

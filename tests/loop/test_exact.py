"""Linear plants are moved exactly: recursions, dead times, any length of a step, and how a run ends."""

from math import exp

import numpy as np
import pytest

from fcl_sim.loop.diagram import Timing
from fcl_sim.loop.run import empty_record, proceed, run, run_tape, trace_of
from fcl_sim.loop.state import initial_state
from fcl_sim.loop.tape import lower
from fcl_sim.loop.wiring import wire
from fcl_sim.plant.linear import first_order, state_space, transfer_function, zero_pole_gain
from tests.loop.block_loops import node
from tests.loop.diagrams import timing
from tests.loop.linear_loops import diagram, simulated

TS, TAU, GAIN = 0.5, 10.0, 2.0
A = exp(-TS / TAU)
WAVE = node("u", "sine", amplitude=1.0, frequency="0.05 Hz")
STEP = node("u", "constant", value=1.0)


def recursion(u, scans, delay=0.0):
    """First order under a zero-order hold: y_{k+1} from y_k and the inputs written before, 0 at first."""
    whole, part = divmod(round(delay * 1e9), round(TS * 1e9))
    left = exp(-(TS - part / 1e9) / TAU)
    y = [0.0]
    for k in range(scans):
        new, old = (u[k - d] if k >= d else 0.0 for d in (whole, whole + 1))
        y.append(A * y[-1] + GAIN * (1 - left) * new + GAIN * (left - A) * old)
    return np.array(y)


@pytest.mark.parametrize("delay", [0.0, 2.0, 2.3, 0.1, 0.000000001, 3.499999999])
def test_first_order_and_dead_time_follow_the_recursion_of_the_hold(delay):
    trace = simulated(first_order(GAIN, TAU), timing(500.0, 60.0), WAVE, delay=delay)
    expected = recursion(trace["plant.u"], 120, delay)
    assert trace["plant.y"] == pytest.approx(expected, abs=4e-15)


@pytest.mark.parametrize("delay", [0.0, 2.0, 2.3, 11.123456789])
def test_a_step_of_first_order_and_dead_time_is_its_closed_form(delay):
    trace = simulated(first_order(GAIN, TAU), timing(500.0, 60.0), STEP, delay=delay)
    late = np.maximum(trace.time - delay, 0.0)
    assert trace["plant.y"] == pytest.approx(GAIN * -np.expm1(-late / TAU), abs=4e-15)


SLOW = Timing(scan=500_000_000, duration=60 * 10**9, latency=130_000_000, jitter=200_000_000, seed=7)


@pytest.mark.parametrize("delay", [0.0, 0.7, 6.0])
def test_latency_and_jitter_move_the_writes_and_nothing_else(delay):
    system = zero_pole_gain([-3.0 + 0j], [-0.5 + 0j, -0.1 + 1j, -0.1 - 1j], 0.4)
    trace = simulated(system, SLOW, WAVE, delay=delay)
    assert len(set(np.diff(trace.ticks))) > 100
    poles = np.array([-0.5, -0.1 + 1j, -0.1 - 1j])
    shares = [0.4 * (p + 3.0) / (p * np.prod([p - q for q in poles if q != p])) for p in poles]
    rest = 0.4 * 3.0 / np.prod(-poles)

    def step(t):
        late = np.maximum(t, 0.0)[:, np.newaxis]
        return (rest * (t > 0) + (shares * np.exp(poles * late) * (late > 0)).sum(axis=1)).real

    jumps = np.diff(trace["u"], prepend=0.0)
    expected = sum(
        jump * step(trace.time - tick / 1e9 - 0.13 - delay)
        for jump, tick in zip(jumps, trace.ticks, strict=True)
    )
    assert trace["plant.y"] == pytest.approx(expected, abs=1e-13)


@pytest.mark.parametrize("power", [0, 3, 6, 9])
def test_a_plant_with_fast_and_slow_modes_is_as_exact_as_a_plain_one(power):
    fast, slow, push = 10.0**power, -0.1 - 2.0j, 1.0 + 0.5j
    a = [[-fast, 1.0, 0.0], [0.0, slow.real, -slow.imag], [0.0, slow.imag, slow.real]]
    system = state_space(a, [[0.0], [push.real], [push.imag]], [[1.0, 1.0, 0.0]])
    trace = simulated(system, timing(100.0, 2.0), STEP)
    turned, faded = np.exp(slow * trace.time), np.exp(-fast * trace.time)
    circling = push / slow * (turned - 1.0)
    following = push / slow * ((turned - faded) / (slow + fast) - (1.0 - faded) / fast)
    assert trace["plant.y"] == pytest.approx((circling + following).real, abs=1e-13)


def test_a_slow_plant_loses_no_digits_to_a_fast_scan():
    trace = simulated(first_order(1.0, 1e7), timing(1.0, 1.0), STEP)
    assert trace["plant.y"][1:] == pytest.approx(-np.expm1(-trace.time[1:] / 1e7), rel=1e-13)


def test_integrators_add_up_what_they_are_given():
    trace = simulated(transfer_function([1.0], [1.0, 0.0, 0.0]), timing(100.0, 10.0), STEP, delay=0.25)
    late = np.maximum(trace.time - 0.25, 0.0)
    assert trace["plant.y"] == pytest.approx(0.5 * late**2, abs=1e-13)


def test_what_passes_straight_through_is_read_before_it_is_written():
    system = transfer_function([1.0, 0.0], [1.0, 1.0])
    trace = simulated(system, timing(100.0, 3.0), STEP)
    assert trace["plant.y"][0] == 0.0
    assert trace["plant.y"][1:] == pytest.approx(np.exp(-trace.time[1:]), abs=1e-15)
    late = simulated(system, timing(100.0, 3.0), STEP, delay=1.0)
    assert late["plant.y"][:11].tolist() == [0.0] * 11
    assert late["plant.y"][11:] == pytest.approx(np.exp(1.0 - late.time[11:]), abs=1e-15)


def test_the_input_is_recorded_as_it_is_written():
    trace = simulated(first_order(1.0, 1.0), timing(100.0, 3.0), WAVE, delay=1.0)
    assert np.array_equal(trace["plant.u"], trace["u"])


def test_before_the_first_write_arrives_a_plant_has_the_input_it_started_with():
    trace = run(diagram(first_order(2.0, 1.0), timing(100.0, 3.0), STEP, delay=1.0, start=3.0))
    assert trace["plant.y"][10] == pytest.approx(6.0 * -np.expm1(-1.0), abs=1e-15)


@pytest.mark.parametrize("stops", [[60], [0, 1, 2, 119, 120], list(range(121))], ids=["two", "edges", "each"])
def test_a_run_of_a_linear_plant_in_pieces_is_the_run_in_one(stops):
    tape = lower(wire(diagram(first_order(GAIN, TAU), SLOW, WAVE, delay=2.3)))
    whole = run_tape(tape)
    state, record = initial_state(tape), empty_record(tape)
    for stop in [*stops, None]:
        proceed(tape, state, record, stop)
        state = state.copy()
    assert np.array_equal(trace_of(tape, state, record).values, whole.values)


@pytest.mark.filterwarnings("ignore:(overflow|invalid value) encountered")  # uncompiled, NumPy says so
def test_a_plant_that_grows_beyond_all_bounds_ends_in_a_fault_with_the_trace_up_to_there():
    trace = run(diagram(transfer_function([1.0], [1.0, -100.0]), timing(100.0, 20.0), STEP))
    assert trace.fault is not None
    assert trace.fault.signal == "plant.x1"
    assert trace.fault.reason.endswith("is NaN or infinite, or grows faster than the integrator can follow")
    assert 7.0 < trace.time[-1] < 7.2  # exp(100 t) is the largest number there is at 7.0978 s
    assert np.isfinite(trace.values).all()


@pytest.mark.filterwarnings("ignore:(overflow|invalid value) encountered")  # uncompiled, NumPy says so
def test_a_plant_that_is_too_fast_for_any_number_ends_in_a_fault():
    trace = run(diagram(transfer_function([1.0], [1.0, -1e300]), timing(100.0, 1.0), STEP))
    assert trace.fault is not None
    assert trace.ticks.tolist() == [0]


def under_pi(gain, time):
    """Return first order without dead time under a PI controller, setpoint 1 from scan 0 on."""
    wires = {"setpoint": "one", "measurement": "plant.y"}
    control = node("u", "pid", wires, Kc=gain, Ti=f"{time!r} s")
    trace = simulated(
        first_order(GAIN, TAU), timing(500.0, 60.0), node("one", "constant", value=1.0), control
    )
    return trace["plant.y"]


@pytest.mark.parametrize("beta", [0.1, 0.7, 1.0, 1.6])
def test_a_pi_that_cancels_the_pole_approaches_by_a_factor_each_scan_and_at_1_at_once(beta):
    y = under_pi(beta * A / ((1 - A) * GAIN), TS * A / (1 - A))
    assert y == pytest.approx(1 - (1 - beta) ** np.arange(y.size), abs=2e-15)


@pytest.mark.parametrize(("gain", "time"), [(0.5, 8.0), (3.0, 4.0), (6.0, 100.0)])
def test_a_pi_moves_first_order_by_the_poles_of_the_loop(gain, time):
    q0, q1, b = gain * (1 + TS / time), -gain, GAIN * (1 - A)
    y = under_pi(gain, time)
    p, q = np.roots([1.0, -(1 + A - b * q0), A + b * q1]).astype(complex)
    share = (b * q0 - 1 + q) / (p - q)  # of p, so that y_0 = 0 and y_1 = b q0
    k = np.arange(y.size)
    assert y == pytest.approx((1 + share * p**k - (1 + share) * q**k).real, abs=1e-14)

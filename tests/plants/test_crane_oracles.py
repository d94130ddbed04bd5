"""The crane's mechanics against closed forms (Annex C model; tolerances ten times a careful run's error)."""

from dataclasses import replace
from math import cos, pi, radians, sin, sqrt

import numpy as np
import pytest

from fcl_sim.loop.diagram import Diagram, Wire
from fcl_sim.loop.run import run
from fcl_sim.loop.trace import Trace
from tests.loop.diagrams import constant, crane, crane_alone, timing

G, L, TROLLEY, LOAD = 9.81, 10.0, 15_000.0, 20_000.0
FREE = {"rolling_resistance": 0.0, "viscous_friction": 0.0, "damping": 0.0}
HELD = {"rolling_resistance": 1.0, "damping": 0.0}


def pendulum_period(amplitude: float) -> float:
    a, b = 1.0, cos(amplitude / 2)
    while abs(a - b) > 1e-16:
        a, b = (a + b) / 2, sqrt(a * b)
    return 2 * pi * sqrt(L / G) / a


def windy(diagram: Diagram, wind: float) -> Diagram:
    """The same in a steady wind, in m/s."""
    node = constant("wind", wind, "crane.speed", {"x": "m/s", "y": "m/s"})
    plant = replace(diagram.plant, inputs={**diagram.plant.inputs, "wind": Wire("wind.y")})
    return replace(diagram, plant=plant, nodes=(diagram.nodes[0], node))


def rising_zeros(trace: Trace, name: str) -> np.ndarray:
    """Times at which a signal rises through zero, from six samples around each."""
    t, y = trace.time, trace[name]
    times = []
    for i in np.nonzero((y[:-1] < 0) & (y[1:] >= 0))[0]:
        if 2 < i < len(y) - 4:
            part = slice(i - 2, i + 4)
            # the inverse function is as smooth as the swing itself at its steepest
            times.append(np.polynomial.Polynomial.fit(y[part], t[part] - t[i], 5)(0.0) + t[i])
    return np.array(times)


@pytest.mark.parametrize("degrees", [1.0, 30.0, 60.0])
def test_a_held_crane_swings_with_the_exact_period_of_a_pendulum(degrees):
    start = {"position": 0.0, "angle": radians(degrees)}
    trace = run(crane_alone(timing(1.0, 30.0), HELD, start))
    zeros = rising_zeros(trace, "crane.angle")
    period = (zeros[-1] - zeros[0]) / (len(zeros) - 1)
    assert period == pytest.approx(pendulum_period(radians(degrees)), rel=2e-11)
    assert np.all(trace["crane.position"] == 0.0)


def test_a_held_crane_swings_out_as_a_damped_oscillator():
    zeta, amplitude = 0.05, 1e-3
    start = {"position": 0.0, "angle": amplitude}
    trace = run(crane_alone(timing(10.0, 30.0), {**HELD, "damping": zeta}, start))
    natural = sqrt(G / L)
    damped = natural * sqrt(1 - zeta**2)
    t = trace.time
    shape = np.cos(damped * t) + zeta / sqrt(1 - zeta**2) * np.sin(damped * t)
    expected = amplitude * np.exp(-zeta * natural * t) * shape
    assert np.abs(np.radians(trace["crane.angle"]) - expected).max() <= 2.5e-6 * amplitude


def test_wind_holds_the_load_of_a_held_crane_out_of_plumb():
    wind, damped = 20.0, {**HELD, "damping": 0.5}
    blown = windy(crane_alone(timing(100.0, 60.0), damped, {"position": 0.0}), wind)
    force = 1.25 / 2 * 38.0 * wind**2
    angle = np.radians(run(blown)["crane.angle"][-1])
    assert angle == pytest.approx(np.arctan(force / (LOAD * G)), abs=1e-9)
    against = np.radians(run(windy(blown, -wind))["crane.angle"][-1])
    assert against == pytest.approx(-angle, abs=1e-9)


def test_wind_gives_a_free_crane_its_momentum():
    wind = -8.0
    trace = run(windy(crane_alone(timing(100.0, 20.0), FREE, {"position": 0.0}), wind))
    v, theta, w = trace["crane.speed"], np.radians(trace["crane.angle"]), np.radians(trace["crane.rate"])
    momentum = (TROLLEY + LOAD) * v + LOAD * L * w * np.cos(theta)
    given = -1.25 / 2 * 38.0 * wind**2 * trace.time
    assert np.abs(momentum - given).max() <= 1e-9 * abs(given[-1])


def test_a_free_trolley_and_its_load_swing_faster_than_a_pendulum():
    trace = run(crane_alone(timing(1.0, 30.0), FREE, {"position": 0.0, "angle": 1e-3}))
    zeros = rising_zeros(trace, "crane.angle")
    period = (zeros[-1] - zeros[0]) / (len(zeros) - 1)
    assert period == pytest.approx(2 * pi / sqrt(G / L * (1 + LOAD / TROLLEY)), rel=2.4e-6)


def test_without_friction_momentum_energy_and_excursion_are_those_of_the_closed_forms():
    amplitude = 0.5
    trace = run(crane_alone(timing(1.0, 60.0), FREE, {"position": 0.0, "angle": amplitude}))
    v, theta, w = trace["crane.speed"], np.radians(trace["crane.angle"]), np.radians(trace["crane.rate"])
    momentum = (TROLLEY + LOAD) * v + LOAD * L * w * np.cos(theta)
    assert np.abs(momentum).max() <= 6.5e-11 * LOAD * sqrt(G * L)
    energy = energy_of(v, theta, w)
    assert np.abs(energy / energy[0] - 1).max() <= 5e-10
    excursion = np.ptp(trace["crane.position"])
    assert excursion == pytest.approx(2 * LOAD * L * sin(amplitude) / (TROLLEY + LOAD), abs=1e-6)


def energy_of(v, theta, w):
    kinetic = (TROLLEY + LOAD) * v**2 / 2 + LOAD * L**2 * w**2 / 2 + LOAD * L * v * w * np.cos(theta)
    return kinetic + LOAD * G * L * (1 - np.cos(theta))


def test_without_a_load_constant_power_accelerates_as_the_square_root_of_time():
    parameters = {**FREE, "load_mass": 0.0, "drive_lag": 1e-3, "maximum_speed": 100.0, "adhesion": 10.0}
    power, first = 10.0, 1.2
    force = 1000 * power / first
    start = {"position": 0.0, "speed": first, "drive_force": force}
    trace = run(crane_alone(timing(1.0, 20.0), parameters, start, power=power))
    expected = np.sqrt(first**2 + 2 * 1000 * power * trace.time / TROLLEY)
    assert np.abs(trace["crane.speed"] / expected - 1).max() <= 3e-4


def test_the_work_of_drive_friction_and_damping_is_the_change_of_energy():
    trace = run(crane(timing=timing(1.0, 30.0)))
    v, theta, w = trace["crane.speed"], np.radians(trace["crane.angle"]), np.radians(trace["crane.rate"])
    friction = 0.005 * (TROLLEY + LOAD) * G * np.abs(v) + 200.0 * v**2
    damping = 2 * 0.005 * LOAD * L * sqrt(G * L) * w**2
    power = 1000 * trace["crane.force"] * v - friction - damping
    work = np.concatenate([[0.0], np.cumsum((power[1:] + power[:-1]) / 2 * np.diff(trace.time))])
    energy = energy_of(v, theta, w)
    turnover = np.sum(np.abs(power[1:] + power[:-1]) / 2 * np.diff(trace.time))
    assert np.abs(energy - energy[0] - work).max() <= 2e-5 * turnover


def test_a_trolley_under_constant_acceleration_swings_between_zero_and_twice_the_plumb_angle():
    # A huge trolley is not moved by its load, so its acceleration is that of the force alone.
    drive = {"adhesion": 10.0, "maximum_speed": 1e6, "limiter_gain": 1e9, "base_speed": 1e3}
    parameters = {**FREE, **drive, "trolley_mass": 1e12}
    acceleration = 0.5
    force = acceleration * 1e12
    start = {"position": 0.0, "drive_force": force}
    diagram = crane_alone(timing(10.0, 20.0), parameters, start, power=force)  # kW at vb = 1000 m/s: N
    trace = run(diagram)
    lowest = np.radians(trace["crane.angle"].min())
    assert lowest == pytest.approx(-2 * np.arctan(acceleration / G), rel=1e-4)
    assert trace["crane.angle"].max() <= 1e-6


def test_a_constant_force_against_viscous_friction_approaches_its_speed_exponentially():
    drive = {"base_speed": 1e3, "maximum_speed": 1e6, "limiter_gain": 1e9, "adhesion": 10.0}
    friction = 4_000.0
    parameters = {**FREE, **drive, "load_mass": 0.0, "viscous_friction": friction}
    force = 10_000.0
    start = {"position": 0.0, "drive_force": force}
    trace = run(crane_alone(timing(10.0, 20.0), parameters, start, power=force))  # kW at vb = 1000 m/s: N
    expected = force / friction * -np.expm1(-friction / TROLLEY * trace.time)
    assert np.abs(trace["crane.speed"] - expected).max() <= 1e-10 * force / friction

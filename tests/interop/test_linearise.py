from fractions import Fraction

import control
import numpy as np
import pytest

import fcl_sim
from fcl_sim import interop
from fcl_sim.model import AndOperator, Method, RuleBlock
from tests import oracle
from tests.engine.bases import block as base
from tests.engine.bases import every, output, points, rule, singleton
from tests.interop.blocks import built, crane, linear, narrow

DT = 0.5
K, TAU = 2.0, 10.0
A = np.exp(-DT / TAU)
B = K * (1 - A)
KC, TI = 1.25, 10.0
GRIDS = {
    "4 rules": {"e": (-2.0, 2.0), "de": (-4.0, 4.0)},
    "25 rules": {"e": (-2.0, -0.7, 0.0, 0.3, 2.0), "de": (-4.0, -0.9, 0.1, 1.0, 4.0)},
}
DELAY = control.tf([1], [1, 0], DT)
DIFFERENCE = (1 - DELAY) / DT
SUM = DT / (1 - DELAY)


def rest(*, integrated=True, delay=0):
    """Return what lies around a block of e and de: it drives a first-order plant, directly or by its sum."""
    plant = control.ss(control.sample_system(control.tf([K], [TAU, 1]), DT), inputs="u", outputs="x")
    parts = [
        control.ss(SUM if integrated else control.tf([1], [1], DT), inputs="y", outputs="u"),
        plant,
        control.ss(DELAY**delay, inputs="x", outputs="measured"),
        control.summing_junction(inputs=["-measured"], output="e", dt=DT),
        control.ss(DIFFERENCE, inputs="e", outputs="de"),
    ]
    return control.interconnect(parts, inputs=["y"], outputs=["e", "de"])


def poles_but_those_at_0(poles):
    return np.sort_complex(poles[np.abs(poles) > 1e-6])


@pytest.mark.parametrize("point", [{"e": 0.0, "de": 0.0}, {"e": 0.3, "de": 1.0}, {"e": -1.37, "de": 0.77}])
@pytest.mark.parametrize("grid", GRIDS)
def test_the_fuzzy_pi_that_is_linear_has_the_poles_of_the_conventional_one(grid, point):
    block = linear(GRIDS[grid], (KC / TI, KC))
    found = interop.linearise(block, point, rest())
    assert found.gains == pytest.approx(np.array([[KC / TI, KC]]), abs=1e-12)
    assert found.kinks == ()
    assert not found.couples
    q0, q1 = KC + KC / TI * DT, -KC
    expected = np.roots([1, -(1 + A - B * q0), A + B * q1])
    assert poles_but_those_at_0(found.loop.poles) == pytest.approx(np.sort_complex(expected), abs=1e-9)
    assert found.loop.stable


@pytest.mark.parametrize("grid", GRIDS)
def test_the_fuzzy_pd_that_is_linear_has_the_poles_of_the_conventional_one(grid):
    kp, kd = 3.0, 0.8
    found = interop.linearise(linear(GRIDS[grid], (kp, kd)), {"e": 0.1, "de": -0.2}, rest(integrated=False))
    expected = np.roots([1, -A + B * (kp + kd / DT), -B * kd / DT])
    assert np.sort_complex(found.loop.poles) == pytest.approx(np.sort_complex(expected), abs=1e-9)


@pytest.mark.parametrize("delay", [1, 4])
def test_margins_are_those_of_the_conventional_loop(delay):
    found = interop.linearise(linear(GRIDS["4 rules"], (KC / TI, KC)), {"e": 0, "de": 0}, rest(delay=delay))
    ours = found.loop.margins["y"]
    opened = control.ss((KC + KC / TI * SUM) * control.tf([B], [1, -A], DT) * DELAY**delay)
    gain, phase, modulus, at_phase, at_gain, _ = control.stability_margins(opened)
    assert (ours.gain_margin, ours.phase_crossover) == pytest.approx((gain, at_phase), rel=1e-6)
    assert (ours.phase_margin, ours.gain_crossover) == pytest.approx((phase, at_gain), rel=1e-6)
    assert ours.modulus_margin == pytest.approx(modulus, rel=1e-6)
    assert ours.delay_margin == pytest.approx(np.radians(phase) / at_gain, rel=1e-6)


@pytest.mark.parametrize("delay", [2, 9])
def test_margins_are_those_of_the_formula_of_the_loop(delay):
    found = interop.linearise(linear(GRIDS["4 rules"], (KC / TI, KC)), {"e": 0, "de": 0}, rest(delay=delay))
    ours = found.loop.margins["y"]

    def response(frequency):
        z = np.exp(1j * frequency * DT)
        return (KC + KC / TI * DT * z / (z - 1)) * B / (z - A) * z ** -float(delay)

    assert response(ours.phase_crossover) == pytest.approx(-1 / ours.gain_margin, abs=1e-8)
    assert response(ours.gain_crossover) == pytest.approx(
        -np.exp(1j * np.radians(ours.phase_margin)), abs=1e-8
    )
    nearest = np.abs(1 + response(np.linspace(1e-3, np.pi / DT, 400_000))).min()
    assert ours.modulus_margin == pytest.approx(nearest, rel=1e-8)


def test_the_gain_margin_makes_the_loop_oscillate_at_the_phase_crossover():
    def loop(factor):
        block = linear(GRIDS["4 rules"], (factor * KC / TI, factor * KC))
        return interop.linearise(block, {"e": 0, "de": 0}, rest(delay=4)).loop

    margins = loop(1.0).margins["y"]
    critical = loop(margins.gain_margin).poles[0]
    assert abs(critical) == pytest.approx(1.0, abs=1e-9)
    assert abs(np.angle(critical)) / DT == pytest.approx(margins.phase_crossover, rel=1e-9)
    assert loop(0.99 * margins.gain_margin).stable
    assert not loop(1.01 * margins.gain_margin).stable


def test_a_loop_of_first_order_has_its_gain_margin_at_the_nyquist_frequency():
    gain = 3.0
    block = linear({"e": (-2.0, 2.0)}, (gain,))
    found = interop.linearise(block, {"e": 0.0}, control.tf([-K], [TAU, 1]), DT)
    assert found.loop.poles == pytest.approx([A - B * gain], abs=1e-9)
    margins = found.loop.margins["y"]
    assert margins.gain_margin == pytest.approx((1 + A) / (B * gain))
    assert margins.phase_crossover == pytest.approx(np.pi / DT)


def test_a_loop_that_is_not_closed_has_no_crossings():
    found = interop.linearise(narrow("7"), {"x": 1.5}, control.tf([-K], [TAU, 1]), DT)
    assert found.values == {"y": 7.0}
    assert found.active == {"y": False}
    margins = found.loop.margins["y"]
    assert (margins.gain_margin, margins.phase_margin, margins.delay_margin) == (np.inf, np.inf, np.inf)
    assert np.isnan([margins.phase_crossover, margins.gain_crossover]).all()
    assert margins.modulus_margin == 1.0
    assert found.loop.poles == pytest.approx([A])


def test_the_crane_has_the_gains_of_its_neighbouring_singletons_at_the_set_point():
    found = interop.linearise(crane(), {"distance": 0, "angle": 0})
    for side in (found.gains, found.below, found.above):
        assert side == pytest.approx(np.array([[27 / 5, 9 / 5]]), rel=1e-9)
    assert found.values == {"power": 0.0}
    assert found.kinks == ()


def test_at_the_peak_of_a_term_the_crane_has_two_gains_and_takes_their_mean():
    at = {"distance": 5, "angle": 0}
    below, above = np.array([[27 / 5, 36 / 5]]), np.array([[0.0, -18 / 5]])
    found = interop.linearise(crane(), at)
    assert found.below == pytest.approx(below, abs=1e-9)
    assert found.above == pytest.approx(above, abs=1e-9)
    assert found.gains == pytest.approx((below + above) / 2, abs=1e-9)
    assert found.kinks == (("power", "distance"), ("power", "angle"))
    assert interop.linearise(crane(), at, side="below").gains == pytest.approx(below, abs=1e-9)
    assert interop.linearise(crane(), at, side="above").gains == pytest.approx(above, abs=1e-9)


def test_under_min_the_gains_of_two_inputs_do_not_add_up():
    grid = GRIDS["25 rules"]
    assert interop.linearise(linear(grid, (1.0, 2.0), AndOperator.MIN), {"e": 0, "de": 0.1}).couples
    assert not interop.linearise(linear(grid, (1.0, 2.0)), {"e": 0, "de": 0.1}).couples


def areas():
    terms = tuple(points(f"t{i}", (i - 1, 0), (i, 1), (i + 1.5, 0)) for i in range(4))
    results = tuple(points(f"s{i}", (5 * i - 8, 0), (5 * i, 1), (5 * i + 6, 0)) for i in range(4))
    rules = tuple(
        rule(f"{i}{j}", every(("a", f"t{i}"), ("b", f"t{j}")), ("y", f"s{(i + 2 * j) % 4}"))
        for i in range(4)
        for j in range(4)
    )
    return base(
        {"a": terms, "b": terms},
        (output("y", *results, method=Method.COG),),
        RuleBlock(name="r", rules=rules),
    )


@pytest.mark.parametrize(("a", "b"), [(0.35, 1.3), (1.9, 0.45), (2.25, 2.6)])
def test_a_curved_law_of_areas_has_the_gains_of_the_exact_one(a, b):
    block = areas()
    found = interop.linearise(built(block), {"a": a, "b": b})
    step = Fraction(1, 10**7)

    def exact(**moved):
        values = {"a": Fraction(a), "b": Fraction(b)}
        return oracle.evaluate(block, values | {n: values[n] + by for n, by in moved.items()}).outputs["y"]

    expected = [float((exact(**{n: step}) - exact(**{n: -step})) / (2 * step)) for n in ("a", "b")]
    assert found.gains == pytest.approx(np.array([expected]), abs=1e-8)


def test_where_a_rule_begins_to_fire_there_is_no_gain():
    with pytest.raises(ValueError, match=r"y has no finite gain by x below x = 1: it jumps"):
        interop.linearise(narrow("7"), {"x": 1.0})


def test_where_no_rule_is_active_nc_holds_and_the_loop_keeps_a_pole_at_1():
    found = interop.linearise(narrow(), {"x": 1.5}, control.tf([-K], [TAU, 1]), DT, previous={"Y": 3.0})
    assert found.values == {"y": 3.0}
    assert found.gains.tolist() == [[0.0]]
    assert found.memory == pytest.approx(np.ones((1, 1)))
    assert np.sort(found.loop.poles.real) == pytest.approx([A, 1.0])


def test_where_a_rule_is_active_nc_forgets():
    found = interop.linearise(narrow(), {"x": 0.5})
    assert found.memory.tolist() == [[0.0]]


def test_the_linear_system_stands_where_the_block_stood():
    for block, point in ((crane(), {"distance": 2.0, "angle": 1.0}), (narrow(), {"x": 1.5})):
        system = interop.to_iosystem(block, DT)
        found = interop.linearise(block, point)
        flat = found.system(DT)
        assert flat.input_labels == system.input_labels
        assert flat.output_labels == system.output_labels
        assert flat.state_labels == system.state_labels
        small = 1e-3 * np.arange(1, flat.ninputs + 1)
        before = np.array([found.values[name] for name in found.states])
        there = system.output(0.0, before, np.array([*point.values()]) + small)
        expected = flat.output(0.0, np.zeros(flat.nstates), small) + np.array([*found.values.values()])
        assert there == pytest.approx(expected, abs=1e-5)


def test_a_plant_in_continuous_time_is_sampled_under_a_zero_order_hold():
    block = linear({"x": (-2.0, 2.0), "v": (-2.0, 2.0)}, (-1.5, -0.7))
    mass = control.ss([[0, 1], [0, 0]], [[0], [1]], np.eye(2), 0)
    found = interop.linearise(block, {"x": 0, "v": 0}, mass, 0.2)
    by_hand = np.array([[1, 0.2], [0, 1]]) + np.array([[0.02], [0.2]]) @ np.array([[-1.5, -0.7]])
    expected = np.sort_complex(np.linalg.eigvals(by_hand))
    assert np.sort_complex(found.loop.poles) == pytest.approx(expected, abs=1e-9)


def test_signals_of_the_plant_are_found_by_name():
    block = linear({"e": (-2.0, 2.0), "de": (-4.0, 4.0)}, (KC / TI, KC))
    plant = rest()
    turned = control.ss(plant[[1, 0], [0]], inputs=["y"], outputs=["de", "e"])
    expected = interop.linearise(block, {"e": 0, "de": 0}, plant).loop.poles
    found = interop.linearise(block, {"e": 0, "de": 0}, turned).loop.poles
    assert found == pytest.approx(expected, abs=1e-9)


def two_outputs():
    """Return a block of y = 2 x, z = -0.5 x between -1 and 1."""
    terms = (points("n", (-1, 1), (1, 0)), points("p", (-1, 0), (1, 1)))
    rules = (
        rule("1", every(("x", "n")), ("y", "low"), ("z", "low")),
        rule("2", every(("x", "p")), ("y", "high"), ("z", "high")),
    )
    y = output("y", singleton("low", -2), singleton("high", 2))
    z = output("z", singleton("low", 0.5), singleton("high", -0.5))
    return built(base({"x": terms}, (y, z), RuleBlock(name="r", rules=rules)))


def test_each_output_is_cut_open_with_the_others_closed():
    # x[k+1] = 0.5 x + 0.3 y + 0.4 z, so the pole lies at 0.5 + 0.3 · 2 - 0.4 · 0.5 = 0.9.
    plant = control.ss([[0.5]], [[0.3, 0.4]], [[1]], [[0, 0]], 1.0)
    loop = interop.linearise(two_outputs(), {"x": 0.0}, plant).loop
    assert loop.poles == pytest.approx([0.9])
    # With a factor k at y it lies at 0.3 + 0.6 k, at z at 1.1 - 0.2 k: which k brings it to 1?
    assert loop.margins["y"].gain_margin == pytest.approx(0.7 / 0.6)
    assert loop.margins["y"].phase_crossover == 0.0
    assert loop.margins["z"].gain_margin == pytest.approx(0.1 / 0.2)


@pytest.mark.parametrize(
    ("plant", "dt", "message"),
    [
        (control.tf([1], [1, 1]), DT, "must lead to the inputs of the block, distance, angle; it has y"),
        (control.tf([1], [1, 0.5], 0.1), DT, r"sampled every 0.1 s, the block every 0.5 s"),
        (control.tf([1], [1, 1]), None, "dt must be the seconds between two scans"),
        (
            control.ss(-1, 1, [[1], [1]], 0, inputs=["power"], outputs=["distance", "angel"]),
            DT,
            "it has distance, angel",
        ),
    ],
    ids=["too few signals", "another scan", "no scan", "a misspelt name"],
)
def test_a_plant_that_does_not_fit_is_refused(plant, dt, message):
    with pytest.raises(ValueError, match=message):
        interop.linearise(crane(), {"distance": 0, "angle": 0}, plant, dt)


def test_a_point_is_one_number_for_each_input():
    with pytest.raises(TypeError, match="needs a value for angle"):
        interop.linearise(crane(), {"distance": 0})
    with pytest.raises(TypeError, match="no input angel; did you mean angle"):
        interop.linearise(crane(), {"distance": 0, "angel": 0})
    with pytest.raises(ValueError, match="one number for each variable"):
        interop.linearise(crane(), {"distance": [0, 1], "angle": 0})


def test_the_room_is_an_attribute_of_the_package():
    assert fcl_sim.interop is interop

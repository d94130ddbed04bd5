"""Transfer functions, zeros and poles, state space: the matrices answer as the formulae do."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from fcl_sim.plant.linear import (
    LinearError,
    at_rest,
    first_order,
    state_space,
    transfer_function,
    zero_pole_gain,
)

FREQUENCIES = 1j * np.logspace(-2, 2, 41)


def answers(system):
    """The response of matrices to every frequency."""
    one = np.eye(len(system.a))
    return np.array(
        [(system.c @ np.linalg.solve(s * one - system.a, system.b) + system.d)[0, 0] for s in FREQUENCIES]
    )


def near(system, expected, size=1e-12):
    return np.abs(answers(system) / expected - 1.0).max() <= size


coefficients = st.floats(0.05, 20.0)
real = st.floats(-9.0, -0.1)
pairs = st.tuples(real, st.floats(0.1, 9.0))


@given(st.lists(coefficients, min_size=1, max_size=4), st.lists(coefficients, min_size=2, max_size=5))
def test_matrices_answer_as_their_transfer_function(numerator, denominator):
    numerator = numerator[: len(denominator)]
    roots = np.abs(np.polyval(numerator, FREQUENCIES)), np.abs(np.polyval(denominator, FREQUENCIES))
    assume(min(each.min() for each in roots) > 0.0)
    expected = np.polyval(numerator, FREQUENCIES) / np.polyval(denominator, FREQUENCIES)
    size = np.polyval(denominator, np.abs(FREQUENCIES)) / np.abs(np.polyval(denominator, FREQUENCIES))
    size *= np.polyval(numerator, np.abs(FREQUENCIES)) / np.abs(np.polyval(numerator, FREQUENCIES))
    assume(size.max() < 1e4)  # else one of the frequencies is a pole or a zero
    error = np.abs(answers(transfer_function(numerator, denominator)) / expected - 1.0)
    assert (error <= 1e-11 * size**2).all()


@given(
    st.lists(real, max_size=2),
    st.lists(pairs, max_size=1),
    st.lists(real, min_size=3, max_size=5),
    st.lists(pairs, max_size=2),
)
def test_matrices_answer_as_their_zeros_and_poles(zeros, zero_pairs, poles, pole_pairs):
    below = [complex(each) for each in poles] + [
        complex(re, s * im) for re, im in pole_pairs for s in (1, -1)
    ]
    above = [complex(each) for each in zeros] + [
        complex(re, s * im) for re, im in zero_pairs for s in (1, -1)
    ]
    above = above[: len(below)] if len(above) <= len(below) else [complex(each) for each in zeros]
    expected = (
        3.0
        * np.prod([FREQUENCIES - z for z in above], axis=0)
        / np.prod([FREQUENCIES - p for p in below], axis=0)
    )
    assert near(zero_pole_gain(above, below, 3.0), expected, 1e-9)


def test_poles_that_coincide_stay_where_they_are():
    eight = zero_pole_gain([], [-1.0 + 0j] * 8, 1.0)
    assert np.array_equal(eight.a, np.triu(eight.a, -1))
    assert near(eight, 1.0 / (FREQUENCIES + 1.0) ** 8, 1e-13)


def test_a_first_order_lag_is_its_own_transfer_function():
    assert near(first_order(2.0, 10.0), 2.0 / (10.0 * FREQUENCIES + 1.0), 1e-15)
    assert near(transfer_function([2.0], [10.0, 1.0]), 2.0 / (10.0 * FREQUENCIES + 1.0), 1e-15)


def test_time_constants_far_apart_make_no_large_matrix():
    system = transfer_function([1.0], np.poly([-1e6, -1e3, -1.0]))
    assert np.abs(system.a).sum(axis=0).max() <= 1e7
    assert near(system, 1.0 / np.polyval(np.poly([-1e6, -1e3, -1.0]), FREQUENCIES))


@pytest.mark.parametrize(
    "system",
    [
        first_order(2.0, 10.0),
        transfer_function([1.0, 3.0], [1.0, 2.0, 5.0]),
        transfer_function([1.0, 0.0], [1.0, 1.0]),
        transfer_function([2.0], [1.0, 0.0]),
        zero_pole_gain([-2.0 + 0j], [-1 + 1j, -1 - 1j, -3 + 0j], 4.0),
    ],
    ids=["lag", "second order", "high-pass", "integrator", "zeros"],
)
def test_a_plant_at_rest_has_the_output_that_is_asked_for_and_does_not_move(system):
    wanted = 0.0 if system.d.any() and not answers(system)[0].real > 0.5 else 7.0
    x, u = at_rest(system, [wanted])
    assert system.c @ x + system.d @ u == pytest.approx(wanted, abs=1e-12)
    assert system.a @ x + system.b @ u == pytest.approx(0.0, abs=1e-12)


def test_a_differentiating_plant_does_not_rest_away_from_zero():
    with pytest.raises(LinearError, match="does not rest"):
        at_rest(transfer_function([1.0, 0.0], [1.0, 1.0, 1.0]), [1.0])


REFUSED = [
    (lambda: first_order(1.0, 0.0), "time_constant"),
    (lambda: transfer_function([1.0], [0.0]), "denominator"),
    (lambda: transfer_function([1.0], [0.0, 2.0]), "denominator"),
    (lambda: transfer_function([1.0, 0.0, 0.0], [1.0, 2.0]), "numerator"),
    (lambda: zero_pole_gain([], [], 1.0), "poles"),
    (lambda: zero_pole_gain([-1.0 + 0j] * 2, [-1.0 + 0j], 1.0), "zeros"),
    (lambda: zero_pole_gain([], [-1 + 1j, -1 - 2j], 1.0), "poles"),
    (lambda: zero_pole_gain([], [-1 - 1j], 1.0), "poles"),
    (lambda: state_space([[1.0, 2.0]], [[1.0]], [[1.0]]), "A"),
    (lambda: state_space([[1.0]], [[1.0], [2.0]], [[1.0]]), "B"),
    (lambda: state_space([[1.0]], [[1.0]], [[1.0, 2.0]]), "C"),
    (lambda: state_space([[1.0]], [[1.0]], [[1.0]], [[1.0, 2.0]]), "D"),
    (lambda: state_space([[np.nan]], [[1.0]], [[1.0]]), "A"),
    (lambda: state_space([1.0], [[1.0]], [[1.0]]), "A"),
    (lambda: state_space([[1.0], [1.0, 2.0]], [[1.0]], [[1.0]]), "A"),
]


@pytest.mark.parametrize(
    ("make", "about"), REFUSED, ids=[f"{about}_{n}" for n, (_, about) in enumerate(REFUSED)]
)
def test_numbers_that_make_no_plant_are_refused_by_the_name_of_their_parameter(make, about):
    with pytest.raises(LinearError) as caught:
        make()
    assert caught.value.about == about
    assert f"`{about}`" in str(caught.value)

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.interop.slopes import slopes

SLOPES = st.floats(-100, 100)


def at_zero(law):
    return slopes(law, np.zeros(1), np.ones(1))


@given(SLOPES, SLOPES, SLOPES, SLOPES, st.floats(1e-6, 1.0), st.floats(1e-6, 1.0))
def test_each_side_is_taken_up_to_the_nearest_kink(inner_left, outer_left, inner, outer, left, right):
    def law(x):
        up = inner * np.clip(x, 0, right) + outer * np.maximum(x - right, 0)
        return 3.0 + up + inner_left * np.clip(x, -left, 0) + outer_left * np.minimum(x + left, 0)

    found = at_zero(law)
    assert found.above == pytest.approx(inner, abs=1e-6)
    assert found.below == pytest.approx(inner_left, abs=1e-6)


@given(st.floats(-3, 3))
def test_a_curved_law_is_followed(x):
    found = slopes(lambda points: np.sin(points) / (2 + np.cos(points)), np.array([x]), np.array([6.0]))
    expected = (2 * np.cos(x) + 1) / (2 + np.cos(x)) ** 2
    for side in (found.below, found.above):
        assert side == pytest.approx(expected, abs=1e-9)
    assert np.abs(found.above - found.below) <= found.alike


def test_a_jump_has_no_slope_on_its_side():
    found = at_zero(lambda x: np.where(x > 0, 2.0, 1.0) + x)
    assert np.isnan(found.above)
    assert found.below == pytest.approx(1.0)


def test_a_root_has_no_finite_slope():
    assert np.isnan(at_zero(lambda x: np.sqrt(np.maximum(x, 0))).above)


@pytest.mark.parametrize(
    ("law", "couples"),
    [
        (lambda x: x[:1] * x[1:] + 2 * x[:1] - x[1:], False),
        (lambda x: np.abs(x[:1]) + np.maximum(x[1:], 0), False),
        (lambda x: np.minimum(x[:1], x[1:]), True),
    ],
    ids=["a product", "kinks of each input by itself", "MIN of both"],
)
def test_inputs_couple_where_their_changes_do_not_add_up(law, couples):
    assert slopes(law, np.zeros(2), np.ones(2)).couples is couples

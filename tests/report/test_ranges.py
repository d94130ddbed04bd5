"""Whatever the numbers are, the axis that shows them has a range that can be drawn."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.report import pictures, ranges, time_plots
from fcl_sim.report.sampling import Domain, closer
from fcl_sim.report.vector import svg
from tests.report.synthetic import run, trace

LARGE = np.finfo(np.float64).max
ANYTHING = st.floats(allow_nan=True, allow_infinity=True)


@given(st.lists(ANYTHING, min_size=1, max_size=9), st.sampled_from([0.0, 1e-12, 1e-6]))
def test_a_range_is_finite_holds_what_can_be_drawn_and_can_be_parted(numbers, noise):
    shown = ranges.finite([np.array(numbers)])
    if not len(shown):
        return
    low, high = ranges.widened(float(shown.min()), float(shown.max()), 0.08, noise)
    assert np.isfinite([low, high, high - low]).all()
    assert low < shown.min() <= shown.max() < high
    assert low < (low + high) / 2 < high
    assert 1.0 / (high - low) > 0.0


@given(st.floats(1e-200, 1e200), st.booleans())
def test_what_another_order_of_sums_makes_is_no_movement(number, is_negative):
    number = -number if is_negative else number
    assert not ranges.moves(*sorted([number, float(np.nextafter(number, np.inf))]))
    assert ranges.moves(*sorted([number, number * 1.001]))


WILD = {
    "overflows": lambda n: np.where(np.arange(n) % 2, 1.5e308, -1.5e308),
    "reaches the largest number": lambda n: LARGE * np.linspace(0, 1, n),
    "moves by the least number": lambda n: np.where(np.arange(n) % 2, 5e-324, 0.0),
    "is infinite for a while": lambda n: np.where(np.arange(n) % 9, 1.0, np.inf),
    "is no number": lambda n: np.full(n, np.nan),
    "stands at a huge number": lambda n: np.full(n, 1e17),
    "moves by a rounding": lambda n: np.where(np.arange(n) % 2, 20.0, np.nextafter(20.0, 21.0)),
}


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("kind", WILD)
def test_a_signal_that_runs_wild_is_drawn(kind, tmp_path):
    made = trace()
    values = made.values.copy()
    values[:, 0] = WILD[kind](len(values))
    for picture in pictures.over_time(run(tmp_path, trace=replace(made, values=values))):
        text = svg(picture.draw()).decode()
        assert "nan" not in text
        assert "inf" not in text


def test_a_run_that_is_far_outside_of_the_terms_has_no_closer_look():
    domain = Domain(name="distance", unit="m", low=-6.6, high=84.1)
    near = [np.array([10.0, 11.0]), np.array([1000.0, 1000.1])]
    assert closer([domain, domain], near) is None
    assert closer([domain, domain], [near[0], near[0]]) is not None


def test_a_run_that_broke_down_leaves_the_others_to_be_seen(tmp_path):
    wild = trace("fault")
    values = wild.values.copy()
    values[:, 0] = np.linspace(0.0, 1e37, len(values))
    broken = time_plots.Shown(label="wild", trace=replace(wild, values=values), duration=60.0)
    sound = time_plots.Shown(label="sound", trace=trace(), duration=60.0)
    lane, *_ = [each for each in time_plots.lanes(sound) if each.signal == "crane.distance"]
    (axes,) = time_plots.time_plot([sound, broken], [lane]).axes[-1:]
    span = float(np.ptp(sound.trace["crane.distance"]))
    assert axes.y[1] - axes.y[0] < 4.0 * span
    (alone,) = time_plots.time_plot([broken], [lane]).axes[-1:]
    assert alone.y[1] > 9e36

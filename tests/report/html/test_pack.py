"""Numbers in a page: what the script reads is what was packed, to a step of 16 bits."""

import base64
import json
import zlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fcl_sim.report.html.pack import STEPS, Pack
from tests.report.html.scripts import Script

SCRIPT = Script("data.js", "numbers.js")

READ = """(document_, body, number) => {
  const series = decoded(Uint8Array.from(body), document_.series[number]);
  if (series.constant !== undefined) return { constant: series.constant };
  return { kept: series.kept && [...series.kept], values: [...series.values] };
}"""

FINITE = st.floats(-1e6, 1e6)


def opened(pack):
    """Return the document and the body of a pack, as they lie in a page."""
    packed = zlib.decompress(base64.b64decode(pack.text({"name": "µ < 😀"})))
    length = int.from_bytes(packed[:4], "little")
    return json.loads(packed[4 : 4 + length]), list(packed[4 + length :])


def read(pack, number):
    """Return what the script reads of a series: values, and the samples that were kept."""
    found = SCRIPT.call(READ, *opened(pack), number)
    if "constant" in found:
        return found["constant"], None
    values = np.array([np.nan if each is None else each for each in found["values"]])
    return values, found["kept"]


@given(st.lists(FINITE | st.sampled_from([np.nan, np.inf]), min_size=1, max_size=40))
def test_a_short_series_is_read_back_to_half_a_step_of_its_range(values):
    pack = Pack(1000)
    given_ = np.array(values)
    number = pack.series(given_)
    found, kept = read(pack, number)
    finite = np.isfinite(given_)
    span = np.ptp(given_[finite]) if finite.any() else 0.0
    assert kept is None
    expected = np.where(finite, given_, np.nan)
    step = 0.5001 * span / STEPS
    np.testing.assert_allclose(np.broadcast_to(found, given_.shape), expected, rtol=1e-12, atol=step)


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=12)
def test_of_a_long_series_every_stretch_keeps_its_extremes(seed):
    values = np.random.default_rng(seed).normal(size=5000).cumsum()
    pack = Pack(100)
    found, kept = read(pack, pack.series(values))
    step = np.ptp(values) / STEPS
    assert len(kept) < 600
    np.testing.assert_allclose(found, values[kept], atol=step)
    for part in np.split(np.arange(5000), 100):
        inside = found[np.isin(kept, part)]
        assert abs(inside.max() - values[part].max()) <= step
        assert abs(inside.min() - values[part].min()) <= step
    assert (kept[0], kept[-1]) == (0, 4999)


def test_equal_series_are_packed_once_and_a_whole_one_keeps_every_sample():
    values = np.sin(np.arange(1000.0))
    pack = Pack(50)
    assert pack.series(values) == pack.series(values.copy()) == 0
    assert read(pack, pack.series(values, whole=True))[1] is None
    assert read(pack, pack.series(np.full(9, 2.5))) == (2.5, None)


def test_a_series_of_huge_numbers_and_one_without_any_can_be_packed():
    pack = Pack(50)
    huge = np.array([-1.7e308, 0.0, 1.7e308])
    np.testing.assert_allclose(read(pack, pack.series(huge))[0], huge, atol=1.7e308 / STEPS)
    assert np.isnan(read(pack, pack.series(np.full(3, np.nan)))[0]).all()
    assert read(pack, pack.series(np.zeros(0)))[0].size == 0


TIMES = """(told, body) => {
  const pack = { times: (told) => unevenTimes(Uint8Array.from(body), told) };
  const clock = clockOf(told, pack);
  return Array.from({ length: clock.count }, (_, index) => clock.at(index));
}"""


@given(
    st.integers(0, 10**12),
    st.lists(st.integers(1, 10**13) | st.just(10**7), max_size=40),
    st.integers(1, 10**6),
)
def test_times_are_read_back_exactly_however_uneven_they_are(begin, steps, grain):
    ticks = begin + np.cumsum([0, *(grain * each % 10**14 + 1 for each in steps)])
    pack = Pack(50)
    pack.plain(np.zeros(7, dtype=np.uint8))
    told = pack.times(ticks)
    assert SCRIPT.call(TIMES, json.loads(json.dumps(told)), list(pack._body)) == (ticks / 1e9).tolist()


def test_the_same_times_are_packed_once_and_even_ones_take_nothing():
    pack = Pack(50)
    assert pack.times(np.arange(5) * 10**7) == {"begin": 0, "step": 10**7, "count": 5}
    assert pack.times(np.zeros(0, dtype=np.int64)) == {"begin": 0, "step": 0, "count": 0}
    assert not pack._body
    late = np.cumsum([0, 100, 100, 300, 100])
    assert pack.times(late) == pack.times(late.copy())
    assert len(pack._body) == 4  # by whole steps a byte is enough


def test_a_long_run_with_jitter_takes_three_bytes_a_sample():
    shaken = np.arange(100_000) * 10**7 + np.random.default_rng(1).integers(0, 10**6, 100_000)
    pack = Pack(50)
    pack.times(shaken)
    assert len(pack._body) <= 3 * len(shaken)


LINE = """(series, times) => {
  const clock = clockOf({ begin: 0, step: 5e8, count: series.count }, null);
  const line = new Line(clock, { ...series, grain: 0 });
  return times.map((time) => line.at(time));
}"""


def test_between_samples_a_line_is_straight_and_outside_of_the_run_it_has_no_value():
    values, times = [3.0, -1.0, 4.0, 4.0], [0.0, 0.25, 0.5, 0.9, 1.5]
    found = SCRIPT.call(LINE, {"count": 4, "kept": None, "values": values}, [*times, -0.1, 1.6])
    assert found[:-2] == pytest.approx(np.interp(times, [0.0, 0.5, 1.0, 1.5], values))
    assert found[-2:] == [None, None]


def test_a_constant_has_its_value_at_every_time():
    assert SCRIPT.call(LINE, {"count": 9, "constant": 2.5}, [0.0, 1.3, 4.0]) == [2.5, 2.5, 2.5]


def test_a_line_tells_its_extremes_within_a_window():
    extent = """(values) => {
      const clock = clockOf({ begin: 0, step: 1e9, count: values.length }, null);
      return new Line(clock, { kept: null, values, grain: 0 }).extent(0.5, 2.25);
    }"""
    assert SCRIPT.call(extent, [0.0, 1.0, 7.0, 3.0, 99.0]) == [0.5, 7.0]

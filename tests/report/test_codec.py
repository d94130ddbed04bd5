"""Nouns as data: everything comes back bit for bit, and nothing comes back that is not ours."""

import json
from dataclasses import replace
from fractions import Fraction
from math import inf, isnan, nan
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from fcl_sim.judge.verdict import AtLeast, Status
from fcl_sim.loop.trace import Fault
from fcl_sim.report.codec import Unreadable, decoded, encoded
from tests.report.synthetic import crane, outcome, run

FAULT = "fcl_sim.loop.trace.Fault"
OURS = "fcl_sim.testbench"


def back(noun):
    document, pools = encoded(noun)
    return decoded(json.loads(json.dumps(document, allow_nan=False)), pools)


SCALARS = st.none() | st.booleans() | st.integers() | st.text() | st.floats(allow_nan=False) | st.fractions()
VALUES = st.recursive(
    SCALARS | st.sampled_from(Status),
    lambda inner: (
        st.lists(inner)
        | st.lists(inner).map(tuple)
        | st.dictionaries(st.text(), inner)
        | st.frozensets(st.text())
    ),
    max_leaves=12,
)


@settings(max_examples=40)
@given(VALUES)
def test_what_is_plain_comes_back_as_it_was(value):
    assert back(value) == value
    assert type(back(value)) is type(value)


def test_the_numbers_that_json_has_no_word_for_come_back():
    found = back((nan, inf, -inf, -0.0))
    assert isnan(found[0])
    assert found[1:3] == (inf, -inf)
    assert str(found[3]) == "-0.0"


@given(arrays(np.float64, array_shapes(min_dims=1, max_dims=2, min_side=0, max_side=5)))
def test_arrays_come_back_bit_for_bit(array):
    found = back(array)
    assert found.shape == array.shape
    assert found.tobytes() == np.ascontiguousarray(array).tobytes()


def test_a_column_that_occurs_twice_is_kept_once():
    column = np.arange(1000.0)
    _, pools = encoded((column, np.column_stack([column, column, -column])))
    assert pools["float64"].size == 2000


def test_what_is_shared_stays_shared():
    fault = Fault(3, "x", "why")
    first, second = back((fault, (fault,)))
    assert first == fault
    assert second[0] is first


def test_a_block_comes_back_and_computes_the_same():
    block = crane()
    point = {"distance": np.linspace(-10.0, 30.0, 41), "angle": 3.0}
    assert np.array_equal(back(block).evaluate(point)["power"], block.evaluate(point)["power"])


def test_a_plant_comes_back_without_its_functions(tmp_path):
    before = outcome(tmp_path, run(tmp_path)).base.diagram.plant.model
    after = back(before)
    assert after.declaration == before.declaration
    assert after.functions.path == before.path
    assert after.functions.dynamics is not before.functions.dynamics


def test_an_outcome_comes_back_whole(tmp_path):
    before = outcome(tmp_path, run(tmp_path), run(tmp_path, "raw_distance", "swings"))
    document, pools = encoded(before)
    again, same = encoded(back(before))
    assert again == document
    assert {kind: pool.tobytes() for kind, pool in same.items()} == {
        kind: pool.tobytes() for kind, pool in pools.items()
    }


@pytest.mark.parametrize(
    ("wrong", "why"),
    [
        (lambda d: d["classes"].update({"os.system": ["command"]}), "there is no os.system"),
        (
            lambda d: d["classes"].update({"fcl_sim.testbench.run": ["path"]}),
            "there is no fcl_sim.testbench.run",
        ),
        (lambda d: d["classes"].update({FAULT: ["tick"]}), "has other fields"),
        (lambda d: d.update(top={"noun": 7}), "IndexError"),
        (lambda d: d.pop("nouns"), "KeyError"),
    ],
)
def test_what_is_not_of_this_version_is_refused(wrong, why):
    document, pools = encoded(Fault(3, "x", "why"))
    wrong(document)
    with pytest.raises(Unreadable, match=why):
        decoded(document, pools)


def test_what_is_no_data_is_refused():
    with pytest.raises(TypeError, match="function is no data"):
        encoded(back)


def test_fractions_and_paths_keep_their_kind():
    assert back(AtLeast(share=Fraction(2, 3))) == AtLeast(share=Fraction(2, 3))
    assert back(Path("a") / "b") == Path("a/b")
    assert back(replace(Fault(1, "a", "b"), tick=np.int64(4))).tick == 4

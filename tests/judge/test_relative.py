"""A figure beside that of another run: the ratio or the difference is bounded."""

import math

import numpy as np
import pytest

from fcl_sim.judge.judge import judge
from fcl_sim.judge.verdict import Form, Relative, Requirement, Status
from fcl_sim.loop.trace import Fault, Trace

TIME = np.arange(6001) * 0.01


def trace(values, fault=None) -> Trace:
    values = np.asarray(values, dtype=float)
    ticks = np.arange(len(values)) * 10_000_000
    return Trace(ticks=ticks, names=("y",), units={"y": "m"}, values=values[:, None], fault=fault)


def decay(tau: float) -> Trace:
    return trace(np.exp(-TIME / tau))


SETTLING = {"metric": "settling_time", "arguments": {"final": 0.0, "band": 0.02}}


def one(run, runs, form=Form.RATIO, **given):
    asked = {"id": "R", "text": "as told", "signal": "y", "relative_to": Relative("old", form), **SETTLING}
    (verdict,) = judge(run, [Requirement(**{**asked, **given})], runs)
    return verdict


def test_a_ratio_is_taken_to_the_figure_of_the_other_run():
    found = one(decay(3.0), {"old": decay(2.0)}, maximum=1.25)
    assert found.status is Status.FAIL
    assert found.value == pytest.approx(1.5, abs=1e-4)
    assert found.reason == (
        "The settling time of y is 11.74 s, 1.5 times the 7.824 s in the run `old`; at most 1.25 is allowed."
    )
    assert found.definition.startswith("ratio to that of the run `old`: time from the start")
    assert (found.band, found.violation) == (None, None)


def test_a_difference_is_in_the_unit_of_the_metric():
    found = one(decay(1.0), {"old": decay(2.0)}, Form.DIFFERENCE, maximum=0.0, unit="s")
    assert found.status is Status.PASS
    assert found.value == pytest.approx(-math.log(50), abs=1e-4)
    assert found.reason == (
        "The settling time of y is 3.912 s, -3.912 s from the 7.824 s in the run `old`; "
        "at most 0 s is allowed."
    )


def test_what_never_settles_is_beyond_every_ratio():
    found = one(trace(np.ones(6001)), {"old": decay(2.0)}, maximum=1e9)
    assert (found.status, found.value) == (Status.FAIL, None)
    assert found.reason.startswith("y does not settle, and the settling time is 7.824 s in the run `old`; ")


@pytest.mark.parametrize("form", Form)
@pytest.mark.parametrize("expect_fail", [False, True])
def test_another_run_that_never_settles_is_nothing_to_compare_with(form, expect_fail):
    found = one(decay(1.0), {"old": trace(np.ones(6001))}, form, maximum=1e9, expect_fail=expect_fail)
    assert found.status is Status.UNTESTED
    assert found.reason.startswith("The run `old` gives nothing to compare with: y does not settle there.")


def test_there_is_no_ratio_to_nothing():
    peak = {"metric": "peak", "arguments": {}}
    found = one(decay(1.0), {"old": trace(np.zeros(6001))}, **peak, maximum=1e9)
    assert found.status is Status.UNTESTED
    assert one(decay(1.0), {"old": trace(np.zeros(6001))}, Form.DIFFERENCE, **peak, maximum=1.0).value == 1.0


def test_faults_of_either_run_are_faults():
    broken = trace([1.0, 1.0], Fault(10_000_000, "y", "it diverges"))
    assert one(broken, {"old": decay(1.0)}, maximum=9.0).status is Status.FAULT
    found = one(decay(1.0), {"old": broken}, maximum=9.0)
    assert found.status is Status.FAULT
    assert found.reason == ("The run `old` gives nothing to compare with: it ended at 0.01 s: it diverges.")
    nan = trace([1.0, math.nan, 0.0])
    assert one(nan, {"old": decay(1.0)}, maximum=9.0).status is Status.FAULT
    assert one(decay(1.0), {"old": nan}, maximum=9.0).status is Status.FAULT


def test_a_trace_without_the_other_run_is_untested():
    found = one(decay(1.0), {}, maximum=9.0)
    assert found.status is Status.UNTESTED
    assert found.reason == "There is no trace of the run `old` to compare with."

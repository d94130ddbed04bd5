"""A metric that is taken anew at each restart: the worst counts, or the sum."""

import math

import numpy as np
import pytest

from fcl_sim.judge.judge import judge
from fcl_sim.judge.measure import measure
from fcl_sim.judge.metrics import METRICS
from fcl_sim.judge.verdict import Requirement, Status, Verdict
from fcl_sim.loop.trace import FuzzyRecord, Trace

SCAN = 10_000_000
TIME = np.arange(6001) * 0.01


def trace(values, undefined=None) -> Trace:
    values = np.asarray(values, dtype=float)
    active = np.ones(len(values), np.bool_) if undefined is None else ~np.asarray(undefined, dtype=np.bool_)
    nothing = np.zeros((len(values), 1))
    record = FuzzyRecord(("x",), ("power",), ("1",), nothing, nothing, nothing, active[:, None])
    return Trace(
        ticks=np.arange(len(values)) * SCAN,
        names=("y", "controller.rules.power"),
        units={"y": "m", "controller.rules.power": "kW"},
        values=np.column_stack([values, 0 * values]),
        fuzzy={"controller.rules": record},
    )


def one(run: Trace, metric: str, restart_at=(), signal="y", **given) -> Verdict:
    bounds = {key: given.pop(key) for key in ("minimum", "maximum", "unit") if key in given}
    requirement = Requirement(
        id="R",
        text="as told",
        metric=metric,
        signal=signal,
        arguments={key.removesuffix("_"): value for key, value in given.items()},
        restart_at=restart_at,
        **bounds,
    )
    (verdict,) = judge(run, [requirement])
    return verdict


def steps(*taus: float) -> np.ndarray:
    """Return an error that starts at 1 m every 20 s and decays with these time constants."""
    parts = [np.exp(-TIME[:2000] / tau) for tau in taus]
    return np.append(np.concatenate(parts), 0.0)


THREE = (20.0, 40.0)


def test_the_worst_of_the_pieces_counts_and_is_named():
    run = trace(steps(1.0, 3.0, 2.0))
    found = one(run, "settling_time", THREE, final=0.0, band=0.02, maximum=10.0, unit="s")
    assert found.status is Status.FAIL
    assert found.value == pytest.approx(3 * math.log(50), abs=1e-4)
    assert found.reason == (
        "The settling time of y is 11.74 s; at most 10 s is allowed; it is the worst of 3 pieces, that "
        "from 20 s to 40 s, first violated from 30 s to 31.73 s."
    )
    assert (found.band.start, found.band.end, found.band.high) == (30.0, 40.0, 0.02)
    assert found.violation == (30.0, 31.73)
    assert found.definition.endswith("; final = 0 m, band = 0.02 m, restart_at = 20, 40 s")


def test_without_restarts_the_same_run_settles_after_the_last_step():
    found = one(trace(steps(1.0, 3.0, 2.0)), "settling_time", final=0.0, band=0.02, maximum=60.0)
    assert found.value == pytest.approx(40 + 2 * math.log(50), abs=1e-4)


def test_integrals_are_summed_over_the_pieces():
    run = trace(steps(1.0, 3.0, 2.0))
    found = one(run, "iae", THREE, final=0.0, maximum=10.0, unit="m s")
    assert found.value == pytest.approx(6.0, abs=0.02)
    assert "; it is the sum over 3 pieces" in found.reason
    found = one(run, "itae", THREE, final=0.0, maximum=20.0)
    assert found.value == pytest.approx(1 + 9 + 4, abs=0.1)


def test_which_piece_is_the_worst_is_for_the_bounds_to_say():
    run = trace(np.repeat([1.0, 5.0, 3.0], [2000, 2000, 2001]))
    assert one(run, "mean", THREE, maximum=4.0).value == 5.0
    assert one(run, "mean", THREE, minimum=2.0).value == 1.0
    assert one(run, "mean", THREE, minimum=0.0, maximum=5.5).value == 5.0
    assert one(run, "mean", THREE, minimum=0.9, maximum=6.0).value == 1.0
    assert one(run, "fraction_in_range", THREE, low=2.0, minimum=0.5).value == 0.0
    assert one(run, "peak", THREE, maximum=9.0).value == 5.0


def test_a_piece_ends_just_before_the_restart_with_its_last_sample_held():
    run = trace([1.0, 1.0, 7.0, 7.0])
    assert one(run, "peak", (0.02,), to=0.02, maximum=9.0).value == 7.0
    assert one(run, "total_variation", (0.02,), maximum=9.0).value == 0.0
    assert one(run, "energy", (0.02,), maximum=9.0).value == pytest.approx(0.02 + 0.07)


@pytest.mark.parametrize("name", [name for name, each in METRICS.items() if each.combined == "sum"])
def test_a_sum_over_pieces_that_do_not_restart_the_clock_is_the_whole(name):
    """But for what is weighted with time, which counts from each restart."""
    if name in {"itae", "itse", "reversals"}:
        return
    values = np.repeat([3.0, -1.0, 2.0, -4.0], 10)[:40]
    given = {"final": 0.5, "low": -1.0, "high": 2.0}
    given = {each.name: given[each.name] for each in METRICS[name].arguments if each.name in given}
    held = np.append(values, values[-1])
    run = trace(held, undefined=held > 0)
    signal = "controller.rules.power" if name == "time_undefined" else "y"
    restart = 0.15  # within a stretch in which nothing moves
    whole = one(run, name, signal=signal, maximum=1e9, **given).value
    assert one(run, name, (restart,), signal=signal, maximum=1e9, **given).value == pytest.approx(whole)


def test_a_piece_in_which_there_is_nothing_to_measure_leaves_the_requirement_untested():
    run = trace(np.append(steps(1.0, 2.0)[:-1], np.zeros(2001)))
    found = one(run, "overshoot", THREE, final=0.0, maximum=1.0)
    assert found.status is Status.UNTESTED
    assert found.reason == (
        "y starts at its final value, so there is no motion towards it to measure from 40 s to 60 s."
    )


def test_a_trace_that_ends_before_the_last_piece_is_inconclusive():
    run = trace(steps(1.0))
    assert one(run, "iae", (40.0,), final=0.0, to=60.0, maximum=9.0).status is Status.INCONCLUSIVE
    assert one(run, "iae", (10.0,), final=0.0, to=30.0, maximum=9.0).status is Status.INCONCLUSIVE


def test_nan_in_any_piece_is_a_fault():
    values = steps(1.0, 1.0, 1.0)
    values[2500] = math.nan
    assert one(trace(values), "iae", THREE, final=0.0, maximum=9.0).status is Status.FAULT


def test_time_undefined_is_read_from_the_record_of_the_rules():
    undefined = np.zeros(6001, np.bool_)
    undefined[1000:1500] = True
    run = trace(steps(1.0, 1.0, 1.0), undefined)
    found = one(run, "time_undefined", signal="controller.rules.power", maximum=1.0, unit="s")
    assert found.status is Status.FAIL
    assert found.value == pytest.approx(5.0)
    recorded = Trace(run.ticks, run.names, run.units, run.values)
    found = one(recorded, "time_undefined", signal="controller.rules.power", maximum=1.0, unit="s")
    assert found.status is Status.UNTESTED
    assert found.reason == "The trace does not tell when a rule was active for controller.rules.power."


def test_a_measure_of_a_block_with_one_output_may_name_the_block():
    run = trace(steps(1.0), np.ones(2001))
    requirement = Requirement(
        id="R", text="", metric="time_undefined", signal="controller.rules", maximum=1.0
    )
    assert measure(run, requirement, METRICS["time_undefined"]).value == pytest.approx(20.0)

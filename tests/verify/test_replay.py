"""A log goes through a rule base as it went through the controller, and what differs is named."""

from dataclasses import replace

import numpy as np
import pytest

from fcl_sim.diagnostics import InputFault
from fcl_sim.loop import trace_file, trace_reader
from fcl_sim.loop.trace import Trace
from fcl_sim.verify.replay import TOLERANCES, replay
from tests.verify.rule_bases import RULES, heating, recorded
from tests.verify.test_coverage import TICKS

WALK = [(round(20 + 22 * np.sin(k / 3)), round(10 + 12 * np.cos(k / 5))) for k in range(60)]
KINDS = [("LREAL", "LREAL"), ("REAL", "REAL"), ("INT", "INT")]


def log_of(record, names=("room", "wind", "valve")):
    values = np.column_stack([record.inputs, record.outputs])[:, : len(names)]
    return Trace(TICKS[: len(values)], names, dict.fromkeys(names, ""), values)


@pytest.mark.parametrize(("arithmetic", "kind"), KINDS)
@pytest.mark.parametrize("default", ["NC", "0"])
def test_what_an_instance_gave_is_given_again_to_the_last_bit(arithmetic, kind, default):
    block = heating(default=default, kind=kind)
    record = recorded(block, arithmetic, WALK)
    assert not record.active.all()
    found = replay(block, log_of(record), absolute=0.0)
    assert found.arithmetic == arithmetic
    assert np.array_equal(found.record.outputs, record.outputs)
    assert np.array_equal(found.record.degrees, record.degrees)
    assert np.array_equal(found.record.active, record.active)
    (valve,) = found.comparisons
    assert (valve.compared, valve.deviating, valve.first, valve.largest) == (60, 0, None, None)
    assert found.first is None


@pytest.mark.parametrize("name", ["log.csv", "log.npz"])
def test_a_trace_of_ours_is_replayed_from_its_file_cold_restarts_included(tmp_path, name):
    block = heating()
    record = recorded(block, "LREAL", WALK, cold=(25,))
    values = np.column_stack([record.inputs[:, 0] * 2.0, record.outputs])
    names = ("plant.room", "controller.rules")
    trace = Trace(TICKS[:60], names, dict.fromkeys(names, ""), values, {"controller.rules": record})
    trace_file.write(trace, tmp_path / name)
    found = replay(block, trace_reader.read(tmp_path / name), absolute=0.0)
    assert found.inputs == {"room": "controller.rules.room", "wind": "controller.rules.wind"}
    assert found.comparisons[0].column == "controller.rules.valve"
    assert found.first is None


def test_the_first_sample_that_deviates_is_that_of_an_instance_and_its_rules_are_named():
    block, other = heating(), heating(RULES.replace("valve IS open", "valve IS closed"))
    ours, theirs = (recorded(each, "LREAL", WALK).outputs[:, 0] for each in (block, other))
    found = replay(block, log_of(recorded(other, "LREAL", WALK)))
    deviating = np.flatnonzero(np.abs(ours - theirs) > 1e-9 * 100)
    (valve,) = found.comparisons
    assert valve.deviating == deviating.size > 0
    assert valve.first.sample == deviating[0] + 1
    assert valve.first.tick == TICKS[deviating[0]]
    assert (valve.first.replayed, valve.first.recorded) == (ours[deviating[0]], theirs[deviating[0]])
    assert valve.largest.difference == np.max(np.abs(ours - theirs))
    assert "2" in {each.label for each in found.rules}
    assert {each.label: each.degree for each in found.rules} == {
        label: degree
        for label, degree in zip("1234", found.record.degrees[deviating[0]].tolist(), strict=True)
        if degree > 0.0
    }
    assert set(found.terms) == {"room", "wind"}
    assert all(degree > 0.0 for terms in found.terms.values() for degree in terms.values())


def test_a_deviation_is_one_beyond_the_tolerance_in_the_unit_or_of_the_range():
    block = heating()
    record = recorded(block, "LREAL", WALK)
    off = replace(record, outputs=record.outputs + 0.5)
    assert replay(block, log_of(off)).comparisons[0].deviating == 60
    assert replay(block, log_of(off), absolute=0.5 + 1e-9).first is None
    assert replay(block, log_of(off), relative=0.005 + 1e-9).first is None
    assert replay(block, log_of(off), absolute=0.25, relative=0.002).comparisons[0].deviating == 60
    assert TOLERANCES.keys() == {"LREAL", "REAL", "INT"}


def test_a_sample_without_a_recorded_output_is_not_compared_and_none_at_all_is_an_evaluation():
    block = heating()
    record = recorded(block, "LREAL", WALK)
    log = log_of(record)
    log.values[10:20, 2] = np.nan
    assert replay(block, log).comparisons[0].compared == 50
    found = replay(block, log_of(record, ("room", "wind")))
    assert found.comparisons == ()
    assert np.array_equal(found.trace["valve"], record.outputs[:, 0])


def test_columns_are_found_by_name_whatever_the_case_by_the_end_of_theirs_or_as_told():
    block = heating()
    record = recorded(block, "LREAL", WALK)
    for names in (("ROOM", "Wind", "valve"), ("plc.room", "plc.WIND", "plc.valve")):
        assert replay(block, log_of(record, names)).first is None
    given = {"a b": "room", "x": "wind", "q": "VALVE"}
    assert replay(block, log_of(record, ("a b", "x", "q")), columns=given).comparisons[0].deviating == 0


@pytest.mark.parametrize(
    ("names", "given", "code", "told"),
    [
        (("rooom", "wind"), {}, "VER201", "no column is the input `room`"),
        (("a.room", "b.room", "wind"), {}, "VER202", "`room` could be a.room or b.room"),
        (("room", "wind"), {"roof": "room"}, "VER204", "there is no column `roof`"),
        (("room", "wind"), {"room": "roof"}, "VER204", "the rule base has no variable `roof`"),
    ],
)
def test_a_column_that_is_not_there_or_could_be_several_is_told(names, given, code, told):
    log = Trace(TICKS[:1], names, dict.fromkeys(names, ""), np.zeros((1, len(names))))
    with pytest.raises(InputFault) as caught:
        replay(heating(), log, columns=given, name="log.csv")
    assert (caught.value.diagnostics[0].code, caught.value.diagnostics[0].message) == (code, told)
    assert caught.value.diagnostics[0].hint


@pytest.mark.parametrize(
    ("value", "kind"), [(np.nan, "LREAL"), (np.inf, "LREAL"), (1e39, "REAL"), (4e4, "INT")]
)
def test_an_input_that_the_arithmetic_cannot_hold_is_told_with_its_sample(value, kind):
    log = log_of(recorded(heating(), "LREAL", WALK))
    log.values[3, 1] = value
    with pytest.raises(InputFault, match=r"VER203.*`wind` in sample 4, at 0.15 s is"):
        replay(heating(kind=kind), log, name="log.csv")

"""What happened during a run stands in its pictures: each event, or of many the first of its kind."""

from dataclasses import replace

from fcl_sim.loop.trace import BlockEvent, Incident
from fcl_sim.report.canvas import Line
from fcl_sim.report.events import marks_of
from fcl_sim.report.pictures import over_time
from tests.report.legible import clashes, cut
from tests.report.synthetic import run, trace

SECOND = 10**9


def eventful(times=(10, 11)):
    reported = tuple(BlockEvent(each * SECOND, "controller.rules", "OVERFLOW", True) for each in times)
    return replace(trace(), events=reported, incidents=(Incident(5 * SECOND, "restart", "warm"),))


def test_each_has_its_mark_in_the_order_of_time():
    assert [(each.time, each.text) for each in marks_of(eventful())] == [
        (5.0, "restart"),
        (10.0, "controller.rules: OVERFLOW"),
        (11.0, "controller.rules: OVERFLOW"),
    ]


def test_of_many_the_first_of_each_kind_is_marked():
    found = marks_of(eventful(range(10, 50)))
    assert [(each.time, each.text) for each in found] == [
        (5.0, "restart"),
        (10.0, "controller.rules: OVERFLOW, first of 40"),
    ]


def test_they_stand_as_uprights_in_every_axis_and_their_names_are_whole(tmp_path):
    (picture,) = over_time(run(tmp_path, trace=eventful()))
    figure = picture.draw()
    names, *axes = figure.axes
    assert names.label == "events"
    for each in axes:
        assert [line.x[0] for line in each.of(Line, "event")] == [5.0, 10.0, 11.0]
    assert cut(figure) == []
    assert clashes(figure) == []
    assert "Dashed uprights" in picture.caption


def test_a_run_without_any_has_no_room_for_them(tmp_path):
    (picture,) = over_time(run(tmp_path))
    assert [each.label for each in picture.draw().axes if each.label == "events"] == []

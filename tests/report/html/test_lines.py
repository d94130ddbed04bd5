"""What the page draws of runs: every signal of each, on an axis of its own where any run parts it."""

import json
from dataclasses import replace

from fcl_sim.judge.verdict import Status
from fcl_sim.report.html.lines import scenario_data
from fcl_sim.report.html.pack import Pack
from fcl_sim.testbench import Against
from tests.report.html.scripts import Script
from tests.report.synthetic import outcome, run, trace, verdict


def data(*args, **given):
    return scenario_data(replace(outcome(*args), **given), Pack(100))


def names(found):
    return [lane["names"] for lane in found["lanes"] if lane["focus"] is None]


def off(folder, name="sensor_off"):
    """Return a run whose controller reads something else than the crane does."""
    found = trace()
    values = found.values.copy()
    values[:, 2] += 7.0
    return run(folder, name, trace=replace(found, values=values))


def test_signals_that_part_in_any_run_have_a_lane_each(tmp_path):
    assert ["crane.distance", "controller.distance"] in names(data(tmp_path, run(tmp_path)))
    for given in (
        names(data(tmp_path, run(tmp_path), off(tmp_path))),
        names(data(tmp_path, off(tmp_path), run(tmp_path))),
    ):
        assert ["crane.distance"] in given
        assert ["controller.distance"] in given


def test_signals_that_part_in_the_older_version_have_a_lane_each(tmp_path):
    against = Against(label="an older one", runs={"base": off(tmp_path)})
    assert ["controller.distance"] in names(data(tmp_path, run(tmp_path), against=against))


def test_what_only_a_variant_is_judged_by_is_judged_on_the_page(tmp_path):
    sway = verdict(id="CR-9", signal="crane.sway", unit="deg")
    runs = [run(tmp_path, verdicts=(verdict(),)), run(tmp_path, "v2", verdicts=(verdict(), sway))]
    judged = {lane["signal"]: lane["judged"] for lane in data(tmp_path, *runs)["lanes"]}
    assert judged["crane.sway"]
    assert not judged["controller.rules.power"]


SCRIPT = Script("data.js", "numbers.js", "lanes.js", "explorer.js")

MARKED = """(data, at) => {
  const runs = data.runs.map((told) => Object.assign(Object.create(Run.prototype), { told }));
  return Object.fromEntries(data.lanes.map((told) => {
    const lane = Object.assign(Object.create(Lane.prototype), { told, scenario: { runs } });
    return [told.signal, [runs[at].idle(told.names), lane.broken(at).length]];
  }));
}"""


def dead(folder):
    """Return a run in which no rule is ever active, the output is 0 kW, and so is the sway, in degrees."""
    found = trace()
    values = found.values.copy()
    values[:, [1, 3]] = 0.0
    record = found.fuzzy["controller.rules"]
    still = replace(record, outputs=record.outputs * 0.0, flags=record.flags & False)
    return run(
        folder,
        "dead",
        trace=replace(found, values=values, fuzzy={"controller.rules": still}),
        verdicts=(verdict(Status.FAIL, None, signal="crane.sway", unit="deg"),),
    )


def test_only_the_output_is_marked_where_no_rule_is_active_and_only_what_is_missed_as_missed(tmp_path):
    found = json.loads(json.dumps(data(tmp_path, run(tmp_path), dead(tmp_path))))
    marked = SCRIPT.call(MARKED, found, 1)
    assert {name: stretches for name, (stretches, _) in marked.items()} == {
        "crane.distance": [],
        "crane.sway": [],
        "controller.rules.power": [[0.0, 60.0]],
    }
    assert {name: missed for name, (_, missed) in marked.items()} == {
        "crane.distance": 0,
        "crane.sway": 1,
        "controller.rules.power": 0,
    }

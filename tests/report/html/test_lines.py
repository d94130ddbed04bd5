"""What the page draws of runs: every signal of each, on an axis of its own where any run parts it."""

from dataclasses import replace

from fcl_sim.report.html.lines import scenario_data
from fcl_sim.report.html.pack import Pack
from fcl_sim.testbench import Against
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

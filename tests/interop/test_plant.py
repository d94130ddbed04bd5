"""A system of python-control as the plant of a scenario moves as the system does."""

from pathlib import Path

import control
import numpy as np
import pytest

from fcl_sim.interop import plant_text
from fcl_sim.loop.run import run
from fcl_sim.scenario.binder import bind
from fcl_sim.scenario.reader import read

SCENARIO = """
title = "From python-control"
duration = "20 s"
scan = "100 ms"

[blocks.push]
type = "sine"
frequency = "0.2 Hz"

"""
TWO_BY_TWO = control.ss(
    [[-1.0, 0.3], [0.0, -0.2]], np.eye(2), [[1.0, 1.0], [0.0, 2.0]], [[0.0, 0.1], [0.0, 0.0]], name="pair"
)
SYSTEMS = {
    "transfer function": control.tf([1.0, 3.0], [1.0, 0.8, 4.0], name="mass"),
    "state space": control.ss([[-0.5]], [[1.0]], [[0.25]], 0, inputs="heat", outputs="level"),
    "zeros and poles": control.zpk([], [-1, -1 + 2j, -1 - 2j], 5),
    "two by two": TWO_BY_TWO,
}


def bound(text):
    Path("scenarios").mkdir(exist_ok=True)
    Path("scenarios/own.toml").write_text(SCENARIO + text, "utf-8")
    return run(bind(read("scenarios/own.toml")))


@pytest.mark.parametrize("name", SYSTEMS)
def test_the_plant_moves_as_the_system_does(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    system = SYSTEMS[name]
    labels = [each.replace("[", "").replace("]", "") for each in system.input_labels]
    trace = bound(plant_text(system, dict.fromkeys(labels, "push"), name="it"))
    outputs = [each.replace("[", "").replace("]", "") for each in system.output_labels]
    # What passes straight through is read before it is written, so the last scan's is compared.
    sampled = control.sample_system(control.ss(system), 0.1, method="zoh")
    response = control.forced_response(sampled, trace.time, np.tile(trace["push"], (len(labels), 1)))
    before = np.concatenate([[0.0], trace["push"][:-1]])
    through = sampled.D @ np.tile(before - trace["push"], (len(labels), 1))
    expected = np.atleast_2d(response.outputs) + through
    for row, output in enumerate(outputs):
        assert trace[f"it.{output}"] == pytest.approx(expected[row], abs=1e-12)


def test_names_units_and_dead_time_are_written(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    units = {"heat": "%", "level": "m"}
    text = plant_text(SYSTEMS["state space"], {"heat": "percent"}, units, name="tank", delay="2 s")
    push = '[blocks.percent]\ntype = "gain"\ninput = "push"\ngain = "1 %"\n'
    trace = bound(f"{push}\n{text}")
    assert (trace.units["tank.heat"], trace.units["tank.level"]) == ("%", "m")
    assert trace["tank.level"][:21].tolist() == [0.0] * 21
    assert trace["tank.level"][22] != 0.0


@pytest.mark.parametrize(
    ("system", "inputs", "units", "words"),
    [
        (control.tf([1.0], [1.0, 0.5], 0.1), {"u0": "push"}, {}, "is sampled"),
        (SYSTEMS["transfer function"], {"push": "push"}, {}, "has the inputs u0"),
        (SYSTEMS["transfer function"], {"u0": "push"}, {"y": "m"}, "no signal y; it has u0, y0"),
        (control.tf([1.0], [1.0, 1.0], inputs="a b"), {"a b": "push"}, {}, "a b is no name"),
    ],
    ids=["discrete", "inputs", "units", "name"],
)
def test_a_system_that_cannot_be_a_plant_is_refused(system, inputs, units, words):
    with pytest.raises(ValueError, match=words):
        plant_text(system, inputs, units)

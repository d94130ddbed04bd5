"""What a block is set up with: numbers in declared units, and random numbers of its own."""

from dataclasses import replace

import numpy as np
import pytest

from fcl_sim.loop import settings
from fcl_sim.loop.blocks.declaration import BlockInput, BlockOutput, BlockParameter, BlockType, Like, Prepared
from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.loop.diagram import Node, Timing, Wire
from fcl_sim.loop.fit import settle
from fcl_sim.units import parse_quantity, parse_unit

TRIAL = BlockType(
    name="trial",
    summary="every kind of parameter",
    equation="none",
    source="none",
    kernel=None,
    inputs=(BlockInput(name="input", meaning="u"),),
    parameters=(
        BlockParameter(name="rate", unit=Like("input", "1/s"), above=0.0, meaning="a rate"),
        BlockParameter(name="scans", kind="count", default=3, maximum=10, meaning="scans"),
        BlockParameter(name="levels", kind="list", unit=Like("input"), default=(), meaning="levels"),
        BlockParameter(name="curve", kind="table", columns=(Like("input"), None), meaning="a curve"),
    ),
    outputs=(BlockOutput(unit=Like("curve.1")),),
    prepare=lambda setting: Prepared(states=[0.0] * setting.values["scans"]),
)


@pytest.fixture
def trial(monkeypatch):
    monkeypatch.setattr(settings, "BLOCKS", {**settings.BLOCKS, "trial": TRIAL})

    def settled(**parameters):
        node = Node(name="trial", type="trial", inputs={"input": Wire("x")}, parameters=parameters)
        faults = []
        found = settle(node, {"input": parse_unit("m")}, Timing(scan=10**7, duration=10**9), faults)
        return *found, [each.message for each in faults]

    return settled


def row(*texts):
    return tuple(parse_quantity(each) for each in texts)


CURVE = (row("0 m", "0 kW"), row("50 cm", "300 W"))


def test_parameters_are_numbers_in_their_declared_units(trial):
    levels = row("1 m", "25 cm")
    setting, units, faults = trial(rate=parse_quantity("6 cm/s"), levels=levels, curve=CURVE, scans=4)
    assert faults == []
    assert setting.values["rate"] == 0.06
    assert setting.values["scans"] == 4
    assert setting.values["levels"].tolist() == [1.0, 0.25]
    assert setting.values["curve"].tolist() == [[0.0, 0.0], [0.5, 0.3]]
    assert units["trial"].symbol == "kW"
    assert len(TRIAL.prepared(setting).states) == 4
    assert (setting.cycle, setting.scans) == (0.01, 100)


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"rate": parse_quantity("1 m")}, "`rate` of `trial`: 1 m does not convert to m/s"),
        ({"rate": parse_quantity("0 m/s")}, "`rate` of `trial` is 0 m/s"),
        ({"scans": 11}, "`scans` of `trial` is 11"),
        ({"levels": row("1 m", "1 s")}, "`levels` of `trial`: 1 s does not convert to m"),
        ({"curve": (*CURVE, row("1 m", "1 m"))}, "`curve` of `trial`: 1 m does not convert to kW"),
    ],
)
def test_parameters_that_do_not_fit_are_told(trial, changes, told):
    given = {"rate": parse_quantity("1 m/s"), "curve": CURVE, **changes}
    assert trial(**given)[-1] == [told]


def test_random_numbers_belong_to_seed_run_block_and_stream():
    setting = Setting(name="a", values={}, seed=1, run=2)
    first = setting.random().normal(size=5)
    assert np.array_equal(
        first, Setting(name="a", values={"x": 1}, seed=1, run=2, scans=9).random().normal(size=5)
    )
    others = [
        replace(setting, seed=2).random(),
        replace(setting, run=3).random(),
        replace(setting, name="b").random(),
        setting.random(1),
    ]
    assert not any(np.isclose(each.normal(size=5), first).any() for each in others)

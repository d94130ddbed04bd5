"""Names become paths, texts numbers, files plants; requirements take the units of their signals."""

import pytest

from fcl_sim.diagnostics import InputFault
from fcl_sim.loop.diagram import FuzzyNode, Wire
from fcl_sim.loop.wiring import wire
from fcl_sim.scenario.binder import bind, requirements
from fcl_sim.scenario.requirements import Units
from fcl_sim.units import parse_quantity

UNITS = {"crane.distance": "m", "crane.sway": "deg"}


def test_names_of_the_controller_become_paths(bench):
    diagram = bind(bench.read())
    assert [node.name for node in diagram.nodes] == [
        "controller.speed",
        "controller.predicted",
        "controller.rules",
    ]
    speed, predicted, rules = diagram.nodes
    assert speed.inputs == {"input": Wire("controller.distance", -1.0)}
    assert predicted.inputs == {"distance": Wire("controller.distance"), "speed": Wire("controller.speed")}
    assert predicted.parameters == {"distance": parse_quantity(1.0), "speed": parse_quantity("-6 s")}
    assert isinstance(rules, FuzzyNode)
    assert rules.inputs == {"distance": Wire("controller.predicted"), "angle": Wire("controller.angle")}
    assert rules.units == {"distance": "m", "angle": "deg", "power": "kW"}
    assert diagram.aliases == {
        "controller.distance": Wire("crane.distance"),
        "controller.angle": Wire("crane.angle"),
        "controller.power": Wire("controller.rules.power"),
    }


def test_the_plants_values_are_in_its_units(bench):
    plant = bind(bench.read(), "heavy_and_far").plant
    assert plant.parameters == {"load_mass": 40_000.0, "cable_length": 15.0}
    assert plant.start == {"position": -40.0}
    assert plant.inputs == {"power": Wire("controller.power")}


def test_the_diagram_of_every_shipped_variant_wires(bench):
    for name in ("transfer.toml", "printed.toml"):
        scenario = bench.read(name)
        for variant in scenario.variants:
            assert wire(bind(scenario, variant)).units["controller.power"].symbol == "kW"


def test_wires_bear_signs_and_blanks(bench):
    bench.edit("transfer.toml", ('power = "controller.power"', 'power = " - controller.power"'))
    assert bind(bench.read()).plant.inputs == {"power": Wire("controller.power", -1.0)}


def test_blocks_outside_the_controller_see_the_whole_loop(bench):
    bench.edit(
        "transfer.toml",
        ("[plant]", '[blocks]\nfar = { type = "gain", input = "crane.distance", gain = 2.0 }\n\n[plant]'),
        ('distance = "crane.distance", angle', 'distance = "far", angle'),
    )
    diagram = bind(bench.read())
    assert diagram.nodes[0].name == "far"
    assert diagram.aliases["controller.distance"] == Wire("far")
    assert "far" in wire(diagram).units


def test_a_variant_that_is_not_there_is_told_with_the_nearest(bench):
    with pytest.raises(InputFault) as caught:
        bind(bench.read(), "raw_distanc")
    assert str(caught.value) == (
        "scenarios/crane/transfer.toml: error[SCN405]: `crane/transfer` has no variant called `raw_distanc`\n"
        "  hint: did you mean `raw_distance`?"
    )


def test_requirements_take_the_units_of_their_signals(bench):
    bench.edit(
        "transfer.toml", ('band = "0.5 m"', 'band = "50 cm"'), ('max    = "35 s"', 'max    = "0.5 min"')
    )
    first, second, *_ = requirements(bench.read(), "base", Units(UNITS))
    assert (first.id, first.metric, first.signal) == ("CR-1", "settling_time", "crane.distance")
    assert first.arguments == {"final": 0.0, "band": 0.5}
    assert (first.minimum, first.maximum, first.unit) == (None, 30.0, "s")
    assert second.arguments == {"final": 0.0, "band": 0.5}


def test_requirements_fit_a_recorded_trace_in_other_units(bench):
    units = Units({"crane.distance": "mm", "crane.sway": "rad"})
    first, _, third, *_ = requirements(bench.read(), "base", units)
    assert first.arguments == {"final": 0.0, "band": 500.0}
    assert (third.maximum, third.unit) == (100.0, "mm")


def test_a_miss_is_expected_of_the_named_runs_only(bench):
    scenario = bench.read()
    expected = {
        variant: [each.id for each in requirements(scenario, variant, Units(UNITS)) if each.expect_fail]
        for variant in scenario.variants
    }
    assert expected == {
        "base": ["CR-5"],
        "raw_distance": ["CR-1", "CR-2", "CR-3", "CR-4", "CR-5"],
        "frictionless": [],
        "light_load": ["CR-5"],
        "heavy_and_far": [],
        "double_scan": ["CR-5"],
    }


def test_expect_fail_alone_means_every_run(bench):
    scenario = bench.read("printed.toml")
    units = Units(UNITS | {"crane.speed": "m/s", "crane.power": "kW", "crane.position": "m"})
    for variant in scenario.variants:
        found = requirements(scenario, variant, units)
        assert "PR-2" in [each.id for each in found if each.expect_fail]


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (('max    = "0.1 m"', 'max    = "0.1 m"\nmin = "1 m"'), "no value lies between the bounds of CR-3"),
        (
            (
                'peak = { signal = "crane.sway" }',
                'peak = { signal = "crane.sway", from = "9 s", to = "8 s" }',
            ),
            "the window of CR-4 ends before it begins",
        ),
        (
            ('peak = { signal = "crane.sway" }', 'peak = { signal = "crane.sway", from = ["9 s"] }'),
            "`from` of `peak` is a quantity",
        ),
        (
            (
                'peak = { signal = "crane.sway" }',
                'rise_time = { signal = "crane.sway", final = "1 deg", low = "1 s" }',
            ),
            "`low` of `rise_time` is a plain number, and this is in s",
        ),
    ],
)
def test_bounds_and_windows_make_sense(bench, edit, message):
    bench.edit("transfer.toml", edit)
    assert message in bench.fault()

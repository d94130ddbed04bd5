"""A scenario file becomes a Scenario: variants over it, overrides under them, files known by their hash."""

import hashlib
from pathlib import Path

import pytest

from fcl_sim.diagnostics import InputFault
from fcl_sim.scenario.bench import bench_of, name_of
from fcl_sim.scenario.model import BASE
from fcl_sim.scenario.overrides import setting
from fcl_sim.scenario.reader import read

SMALL = """
title = "A small loop"
duration = "10 s"
scan = "100 ms"

[blocks]
half = { type = "gain", input = "crane.distance", gain = "0.5 kW/m" }

[plant]
model = "crane"
name = "lift"
inputs = { power = "half" }
"""


def test_a_scenario_knows_what_it_was_read_from(bench):
    scenario = bench.read()
    assert scenario.name == "crane/transfer"
    assert scenario.bench == Path.cwd()
    assert [(each.role, each.name) for each in scenario.files] == [
        ("scenario", "scenarios/crane/transfer.toml"),
        ("controller", "scenarios/crane/crane.controller.toml"),
        ("rule base", "scenarios/crane/crane_completed.fcl"),
    ]
    for file in scenario.files:
        assert scenario.digests[file.name] == hashlib.sha256(file.path.read_bytes()).hexdigest()


def test_the_base_run_stands_first(bench):
    assert list(bench.read().variants)[:2] == [BASE, "raw_distance"]


def test_times_are_whole_nanoseconds(bench):
    scenario = bench.read()
    assert (scenario.base.timing.scan, scenario.base.timing.duration) == (50_000_000, 60_000_000_000)
    assert scenario.variants["double_scan"].timing.scan == 100_000_000


def test_a_variant_merges_tables_and_leaves_the_base_alone(bench):
    scenario = bench.read()
    rules = {name: setup.blocks["controller.rules"].plain() for name, setup in scenario.variants.items()}
    assert rules["raw_distance"]["inputs"] == {"distance": "distance", "angle": "angle"}
    assert rules[BASE]["inputs"] == {"distance": "predicted", "angle": "angle"}
    assert rules["raw_distance"] | {"inputs": None} == rules[BASE] | {"inputs": None}


def test_a_variant_that_changes_the_type_replaces_the_block(bench):
    gain = 'controller.blocks.speed = { type = "gain", input = "-distance", gain = "1 1/s" }'
    bench.edit(
        "transfer.toml", ("[variants.light_load]", f"[variants.no_filter]\n{gain}\n[variants.light_load]")
    )
    block = bench.read().variants["no_filter"].blocks["controller.speed"].plain()
    assert block == {"type": "gain", "input": "-distance", "gain": "1 1/s"}


def test_a_variant_may_add_a_block_and_take_another_controller(bench):
    variant = bench.read("printed.toml").variants["predicted_distance"]
    assert list(variant.blocks) == ["controller.rules", "controller.speed", "controller.predicted"]
    bench.edit(
        "transfer.toml",
        (
            "[variants.light_load]",
            '[variants.other]\ncontroller.file = "printed.controller.toml"\n\n[variants.light_load]',
        ),
    )
    other = bench.read().variants["other"]
    assert list(other.blocks) == ["controller.rules"]
    assert other.rule_bases["controller.rules"].name == "crane_printed.fcl"


def test_a_variant_has_its_own_title_or_its_name_in_the_bases(bench):
    bench.edit("transfer.toml", ('title = "No rolling resistance"\n', ""))
    scenario = bench.read()
    assert scenario.variants["light_load"].title == "10 t instead of 20 t"
    assert scenario.variants["frictionless"].title == f"{scenario.title}: frictionless"
    assert scenario.description.startswith("The crane of Annex C takes a container")
    assert scenario.variants["light_load"].description == ""


def test_overrides_lie_under_the_variants(bench):
    scenario = bench.read(plant__parameters__load_mass="40 t")
    masses = {name: each.plant.parameters["load_mass"].value for name, each in scenario.variants.items()}
    assert (masses[BASE], masses["light_load"]) == ("40 t", "10 t")
    assert scenario.overrides == {"plant.parameters.load_mass": "40 t"}


def test_overrides_take_any_plain_value(bench):
    rules = {
        "type": "fuzzy",
        "file": "crane_printed.fcl",
        "inputs": {"distance": "distance", "angle": "angle"},
    }
    scenario = bench.read(controller__blocks__rules=rules, timing__seed=3, title='a "quoted" \u007f title')
    assert scenario.base.rule_bases["controller.rules"].name == "crane_printed.fcl"
    assert scenario.base.timing.seed == 3
    assert scenario.title == 'a "quoted" \u007f title'


def test_an_override_that_is_no_plain_value_is_refused(bench):
    with pytest.raises(InputFault) as caught:
        bench.read(duration=object())
    assert str(caught.value) == (
        "error[SCN104]: `duration` cannot be set to a object\n"
        "  hint: give a text, a number, a list or a mapping of these"
    )


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("plant.parameters.load_mass=10 t", ("plant.parameters.load_mass", "10 t")),
        ("a.b = -25 m", ("a.b", "-25 m")),
        ("seed=3", ("seed", 3)),
        ("rtol=1e-9", ("rtol", 1e-9)),
        ('title="10"', ("title", "10")),
        ("x={ a = 1 }", ("x", {"a": 1})),
        ("x==", ("x", "=")),
        ("x=", ("x", "")),
    ],
)
def test_a_setting_needs_no_second_quotes(text, value):
    assert setting(text) == value


@pytest.mark.parametrize("text", ["duration", "=5 s", ""])
def test_a_setting_without_a_key_or_value_is_refused(text):
    with pytest.raises(InputFault, match="sets nothing"):
        setting(text)


def test_a_small_loop_keeps_its_blocks_in_the_scenario(tmp_path):
    file = tmp_path / "small.toml"
    file.write_text(SMALL, "utf-8")
    scenario = read(file)
    assert scenario.base.controller is None
    assert list(scenario.base.blocks) == ["half"]
    assert (scenario.base.plant.name, scenario.base.plant.model.value) == ("lift", "crane")
    assert scenario.base.timing.scan == 100_000_000


def test_timing_and_integration_are_read(tmp_path):
    file = tmp_path / "small.toml"
    tables = (
        '[timing]\nlatency = "20 ms"\njitter = "10 ms"\nseed = 7\ncycle_time = "measured"\n'
        '[integration]\nscheme = "rk4"\nstep = "2 ms"\nrtol = 1e-6\n'
    )
    file.write_text(SMALL + tables, "utf-8")
    setup = read(file).base
    assert (setup.timing.latency, setup.timing.jitter) == (20_000_000, 10_000_000)
    assert (setup.timing.seed, setup.timing.measured) == (7, True)
    assert (setup.integration.scheme, setup.integration.step, setup.integration.rtol) == ("rk4", 0.002, 1e-6)


def test_the_timing_of_the_scenario_lies_over_the_controllers(bench):
    bench.edit(
        "crane.controller.toml", ("[inputs]", '[timing]\nlatency = "5 ms"\njitter = "10 ms"\n\n[inputs]')
    )
    assert (bench.read().base.timing.latency, bench.read().base.timing.jitter) == (5_000_000, 10_000_000)
    both = bench.read(timing__latency="7 ms", controller__timing__jitter="3 ms").base.timing
    assert (both.latency, both.jitter) == (7_000_000, 3_000_000)


def test_a_byte_order_mark_and_windows_line_ends_are_read(tmp_path):
    file = tmp_path / "small.toml"
    file.write_bytes(b"\xef\xbb\xbf" + SMALL.replace("\n", "\r\n").encode())
    assert read(file).title == "A small loop"


def test_a_file_that_is_not_there_is_told_with_its_neighbour(bench):
    with pytest.raises(InputFault) as caught:
        bench.read("tranfer.toml")
    assert str(caught.value) == (
        "scenarios/crane/tranfer.toml: error[SCN101]: there is no file `scenarios/crane/tranfer.toml`\n"
        "  hint: did you mean `transfer.toml`?"
    )


@pytest.mark.parametrize(
    ("path", "bench", "name"),
    [
        ("b/scenarios/crane/transfer.toml", "b", "crane/transfer"),
        ("b/scenarios/x.toml", "b", "x"),
        ("b/elsewhere/x.toml", "b", "x"),
        ("nowhere/x.toml", "nowhere", "x"),
    ],
)
def test_a_scenario_belongs_to_the_bench_above_it(tmp_path, path, bench, name):
    (tmp_path / "b" / "scenarios").mkdir(parents=True)
    assert bench_of(tmp_path / path) == tmp_path / bench
    assert name_of(tmp_path / path) == name


def test_a_file_is_looked_for_beside_the_file_that_names_it(bench):
    elsewhere = bench.folder / "scenarios" / "shared"
    elsewhere.mkdir()
    for name in ("crane.controller.toml", "crane_completed.fcl"):
        (bench.folder / "scenarios" / "crane" / name).rename(elsewhere / name)
    bench.edit("transfer.toml", ('"crane.controller.toml"', '"../shared/crane.controller.toml"'))
    assert bench.read().base.rule_bases["controller.rules"].resolve() == elsewhere / "crane_completed.fcl"
    printed = bench.read(controller__blocks__rules__file="crane_printed.fcl")
    assert printed.base.rule_bases["controller.rules"].parent == Path("scenarios/crane")

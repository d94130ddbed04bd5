"""`runs`: of which runs a requirement is asked, and what a user reads after a slip in it."""

import pytest

from fcl_sim.judge.verdict import Over
from fcl_sim.scenario.asked_runs import asked_of
from fcl_sim.scenario.show import show_scenario
from fcl_sim.testbench import run
from tests.scenario.slips import RELATIVE

FIRST = """
max    = "35 s"
expect = { raw_distance = "fail" }
"""


def ask(bench, asked, expect='expect = { raw_distance = "fail" }'):
    bench.edit("transfer.toml", (FIRST, f'\nmax    = "35 s"\n{asked}\n{expect}\n'))


def ids(scenario, variant, *over):
    return [each.id for each in asked_of(scenario.requirements, variant, *over)]


def test_a_requirement_is_asked_of_the_runs_it_names_alone(bench):
    ask(bench, 'runs = ["base", "raw_distance"]')
    scenario = bench.read()
    asked = {name for name in scenario.variants if "CR-1" in ids(scenario, name)}
    assert asked == {"base", "raw_distance"}
    assert all("CR-2" in ids(scenario, name) for name in scenario.variants)


def test_a_run_that_is_not_asked_has_no_verdict_on_it(bench):
    ask(bench, 'runs = ["raw_distance"]')
    outcome = run(bench.folder / "scenarios/crane/transfer.toml")
    told = {name: [each.requirement.id for each in run.verdicts] for name, run in outcome.variants.items()}
    assert "CR-1" not in told["base"]
    assert told["raw_distance"] == ["CR-1", *told["base"]]


def test_neither_has_its_envelope(bench):
    ask(bench, 'runs = ["raw_distance"]')
    scenario = bench.read()
    over = (Over.BOTH, Over.POINTS)
    assert "CR-1" not in ids(scenario, "base", over)
    assert "CR-1" in ids(scenario, "raw_distance", over)


def test_a_miss_expected_of_all_is_expected_of_those_that_are_asked(bench):
    ask(bench, 'runs = ["raw_distance"]', 'expect = "fail"')
    first = bench.read().requirements[0]
    assert first.expect == {"raw_distance"}


def test_a_signal_that_only_the_asked_run_has_may_be_named(bench):
    bench.edit(
        "transfer.toml",
        ("[variants.raw_distance]\n", '[variants.raw_distance]\nblocks = { far = { type = "constant" } }\n'),
        ('signal = "crane.distance", final = "0 m", band', 'signal = "far", final = 0.0, band'),
        ('band = "0.5 m"', "band = 0.5"),
    )
    bench.edit("transfer.toml", ('type = "constant"', 'type = "constant", value = 0.0'))
    assert "no signal called `far`" in bench.fault()
    ask(bench, 'runs = ["raw_distance"]', "")
    run(bench.folder / "scenarios/crane/transfer.toml")


def test_it_is_shown_where_it_is_not_all(bench):
    assert "asked of" not in show_scenario(bench.read())
    ask(bench, 'runs = ["raw_distance", "base"]')
    told = show_scenario(bench.read())
    assert "\n    asked of: base, raw_distance\n    expected to fail: raw_distance\n" in told


def test_nothing_more_can_be_said_of_the_run_that_a_requirement_is_relative_to(bench):
    beside = 'relative_to = { variant = "base", as = "ratio" }\nmax = 2.0'
    bench.edit("transfer.toml", (FIRST, f'\n{beside}\nexpect = {{ base = "fail" }}\n'))
    told = bench.fault()
    assert "SCN406]: `expect` names the run `base`, to which this is relative" in told
    assert "leave it out: no run is held against itself" in told


LIST = 'runs = ["base", "light"]'
SLIPS = [
    ('runs = ["raw_distence"]', "", "SCN405]: there is no variant called `raw_distence`", "`raw_distance`?"),
    ("runs = []", "", "SCN203]: `runs` is empty, so that it would be asked of no run", LIST),
    ('runs = "base"', "", "SCN203]: `runs` is a list of runs, not a text", LIST),
    ("runs = [1]", "", "SCN203]: `runs` has a number among the names of runs", LIST),
    (
        'runs = ["base"]',
        'expect = { light_load = "fail" }',
        "SCN406]: `expect` names the run `light_load`, of which this is not asked",
        "name it in `runs`, too",
    ),
    (
        'runs = ["base"]',
        "at_least = { light_load = 1 }",
        "SCN406]: `at_least` names the run `light_load`, of which this is not asked",
        "name it in `runs`, too",
    ),
]


@pytest.mark.parametrize(("asked", "more", "message", "hint"), SLIPS)
def test_a_slip_is_told_where_it_stands_with_its_mend(bench, asked, more, message, hint):
    ask(bench, asked, more)
    told = bench.fault()
    assert message in told
    assert hint in told
    assert "transfer.toml:50:" in told or "transfer.toml:51:" in told


END = """light_load = "fail", double_scan = "fail" }
"""


def test_a_requirement_that_is_relative_to_the_one_run_it_names_is_asked_of_none(bench):
    bench.edit("transfer.toml", (END, f'{END}{RELATIVE}runs = ["light_load"]'))
    told = bench.fault()
    assert "SCN406]: CR-9 is asked of the run `light_load` alone and relative to it" in told
    assert "asked of no run" in told
    assert '| runs = ["light_load"]' in told
    assert "hint: name in `runs` what is held against it: base, raw_distance, frictionless" in told


def test_so_is_one_that_is_relative_to_the_only_run_there_is(written):
    told = written(ALONE)
    assert "SCN406]: S-1 is relative to `base`, the only run there is, so that it would be" in told
    assert 'relative_to = { variant = "base", as = "ratio" }' in told
    assert "hint: bound the metric itself, or add a variant" in told


def test_relative_to_one_of_the_runs_it_names_it_is_asked_of_the_others(bench):
    bench.edit("transfer.toml", (END, f'{END}{RELATIVE}runs = ["light_load", "base"]'))
    scenario = bench.read()
    assert {name for name in scenario.variants if "CR-9" in ids(scenario, name)} == {"base"}


ALONE = """
title = "One run"
duration = "1 s"
scan = "100 ms"
plant = { model = "transfer_function", numerator = [1.0], denominator = [1.0, 1.0], inputs = { u = 1.0 } }

[[require]]
id          = "S-1"
text        = "It settles about as fast as it does."
metric      = { peak = { signal = "y" } }
max         = 1.2
relative_to = { variant = "base", as = "ratio" }
"""

"""Formulae in a scenario: read, shown, put into the units of the run, and faulted where they stand."""

import math

import numpy as np
import pytest

from fcl_sim import testbench
from fcl_sim.loop.trace import Trace
from fcl_sim.scenario.show import show_scenario
from fcl_sim.testbench import prepare

PEAK = """\
metric = { peak = { signal = "crane.sway" } }
max    = "9 deg"
"""


def with_formula(bench, text):
    bench.edit("transfer.toml", (PEAK, text))


def fault(bench, text):
    with_formula(bench, text)
    return bench.fault()


def test_a_formula_is_a_requirement_in_the_units_of_the_run(bench):
    with_formula(bench, 'formula = "always abs(crane.sway) < 0.15 rad"\n')
    for each in prepare(bench.read()):
        requirement = each.requirements[3]
        assert (requirement.id, requirement.metric, requirement.unit) == ("CR-4", "", "deg")
        assert requirement.signals == ("crane.sway",)
        assert str(requirement.formula) == "always (abs(crane.sway) < 0.15 rad)"
        assert requirement.expect_fail == (each.variant == "raw_distance")


def test_a_sentence_is_shown_as_the_formula_that_it_stands_for(bench):
    with_formula(bench, 'formula = "never abs(crane.sway) > 9 deg"\n')
    assert "  CR-4: always (not (abs(crane.sway) > 9 deg))\n" in show_scenario(bench.read())


FAULTS = {
    "a signal that does not exist": (
        'formula = "always abs(crane.swey) < 9 deg"\n',
        """\
scenarios/crane/transfer.toml:69:23: error[JDG202]: there is no signal called `crane.swey`
  69 | formula = "always abs(crane.swey) < 9 deg"
     |                       ^^^^^^^^^^
  hint: did you mean `crane.sway`?""",
    ),
    "a unit that does not fit, behind a line that is folded and an escape": (
        'formula = """\nwhenever crane.distance < 2 m, \\\n   then crane.sway < 3 \\u006D"""\n',
        """\
scenarios/crane/transfer.toml:71:22: error[JDG203]: `crane.sway` is in deg, and `3 m` is in m
  71 |    then crane.sway < 3 \\u006D\"\"\"
     |                      ^^^
  hint: write it in deg, or in a unit that converts to it""",
    ),
    "a time without a unit": (
        "formula = 'always[0, 5 s] crane.sway < 3 deg'\n",
        """\
scenarios/crane/transfer.toml:69:19: error[JDG205]: 0 is not a time
  69 | formula = 'always[0, 5 s] crane.sway < 3 deg'
     |                   ^
  hint: write `0 s`""",
    ),
    "a metric beside a formula": (
        'formula = "crane.sway < 9 deg"\n' + PEAK,
        """\
scenarios/crane/transfer.toml:70:1: error[SCN408]: a requirement with a `formula` has no `metric`
  70 | metric = { peak = { signal = "crane.sway" } }
     | ^^^^^^
  hint: a second requirement can have it
scenarios/crane/transfer.toml:71:1: error[SCN408]: a requirement with a `formula` has no `max`
  71 | max    = "9 deg"
     | ^^^
  hint: the formula says its bounds itself""",
    ),
    "neither": (
        "",
        """\
scenarios/crane/transfer.toml:66:3: error[SCN408]: the requirement asks nothing: it has no `metric`
  66 | [[require]]
     |   ^^^^^^^
  hint: write metric = { NAME = { signal = ... } } with min or max, or formula = "...\"""",
    ),
    "no limit for a metric that needs one of two": (
        'metric = { saturation_time = { signal = "crane.sway" } }\nmax = "9 s"\n',
        """\
scenarios/crane/transfer.toml:69:12: error[SCN402]: `saturation_time` needs `low` or `high`, or both
  69 | metric = { saturation_time = { signal = "crane.sway" } }
     |            ^^^^^^^^^^^^^^^""",
    ),
    "restarts that are no list": (
        'metric = { peak = { signal = "crane.sway", restart_at = "5 s" } }\nmax = "9 deg"\n',
        """\
scenarios/crane/transfer.toml:69:57: error[SCN402]: `restart_at` is a list of times
  69 | metric = { peak = { signal = "crane.sway", restart_at = "5 s" } }
     |                                                         ^^^^^
  hint: write it as in restart_at = ["20 s", "40 s"]""",
    ),
    "restarts in disorder": (
        'metric = { peak = { signal = "crane.sway", restart_at = ["5 s", "2 s"] } }\nmax = "9 deg"\n',
        """\
scenarios/crane/transfer.toml:69:57: error[SCN406]: the restarts of CR-4 do not part its window
  69 | metric = { peak = { signal = "crane.sway", restart_at = ["5 s", "2 s"] } }
     |                                                         ^^^^^^^^^^^^^^
  hint: each time comes after the one before it, the first after `from`, the last before `to`""",
    ),
}


@pytest.mark.parametrize("name", FAULTS)
def test_a_slip_is_shown_where_it_stands_in_the_scenario(bench, name):
    text, expected = FAULTS[name]
    assert fault(bench, text) == expected


def test_restarts_reach_the_requirement_in_seconds(bench):
    with_formula(
        bench,
        'metric = { iae = { signal = "crane.sway", final = "0 deg", from = "1 s", '
        'restart_at = ["20 s", "0.5 min"] } }\nmax = "90 deg s"\n',
    )
    requirement = prepare(bench.read())[0].requirements[3]
    assert requirement.restart_at == (20.0, 30.0)
    assert requirement.arguments == {"final": 0.0, "from": 1.0}
    assert "restart_at = [20 s, 0.5 min]" in show_scenario(bench.read())


def test_several_faults_of_a_formula_are_told_at_once(bench):
    told = fault(bench, 'formula = "always crane.swey < 1 deg and crane.sway < 1 m"\n')
    assert [told.count(code) for code in ("JDG202", "JDG203")] == [1, 1]


RELATIVE = """\
metric      = { peak = { signal = "crane.sway" } }
relative_to = { variant = "base", as = "ratio" }
max         = 2.5
"""


def test_a_requirement_beside_another_run_is_none_on_that_run(bench):
    with_formula(bench, RELATIVE)
    found = {each.variant: [one.id for one in each.requirements] for each in prepare(bench.read())}
    assert "CR-4" not in found.pop("base")
    assert all("CR-4" in ids for ids in found.values())
    assert "CR-4: peak(crane.sway) as a ratio to base at most 2.5\n" in show_scenario(bench.read())


def test_a_ratio_has_no_unit_and_a_difference_that_of_the_metric(bench):
    with_formula(bench, RELATIVE)
    ratio = prepare(bench.read())[1].requirements[3]
    assert (ratio.unit, ratio.maximum, ratio.relative_to.variant) == ("", 2.5, "base")
    bench.edit("transfer.toml", ('as = "ratio"', 'as = "difference"'), ("= 2.5", '= "0.1 rad"'))
    difference = prepare(bench.read())[1].requirements[3]
    assert (difference.unit, difference.maximum) == ("deg", pytest.approx(5.72957795))


@pytest.mark.parametrize(
    ("edit", "told"),
    [
        (('"base"', '"raw_distanz"'), "error[SCN405]: there is no variant called `raw_distanz`"),
        (('"ratio"', '"quotient"'), "error[SCN203]: `as` cannot be `quotient`"),
        ((', as = "ratio"', ""), "error[SCN202]: `relative_to` has no `as`"),
        (("2.5", '"2.5 deg"'), "is a plain number, and this is in deg"),
    ],
)
def test_a_slip_in_a_comparison_is_told(bench, edit, told):
    with_formula(bench, RELATIVE.replace(*edit))
    assert told in bench.fault()


def test_every_other_run_is_held_against_the_named_one(bench, monkeypatch):
    with_formula(bench, RELATIVE)
    swings = iter([2.0, 4.0, 6.0, 1.0, 5.0, 2.0])

    def simulated(_diagram, _halt):
        ticks = np.arange(0, 61 * 10**9, 10**9)
        sway = np.full(61, next(swings))
        return Trace(
            ticks=ticks,
            names=("crane.distance", "crane.sway"),
            units={"crane.distance": "m", "crane.sway": "deg"},
            values=np.column_stack([np.linspace(25.0, 0.0, 61), sway]),
        )

    monkeypatch.setattr("fcl_sim.testbench.running.simulate", simulated)
    outcome = testbench.run_scenario(bench.read())
    assert [run.metrics.get("CR-4") for run in outcome.variants.values()] == [None, 2.0, 3.0, 0.5, 2.5, 1.0]


CORRIDOR = 'corridor = { signal = "crane.sway", file = "corridor.csv" }\n'
TABLE = "time [s],low [deg],high [rad]\n0,-9,0.5\n60,,0.25\n"


def with_corridor(bench, table, text=CORRIDOR):
    (bench.folder / "scenarios/crane/corridor.csv").write_text(table, "utf-8")
    with_formula(bench, text)


def test_a_corridor_is_read_from_its_table_in_the_unit_of_the_signal(bench):
    with_corridor(bench, TABLE)
    scenario = bench.read()
    asked = prepare(scenario)[0].requirements[3]
    assert (asked.unit, asked.signals, asked.corridor.ticks) == ("deg", ("crane.sway",), (0, 60_000_000_000))
    assert asked.corridor.low == pytest.approx((-9.0, math.nan), nan_ok=True)
    assert asked.corridor.high == pytest.approx((math.degrees(0.5), math.degrees(0.25)))
    assert "  CR-4: crane.sway stays within corridor.csv\n" in show_scenario(scenario)
    assert [each.name for each in scenario.files if each.role == "corridor"] == [
        "scenarios/crane/corridor.csv"
    ]


@pytest.mark.parametrize(
    ("table", "text", "told"),
    [
        ("time [s],lower [deg]\n0,1\n", CORRIDOR, "corridor.csv` has a column `lower`"),
        ("time [s],low [deg]\n", CORRIDOR, "corridor.csv` has no rows, or no edges"),
        ("time [s],low [deg]\n0,x\n", CORRIDOR, "corridor.csv:2:1: error[JDG303]: `x` is no number"),
        ("time [s],low [m]\n0,1\n", CORRIDOR, "`crane.sway` is in deg, and `low` of its corridor is in m"),
        (TABLE, CORRIDOR.replace("sway", "swey"), "there is no signal called `crane.swey`"),
        (TABLE, CORRIDOR.replace("corridor.csv", "coridor.csv"), "did you mean `corridor.csv`?"),
        (TABLE, CORRIDOR + 'max = "3 deg"\n', "error[SCN408]: a requirement with a `corridor` has no `max`"),
        (TABLE, CORRIDOR.replace(', file = "corridor.csv"', ""), "error[SCN202]: `corridor` has no `file`"),
    ],
)
def test_a_slip_in_a_corridor_is_told(bench, table, text, told):
    with_corridor(bench, table, text)
    assert told in bench.fault()

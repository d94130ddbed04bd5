"""What has not the shape of a scenario, or is no TOML at all, is named where it stands."""

import re
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fcl_sim.diagnostics import InputFault
from fcl_sim.loop.blocks import BLOCKS
from fcl_sim.plant.catalog import shipped_bench
from fcl_sim.scenario.reader import read
from fcl_sim.scenario.shape import OTHER_NAMES
from fcl_sim.testbench import prepare

FOLDER = Path("scenarios/crane")

MISSHAPEN = [
    (
        "",
        (
            "scenarios/own.toml: error[SCN202]: the scenario has no `title`\n"
            "  hint: `title` is one line for tables"
        ),
    ),
    (
        "plant = 3",
        "`plant` is a table, not a number\n  1 | plant = 3\n    |         ^\n  hint: write [plant], or",
    ),
    ("title = 5", "`title` is a text, not a number"),
    ('title = " "', "`title` is empty"),
    ("[require]", "`require` is a list, not a table"),
    ("[variants.'a b']", "`a b` is not a name"),
    ("[plant]\nmodel = 'crane'\ninputs = { power = 3 }", "`power` is the name of a signal, not a number"),
    (
        "[plant]\nmodel = 'crane'\ninputs = { power = 'a b c.' }",
        "`power`: `a b c.` is not the name of a signal",
    ),
    ("[timing]\nseed = 'x'", "`seed` is a whole number, not a text"),
    ("[timing]\nseed = -1", "`seed` must lie between 0 and 2^63 - 1"),
    ("[timing]\nlatency = '-1 s'", "`latency` is negative: -1 s"),
    ("[timing]\nlatency = true", "`latency` is a time, not true or false"),
    ("[timing]\ncycle_time = 'mesured'", "`cycle_time` cannot be `mesured`"),
    ("[integration]\nrtol = 0", "`rtol` must be greater than 0 and finite, not 0"),
    ("[integration]\nrtol = '1e-8'", "`rtol` is a number, not a text"),
    ("[integration]\nscheme = 'rk45'", "`scheme` cannot be `rk45`"),
    ("[integration]\nstep = '0 s'", "`step` must be greater than 0"),
    ("duration = '1 m'", "`duration`: 1 m is not a time"),
    ("duration = 1979-05-27", "`duration` is a time, not a date or time"),
    ("[[require]]\nid = 'A'\nmetric = { peak = 3 }", "`peak` is a table, not a number"),
    ("[[require]]\nid = 'A'\nmetric = { peak = {}, mean = {} }", "`metric` names 2 metrics instead of one"),
    ("[[require]]\nid = 'A'\nmin = true", "`min` is a quantity, not true or false"),
    ("[[require]]\nid = 'A'\nmin = '1 furlong'", "`min`: there is no unit `furlong`"),
    ("[[require]]\ntext = 'A'", "`require` 1 has no `id`"),
    ("[[require]]\nid = 'A'\nrelative_to = 'x'", "`relative_to` is a table, not a text"),
    ("require = [3]", "an entry of `require` is a table, not a number"),
    ("[blocks.gain]\ntype = 'gain'\ninput = 'x'", "`gain` has no `gain`"),
    ("[blocks.x]\ninput = 'x'", "`x` has no `type`"),
]


@pytest.mark.parametrize(("text", "message"), MISSHAPEN)
def test_what_has_not_its_shape_is_named(written, text, message):
    assert message in written(text)


NO_TOML = [
    ("title = 'x", "not TOML"),
    ("title = x", 'hint: texts are written in quotes, as in title = "Crane"'),
    ("title = 'x'\ntitle = 'y'\n", "not TOML: a key or table is given twice\n  2 | title = 'y'"),
    ("[plant]\n[plant]", "not TOML: a key or table is given twice\n  2 | [plant]"),
    ("plant = { model = 'crane', }", "hint: TOML allows no comma before }"),
    ("x = " + "[" * 5000, "not TOML: arrays or tables are nested too deeply"),
    ("x = " + "9" * 5000, "not TOML: "),
    ("x = '\0'", "not TOML: "),
]


@pytest.mark.parametrize(("text", "message"), NO_TOML, ids=range(len(NO_TOML)))
def test_what_is_no_toml_is_told_with_its_line(written, text, message):
    assert message in written(text)


PIECES = [
    *["{", "}", "[", "]", "[[", "=", '"', "'", '"""', "#", "\n", ".", ",", "3", "-1", "nan", "inf", "true"],
    *['"20 t"', '"x"', '""', '"-"', '"a.b.c"', "{ a = 1 }", "[1, 2]", "{}", "[]", "1979-05-27", '"1e300 t"'],
    *[
        '"99999999999 h"',
        '"1 ns"',
        '"controller.power"',
        "base",
        "type",
        "plant",
        '"fail"',
        "\0",
        "\u00e9",
        "\r\n",
    ],
]


@given(st.sampled_from(["transfer.toml", "crane.controller.toml"]), st.data())
@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_no_text_makes_the_reader_stumble(bench, name, data):
    file = FOLDER / name
    text = (shipped_bench() / file).read_text("utf-8")
    words = [each.span() for each in re.finditer(r'"[^"\n]*"|\w+|[^\w\s]|\n', text)]
    start, end = data.draw(st.sampled_from(words))
    file.write_text(text[:start] + data.draw(st.sampled_from(["", *PIECES])) + text[end:], "utf-8")
    told = ""
    try:
        prepare(read(FOLDER / "transfer.toml"))
    except InputFault as fault:
        told = str(fault)
    file.write_text(text, "utf-8")
    assert told == "" or "error[" in told


@pytest.mark.parametrize(
    ("other", "name"),
    [
        ("derivative", "differentiator"),
        ("delay", "dead_time"),
        ("pt1", "first_order_lag"),
        ("Low_Pass", "first_order_lag"),
        ("saturation", "limiter"),
        ("value", "constant"),
    ],
)
def test_a_kind_of_block_by_another_name_is_met_with_ours(written, other, name):
    assert (
        f"there is no kind of block called `{other}`\n"
        f"  2 | type = '{other}'\n"
        f"    |        {'^' * (len(other) + 2)}\n"
        f"  hint: did you mean `{name}`?"
    ) in written(f"[blocks.x]\ntype = '{other}'")


def test_every_other_name_leads_to_a_kind_of_block_and_is_none():
    assert set(OTHER_NAMES.values()) <= set(BLOCKS)
    assert not set(OTHER_NAMES) & set(BLOCKS)

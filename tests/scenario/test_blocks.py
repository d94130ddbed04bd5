"""Blocks in a scenario: each kind of input and parameter, and what is wrong with one, where it stands."""

from pathlib import Path

import pytest

from fcl_sim.diagnostics import Source
from fcl_sim.loop.blocks.declaration import BlockParameter, BlockType
from fcl_sim.loop.diagram import Wire
from fcl_sim.scenario import blocks
from fcl_sim.scenario.binder import bind, wire_of
from fcl_sim.scenario.reader import read
from fcl_sim.scenario.schema import block_model
from fcl_sim.scenario.shape import shape_faults
from fcl_sim.toml import parse
from fcl_sim.units import parse_quantity

HEAD = """\
title = "Blocks"
duration = "2 s"
scan = "50 ms"
[plant]
model = "crane"
inputs = { power = "limited" }
[blocks]
own = { type = "python", file = "own.py", inputs = { d = "crane.distance" }, outputs = { power = "kW" } }
start = { type = "step", after = "1", at = "0.5 s" }
driven = { type = "product", inputs = ["own.power", "-start"] }
limited = { type = "limiter", input = "driven", low = "-5 W", high = "top" }
top = { type = "constant", value = "8 kW" }
"""
OWN = "def step(inputs, state, t):\n    return -10.0 if inputs['d'] > 1.0 else 0.0\n"


@pytest.fixture
def scenario(tmp_path, monkeypatch):
    (tmp_path / "scenarios").mkdir(exist_ok=True)
    (tmp_path / "scenarios" / "own.py").write_text(OWN, "utf-8")
    monkeypatch.chdir(tmp_path)

    def write(text):
        file = tmp_path / "scenarios" / "own.toml"
        file.write_text(text, "utf-8")
        return read("scenarios/own.toml")

    return write


def test_every_kind_of_input_and_parameter_is_bound(scenario):
    read_in = scenario(HEAD)
    own, start, driven, limited, top = bind(read_in).nodes
    assert own.inputs == {"d": Wire("crane.distance")}
    assert own.parameters["outputs"] == {"power": "kW"}
    assert str(own.parameters["file"]) == "scenarios/own.py"
    assert start.parameters == {"after": parse_quantity("1"), "at": parse_quantity("0.5 s")}
    assert driven.inputs == {"1": Wire("own.power"), "2": Wire("start", -1.0)}
    assert limited.inputs == {"input": Wire("driven"), "high": Wire("top")}
    assert limited.parameters == {"low": parse_quantity("-5 W")}
    assert top.parameters == {"value": parse_quantity("8 kW")}
    assert "scenarios/own.py" in read_in.digests


SLIPS = [
    ('low = "-5 W"', 'lo = "-5 W"', "SCN201", "`limited` has no key `lo`", "did you mean `low`?"),
    (
        'low = "-5 W"',
        'low = "-5 m"',
        "WIR201",
        "`low` of `limited`: -5 m does not convert to kW",
        "lower bound",
    ),
    ('low = "-5 W"', "low = -5", "WIR201", "`low` of `limited`: -5 does not convert to kW", "write it in kW"),
    (', value = "8 kW"', "", "SCN202", "`top` has no `value`", "the constant, with its unit"),
    (
        'inputs = ["own.power", "-start"]',
        'inputs = "own.power"',
        "SCN203",
        "`inputs` is a list, not a text",
        "[ ... ]",
    ),
    (
        'inputs = ["own.power", "-start"]',
        "inputs = [3]",
        "SCN203",
        "an entry of `inputs` is the name",
        "in quotes",
    ),
    (
        'inputs = ["own.power", "-start"]',
        'inputs = ["start"]',
        "WIR103",
        "`driven` has fewer than 2",
        "factors",
    ),
    ('"-start"', '"strat"', "WIR102", "there is no signal called `strat`", "did you mean `start`?"),
    ('at = "0.5 s"', 'at = "0.5 m"', "SCN404", "`at` is in s, and this is in m", "write it in s"),
    (
        'file = "own.py"',
        'file = "onw.py"',
        "SCN101",
        "there is no file `scenarios/onw.py`",
        "did you mean `own.py`?",
    ),
    ('outputs = { power = "kW" }', 'outputs = { power = "kWW" }', "SCN204", "there is no unit `kWW`", "kW"),
    (
        "outputs =",
        'function = "stop", outputs =',
        "WIR202",
        "has no function `stop`",
        "def stop(inputs, state, t)",
    ),
    (
        "outputs =",
        'late = "no", outputs =',
        "SCN203",
        "`late` is true or false, not a text",
        "without quotes",
    ),
]


@pytest.mark.parametrize("slip", SLIPS, ids=lambda slip: slip[1])
@pytest.mark.usefixtures("scenario")
def test_a_slip_in_a_block_is_told_with_its_place_and_mend(written, slip):
    before, after, code, message, hint = slip
    text = HEAD.replace(before, after, 1)
    assert text != HEAD
    told = written(text)
    assert "scenarios/own.toml:" in told
    assert f"error[{code}]" in told
    assert message in told
    assert hint in told.partition("hint:")[2]
    assert "^" in told


@pytest.mark.usefixtures("scenario")
def test_a_choice_is_one_of_its_words(written):
    block = 'way = { type = "integrator", method = "forwards", input = "crane.speed" }\n'
    told = written(HEAD + block)
    assert "`method` cannot be `forwards`" in told
    assert "did you mean `forward`?" in told


TRIAL = BlockType(
    name="trial",
    summary="lists, tables, counts",
    equation="none",
    source="none",
    kernel=None,
    parameters=(
        BlockParameter(name="scans", kind="count", default=3, meaning="scans"),
        BlockParameter(name="levels", kind="list", unit="m", default=(), meaning="levels"),
        BlockParameter(name="curve", kind="table", columns=("s", None), meaning="a curve"),
        BlockParameter(name="kp", unit="", default=1.0, port=True, meaning="a gain"),
        BlockParameter(name="ranges", kind="rows", columns=("m", None), default=(), meaning="ranges"),
        BlockParameter(name="marks", kind="rows", unit="m", default=(), meaning="marks"),
    ),
)


@pytest.fixture
def trial(monkeypatch):
    monkeypatch.setattr(blocks, "BLOCKS", {"trial": TRIAL})

    def read_block(text):
        entry = parse(Source("own.toml", f'type = "trial"\n{text}\n'), not_toml="SCN102", twice="SCN103")
        faults = shape_faults(block_model(TRIAL), entry, "`trial`")
        node = None if faults else blocks.plain_node("trial", entry, {}, wire_of, faults)
        return node, [f"{each.code} {each.message}" for each in faults]

    return read_block


def test_lists_tables_counts_and_parameters_that_are_signals_are_read(trial):
    node, faults = trial(
        'scans = 4\nlevels = ["1 m", "2 cm"]\ncurve = [["0 s", 1], ["1 min", "2"]]\nkp = "-x.kp"'
    )
    assert faults == []
    assert node.inputs == {"kp": Wire("x.kp", -1.0)}
    assert node.parameters["scans"] == 4
    assert node.parameters["levels"] == (parse_quantity("1 m"), parse_quantity("2 cm"))
    assert node.parameters["curve"][1] == (parse_quantity("1 min"), parse_quantity(2.0))
    assert trial('curve = []\nkp = "2.5"')[0].parameters["kp"] == parse_quantity(2.5)


@pytest.mark.usefixtures("scenario")
def test_a_slip_in_a_formula_is_shown_in_the_scenario(written):
    told = written(
        HEAD + 'f = { type = "expression", formula = "d + \\u0032 s", inputs = { d = "crane.distance" } }\n'
    )
    assert "error[WIR203]: `f`: `d` is in m, and `2 s` is in s" in told
    assert "hint: write it in m" in told
    line = next(each for each in told.splitlines() if "formula =" in each)
    carets = told.splitlines()[told.splitlines().index(line) + 1]
    assert line[carets.index("^") : carets.rindex("^") + 1] == "\\u0032 s"


@pytest.mark.usefixtures("scenario")
def test_a_table_is_read_beside_the_scenario_and_its_slips_are_shown_there(scenario, written):
    row = 'r = { type = "table", file = "r.csv" }\n'
    Path("scenarios/r.csv").write_text("time [s];x [m]\n0;1,5\n1;2\n", "utf-8")
    assert "scenarios/r.csv" in scenario(HEAD + row).digests
    Path("scenarios/r.csv").write_text("time [s];x [m]\n0;1,5\n1;two\n", "utf-8")
    told = written(HEAD + row)
    assert "error[WIR204]: `r`: `two` is not a number" in told
    assert "scenarios/r.csv:3:3" in told


def test_rows_are_read_by_name_with_columns_or_of_any_length(trial):
    node, faults = trial('curve = []\nranges = { a = ["1 cm", "2 kW"] }\nmarks = { b = [], c = ["1 m", 0] }')
    assert faults == ["SCN404 `marks` is in m, and this has no unit"]
    assert node.parameters["ranges"] == {"a": (parse_quantity("1 cm"), parse_quantity("2 kW"))}
    assert node.parameters["marks"]["b"] == ()


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("scans = 1.5\ncurve = []", "SCN203 `scans` is a whole number, not a number"),
        ('levels = "1 m"\ncurve = []', "SCN203 `levels` is a list, not a text"),
        ('levels = ["1 s"]\ncurve = []', "SCN404 `levels` is in m, and this is in s"),
        ("levels = [true]\ncurve = []", "SCN203 an entry of `levels` is a quantity, not true or false"),
        ('curve = [["0 s"]]', "SCN203 a row of `curve` has 2 numbers, not 1"),
        ("curve = [3]", "SCN203 an entry of `curve` is a list, not a number"),
        ('curve = [["0 m", 1]]', "SCN404 `curve` is in s, and this is in m"),
        ('curve = []\nranges = { a = ["1 m"] }', "SCN203 a row of `ranges` has 2 numbers, not 1"),
        ("curve = []\nranges = { a = 1 }", "SCN203 `a` is a list, not a number"),
        ('curve = []\nkp = "2 furlong"', "SCN204 `kp`: there is no unit `furlong`"),
    ],
)
def test_lists_tables_and_counts_that_do_not_fit_are_told(trial, text, told):
    assert trial(text)[1] == [told]

import json
import math
import subprocess
import sys

import numpy as np
import pytest

from tests.house.places import ROOT

CRANE = ROOT / "scenarios" / "crane" / "crane_printed.fcl"

FIGURE_C8 = """\
FUNCTION_BLOCK three
VAR_INPUT distance: REAL; angle: REAL; END_VAR
VAR_OUTPUT power: REAL; END_VAR
FUZZIFY distance TERM medium := (5, 0) (10, 1) (22, 0); TERM far := (10, 0) (22, 1); END_FUZZIFY
FUZZIFY angle TERM zero := (-5, 0) (0, 1) (5, 0); TERM pos_small := (0, 0) (5, 1) (50, 0); END_FUZZIFY
DEFUZZIFY power TERM zero := 0; TERM pos_medium := 9; METHOD: CoGS; DEFAULT := 0; END_DEFUZZIFY
RULEBLOCK No1
    AND: MIN; ACCU: MAX;
    RULE 1: IF distance IS medium AND angle IS pos_small THEN power IS pos_medium;
    RULE 2: IF distance IS medium AND angle IS zero THEN power IS zero;
    RULE 3: IF distance IS far AND angle IS zero THEN power IS pos_medium;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""


@pytest.fixture
def three(tmp_path):
    file = tmp_path / "three.fcl"
    file.write_text(FIGURE_C8)
    return file


def test_the_three_rules_of_figure_c8_give_7_2_exactly(invoke, three):
    result = invoke("eval", three, "distance=12", "angle=4")
    assert (result.exit_code, result.stdout, result.stderr) == (0, "power = 7.2\n", "")


def test_every_step_is_shown_on_request(invoke):
    result = invoke("eval", CRANE, "distance=12", "angle=4", "--explain")
    lines = [line.strip() for line in result.stdout.splitlines()]
    for shown in ("medium   0.8333", "far      0.1667", "zero       0.2", "pos_small  0.8"):
        assert shown in lines


def test_json_has_every_digit_and_every_rule(invoke, three):
    document = json.loads(invoke("eval", three, "distance=12", "angle=4", "--json").stdout)
    assert document == {
        "schema": 1,
        "block": "three",
        "arithmetic": "LREAL",
        "inputs": {"distance": 12.0, "angle": 4.0},
        "outputs": {"power": 7.2},
        "active": {"power": True},
        "degrees": {"1": 0.8, "2": 0.2, "3": 1 / 6},
    }
    whole = json.loads(invoke("eval", three, "distance=12", "angle=4", "--json", "--explain").stdout)
    assert whole["explanation"]["defuzzified"][0]["value"] == 7.2


def test_in_real_every_number_is_one_of_binary32(invoke, three):
    asked = ("eval", three, "distance=12.1", "angle=4", "--arithmetic", "REAL", "--json")
    document = json.loads(invoke(*asked, "--explain").stdout)
    assert document["arithmetic"] == "REAL"
    for number in (*document["outputs"].values(), *document["degrees"].values()):
        assert number == float(np.float32(number))
    told = document["explanation"]["fuzzified"][0]
    assert told["value"] == float(np.float32(12.1))


def test_in_int_numbers_are_counts(invoke, three):
    asked = ("eval", three, "distance=12", "angle=4", "--arithmetic", "INT")
    assert invoke(*asked).stdout == "power = 7\n"
    assert json.loads(invoke(*asked, "--json").stdout) == {
        "schema": 1,
        "block": "three",
        "arithmetic": "INT",
        "inputs": {"distance": 12.0, "angle": 4.0},
        "outputs": {"power": 7},
    }
    result = invoke(*asked, "--explain")
    assert (result.exit_code, result.stdout) == (2, "")
    assert "--explain and --figure are for LREAL and REAL" in result.stderr


def test_an_output_without_an_active_rule_says_where_its_value_comes_from(invoke):
    result = invoke("eval", CRANE, "distance=-10", "angle=0")
    assert result.stdout == "power = 0  (no rule is active: DEFAULT)\n"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["distance=12"], "three needs a value for angle"),
        (["distance=12", "angel=4"], "no input angel; did you mean angle?"),
        (["distance=12", "angle=nan"], "angle is nan"),
        (["distance", "angle=4"], "'distance' is not NAME=NUMBER"),
        (
            ["distance=1,5", "angle=4"],
            "'1,5' for 'distance' is not a number: the decimal separator is a point",
        ),
        (["distance=far", "angle=4"], "'far' for 'distance' is not a number"),
        (["angle=1", "angle=2"], "'angle' is given twice"),
    ],
)
def test_inputs_that_do_not_fit_are_wrong_usage(invoke, three, arguments, message):
    result = invoke("eval", three, *arguments)
    assert result.exit_code == 2
    assert result.stderr.endswith(f"\nError: {message}\n")


def test_figure_c16_as_printed_is_refused_at_the_guilty_word(invoke, tmp_path):
    file = tmp_path / "printed.fcl"
    corrected = CRANE.read_text("utf-8")
    line = next(each for each in corrected.splitlines() if "RULE 2" in each and "THEN" in each)
    file.write_text(corrected.replace(line, line.replace("pos_high", "pos_big")))
    number = corrected.splitlines().index(line) + 1
    result = invoke("eval", file, "distance=12", "angle=4")
    assert result.exit_code == 3
    first, excerpt, caret, *rest = result.stderr.splitlines()
    assert first.startswith(f"{file}:{number}:{line.index('pos_high') + 1}: error[FCL310]: ")
    assert caret.index("^^^^^^^") == excerpt.index("pos_big")
    assert any("pos_high" in each for each in rest if "hint" in each)


def test_a_missing_file_is_one_line_with_the_nearest_name(invoke, three):
    missing = three.with_name("tree.fcl")
    result = invoke("eval", missing, "distance=12")
    assert result.exit_code == 3
    assert result.stderr == (
        f"{missing}: error[FCL101]: there is no such file\n  hint: did you mean `{three}`?\n"
    )


def test_one_block_of_several_is_chosen_by_name(invoke, three):
    three.write_text(FIGURE_C8 + FIGURE_C8.replace("three", "other").replace(":= 9;", ":= 18;"))
    result = invoke("eval", three, "distance=12", "angle=4", "--block", "other")
    assert result.stdout == "power = 14.4\n"
    assert invoke("eval", three, "distance=12", "angle=4").exit_code == 3


def test_numbers_are_printed_with_the_digits_that_tell_them_apart(invoke, three):
    value = float(invoke("eval", three, "distance=12.3", "angle=4.1").stdout.removeprefix("power = "))
    degrees = json.loads(invoke("eval", three, "distance=12.3", "angle=4.1", "--json").stdout)
    assert value == degrees["outputs"]["power"]
    assert not math.isnan(value)


@pytest.mark.parametrize(
    ("ending", "beginning"), [("png", b"\x89PNG\r\n"), ("svg", b"<svg"), ("pdf", b"%PDF-")]
)
def test_the_steps_are_drawn_into_one_file_the_same_again(invoke, three, ending, beginning):
    target = three.with_name(f"steps.{ending}")
    result = invoke("eval", three, "distance=12", "angle=4", "--figure", target)
    assert (result.exit_code, result.stdout, result.stderr) == (0, "power = 7.2\n", f"written: {target}\n")
    first = target.read_bytes()
    assert first.startswith(beginning)
    assert invoke("eval", three, "distance=12", "angle=4", "--figure", target).exit_code == 0
    assert target.read_bytes() == first
    assert sorted(file.name for file in three.parent.iterdir()) == [target.name, three.name]


def test_a_figure_leaves_the_json_document_alone(invoke, three):
    target = three.with_name("steps.svg")
    result = invoke("eval", three, "distance=12", "angle=4", "--json", "--figure", target)
    assert json.loads(result.stdout)["outputs"] == {"power": 7.2}
    assert result.stderr == f"written: {target}\n"
    assert target.is_file()


@pytest.mark.parametrize(
    ("name", "message", "hint"),
    [
        (
            "steps.gif",
            "error[RUN106]: a picture is not written as `.gif`",
            "end the name in .png, .svg or .pdf",
        ),
        (
            "nowhere/steps.png",
            "error[RUN101]: there is no folder `{folder}/nowhere`",
            "make the folder, or name another one",
        ),
    ],
)
def test_a_figure_that_cannot_be_written_is_said_before_anything_else(invoke, three, name, message, hint):
    result = invoke("eval", three, "distance=12", "angle=4", "--figure", three.parent / name)
    assert (result.exit_code, result.stdout) == (3, "")
    told = message.format(folder=three.parent)
    assert result.stderr == f"{three.parent / name}: {told}\n  hint: {hint}\n"
    assert [file.name for file in three.parent.iterdir()] == [three.name]


def test_an_evaluation_without_a_figure_loads_nothing_that_draws(three):
    code = (
        "import sys; from fcl_sim.cli.program import program; "
        f"program(['eval', {str(three)!r}, 'distance=12', 'angle=4'], standalone_mode=False); "
        "assert not {'matplotlib', 'typst'} & set(sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=False).returncode == 0


def test_exactly_a_ridge_is_seen_where_no_rule_is_active(invoke):
    result = invoke("eval", CRANE, "--exact", "--explain", "distance=5", "angle=-45")
    assert result.stdout == (
        "distance = 5: close 1\n"
        "angle = -45: neg_big 8/9 (0.888889), neg_small 1/9 (0.111111)\n"
        "no rule fires\n"
        "power = 0  (no rule is active: DEFAULT)\n"
    )


def test_exactly_numbers_are_fractions(invoke, three):
    assert invoke("eval", three, "--exact", "distance=12", "angle=4").stdout == "power = 7.2\n"
    assert invoke("eval", three, "--exact", "distance=37/3", "angle=4").stdout == "power = 7.2\n"
    document = json.loads(invoke("eval", three, "--exact", "--json", "distance=37/3", "angle=0.1").stdout)
    assert document["exact"] == {
        "inputs": {"distance": "37/3", "angle": "1/10"},
        "outputs": {"power": "7/4"},
        "degrees": {"1": "1/50", "2": "29/36", "3": "7/36"},
        "rounded": [],
    }
    assert document["outputs"] == {"power": 1.75}


def test_what_is_no_fraction_is_told(invoke, three):
    text = three.read_text().replace("(5, 0) (10, 1) (22, 0)", "GAUSS 10 4")
    three.write_text(text)
    told = invoke("eval", three, "--exact", "distance=10", "angle=0").stdout
    assert told.splitlines()[-1] == "rounded, since they are no fractions: `medium` of `distance`"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["distance=12", "angle=1/0"], "'1/0' for 'angle' is not a number"),
        (["distance=12", "angle=inf"], "'inf' for 'angle' is not a number"),
        (["distance=12", "angle=1e999"], "'1e999' for 'angle' is not a number"),
        (["distance=12"], "three needs a value for angle"),
        (["distance=12", "angel=4"], "no input angel; did you mean angle?"),
        (
            ["distance=12", "angle=4", "--arithmetic", "REAL"],
            "--exact goes without --arithmetic and --figure",
        ),
    ],
)
def test_exactly_what_cannot_be_meant_is_wrong_usage(invoke, three, arguments, message):
    result = invoke("eval", three, "--exact", *arguments)
    assert (result.exit_code, result.stderr.splitlines()[-1]) == (2, f"Error: {message}")


def test_an_area_that_is_not_straight_is_not_computed_in_fractions(invoke, three):
    text = three.read_text().replace("zero := 0;", "zero := (-5, 0) (0, 1) (5, 0);")
    text = text.replace("pos_medium := 9;", "pos_medium := (0, 0) (9, 1) (18, 0);")
    three.write_text(text.replace("METHOD: CoGS;", "METHOD: CoG; ACCU: ASUM; RANGE := (-5 .. 18);"))
    result = invoke("eval", three, "--exact", "distance=12", "angle=4")
    assert (result.exit_code, result.stderr.splitlines()[-1]) == (
        2,
        (
            "Error: three cannot be computed with --exact: "
            "ACCU ASUM makes areas that are not followed in fractions"
        ),
    )


def test_a_fraction_without_exact_says_what_it_is_for(invoke, three):
    result = invoke("eval", three, "distance=1/3", "angle=4")
    assert result.stderr.splitlines()[-1] == (
        "Error: '1/3' for 'distance' is not a number: fractions are for --exact"
    )

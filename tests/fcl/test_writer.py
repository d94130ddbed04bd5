"""The canonical form: what it looks like."""

import pytest

from fcl_sim import fcl
from fcl_sim.diagnostics import InputFault, Source
from fcl_sim.fcl.write_numbers import constant, number
from fcl_sim.model import (
    Curve,
    CurveKind,
    DataType,
    Defuzzification,
    FunctionBlock,
    Fuzzification,
    Method,
    Point,
    Points,
    Term,
    Variable,
)
from tests.fcl.texts import BATH, block, with_rule

DIALECT = """\
TYPE lamp: STRUCT red, green: REAL; END_STRUCT; END_TYPE
FUNCTION_BLOCK my-block
VAR_INPUT t: REAL; RANGE := (0 .. 10); l: lamp; u: INT (0..5) := 3; END_VAR
VAR_OUTPUT y: REAL; z: REAL; END_VAR
FUZZIFY t
  LOCK: RANGE;
  TERM a := Triangle 0 5 10
  TERM b := Gaussian 5 2 0.5
  TERM c := SigmoidDifference (1, 2, 3, 4);
  TERM d := 5;
END_FUZZIFY
DEFUZZIFY y
  TERM f := FUNCTION -t ^ 2 + (t - (u - 3)) * -4 / max(t, -1, sin(t)) - -2;
  TERM g := Linear 1 0 0 -2;
  METHOD: COGF; ACCU: HSUM; DEFAULT := nan | NC;
END_DEFUZZIFY
DEFUZZIFY z
  TERM l := (0, 0), (1, 1); METHOD: MM; LOCK: PREVIOUS | RANGE; ENABLED: FALSE; RANGE(-1 .. 1); DEFAULT := NC;
END_DEFUZZIFY
RULEBLOCK
  AND: EINSTEIN; ENABLED: FALSE; ACCU: MAX;
  RULE: IF t IS NOT very a AND t IS any OR l = red THEN (y IS f), z IS l WITH u;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""

CANONICAL = """\
TYPE
    STRUCT lamp
        red: REAL;
        green: REAL;
    END_STRUCT
END_TYPE

FUNCTION_BLOCK my-block

VAR_INPUT
    t: REAL; RANGE := (0 .. 10);
    l: lamp;
    u: INT := 3; RANGE := (0 .. 5);
END_VAR

VAR_OUTPUT
    y: REAL;
    z: REAL;
END_VAR

FUZZIFY t
    LOCK: RANGE;
    TERM a := (0, 0) (5, 1) (10, 0);
    TERM b := Gaussian 5 2 0.5;
    TERM c := SigmoidDifference 1 2 3 4;
    TERM d := SINGLETONS (5, 1);
END_FUZZIFY

DEFUZZIFY y
    TERM f := FUNCTION -t ^ 2 + (t - (u - 3)) * (-4) / max(t, -1, sin(t)) - (-2);
    TERM g := FUNCTION 1 * t + 0 * l.red + 0 * l.green + (-2 * u);
    METHOD: CoGS;
    DEFAULT := nan | NC;
    ACCU: HSUM;
END_DEFUZZIFY

DEFUZZIFY z
    ENABLED: FALSE;
    RANGE := (-1 .. 1);
    TERM l := (0, 0) (1, 1);
    METHOD: MM;
    DEFAULT := NC;
    LOCK: PREVIOUS | RANGE;
END_DEFUZZIFY

RULEBLOCK No1
    ENABLED: FALSE;
    AND: EPROD;
    OR: ESUM;
    ACCU: MAX;
    RULE 1: IF t IS NOT very a AND t IS any OR l.red THEN y IS f, z IS l WITH u;
END_RULEBLOCK

END_FUNCTION_BLOCK
"""


def rewritten(text, name="t", **options):
    return fcl.rewrite(Source(name, text), **options)


def written_rule(rule):
    lines = fcl.write(block(with_rule(rule))).split("\n")
    start = next(n for n, each in enumerate(lines) if each.startswith("    RULE"))
    end = next(n for n, each in enumerate(lines) if n >= start and each.endswith(";"))
    return "\n".join(each[4:] for each in lines[start : end + 1])


def test_both_dialects_have_one_form():
    assert rewritten(DIALECT) == CANONICAL


def test_sections_and_terms_are_set_as_the_standard_prints_them():
    text = rewritten(BATH)
    assert text.startswith(
        "FUNCTION_BLOCK bath\n\nVAR_INPUT\n    temp: REAL;\n    level: REAL;\nEND_VAR\n\nVAR_"
    )
    assert "DEFUZZIFY valve\n    TERM closed := 0;\n    TERM inlet  := 100;\n    METHOD: CoGS;\n" in text
    assert "    DEFAULT := 0;\nEND_DEFUZZIFY\n\nRULEBLOCK No1\n    AND: MIN;\n" in text
    assert text.endswith("END_RULEBLOCK\n\nEND_FUNCTION_BLOCK\n")


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"),
        (-0.0, "-0"),
        (27.0, "27"),
        (-0.5, "-0.5"),
        (100000.0, "100000"),
        (1e15, "1000000000000000"),
        (1e16, "1.0E16"),
        (1.2345678901234567e19, "12345678901234567000"),
        (1e22, "1.0E22"),
        (0.0001, "0.0001"),
        (0.00012345, "0.00012345"),
        (1e-5, "1.0E-5"),
        (1.5e-7, "1.5E-7"),
        (0.1 + 0.2, "0.30000000000000004"),
        (float("nan"), "nan"),
        ("bp_warm", "bp_warm"),
    ],
)
def test_numbers_are_short_and_plain(value, text):
    assert number(value) == text


@pytest.mark.parametrize(
    ("value", "data_type", "text"),
    [
        (1.0, DataType.BOOL, "TRUE"),
        (0.0, DataType.BOOL, "FALSE"),
        (-5.0, DataType.INT, "-5"),
        (0.5, DataType.REAL, "0.5"),
        (float(2**63 - 1), DataType.LINT, "9223372036854775807"),
        (float(2**64 - 1), DataType.ULINT, "18446744073709551615"),
    ],
)
def test_initial_values_suit_their_type(value, data_type, text):
    assert constant(value, data_type) == text


@pytest.mark.parametrize(
    ("rule", "written"),
    [
        ("rule 1: if (temp is cold) and ((level is low)) then valve is inlet;",
         "RULE 1: IF temp IS cold AND level IS low THEN valve IS inlet;"),
        ("RULE1: IF (temp IS cold AND level IS low) OR temp IS hot THEN valve IS inlet;",
         "RULE 1: IF temp IS cold AND level IS low OR temp IS hot THEN valve IS inlet;"),
        ("RULE 1: IF temp IS cold AND (level IS low OR temp IS hot) THEN valve IS inlet;",
         "RULE 1: IF temp IS cold AND (level IS low OR temp IS hot) THEN valve IS inlet;"),
        ("RULE 1: IF temp IS cold AND (level IS low AND temp IS hot) THEN valve IS inlet;",
         "RULE 1: IF temp IS cold AND (level IS low AND temp IS hot) THEN valve IS inlet;"),
        ("RULE 1: IF NOT (temp IS cold) AND NOT (level IS low OR level IS high) THEN valve IS inlet;",
         "RULE 1: IF temp IS NOT cold AND NOT (level IS low OR level IS high) THEN valve IS inlet;"),
        ("RULE 1: IF NOT NOT temp IS cold THEN valve IS inlet WITH 1.0;",
         "RULE 1: IF NOT temp IS NOT cold THEN valve IS inlet;"),
        ("RULEIF: IF temp IS cold THEN valve IS inlet WITH 0.50, valve IS closed WITH level;",
         "RULE_IF: IF temp IS cold THEN valve IS inlet WITH 0.5, valve IS closed WITH level;"),
    ],
)  # fmt: skip
def test_parentheses_stand_where_table_6_needs_them(rule, written):
    assert written_rule(rule) == written


def test_the_deepest_condition_that_is_read_is_written():
    prefix = ("NOT " * 9 + "(") * 5
    rule = f"RULE 1: IF {prefix}temp IS cold OR temp IS hot{')' * 5} THEN valve IS inlet;"
    text = fcl.write(block(with_rule(rule)))
    assert f"IF {'NOT ' * 45}(temp IS cold OR temp IS hot)" in " ".join(text.split())
    assert block(text) == block(with_rule(rule))
    (finding,) = fcl.read(with_rule(rule.replace("IF NOT", "IF NOT NOT"))).errors
    assert finding.message == "this condition is nested more than 50 levels deep"


def test_a_long_rule_is_broken_before_its_operators():
    alternatives = " OR ".join(["temp IS cold AND level IS low AND NOT (temp IS hot OR level IS high)"] * 2)
    assert (
        written_rule(f"RULE 12: IF {alternatives} THEN valve IS inlet, valve IS closed WITH 0.25;")
        == """\
RULE 12: IF temp IS cold AND level IS low AND NOT (temp IS hot OR level IS high)
            OR temp IS cold AND level IS low AND NOT (temp IS hot OR level IS high)
         THEN valve IS inlet,
              valve IS closed WITH 0.25;"""
    )
    subconditions = " AND ".join(["temp IS cold", "level IS low"] * 4)
    assert (
        written_rule(f"RULE 1: IF {subconditions} THEN valve IS inlet;")
        == """\
RULE 1: IF temp IS cold AND level IS low AND temp IS cold AND level IS low AND temp IS cold
           AND level IS low AND temp IS cold AND level IS low
        THEN valve IS inlet;"""
    )


def test_many_points_go_on_below_the_first():
    points = " ".join(f"({n}.125, {n % 2})" for n in range(12))
    text = rewritten(BATH.replace("(3, 1) (27, 0)", points))
    assert (
        """\
    TERM cold := (0.125, 0) (1.125, 1) (2.125, 0) (3.125, 1) (4.125, 0) (5.125, 1) (6.125, 0) (7.125, 1)
                 (8.125, 0) (9.125, 1) (10.125, 0) (11.125, 1);
    TERM hot  := (3, 0) (27, 1);
"""
        in text
    )


def test_what_a_text_says_without_need_stays_and_what_it_leaves_out_is_said():
    text = (
        BATH.replace("AND: MIN;", "OR: MAX; ACT: MIN;").replace("ACCU: MAX;", "").replace("METHOD: CoGS;", "")
    )
    assert "    AND: MIN;\n    OR: MAX;\n    ACT: MIN;\n    ACCU: MAX;\n" in rewritten(text)
    assert "    METHOD: CoGS;\n" in rewritten(text)
    assert "    AND: MIN;\n    OR: MAX;\n    ACCU: MAX;\n    RULE 1:" in fcl.write(block(text))


def test_variables_that_are_declared_together_stay_together():
    text = BATH.replace("temp: REAL;\n    level: REAL;", "temp, level: REAL := 1; END_VAR VAR_INPUT x: REAL;")
    assert (
        "VAR_INPUT\n    temp, level: REAL := 1;\nEND_VAR\n\nVAR_INPUT\n    x: REAL;\nEND_VAR\n"
        in rewritten(text)
    )
    assert "VAR_INPUT\n    temp: REAL := 1;\n    level: REAL := 1;\n    x: REAL;\nEND_VAR\n" in fcl.write(
        block(text)
    )


def test_a_range_stays_in_fuzzify_where_the_text_has_it():
    text = BATH.replace("FUZZIFY temp\n", "FUZZIFY temp\nRANGE := (0 .. 30); ENABLED: TRUE;\n")
    assert "FUZZIFY temp\n    ENABLED: TRUE;\n    RANGE := (0 .. 30);\n    TERM" in rewritten(text)
    assert "temp: REAL; RANGE := (0 .. 30);\n" in fcl.write(block(text))


def test_options_are_written_word_for_word():
    options = "OPTION (* no comment *) a = 'b';;\t\n  (c \n  END_OPTION\n"
    text = BATH.replace("RULEBLOCK No1", options + "RULEBLOCK No1")
    assert "\nOPTIONS (* no comment *) a = 'b';;\t\n  (c \n  END_OPTIONS\n" in rewritten(text)
    assert rewritten(text.replace("\n", "\r\n")) == rewritten(text)


def test_text_behind_the_function_block_is_kept():
    text = rewritten(BATH + "PROGRAM main (* keep *)\n  x := 1 // too\n\n" + BATH.replace("bath", "b"))
    assert "END_FUNCTION_BLOCK\n\nPROGRAM main (* keep *)\n  x := 1 // too\n\nFUNCTION_BLOCK b\n" in text
    assert rewritten(text) == text


@pytest.mark.parametrize(
    ("file", "heading"), [("tank.fcl", "FUNCTION_BLOCK tank"), ("tank;2.fcl", "FUNCTION_BLOCK")]
)
def test_a_block_without_a_name_gets_that_of_its_file_if_it_is_one(file, heading):
    text = rewritten(BATH.replace("FUNCTION_BLOCK bath", "FUNCTION_BLOCK"), file)
    assert text.split("\n")[0] == heading


def test_structure_types_that_blocks_share_stand_before_them():
    types = "TYPE STRUCT s a: REAL; END_STRUCT END_TYPE\n"
    one = "FUNCTION_BLOCK one\nVAR_INPUT x: s; END_VAR END_FUNCTION_BLOCK\n"
    two = "FUNCTION_BLOCK two\nVAR_INPUT y: s; END_VAR END_FUNCTION_BLOCK\n"
    assert rewritten(types + one + two).count("STRUCT s\n") == 1
    inline = one.replace("x: s", "x: s; z: STRUCT b: INT; END_STRUCT")
    assert rewritten(types + inline + two).count("STRUCT s\n") == 1
    others = types.replace("REAL", "INT") + two
    text = fcl.write((*fcl.read(types + one).blocks, *fcl.read(others).blocks))
    assert text.startswith("FUNCTION_BLOCK one\n\nTYPE\n    STRUCT s\n        a: REAL;\n")
    assert "FUNCTION_BLOCK two\n\nTYPE\n    STRUCT s\n        a: INT;\n" in text


def test_a_rule_block_without_a_name_gets_one_that_is_free():
    unnamed = "RULEBLOCK\nACCU: MAX; RULE 1: IF temp IS hot THEN valve IS inlet; END_RULEBLOCK\n"
    text = rewritten(BATH.replace("RULEBLOCK No1", f"{unnamed}{unnamed}RULEBLOCK no1"))
    assert [each.name for each in block(text).rule_blocks] == ["No2", "No3", "no1"]


def test_a_structure_type_that_no_variable_has_is_kept():
    text = rewritten(f"TYPE STRUCT spare a: REAL; END_STRUCT END_TYPE (* later *)\n{BATH}")
    assert text.startswith(
        "TYPE\n    STRUCT spare\n        a: REAL;\n    END_STRUCT\nEND_TYPE (* later *)\n\nFUNC"
    )


def test_a_text_with_errors_is_not_written():
    with pytest.raises(InputFault) as caught:
        rewritten(BATH.replace("IS inlet", "IS outlet"))
    assert [each.code for each in caught.value.diagnostics] == ["FCL310"]


def test_a_height_that_fcl_cannot_say_is_our_mistake():
    shape = Curve(CurveKind.COSINE, (1.0, 2.0), 0.5)
    faulty = FunctionBlock(
        name="b",
        inputs=(Variable("x"),),
        outputs=(Variable("y"),),
        fuzzifications=(Fuzzification("x", (Term("t", shape),)),),
        defuzzifications=(
            Defuzzification(
                variable="y", terms=(Term("t", Points((Point(0.0, 1.0),))),), method=Method.COG, default=None
            ),
        ),
        rule_blocks=(),
    )
    with pytest.raises(ValueError, match="COSINE has no height in FCL"):
        fcl.write(faulty)

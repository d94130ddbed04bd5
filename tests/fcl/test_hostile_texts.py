"""Texts that were made to exhaust a reader get a message, wherever they are deep, long or endless."""

import pytest

from fcl_sim import fcl
from fcl_sim.fcl.reading import LONGEST_TEXT
from tests.fcl.texts import BATH, codes, with_rule

MANY = 10_000


def rule(condition="temp IS cold", conclusion="valve IS inlet"):
    return with_rule(f"RULE 1: IF {condition} THEN {conclusion};")


def term(shape):
    return BATH.replace("inlet := 100", f"inlet := {shape}")


@pytest.mark.parametrize(
    "text",
    [
        rule("(" * MANY + "temp IS cold" + ")" * MANY),
        rule("NOT " * MANY + "temp IS cold"),
        rule("temp IS " + "very " * MANY + "cold"),
        rule(conclusion="(" * MANY + "valve IS inlet"),
        term("FUNCTION " + "(" * MANY + "temp" + ")" * MANY),
        term("FUNCTION " + "-" * MANY + "temp"),
        term("FUNCTION " + "sin(" * MANY + "temp" + ")" * MANY),
        term("FUNCTION temp" + " ^ temp" * 900),
        term("FUNCTION temp" + " - temp" * 900),
        term("FUNCTION temp" + " + temp" * MANY),
    ],
)
def test_what_is_too_deep_or_too_long_is_one_message(text):
    assert codes(text) == ["FCL208"]


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("FUNCTION_BLOCK a VAR_INPUT " + "a: STRUCT " * MANY, "FCL305"),
        ("TYPE " + "a: STRUCT a: " * MANY, "FCL205"),
        ("STRUCT " * MANY, "FCL202"),
        ("FUNCTION_BLOCK " * MANY, "FCL202"),
        ("(" * MANY, "FCL205"),
        (BATH.replace("temp IS cold", "temp" + ".a" * MANY), "FCL201"),
        (BATH.replace("cold :=", "cold\0 :="), "FCL112"),
        (BATH + "(* " * MANY, "FCL110"),
        ("(* " + BATH, "FCL110"),
        ("x" * (LONGEST_TEXT + 1), "FCL102"),
    ],
)
def test_what_does_not_end_is_refused(text, code):
    reading = fcl.read(text)
    assert reading.blocks == ()
    assert code in [each.code for each in reading.errors]


def test_a_long_sum_is_one_operation_and_no_deep_tree():
    (found,) = fcl.read(term("FUNCTION temp" + " + temp" * 900)).blocks
    assert len(found.defuzzifications[0].terms[1].shape.expression.arguments) == 901

"""The product of each stage as text."""

from pathlib import Path

from fcl_sim import fcl
from fcl_sim.diagnostics import Source
from tests.fcl.texts import BATH, block, changed, tree

GOOD = Path(__file__).parent / "good"


def test_tokens_are_listed_with_their_places_and_kinds():
    source = Source("t", "RULE 3a: (* note *)\n\t-1.5 §\x07 16#F")
    assert fcl.show_tokens(fcl.scan(source)) == (
        "1:1      name     RULE\n"
        "1:6      mixed    3a\n"
        "1:8      symbol   :\n"
        "1:10     comment  (* note *)\n"
        "2:2      symbol   -\n"
        "2:3      number   1.5\n"
        "2:7      stray    '§\\x07'\n"
        "2:10     literal  16#F\n"
        "2:14     end"
    )


def test_the_tree_shows_the_text_as_it_was_taken():
    shown = fcl.show_tree(
        tree(changed(("valve IS inlet;", "valve IS inlet WITH 0.50;"), ("level: REAL", "level: REAL := 1E1")))
    )
    assert shown == (
        "FUNCTION_BLOCK bath\n"
        "  VAR_INPUT\n"
        "    temp: REAL\n"
        "    level: REAL := 1E1\n"
        "  VAR_OUTPUT\n"
        "    valve: REAL\n"
        "  FUZZIFY temp\n"
        "    TERM cold := (3, 1) (27, 0)\n"
        "    TERM hot := (3, 0) (27, 1)\n"
        "  FUZZIFY level\n"
        "    TERM low := (0, 1) (1, 0)\n"
        "    TERM high := (0, 0) (1, 1)\n"
        "  DEFUZZIFY valve\n"
        "    TERM closed := 0\n"
        "    TERM inlet := 100\n"
        "    METHOD: CoGS\n"
        "    DEFAULT: 0\n"
        "  RULEBLOCK No1\n"
        "    AND: MIN\n"
        "    ACCU: MAX\n"
        "    RULE 1\n"
        "      IF\n"
        "        AND\n"
        "          temp IS cold\n"
        "          level IS low\n"
        "      THEN\n"
        "        valve IS inlet WITH 0.50\n"
        "    RULE 2\n"
        "      IF\n"
        "        OR\n"
        "          temp IS hot\n"
        "          level IS high\n"
        "      THEN\n"
        "        valve IS closed"
    )


def test_the_tree_shows_what_could_not_be_read_as_a_question():
    damaged = changed(
        ("level: REAL", "level: "), ("cold := (3, 1) (27, 0)", "cold := "), ("METHOD: CoGS", "METHOD: ")
    )
    shown = fcl.show_tree(tree(damaged)).split("\n")
    assert {"    level: ?", "    TERM cold := ?", "    METHOD: ?"} <= set(shown)


def test_the_model_shows_every_choice():
    text = changed(("    AND: MIN;\n", ""), ("    ACCU: MAX;\n", ""), ("    DEFAULT := 0;\n", ""))
    assert fcl.show_model(block(text)) == (
        "FUNCTION_BLOCK bath\n"
        "  VAR_INPUT temp: REAL\n"
        "  VAR_INPUT level: REAL\n"
        "  VAR_OUTPUT valve: REAL\n"
        "  FUZZIFY temp\n"
        "    TERM cold := (3, 1) (27, 0)\n"
        "    TERM hot := (3, 0) (27, 1)\n"
        "  FUZZIFY level\n"
        "    TERM low := (0, 1) (1, 0)\n"
        "    TERM high := (0, 0) (1, 1)\n"
        "  DEFUZZIFY valve: METHOD CoGS, DEFAULT NC, RANGE none\n"
        "    TERM closed := 0\n"
        "    TERM inlet := 100\n"
        "  RULEBLOCK No1: AND MIN, OR MAX, ACT MIN, ACCU MAX\n"
        "    RULE 1: IF temp IS cold AND level IS low THEN valve IS inlet\n"
        "    RULE 2: IF temp IS hot OR level IS high THEN valve IS closed"
    )


def test_conditions_of_the_model_are_shown_so_that_they_read_back():
    (extension,) = fcl.read_file(GOOD / "extension.fcl").blocks
    shown = fcl.show_model(extension)
    assert "IF (temp IS cold AND pressure IS low) OR NOT (temp IS hot OR brown) THEN" in shown
    assert "THEN valve IS inlet WITH 0.5, fan IS on WITH w_rule" in shown
    assert "TERM warm := (bp_warm1, 0) (21, 1) (bp_warm2, 0)" in shown
    assert "VAR_INPUT w_rule: REAL := 0.8" in shown


def test_a_text_without_a_function_block_shows_nothing():
    assert fcl.show_tree(tree("")) == ""
    assert fcl.show_tree(tree(BATH))

"""All stages in one go: the standard's own example, and texts that mean no good."""

import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim import fcl
from fcl_sim.diagnostics import Source
from fcl_sim.diagnostics.codes import CODES
from fcl_sim.diagnostics.render import render_all
from fcl_sim.fcl.findings import MOST_FINDINGS
from fcl_sim.fcl.reading import LONGEST_TEXT
from tests.fcl.texts import BATH, changed, codes, with_rule

GOOD = Path(__file__).parent / "good"
CRANE = (GOOD / "crane_printed.fcl").read_text("utf-8")
AS_PRINTED = CRANE.replace("pos_high; (* printed: pos_big *)", "pos_big;")


def test_figure_c_16_as_printed_is_refused_for_its_one_slip():  # S17
    reading = fcl.read(AS_PRINTED, "figure_c16.fcl")
    assert reading.blocks == ()
    assert render_all(reading.diagnostics) == (
        "figure_c16.fcl:37:69: error[FCL310]: `pos_big` is not a term of `power`, it is one of `angle`\n"
        "  37 |     RULE 2: IF distance IS far AND angle IS neg_small THEN power IS pos_big;\n"
        "     |                                                                     ^^^^^^^\n"
        "  hint: did you mean `pos_high`? Valid here: neg_high, neg_medium, zero, pos_medium or pos_high\n"
        "1 error"
    )


def test_a_text_with_an_error_gives_no_blocks_and_one_with_warnings_does():
    assert fcl.read(changed(("inlet;", "intel;"))).blocks == ()
    reading = fcl.read(changed(("    METHOD: CoGS;\n", "")))
    assert len(reading.blocks) == len(reading.diagnostics) == 1
    assert reading.errors == ()


def test_findings_are_in_the_order_of_the_text():
    text = changed(
        ("level: REAL", "level REAL"),
        ("cold := (3", "cold := § (3"),
        ("THEN valve IS inlet", "THEN valve IS x"),
    )
    lines = [each.places[0].span.line for each in fcl.read(text).diagnostics]
    assert lines == sorted(lines)
    assert len(lines) == 3


def test_a_hundred_different_findings_are_shown_and_then_it_is_said_that_there_are_more():
    rules = "".join(f"RULE {each}: IF unknown{each} IS x THEN valve IS inlet;\n" for each in range(3, 500))
    diagnostics = fcl.read(changed(("END_RULEBLOCK", rules + "END_RULEBLOCK"))).diagnostics
    assert len(diagnostics) == MOST_FINDINGS + 1
    assert [each.code for each in diagnostics].count("FCL199") == 1


def test_a_text_beyond_all_measure_is_one_message():
    assert codes(" " * (LONGEST_TEXT + 1)) == ["FCL102"]


@pytest.mark.parametrize("stage", ["FUZZIFY temp", "RULE 1: IF ", "level: ", "METHOD: "])
def test_a_nul_byte_is_one_message(stage):
    (diagnostic,) = fcl.read(changed((stage, stage + "\0"))).diagnostics
    assert diagnostic.message == "the character U+0000 (NUL) has no meaning in FCL"


def test_a_comment_that_is_opened_anywhere_and_never_closed_is_one_message():
    starts = [each.start for each in fcl.scan(Source("t", BATH)).tokens]
    several = [at for at in starts if codes(BATH[:at] + "(*" + BATH[at:]) != ["FCL110"]]
    assert several == []


def is_well_formed(reading, text):
    assert bool(reading.blocks) != bool(reading.errors)
    for diagnostic in reading.diagnostics:
        assert diagnostic.code in CODES
        assert diagnostic.places
        for place in diagnostic.places:
            assert 0 <= place.span.start <= place.span.end <= len(text)
    return render_all(reading.diagnostics)


@given(st.text(max_size=200))
def test_no_text_raises_an_exception(text):
    assert is_well_formed(fcl.read(text), text)


WORDS = re.findall(
    r"\S+",
    "FUNCTION_BLOCK END_FUNCTION_BLOCK VAR_INPUT VAR_OUTPUT VAR END_VAR FUZZIFY END_FUZZIFY "
    "DEFUZZIFY END_DEFUZZIFY RULEBLOCK END_RULEBLOCK OPTIONS END_OPTIONS TYPE END_TYPE STRUCT "
    "TERM RULE RULE1 IF THEN IS AND OR NOT WITH METHOD DEFAULT RANGE ACCU ACT RETAIN "
    ": := ; , ( ) .. . = + - 1 0.5 1E999 16# REAL#x 3a x temp cold NC CoGS very TRIAN (* *) /* */ // ' § \0",
)


@given(st.lists(st.sampled_from(WORDS), max_size=60).map(" ".join))
def test_no_row_of_keywords_raises_an_exception(text):
    assert is_well_formed(fcl.read(text), text)


GOOD_TEXTS = [
    re.split(r"(\W)", file.read_text("utf-8"))
    for file in sorted(GOOD.glob("*.fcl"))
    if file.stat().st_size < 2000
]


@given(st.data())
def test_no_change_of_a_good_file_raises_an_exception(data):
    words = list(data.draw(st.sampled_from(GOOD_TEXTS)))
    for _ in range(data.draw(st.integers(1, 4))):
        at = data.draw(st.integers(0, len(words) - 1))
        words[at : at + data.draw(st.integers(0, 4))] = data.draw(
            st.lists(st.sampled_from(WORDS), max_size=2)
        )
        words = words or [""]
    text = " ".join(words)
    assert is_well_formed(fcl.read(text), text)


@given(st.integers(0, len(CRANE)))
def test_a_text_cut_off_anywhere_is_refused(length):
    text = CRANE[:length]
    if text.rstrip() == CRANE.rstrip():
        return
    reading = fcl.read(text)
    assert reading.blocks == ()
    assert reading.errors


def test_rules_by_the_thousand_are_read():
    rules = "".join(f"RULE {each}: IF temp IS cold THEN valve IS inlet;\n" for each in range(3, 2003))
    (found,) = fcl.read(changed(("END_RULEBLOCK", rules + "END_RULEBLOCK"))).blocks
    assert len(found.rule_blocks[0].rules) == 2002


def test_a_text_of_ten_thousand_unclosed_parentheses_is_refused():
    assert set(codes(with_rule("RULE 1: IF " + "(" * 10_000))) == {"FCL208"}

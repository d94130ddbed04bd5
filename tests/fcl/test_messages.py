"""What is said, word for word, where the choice of words depends on what is known."""

import pytest

from fcl_sim import fcl
from tests.fcl.texts import changed, with_rule

LOCAL = ("FUZZIFY temp", "VAR\n    wish: REAL;\nEND_VAR\nFUZZIFY temp")
DEFUZZIFY = """\
DEFUZZIFY valve
    TERM closed := 0;
    TERM inlet := 100;
    METHOD: CoGS;
    DEFAULT := 0;
END_DEFUZZIFY
"""
FUZZIFY = """\
FUZZIFY level
    TERM low := (0, 1) (1, 0);
    TERM high := (0, 0) (1, 1);
END_FUZZIFY
"""


def only(text):
    (diagnostic,) = fcl.read(text).diagnostics
    return diagnostic.message, diagnostic.hint


@pytest.mark.parametrize(
    ("written", "hint"),
    [
        ("REEL", "did you mean REAL?"),
        ("FLOAT", "did you mean REAL?"),
        ("double", "did you mean LREAL?"),
        (
            "STRING_OF_10",
            "the types of numbers are BOOL, SINT, INT, DINT, LINT, USINT, UINT, UDINT, ULINT, REAL, LREAL",
        ),
    ],
)
def test_an_unknown_type_is_met_with_the_known_ones(written, hint):
    assert only(changed(("level: REAL", f"level: {written}"))) == (
        f"`{written}` is not a data type of a number",
        hint,
    )


@pytest.mark.parametrize(
    ("old", "new", "message", "hint"),
    [
        ("METHOD: CoGS", "METHOD: CoGX", "`CoGX` is not a method of defuzzification", "did you mean CoG?"),
        (
            "METHOD: CoGS",
            "METHOD: Mean",
            "`Mean` is not a method of defuzzification",
            "valid here: CoG, CoGS, CoA, LM or RM",
        ),
        ("AND: MIN", "AND: MINI", "`MINI` is not an algorithm for AND", "did you mean MIN?"),
        (
            "AND: MIN",
            "AND: MIN; OR: MIN",
            "`MIN` is not an algorithm for OR",
            "valid here: MAX, ASUM or BSUM",
        ),
        ("ACCU: MAX", "ACCU: ADD", "`ADD` is not a method of accumulation", "valid here: MAX, BSUM or NSUM"),
    ],
)
def test_an_unknown_algorithm_is_met_with_the_known_ones(old, new, message, hint):
    assert only(changed((old, new))) == (message, hint)


def test_a_condition_on_something_without_terms_says_what_is_missing():
    assert only(changed((FUZZIFY, ""))) == (
        "`level` has no FUZZIFY, so that it has no terms",
        "write FUZZIFY level … END_FUZZIFY; without IS, `level` is taken as a degree",
    )
    text = with_rule("RULE 1: IF wish IS great THEN valve IS inlet;").replace(*LOCAL, 1)
    assert only(text) == (
        "`wish` is a local variable and has no terms",
        "without IS, `wish` is the degree that the rules above have concluded",
    )
    alarm = changed(
        ("valve: REAL;", "valve: REAL; alarm: REAL;"), ("valve IS inlet", "valve IS inlet, alarm")
    )
    text = alarm.replace("level IS high", "alarm IS high")
    assert only(text) == ("`alarm` has no DEFUZZIFY, so that it has no terms", "")


def test_a_conclusion_on_something_without_terms_says_what_is_missing():
    assert only(changed((DEFUZZIFY, ""))) == (
        "`valve` has no DEFUZZIFY: it has no terms and cannot become a number",
        "write DEFUZZIFY valve … END_DEFUZZIFY",
    )
    text = with_rule("RULE 1: IF temp IS cold THEN wish IS great;").replace(*LOCAL, 1)
    assert only(text) == (
        "`wish` is a local variable and has no terms",
        "conclude on it without IS: `THEN wish`",
    )


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("(3, 1) (27, 0)", "(valve, 1) (27, 0)", "the abscissa of a point is a number or an input"),
        ("TERM inlet := 100", "TERM inlet := valve", "a singleton is a number or an input"),
        ("IS inlet;", "IS inlet WITH valve;", "a weighting factor is a number or an input"),
    ],
)
def test_what_a_number_can_be_replaced_by_is_said(old, new, message):
    assert only(changed((old, new))) == (
        f"`valve` is declared in VAR_OUTPUT: {message}",
        "declare `valve` in VAR_INPUT",
    )


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("cold := (3", "cold = (3", "`:=` is expected after the name of the term, not `=`"),
        ("temp: REAL", "temp := REAL", "`:` is expected after the name of the variable, not `:=`"),
        ("temp: REAL", "temp REAL", "`:` is expected after the name of the variable, not `REAL`"),
        ("(3, 1)", "(3)", "`,` is expected after the abscissa of the point, not `)`"),
        (
            "(3, 1)",
            "(, 1)",
            "the abscissa of a point, a number or the name of a variable, is expected, not `,`",
        ),
        ("IF temp IS cold", "IF temp cold", "IS, AND, OR or THEN is expected after `temp`, not `cold`"),
        ("IF temp IS cold", "IF temp IS", "a term of `temp` is expected, not `AND`"),
        ("DEFAULT := 0", "DEFAULT := temp", "a number or NC is expected after DEFAULT, not `temp`"),
        ("RULE 1: IF", "RULE 1; IF", "`:` is expected after the label of the rule, not `;`"),
        ("RULE 1: IF", "RULE 1: WENN", "IF is expected after the label of the rule, not `WENN`"),
        ("RULEBLOCK No1", "RULEBLOCK +", "the name of a rule block is expected, not `+`"),
        ("FUZZIFY temp", "FUZZIFY 1: REAL", "the name of an input variable is expected, not `1`"),
        ("DEFUZZIFY valve", "DEFUZZIFY (valve)", "the name of an output variable is expected, not `(`"),
        (
            "valve IS inlet;",
            "valve IS inlet valve;",
            "`;` is expected at the end of the statement, not `valve`",
        ),
    ],
)
def test_what_is_expected_is_said(old, new, message):
    assert only(changed((old, new)))[0] == message


def test_exclusive_or_is_written_out():
    _, hint = only(with_rule("RULE 1: IF temp IS cold XOR level IS low THEN valve IS inlet;"))
    assert hint == "write (a AND NOT b) OR (NOT a AND b)"


@pytest.mark.parametrize(
    ("method", "reason"),
    [("CoGS", "all terms are singletons"), ("CoG", "the terms have an area")],
)
def test_a_method_that_is_taken_is_taken_for_a_reason(method, reason):
    text = changed(("    METHOD: CoGS;\n", "    RANGE(-10..110);\n"))
    if method == "CoG":
        text = text.replace("closed := 0", "closed := (-10, 1) (10, 0)").replace(
            "inlet := 100", "inlet := (90, 0) (110, 1)"
        )
    assert only(text) == (
        f"DEFUZZIFY valve has no METHOD: {method} is taken, since {reason}",
        f"write `METHOD: {method};`",
    )


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("closed := 0;", "closed := 1,5;"),
        ("DEFAULT := 0;", "DEFAULT := 1,5;"),
        ("valve IS inlet;", "valve IS inlet WITH 1,5;"),
    ],
)
def test_a_decimal_comma_is_met_with_the_point(old, new):
    _, hint = only(changed((old, new)))
    assert hint == "a decimal fraction is written with a point: 1.5"


def test_a_comma_before_something_else_is_not_taken_for_a_decimal_one():
    for between in (", ", " ,", ", inlet"):
        _, hint = only(changed(("closed := 0;", f"closed := 1{between}5;")))
        assert hint == ""

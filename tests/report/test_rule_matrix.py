"""The rules as a table: what a shaded cell means is said, and which rules stand in none."""

import pytest

from fcl_sim.block import loads
from fcl_sim.report.rule_matrix import rule_tables

BASE = """FUNCTION_BLOCK two
VAR_INPUT a: REAL; b: REAL; END_VAR
VAR_OUTPUT y: REAL; END_VAR
FUZZIFY a TERM low := (0, 1) (1, 0); TERM high := (0, 0) (1, 1); END_FUZZIFY
FUZZIFY b TERM low := (0, 1) (1, 0); TERM high := (0, 0) (1, 1); END_FUZZIFY
DEFUZZIFY y TERM no := 0; TERM yes := 1; METHOD: CoGS; DEFAULT := 0; END_DEFUZZIFY
RULEBLOCK first
    RULE 1: IF a IS low AND b IS low THEN y IS no;
    RULE 2: IF a IS low AND b IS high THEN y IS no;
    RULE 3: IF a IS high AND b IS low THEN y IS yes;
    {more}
END_RULEBLOCK
END_FUNCTION_BLOCK"""


BESIDE = "1 rule of another form, 4, may fire in any cell and stands in none."


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ("", "Shaded: no rule."),
        ("RULE 4: IF a IS high AND b IS high THEN y IS yes;", ""),
        (
            "RULE 4: IF a IS high OR b IS high THEN y IS yes;",
            f"Shaded: no rule for this cell alone. {BESIDE}",
        ),
    ],
)
def test_what_a_shaded_cell_means_is_said(more, said):
    (table,) = rule_tables(loads(BASE.format(more=more)).function_block)
    assert table["rest"] == said

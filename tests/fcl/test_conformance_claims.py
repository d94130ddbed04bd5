"""What our own tables say is so: each row has examples that are read, found under it, and evaluated."""

import pytest

from fcl_sim import fcl
from fcl_sim.diagnostics import InputFault
from fcl_sim.engine.assemble import assemble
from fcl_sim.fcl.conformance_features import features
from fcl_sim.fcl.conformance_tables import IN_PART, ROWS
from tests.fcl.texts import block, changed

INPUT = ("    level: REAL;\n", "    level: REAL;\n    x: REAL;\n")
COLD, IF, THEN = "(3, 1) (27, 0)", "temp IS cold AND level IS low", "THEN valve IS inlet"
SECTION = "FUZZIFY temp"
SECOND = "RULEBLOCK No2 ACCU: MAX; RULE 1: IF temp IS hot THEN valve IS closed; END_RULEBLOCK"
AREAS = (
    ("TERM closed := 0;", "TERM closed := (0, 1) (50, 0);"),
    ("TERM inlet := 100;", "TERM inlet := (50, 0) (100, 1);"),
    ("METHOD: CoGS;", "METHOD: CoG;\n    RANGE(0 .. 100);"),
)


def cold(*shapes):
    return [[(COLD, each)] for each in shapes]


def setting(*lines):
    return [[("METHOD: CoGS;", f"METHOD: CoGS; {each};")] for each in lines]


EXAMPLES = {
    "input term": cold("(0, 0) (3, 1) (27, 0)"),
    "output term": [[]],
    "and": [[]],
    "accumulation": [[]],
    "method": [[]],
    "default": [[("DEFAULT := 0", f"DEFAULT := {each}")] for each in ("NC", "7")],
    "condition": [[]],
    "conclusion": [[]],
    "local": [
        [
            (SECTION, "VAR\n    mild: REAL;\nEND_VAR\nFUZZIFY temp"),
            (THEN, "THEN mild;\n    RULE 3: IF mild THEN valve IS inlet"),
        ]
    ],
    "input points": [
        *cold("(0, 0) (3, 1) (9, 1) (27, 0)"),
        [INPUT, (COLD, "(x, 1) (27, 0)")],
    ],
    "output points": [
        AREAS,
        [INPUT, *AREAS, ("(50, 0) (100, 1)", "(x, 0) (100, 1)")],
        [INPUT, ("TERM inlet := 100", "TERM inlet := x")],
    ],
    "and pairs": [[("AND: MIN", f"AND: {each}")] for each in ("PROD", "BDIF")],
    "or": [[("AND: MIN", f"OR: {each}")] for each in ("MAX", "ASUM", "BSUM")],
    "not": [[(IF, f"NOT ({IF})")], [(IF, "temp IS NOT cold")]],
    "parentheses": [[(IF, f"({IF})")]],
    "act": [[*AREAS, ("ACCU: MAX", f"ACCU: MAX; ACT: {each}")] for each in ("MIN", "PROD")],
    "accu": [[*AREAS, ("ACCU: MAX", f"ACCU: {each}")] for each in ("BSUM", "NSUM")],
    "range": [AREAS],
    "areas": [[*AREAS, ("METHOD: CoG", f"METHOD: {each}")] for each in ("CoG", "CoA", "LM", "RM")],
    "rule blocks": [[("END_RULEBLOCK\n", f"END_RULEBLOCK\n{SECOND}\n")]],
    "variables": [[INPUT, (IF, "x")]],
    "subconclusions": [
        [(THEN, "THEN valve IS inlet, valve IS closed")],
        [("    valve: REAL;", "    valve: REAL;\n    z: REAL;"), (THEN, "THEN z")],
    ],
    "weight": [[(THEN, f"{THEN} WITH 0.5")], [INPUT, (THEN, f"{THEN} WITH x")]],
    "more points": cold("(0, 0) (3, 1) (9, 1) (27, 0) (30, 0)"),
    "degrees": cold("(3, 0.5) (27, 0)"),
    "shape": [
        *cold("TRIAN 0 3 27", "Rectangle 3 27", "GAUSS 3 7", "Cosine 3 7"),
        [*AREAS, ("(50, 0) (100, 1)", "GAUSS 100 20")],
    ],
    "singletons": [
        *cold("SINGLETONS (3, 1) (4, 0.5)", "3"),
        [("TERM inlet := 100", "TERM inlet := SINGLETONS (90, 1) (100, 0.5)")],
    ],
    "formula": [[("TERM inlet := 100", "TERM inlet := FUNCTION temp + 3")]],
    "norm": [
        *([("AND: MIN", f"AND: {each}")] for each in ("HPROD", "EPROD", "DPROD", "NMIN")),
        *([("ACCU: MAX", f"ACCU: {each}")] for each in ("SUM", "HSUM")),
        [*AREAS, ("ACCU: MAX", "ACCU: HSUM")],
    ],
    "further method": [[("METHOD: CoGS", "METHOD: COGSS")], [*AREAS, ("METHOD: CoG", "METHOD: MM")]],
    "further default": [[("DEFAULT := 0", f"DEFAULT := {each}")] for each in ("nan", "3 | NC")],
    "hedge": [[(IF, "temp IS very cold")], [(THEN, "THEN valve IS seldom inlet")]],
    "concluded": [[(THEN, f"{THEN};\n    RULE 3: IF valve IS inlet THEN valve IS closed")]],
    "own accumulation": setting("ACCU: BSUM"),
    "input range": [[(SECTION, f"{SECTION} RANGE := (0 .. 30);")]],
    "lock": setting("LOCK : PREVIOUS", "RANGE(0 .. 50); LOCK : RANGE"),
    "enabled": [[(SECTION, f"{SECTION} ENABLED : FALSE;")]],
    "structure": [
        [("    level: REAL;\n", "    level: REAL;\n    s: STRUCT a: REAL; END_STRUCT;\n"), (IF, "s.a")]
    ],
    "options": [[(SECTION, f"OPTIONS\n    chip 7\nEND_OPTIONS\n{SECTION}")]],
    "form": [[("FUNCTION_BLOCK bath", "FUNCTION_BLOCK my-bath")]],
}
"""Changes of the bath, by row. Those of lines without a feature of their own are left out."""

BY_ITSELF = {"declaration", "activation", "rule block"}
"""Rows that no feature tells of: every rule base has the one, nobody the other."""


def is_evaluated(found):
    try:
        assemble(found)
    except InputFault:
        return False
    return True


def test_every_row_has_examples():
    assert set(EXAMPLES) | BY_ITSELF == set(ROWS)


@pytest.mark.parametrize("name", EXAMPLES)
def test_an_example_is_read_and_found_under_its_row(name):
    for edits in EXAMPLES[name]:
        assert name in {each.row.name for each in features(block(changed(*edits)))}, edits


@pytest.mark.parametrize("name", EXAMPLES)
def test_a_row_says_whether_the_engine_evaluates_all_of_it(name):
    evaluated = [is_evaluated(block(changed(*edits))) for edits in EXAMPLES[name]]
    assert all(evaluated) is (ROWS[name].ours != IN_PART)


def test_where_range_is_missing_we_deviate_and_say_so():  # S32
    text = changed(*AREAS[:2], ("METHOD: CoGS;", "METHOD: CoG;"))
    assert [each.code for each in fcl.read(text).diagnostics] == ["FCL336"]
    assert "S32" in ROWS["range"].ours

"""What a text uses is found in its model, under the row of the standard's tables that it belongs to."""

import pytest

from fcl_sim.fcl.conformance_features import features, level
from fcl_sim.fcl.conformance_tables import TABLE_8, TABLES
from fcl_sim.model import Level
from tests.fcl.texts import BATH, block, changed

BASIC = changed(("temp IS hot OR level IS high", "level IS high"))
"""BATH, without the one thing that is not of the Basic Level."""


def edited(*edits):
    text = BASIC
    for old, new in edits:
        assert old in text
        text = text.replace(old, new, 1)
    return block(text)


def beyond(found):
    """Return rows and words of what is not of the Basic Level."""
    return {(each.row.name, each.words) for each in features(found) if each.row.level is not Level.BASIC}


def words_of(found):
    return {each.words for each in features(found)}


INPUTS = ("    level: REAL;\n", "    level: REAL;\n    x: REAL;\n")
AREAS = (
    ("TERM closed := 0;", "TERM closed := (0, 1) (50, 0);"),
    ("TERM inlet := 100;", "TERM inlet := (50, 0) (100, 1);"),
    ("METHOD: CoGS;", "METHOD: CoG;\n    RANGE := (0 .. 100);"),
)
AREA_WORDS = {
    ("output points", "points as terms of outputs"),
    ("act", "activation by MIN"),
    ("range", "RANGE of an output"),
    ("areas", "defuzzification by CoG"),
}
CONDITION = "temp IS cold AND level IS low"
CONCLUSION = "THEN valve IS inlet"


def test_the_basic_level_is_found_with_all_of_its_rows():
    found = block(BASIC)
    assert level(found) is Level.BASIC
    names = {row.name for row in TABLE_8} - {"declaration", "activation", "rule block"}
    assert {each.row.name for each in features(found)} == names


@pytest.mark.parametrize(
    ("edits", "expected"),
    [
        ([("TERM cold := (3, 1) (27, 0)", "TERM cold := (0, 0) (3, 1) (27, 0)")], set()),
        (
            [("TERM cold := (3, 1) (27, 0)", "TERM cold := (0, 0) (3, 1) (9, 1) (27, 0)")],
            {("input points", "four points in a term of an input")},
        ),
        (
            [INPUTS, ("TERM cold := (3, 1) (27, 0)", "TERM cold := (x, 1) (27, 0)")],
            {("input points", "variable points of inputs")},
        ),
        (
            [INPUTS, ("TERM inlet := 100", "TERM inlet := x")],
            {("output points", "variable singletons as terms of outputs")},
        ),
        (AREAS, AREA_WORDS),
        ([("AND: MIN", "AND: PROD")], {("and pairs", "AND by PROD")}),
        ([("AND: MIN", "AND: BDIF")], {("and pairs", "AND by BDIF")}),
        ([(CONDITION, "temp IS cold OR level IS low")], {("or", "OR by MAX")}),
        (
            [("AND: MIN", "OR: BSUM"), (CONDITION, "temp IS cold OR level IS low")],
            {("or", "OR by BSUM")},
        ),
        ([(CONDITION, "temp IS NOT cold")], {("not", "NOT of a subcondition")}),
        (
            [(CONDITION, f"NOT ({CONDITION})")],
            {("not", "NOT before parentheses"), ("parentheses", "parentheses in a condition")},
        ),
        ([(CONDITION, "(temp IS cold)")], {("parentheses", "parentheses in a condition")}),
        ([("ACCU: MAX", "ACCU: NSUM")], {("accu", "accumulation by NSUM")}),
        ([INPUTS, (CONDITION, "x")], {("variables", "a variable without IS in a condition")}),
        (
            [(CONCLUSION, "THEN valve IS inlet, valve IS closed")],
            {("subconclusions", "several subconclusions in a rule")},
        ),
        ([(CONCLUSION, "THEN valve IS inlet WITH 0.5")], {("weight", "a constant weighting factor")}),
        (
            [INPUTS, (CONCLUSION, "THEN valve IS inlet WITH x")],
            {("weight", "a variable weighting factor")},
        ),
        ([(CONCLUSION, "THEN valve IS inlet WITH 1")], set()),
        (
            [("END_RULEBLOCK\n", "END_RULEBLOCK\nRULEBLOCK No2 AND: MIN; ACCU: MAX; END_RULEBLOCK\n")],
            {("rule blocks", "several rule blocks")},
        ),
        (
            [
                ("FUZZIFY temp", "VAR\n    mild: REAL;\nEND_VAR\nFUZZIFY temp"),
                (CONCLUSION, "THEN mild;\n    RULE 3: IF mild THEN valve IS inlet"),
            ],
            {
                ("local", "local variables"),
                ("variables", "a variable without IS in a condition"),
                ("subconclusions", "a variable without IS in a conclusion"),
            },
        ),
    ],
)
def test_a_feature_of_the_extension_level_is_found_and_nothing_else(edits, expected):  # Table 9
    found = edited(*edits)
    assert beyond(found) == expected
    assert level(found) is (Level.EXTENSION if expected else Level.BASIC)


@pytest.mark.parametrize(
    ("edits", "row"),
    [
        (
            [("TERM cold := (3, 1) (27, 0)", "TERM cold := (0, 0) (3, 1) (9, 1) (27, 0) (30, 0)")],
            "more points",
        ),
        ([("TERM cold := (3, 1)", "TERM cold := (3, 0.9)")], "degrees"),
        ([("FUZZIFY temp", "OPTIONS\n    chip 7\nEND_OPTIONS\nFUZZIFY temp")], "options"),
        (
            [(CONCLUSION, "THEN valve IS inlet;\n    RULE 3: IF valve IS inlet THEN valve IS closed")],
            "concluded",
        ),
    ],
)
def test_what_no_table_of_the_standard_has_is_of_the_open_level(edits, row):  # Table 10
    found = edited(*edits)
    assert {name for name, _ in beyond(found)} == {row}
    assert level(found) is Level.OPEN


@pytest.mark.parametrize(
    ("default", "words"), [("NC", "DEFAULT := NC"), ("0", "DEFAULT := 0"), ("7", "a DEFAULT other than 0")]
)
def test_a_default_of_zero_is_told_from_others(default, words):
    assert words in words_of(edited(("DEFAULT := 0", f"DEFAULT := {default}")))


@pytest.mark.parametrize(
    ("operators", "rule", "expected"),
    [
        ("AND: MIN", "temp IS cold", set()),
        ("AND: PROD", "temp IS cold", {"AND by PROD"}),
        ("AND: NMIN", "temp IS cold", {"AND by NMIN"}),
        ("OR: ASUM", "temp IS cold OR level IS low", {"OR by ASUM"}),
        ("AND: PROD; OR: MAX", "temp IS cold", {"AND by PROD"}),
        ("AND: PROD; OR: BSUM", "temp IS cold", {"AND by PROD", "OR by BSUM"}),
    ],
)
def test_an_operator_that_no_rule_has_counts_where_the_text_must_name_it(operators, rule, expected):  # S10
    found = edited(("AND: MIN", operators), (CONDITION, rule))
    assert {each for each in words_of(found) if each.startswith(("AND", "OR"))} == expected


@pytest.mark.parametrize(
    ("edit", "words"),
    [
        (("AND: MIN", "AND: NIPMIN"), "AND : NIPMIN"),
        (("METHOD: CoGS", "METHOD: COGF"), "METHOD : COGF"),
    ],
)
def test_an_algorithm_of_another_name_is_told_as_it_is_written(edit, words):
    found = edited(edit)
    assert words in words_of(found)
    assert level(found) is Level.OPEN


def test_options_are_told_where_they_stand():
    (feature,) = [
        each
        for each in features(edited(("FUZZIFY temp", "OPTIONS\n    chip 7\nEND_OPTIONS\nFUZZIFY temp")))
        if each.row.name == "options"
    ]
    assert "chip 7" in feature.places[0].text


def test_activation_counts_for_areas_alone():  # Table 4's note
    assert "activation by PROD" not in words_of(edited(("ACCU: MAX", "ACCU: MAX; ACT: PROD")))
    assert "activation by PROD" in words_of(edited(*AREAS, ("ACCU: MAX", "ACCU: MAX; ACT: PROD")))


def test_a_feature_is_told_once_with_every_place_of_it():
    found = block(BATH.replace("IS cold", "IS NOT cold").replace("IS hot", "IS NOT hot"))
    (feature,) = [each for each in features(found) if each.row.name == "not"]
    assert [place.line for place in feature.places] == [26, 27]


def test_features_stand_in_the_order_of_the_tables():
    rows = [each.row for each in features(block(BATH))]
    order = [row for table in TABLES.values() for row in table]
    assert [order.index(row) for row in rows] == sorted(order.index(row) for row in rows)


def test_where_each_output_has_its_own_accumulation_that_of_the_rules_is_not_used():  # S8
    found = edited(("METHOD: CoGS;", "METHOD: CoGS; ACCU: BSUM;"))
    assert {each for each in words_of(found) if "accumulation" in each} == {"accumulation by BSUM"}


@pytest.mark.parametrize(
    ("setting", "words"),
    [
        ("DEFAULT := 3 | NC", "DEFAULT := value | NC"),
        ("DEFAULT := 3;\n LOCK : PREVIOUS", "a DEFAULT other than 0"),
    ],
)
def test_what_holds_an_output_is_its_default_or_a_lock(setting, words):
    found = words_of(edited(("DEFAULT := 0", setting)))
    assert {each for each in found if "DEFAULT" in each} == {words}
    assert ("LOCK" in found) is ("LOCK" in setting)

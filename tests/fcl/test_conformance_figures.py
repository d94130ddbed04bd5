"""Table 11: the figures of a rule base, and those that we say are tested."""

import pytest

from fcl_sim import fcl
from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.instance import Instance
from fcl_sim.fcl.conformance_engine import LIMITS, TESTED, data_check_list
from fcl_sim.fcl.conformance_figures import FIGURES, data_types
from tests.fcl.texts import BATH, block, with_rule


def figures(found):
    return {key: figure.most(found).number for key, figure in FIGURES.items()}


def test_the_figures_of_a_rule_base_are_counted():
    assert figures(block(BATH)) == {
        "identifier_length": 6,  # closed
        "inputs": 2,
        "terms_per_input": 2,
        "terms_of_inputs": 4,
        "points_per_input_term": 2,
        "points_of_inputs": 8,
        "outputs": 1,
        "terms_per_output": 2,
        "terms_of_outputs": 2,
        "points_per_output_term": 1,
        "points_of_outputs": 2,
        "rule_blocks": 1,
        "rules_per_block": 2,
        "subconditions": 2,
        "rules": 2,
        "subconclusions": 1,
        "nesting": 0,
    }


@pytest.mark.parametrize(
    ("rule", "key", "number"),
    [
        ("RULE 1: IF ((temp IS cold) AND level IS low) THEN valve IS inlet;", "nesting", 2),
        (
            "RULE 1: IF NOT (temp IS cold AND level IS low) OR temp IS hot THEN valve IS inlet;",
            "subconditions",
            3,
        ),
        ("RULE 1: IF temp IS cold THEN valve IS inlet, valve IS closed;", "subconclusions", 2),
    ],
)
def test_what_a_rule_holds_is_counted(rule, key, number):
    assert FIGURES[key].most(block(with_rule(rule))).number == number


@pytest.mark.parametrize(
    ("shape", "points"),
    [("(3, 1) (9, 1) (27, 0)", 3), ("GAUSS 3 7", 0), ("SINGLETONS (3, 1) (4, 1)", 2), ("TRIAN 0 3 27", 3)],
)
def test_points_are_those_of_the_shape_and_a_smooth_one_has_none(shape, points):
    found = block(BATH.replace("TERM cold := (3, 1) (27, 0)", f"TERM cold := {shape}"))
    assert next(iter(FIGURES["points_per_input_term"].counts(found))).number == points


def test_the_one_beyond_a_limit_is_where_the_limit_is_passed():
    (count,) = FIGURES["rules"].counts(block(BATH))
    assert [count.beyond(limit).line for limit in (0, 1, 2)] == [26, 27, 27]


def test_types_are_those_of_inputs_and_outputs():
    found = block(BATH.replace("level: REAL", "level: INT"))
    assert {name: len(places) for name, places in data_types(found).items()} == {"REAL": 2, "INT": 1}


# -- our own figures


def large():
    """Return a text that goes as far as we say is tested."""
    lines = ["FUNCTION_BLOCK " + "b" * 1000, "VAR_INPUT"]
    lines += [f"x{n}: REAL;" for n in range(20)]
    lines += ["END_VAR", "VAR_OUTPUT", *(f"y{n}: REAL;" for n in range(20)), "END_VAR"]
    zigzag = " ".join(f"({n}, {n % 2})" for n in range(200))
    many = [f"TERM t{n} := ({n - 1}, 0) ({n}, 1) ({n + 1}, 0);" for n in range(100)]
    lines += ["FUZZIFY x0", *many, "END_FUZZIFY", "FUZZIFY x1", f"TERM t0 := {zigzag};", "END_FUZZIFY"]
    for n in range(2, 20):
        lines += [f"FUZZIFY x{n}", "TERM t0 := (0, 0) (1, 1);", "TERM t1 := (0, 1) (1, 0);", "END_FUZZIFY"]
    area = "METHOD: CoG; RANGE(0 .. 200); DEFAULT := 0;"
    lines += ["DEFUZZIFY y0", *many, area, "END_DEFUZZIFY"]
    lines += ["DEFUZZIFY y1", f"TERM t0 := {zigzag};", area, "END_DEFUZZIFY"]
    for n in range(2, 20):
        lines += [f"DEFUZZIFY y{n}", "TERM t0 := 0;", "TERM t1 := 1;"]
        lines += ["METHOD: CoGS; DEFAULT := 0;", "END_DEFUZZIFY"]
    rules = [f"RULE {n}: IF x0 IS t{n % 100} THEN y0 IS t{(7 * n) % 100};" for n in range(500)]
    lines += ["RULEBLOCK No1", "AND: MIN; ACCU: MAX;", *rules, "END_RULEBLOCK"]
    wide = " OR ".join(f"x0 IS t{n % 100}" for n in range(200))
    deep = "(" * TESTED["nesting"] + "x0 IS t0" + ")" * TESTED["nesting"]
    conclusions = ", ".join(f"y{n} IS t0" for n in range(20))
    lines += ["RULEBLOCK No2", "AND: MIN; ACCU: MAX;", f"RULE 1: IF {wide} THEN {conclusions};"]
    lines += [f"RULE 2: IF {deep} THEN y2 IS t1;", "END_RULEBLOCK"]
    for n in range(3, 21):
        lines += [f"RULEBLOCK No{n}", "ACCU: MAX;", f"RULE 1: IF x{n - 1} IS t0 THEN y3 IS t1;"]
        lines += ["END_RULEBLOCK"]
    return "\n".join([*lines, "END_FUNCTION_BLOCK"])


def test_the_largest_numbers_that_we_name_are_read_and_evaluated():
    found = block(large())
    reached = figures(found)
    assert {key: number for key, number in TESTED.items() if reached[key] < number} == {}
    instance = Instance(found, assemble(found))
    instance(**{f"x{n}": 0.5 for n in range(20)})
    assert 0.0 < instance.y0 < 200.0
    assert instance.y3 == 0.5


def test_a_figure_with_a_limit_is_refused_beyond_it():
    beyond = LIMITS["nesting"] + 1
    text = with_rule(f"RULE 1: IF {'(' * beyond}temp IS cold{')' * beyond} THEN valve IS inlet;")
    assert [each.code for each in fcl.read(text).errors] == ["FCL208"]


def test_every_row_of_table_11_is_filled_in():
    rows = data_check_list()
    assert len(rows) == 22
    assert all(title and statement for title, statement in rows)
    assert set(TESTED) == set(FIGURES)

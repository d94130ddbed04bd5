"""Conditions: priorities of Table 6, parentheses, NOT."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim import fcl
from fcl_sim.model import And, Degree, Is, Not, Or
from tests.fcl.texts import block, codes, tree, with_rule

TERMS = (("temp", "cold"), ("temp", "hot"), ("level", "low"), ("level", "high"))

cold, hot, low, high = (Is(*each) for each in TERMS)


def condition(text):
    return block(with_rule(f"RULE 1: IF {text} THEN valve IS inlet;")).rule_blocks[0].rules[0].condition


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("temp IS cold", cold),
        ("temp IS NOT cold", Not(cold)),
        ("NOT temp IS cold", Not(cold)),
        ("NOT (temp IS cold)", Not(cold)),
        ("NOT temp IS NOT cold", Not(Not(cold))),
        ("NOT NOT temp IS cold", Not(Not(cold))),
        ("((temp IS cold))", cold),
        ("temp IS cold AND level IS low", And((cold, low))),
        ("temp IS cold AND temp IS hot AND level IS low", And((cold, hot, low))),
        ("temp IS cold OR temp IS hot OR level IS low", Or((cold, hot, low))),
        ("temp IS cold OR temp IS hot AND level IS low", Or((cold, And((hot, low))))),
        ("temp IS cold AND temp IS hot OR level IS low", Or((And((cold, hot)), low))),
        ("(temp IS cold OR temp IS hot) AND level IS low", And((Or((cold, hot)), low))),
        ("NOT temp IS cold AND level IS low", And((Not(cold), low))),
        ("NOT (temp IS cold AND level IS low)", Not(And((cold, low)))),
        ("NOT (NOT temp IS cold OR level IS low) AND temp IS hot", And((Not(Or((Not(cold), low))), hot))),
        ("temp IS cold AND (temp IS hot AND level IS low)", And((cold, And((hot, low))))),
    ],
)
def test_not_binds_before_and_and_and_before_or(text, expected):  # Table 6
    assert condition(text) == expected


def as_text(found):
    """Write a condition with parentheses around every argument."""
    match found:
        case Is():
            return f"{found.variable} IS {found.term}"
        case Not():
            return f"NOT ({as_text(found.argument)})"
        case And() | Or():
            word = " AND " if isinstance(found, And) else " OR "
            return word.join(f"({as_text(each)})" for each in found.arguments)


def as_short_text(found, binding=0):
    """Write a condition with those parentheses alone that Table 6 asks for."""
    match found:
        case Is():
            return f"{found.variable} IS {found.term}"
        case Not():
            return f"NOT {as_short_text(found.argument, 3)}"
        case And() | Or():
            own, word = (2, " AND ") if isinstance(found, And) else (1, " OR ")
            text = word.join(as_short_text(each, own + 1) for each in found.arguments)
            return f"({text})" if own < binding else text


def several(inner):
    return st.lists(inner, min_size=2, max_size=3).map(tuple)


conditions = st.recursive(
    st.sampled_from([cold, hot, low, high]),
    lambda inner: inner.map(Not) | several(inner).map(And) | several(inner).map(Or),
    max_leaves=12,
)


@given(conditions)
def test_a_condition_written_with_all_its_parentheses_is_read_back(written):
    assert condition(as_text(written)) == written


@given(conditions)
def test_a_condition_written_with_the_fewest_parentheses_is_read_back(written):
    assert condition(as_short_text(written)) == written


@pytest.mark.parametrize("depth", [49, 50])
def test_fifty_levels_are_read(depth):
    assert condition("(" * (depth - 1) + "temp IS cold" + ")" * (depth - 1)) == cold
    assert condition("NOT " * depth + "temp IS cold") is not None


@pytest.mark.parametrize("prefix", ["(", "NOT ", "(NOT ", "((temp IS hot) AND "])
def test_ten_thousand_levels_are_one_message(prefix):
    rule = f"RULE 1: IF {prefix * 10_000}temp IS cold THEN valve IS inlet;"
    assert codes(with_rule(rule)) == ["FCL208"]


def test_ten_thousand_subconditions_in_a_row_are_read():
    rule = "RULE 1: IF " + "temp IS cold AND " * 9_999 + "temp IS cold THEN valve IS inlet;"
    (found,) = block(with_rule(rule)).rule_blocks[0].rules[:1]
    assert len(found.condition.arguments) == 10_000


def test_a_variable_alone_is_a_degree_and_local_ones_follow_their_conclusion():  # S27, S29
    text = with_rule(
        "RULE 1: IF temp IS cold THEN wish; RULE 3: IF wish AND level IS low THEN valve IS inlet;"
    )
    text = text.replace("FUZZIFY temp", "VAR wish: REAL; END_VAR\nFUZZIFY temp", 1)
    assert block(text).rule_blocks[0].rules[1].condition == And((Degree("wish"), low))


def test_a_number_has_no_members():  # S7
    for text, message in (
        ("temp.brown", "`temp.brown` is not declared"),
        ("temp = brown", "`temp` is not a structure"),
    ):
        (diagnostic,) = fcl.read(with_rule(f"RULE 1: IF {text} AND level IS low THEN valve IS inlet;")).errors
        assert diagnostic.message == message


def test_the_tree_keeps_the_parentheses_of_the_text():
    shown = fcl.show_tree(tree(with_rule("RULE 1: IF ((temp IS cold)) THEN valve IS inlet;")))
    assert shown.count("( )") == 2


@pytest.mark.parametrize(
    ("text", "depth"),
    [
        ("temp IS cold AND level IS low", 0),
        ("(temp IS cold) AND level IS low", 1),
        ("NOT (temp IS cold AND (level IS low))", 2),
        ("(temp IS cold) OR ((level IS low))", 2),
    ],
)
def test_a_rule_says_how_deep_its_parentheses_are_nested_as_written(text, depth):  # Table 11
    found = block(with_rule(f"RULE 1: IF {text} THEN valve IS inlet;"))
    assert found.rule_blocks[0].rules[0].nesting == depth

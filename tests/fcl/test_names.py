"""Words of the language as names: a keyword is a name wherever it can be meant as one (S1a)."""

import math

import pytest

from fcl_sim import fcl
from fcl_sim.model import Curve, Degree, Hedge, Is, Not, Point, Points, Singletons
from tests.fcl.texts import block, codes, with_rule

WORDS = (
    *("inf", "nan", "infinity", "INF", "NaN", "pi", "nc", "true", "false", "none"),
    *("any", "very", "extremely", "somewhat", "seldom", "Any", "VERY"),
    *("range", "method", "default", "accu", "act", "lock", "enabled", "previous"),
    *("min", "max", "prod", "cog", "cogs", "real", "int", "bool", "type", "struct", "constant", "retain"),
    *("function", "linear", "triangle", "trian", "gauss", "singletons", "discrete", "sin", "log", "xor"),
    *("time", "date", "t", "d", "e5", "_1", "x__y", "rule1", "if_", "end", "then_"),
)
EVERYWHERE = """\
FUNCTION_BLOCK {0}
VAR_INPUT {0}: REAL := 1; other: REAL; END_VAR
VAR_OUTPUT out: REAL; result: LREAL; END_VAR
FUZZIFY {0}
    TERM {0} := (0, 1) ({0}, 0) (9, 1);
    TERM second := TRIAN 0 {0} 9;
    TERM third := GAUSS {0} 2;
    TERM fourth := SINGLETONS ({0}, 1) (9, 0.5);
    TERM fifth := Bell ({0}, 3, 2);
END_FUZZIFY
DEFUZZIFY out
    TERM {0} := {0};
    TERM second := FUNCTION 2 * {0} + max({0}, other);
    METHOD: CoGS;
    DEFAULT := NC;
END_DEFUZZIFY
DEFUZZIFY result
    TERM {0} := (0, 0) (1, 1);
    METHOD: CoG;
    DEFAULT := 0;
    RANGE := (0 .. 1);
END_DEFUZZIFY
RULEBLOCK {0}
    AND: MIN;
    ACCU: MAX;
    RULE {0}: IF {0} IS {0} THEN out IS {0}, result IS {0} WITH {0};
    RULE 2: IF ({0} IS NOT {0}) OR {0} IS very {0} AND NOT {0} IS second THEN out IS second WITH {0};
    RULE 3: IF {0} IS not any {0} AND other OR {0} IS any {0} THEN out IS {0} WITH 0.5, result IS {0};
END_RULEBLOCK
END_FUNCTION_BLOCK
"""


@pytest.mark.parametrize("word", WORDS)
def test_a_word_names_a_variable_its_term_and_a_rule_block_and_is_written_back(word):
    text = EVERYWHERE.format(word)
    found = block(text)
    assert (found.name, found.inputs[0].name, found.rule_blocks[0].name) == (word, word, word)
    points, triangle, gauss, singletons, bell = (each.shape for each in found.fuzzifications[0].terms)
    assert points == Points((Point(0.0, 1.0), Point(word, 0.0), Point(9.0, 1.0)))
    assert triangle == Points((Point(0.0, 0.0), Point(word, 1.0), Point(9.0, 0.0)))
    assert isinstance(gauss, Curve)
    assert gauss.parameters[0] == word
    assert singletons == Singletons((Point(word, 1.0), Point(9.0, 0.5)))
    assert isinstance(bell, Curve)
    assert word in bell.parameters
    first, _, third = found.rule_blocks[0].rules
    assert first.condition == Is(word, word)
    assert [(each.term, each.weight) for each in first.conclusions] == [(word, 1.0), (word, word)]
    assert third.condition.arguments[1] == Is(word, word, hedges=(Hedge.ANY,))
    (again,) = fcl.read(fcl.write([found])).blocks
    assert again == found


@pytest.mark.parametrize("word", WORDS)
def test_a_word_names_a_structure_and_its_member(word):
    text = with_rule(f"RULE 1: IF {word} IS {word} OR {word}.{word} THEN valve IS inlet;").replace(
        "VAR_INPUT", f"STRUCT kind {word}: REAL; END_STRUCT\nVAR_INPUT {word}: kind;", 1
    )
    found = block(text)
    assert set(found.rule_blocks[0].rules[0].condition.arguments) == {Degree(f"{word}.{word}")}
    assert fcl.read(fcl.write([found])).blocks == (found,)


# -- any: a hedge in the place of a term, unless a term is called so


def _condition(text):
    return block(text).rule_blocks[0].rules[0].condition


@pytest.mark.parametrize(
    ("written", "of_a_hedge", "of_a_term"),
    [
        ("IS any", Is("temp", "", hedges=(Hedge.ANY,)), Is("temp", "any")),
        ("IS NOT any", Not(Is("temp", "", hedges=(Hedge.ANY,))), Not(Is("temp", "any"))),
        (
            "IS very any",
            Is("temp", "", hedges=(Hedge.VERY, Hedge.ANY)),
            Is("temp", "any", hedges=(Hedge.VERY,)),
        ),
        (
            "IS any any",
            Is("temp", "", hedges=(Hedge.ANY, Hedge.ANY)),
            Is("temp", "any", hedges=(Hedge.ANY,)),
        ),
        (
            "IS any hot",
            Is("temp", "hot", hedges=(Hedge.ANY,)),
            Is("temp", "hot", hedges=(Hedge.ANY,)),
        ),
    ],
)
def test_a_term_called_any_goes_before_the_hedge(written, of_a_hedge, of_a_term):
    text = with_rule(f"RULE 1: IF temp {written} AND level IS low THEN valve IS inlet;")
    assert _condition(text).arguments[0] == of_a_hedge
    with_term = text.replace("TERM hot", "TERM any := (0, 1) (9, 0);\n    TERM hot", 1)
    assert _condition(with_term).arguments[0] == of_a_term
    for each in (text, with_term):
        found = block(each)
        assert fcl.read(fcl.write([found])).blocks == (found,)


# -- inf and nan: numbers, unless a variable is called so


def test_infinity_is_a_number_where_no_variable_is_called_so():
    text = with_rule("RULE 1: IF level IS low THEN valve IS inlet;")
    for word in ("inf", "INF", "Infinity"):
        edited = text.replace("(3, 1) (27, 0)", f"Trapezoid -{word} -{word} 3 27").replace(
            "(0, 0) (1, 1)", f"Trapezoid (0, 1, {word}, +{word})"
        )
        terms = {term.name: term.shape for each in block(edited).fuzzifications for term in each.terms}
        assert terms["cold"] == Points((Point(3.0, 1.0), Point(27.0, 0.0)))
        assert terms["high"] == Points((Point(0.0, 0.0), Point(1.0, 1.0)))
    assert codes(text.replace("(3, 1) (27, 0)", "Triangle 0 nan 27")) == ["FCL323"]


def test_a_sign_before_infinity_says_that_it_is_a_number():
    text = EVERYWHERE.format("inf").replace("TRIAN 0 inf 9", "Triangle -inf inf 9")
    shape = block(text).fuzzifications[0].terms[1].shape
    assert shape == Points((Point("inf", 1.0), Point(9.0, 0.0)))


def test_nan_is_a_default_value_whatever_variables_are_called():
    text = EVERYWHERE.format("nan").replace("DEFAULT := NC", "DEFAULT := nan | NC")
    found = block(text).defuzzifications[0]
    assert math.isnan(found.default)
    assert found.held

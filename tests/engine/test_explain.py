import pytest

from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.explain import Origin
from fcl_sim.engine.explain_text import explanation_text
from fcl_sim.engine.instance import Instance
from fcl_sim.engine.words import condition_text
from fcl_sim.model import Accumulation, And, AndOperator, Degree, Is, Not, Or, RuleBlock, Variable
from tests.engine.bases import block, every, output, points, rule, singleton

BASE = block(
    {"x": (points("low", (0, 1), (1, 0)), points("high", (2, 0), (3, 1)))},
    (
        output("y", singleton("small", -1), singleton("big", 4), default=None),
        output("z", singleton("on", 1), default=-2.5),
    ),
    RuleBlock(
        name="first",
        and_operator=AndOperator.PROD,
        rules=(
            rule("1", every(("x", "low")), ("y", "small", 0.5), ("z", "on")),
            rule("2", And((Is("x", "high"), Degree("d"))), ("y", "big", "w")),
        ),
    ),
    RuleBlock(
        name="second",
        accumulation=Accumulation.BSUM,
        rules=(rule("1", Not(Or((Not(Is("x", "low")), Not(Degree("d"))))), ("y", "small")),),
    ),
    more_inputs=(Variable("d"), Variable("w")),
    initial={"y": 7.0},
)

EXPLAINED = """\
FUNCTION_BLOCK block

Fuzzification
  x = 0.25
    low   0.75
    high  0
  d = 1.5, taken as 1
  w = 0.125

Aggregation
  RULE first.1   0.75
                 IF x IS low
  RULE first.2   PROD(0, 1) = 0
                 IF x IS high AND d
  RULE second.1  1 - MAX(0.25, 0) = 0.75
                 IF NOT (x IS NOT low OR NOT d)

Activation
  RULE first.1   y IS small: 0.75 · WITH 0.5 = 0.375
  RULE first.1   z IS on: 0.75
  RULE second.1  y IS small: 0.75
  not fired: first.2

Accumulation
  y (MAX and BSUM, then MAX over the rule blocks)
    small  0.75
    big    0
  z (MAX)
    on  0.75

Defuzzification
  y = (-1 · 0.75) / (0.75) = -1  (CoGS)
  z = (1 · 0.75) / (0.75) = 1  (CoGS)"""

UNDEFINED = """\
Activation
  not fired: first.1, first.2, second.1

Accumulation
  y (MAX and BSUM, then MAX over the rule blocks)
    small  0
    big    0
  z (MAX)
    on  0

Defuzzification
  y = 7: no rule is active, NC keeps the previous value
  z = -2.5: no rule is active, DEFAULT"""


def explained(**values):
    return Instance(BASE, assemble(BASE)).explain(**values)


def test_every_step_is_told_in_the_order_of_the_standard():
    assert explanation_text(explained(x=0.25, d=1.5, w=0.125)) == EXPLAINED


def test_no_active_rule_is_told_with_what_the_output_gets_instead():
    explanation = explained(x=1.5, d=1.0, w=1.0)
    assert explanation_text(explanation).endswith(UNDEFINED)
    assert [each.origin for each in explanation.defuzzified] == [Origin.PREVIOUS, Origin.DEFAULT]
    assert explanation.fired == ()


def test_a_weight_from_outside_is_shown_with_the_conclusion_it_belongs_to():
    explanation = explained(x=3.0, d=0.5, w=0.25)
    (fired,) = (each for each in explanation.activated if each.degree > 0.0)
    assert (fired.rule, fired.activated, fired.weight, fired.degree) == ("first.2", 0.5, 0.25, 0.125)
    assert explanation.fired == ("first.2",)


X, Y, Z = Is("x", "a"), Is("y", "b"), Degree("z")


@pytest.mark.parametrize(
    ("condition", "text"),
    [
        (Or((And((X, Y)), Z)), "x IS a AND y IS b OR z"),
        (And((X, Or((Y, Z)))), "x IS a AND (y IS b OR z)"),
        (Not(Not(X)), "NOT x IS NOT a"),
        (Not(And((Not(X), Not(Z)))), "NOT (x IS NOT a AND NOT z)"),
        (And((And((X, Y)), Z)), "(x IS a AND y IS b) AND z"),
    ],
)
def test_a_condition_has_the_parentheses_that_its_priorities_need(condition, text):
    assert condition_text(condition) == text

import json
from dataclasses import replace

import pytest

from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.explain import Origin
from fcl_sim.engine.explain_text import explanation_text
from fcl_sim.engine.instance import Instance
from fcl_sim.engine.words import condition_text, subconditions
from fcl_sim.model import (
    Accumulation,
    Activation,
    And,
    AndOperator,
    Degree,
    Hedge,
    Is,
    Method,
    Not,
    Or,
    RuleBlock,
    Variable,
)
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


AREAS = block(
    {"x": (points("low", (0, 1), (1, 0)), points("high", (2, 0), (3, 1)))},
    (
        output(
            "y",
            points("left", (0, 0), (1, 1), (2, 0)),
            points("right", (1, 0), (2, 1), (3, 0)),
            method=Method.COG,
        ),
        output("z", points("box", (4, 0), (4, 1), (5, 1), (5, 0)), method=Method.RM, default=None),
    ),
    RuleBlock(
        name="first",
        rules=(
            rule("1", every(("x", "low")), ("y", "left"), ("z", "box", 0.5)),
            rule("2", Degree("d"), ("y", "right", 0.5), ("l", None)),
            rule("3", And((Degree("l"), Is("y", "left"))), ("q", None)),
        ),
    ),
    RuleBlock(
        name="second",
        activation=Activation.PROD,
        accumulation=Accumulation.NSUM,
        rules=(rule("1", every(("x", "high")), ("z", "box")),),
    ),
    more_inputs=(Variable("d"),),
)
AREAS = replace(AREAS, outputs=(*AREAS.outputs, Variable("q")))

EXPLAINED_AREAS = """\
Aggregation
  RULE first.1   0.75
                 IF x IS low
  RULE first.2   0.5
                 IF d
  RULE first.3   MIN(0.5, 0.75) = 0.5
                 IF l AND y IS left
  RULE second.1  0
                 IF x IS high

Activation
  RULE first.1  y IS left: MIN(0.75, μ)
  RULE first.1  z IS box: 0.5 · MIN(0.75, μ)
  RULE first.2  y IS right: 0.5 · MIN(0.5, μ)
  RULE first.2  l: 0.5
  RULE first.3  q: 0.5
  not fired: second.1

Accumulation
  y (MAX)
    (0, 0) (0.75, 0.75) (1.25, 0.75) (1.75, 0.25) (2.5, 0.25) (3, 0)
  z (MAX and NSUM, then MAX over the rule blocks)
    (4, 0) (4, 0.375) (5, 0.375) (5, 0)
  l (MAX)
    0.5
  q (MAX)
    0.5

Defuzzification
  y = 1.25  (CoG: centre of gravity)
  z = 5  (RM: rightmost maximum)
  q = 0.5  (degree given out)"""


def test_areas_are_told_by_their_corners_and_degrees_by_what_asks_for_them():
    explanation = Instance(AREAS, assemble(AREAS)).explain(x=0.25, d=0.5)
    assert explanation_text(explanation).split("\n\n", 2)[2] == EXPLAINED_AREAS


def test_an_area_without_width_is_told():
    spike = block(
        {},
        (output("y", points("s", (1, 0), (1, 1), (1, 0)), default=-2.0, method=Method.LM),),
        RuleBlock(name="r", rules=(rule("1", Degree("d"), ("y", "s")),)),
        more_inputs=(Variable("d"),),
    )
    spike = replace(spike, defuzzifications=(replace(spike.defuzzifications[0], range=(0.0, 2.0)),))
    told = explanation_text(Instance(spike, assemble(spike)).explain(d=0.5))
    assert told.endswith("Defuzzification\n  y = -2: the accumulated area is 0, DEFAULT")


def test_an_explanation_is_a_json_object():
    document = json.loads(Instance(AREAS, assemble(AREAS)).explain(x=0.25, d=0.5).to_json())
    assert document["activated"][1] == {
        "rule": "first.1",
        "variable": "z",
        "term": "box",
        "activated": 0.75,
        "weight": 0.5,
        "degree": 0.375,
        "algorithm": "MIN",
    }
    assert document["accumulated"][0]["area"][1] == [0.75, 0.75]
    assert document["defuzzified"][2] == {
        "variable": "q",
        "method": "",
        "places": [],
        "origin": "rules",
        "value": 0.5,
    }


def test_every_subcondition_has_the_degree_that_the_formula_shows():
    explanation = Instance(BASE, assemble(BASE)).explain(x=0.25, d=1.5, w=0.125)
    shown = [
        [(each.condition, each.degree) for each in rule.subconditions] for rule in explanation.aggregated
    ]
    assert shown == [
        [("x IS low", 0.75)],
        [("x IS high", 0.0), ("d", 1.0)],
        [("x IS NOT low", 0.25), ("NOT d", 0.0)],
    ]


def test_subconditions_stand_without_their_hedges_and_any_has_none():
    hedged = Or((Is("x", "low", hedges=(Hedge.VERY,)), Is("x", "", hedges=(Hedge.NOT, Hedge.ANY))))
    assert list(subconditions(Not(hedged))) == [Is("x", "low")]


def test_every_input_is_told_even_one_that_only_weighs():
    explanation = Instance(BASE, assemble(BASE)).explain(x=0.25, w=0.125)
    assert [(each.variable, each.value) for each in explanation.inputs] == [
        ("x", 0.25), ("d", 0.0), ("w", 0.125),
    ]  # fmt: skip

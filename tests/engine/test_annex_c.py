"""The worked example of Annex C, figures C.6 to C.15: distance 12, angle 4."""

from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.explain_text import explanation_text
from fcl_sim.engine.instance import Instance
from tests.engine.bases import CRANE, CRANE_THREE

EXPLAINED = """\
FUNCTION_BLOCK container_crane

Fuzzification
  distance = 12
    too_far  0
    zero     0
    close    0
    medium   0.8333
    far      0.1667
  angle = 4
    neg_big    0
    neg_small  0
    zero       0.2
    pos_small  0.8
    pos_big    0

Aggregation
  RULE 1  MIN(0.8333, 0.8) = 0.8
          IF distance IS medium AND angle IS pos_small
  RULE 2  MIN(0.8333, 0.2) = 0.2
          IF distance IS medium AND angle IS zero
  RULE 3  MIN(0.1667, 0.2) = 0.1667
          IF distance IS far AND angle IS zero

Activation
  RULE 1  power IS pos_medium: 0.8
  RULE 2  power IS zero: 0.2
  RULE 3  power IS pos_medium: 0.1667

Accumulation
  power (MAX)
    neg_high    0
    neg_medium  0
    zero        0.2
    pos_medium  0.8
    pos_high    0

Defuzzification
  power = (0 · 0.2 + 9 · 0.8) / (0.2 + 0.8) = 7.2  (CoGS)"""


def crane(block):
    return Instance(block, assemble(block))


def test_the_degrees_of_figures_c6_and_c7():
    explanation = crane(CRANE).explain(distance=12.0, angle=4.0)
    distance, angle = ({each.term: each.degree for each in one.degrees} for one in explanation.fuzzified)
    assert distance == {"too_far": 0.0, "zero": 0.0, "close": 0.0, "medium": 5 / 6, "far": 1 / 6}
    assert angle == {"neg_big": 0.0, "neg_small": 0.0, "zero": 0.2, "pos_small": 0.8, "pos_big": 0.0}


def test_the_three_rules_of_figure_c8_give_7_2_exactly():
    instance = crane(CRANE_THREE)
    instance(distance=12.0, angle=4.0)
    assert instance.power == 7.2
    assert instance.degrees == {"1": 0.8, "2": 0.2, "3": 1 / 6}


def test_the_explanation_takes_the_steps_of_the_annex():
    assert explanation_text(crane(CRANE_THREE).explain(distance=12.0, angle=4.0)) == EXPLAINED


def test_the_rules_of_figure_c16_are_undefined_where_the_annex_warns():
    instance = crane(CRANE)
    instance(distance=-6.0, angle=0.0)  # too far: no rule
    assert instance.power == 0.0
    assert not instance.active["power"]

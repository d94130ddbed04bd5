from dataclasses import replace

import numpy as np

from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.entries import evaluate_once
from fcl_sim.engine.program import JOINT, RULE, RULE_DEGREE, SUMMARY
from fcl_sim.engine.show import program_text
from fcl_sim.model import (
    Accumulation,
    And,
    Degree,
    Is,
    Method,
    Not,
    Or,
    Point,
    Points,
    RuleBlock,
    Singleton,
    Term,
    Variable,
)
from fcl_sim.model.labels import unique_labels
from tests.engine.bases import (
    CRANE,
    CRANE_THREE,
    block,
    every,
    output,
    points,
    rule,
    singleton,
    tabulated,
)

SMALL = block(
    {"x": (points("low", (0, 1), (1, 0)), points("high", (0, 0), (1, 1)))},
    (output("y", singleton("small", -1), singleton("big", 4), default=None),),
    RuleBlock(
        name="r",
        rules=(
            rule("1", every(("x", "low")), ("y", "small", 0.5)),
            rule("2", Or((Not(Is("x", "low")), And((Is("x", "high"), Degree("d"))))), ("y", "big", "d")),
        ),
    ),
    more_inputs=(Variable("d", initial=0.25),),
    name="small",
)

SHOWN = """\
program small: 136 integers, 84 floats, 28 words of memory

memory (the first 6 words are recorded)
  m0    x
  m1    d
  m2    y
  m3    y active
  m4    rule 1
  m5    rule 2
  m6    x IS low
  m7    x IS high
  m8    x IS NOT low
  m9    degree d
  m10   NOT degree d
  m11   accumulated y IS small
  m12   accumulated y IS big
  m14   clamps

grid x: 2 knots, up to 4 degrees in a cell
  -inf < x < 0        rules 1
      x IS low = 1
  x = 0               rules 1
      x IS low = 1
  0 < x < 1           rules 1, 2
      x IS low = 0 + (x - 1) / -1
      x IS high = 0 + (x - 0) / 1
      x IS NOT low = 0 + (x - 0) / 1
  x = 1               rules 2
      x IS high = 1
      x IS NOT low = 1
  1 < x < inf         rules 2
      x IS high = 1
      x IS NOT low = 1

rules
  1: MIN [x IS low]
      max m11, weight 0.5
  2: code [x IS NOT low; x IS high; degree d; MIN; MAX]
      max m12, weight degree d

outputs
  y: MAX at m11, places -1, 4, DEFAULT NC"""


def test_a_program_can_be_looked_at():
    assert program_text(assemble(SMALL)) == SHOWN


def test_the_head_of_the_memory_is_what_a_trace_records():
    program = assemble(CRANE_THREE)
    memory = program.initial.copy()
    memory[:2] = 12.0, 4.0
    evaluate_once(program, memory)
    assert program.recorded == 2 + 2 * 1 + 3
    assert memory[: program.recorded].tolist() == [12.0, 4.0, 7.2, 1.0, 0.8, 0.2, 1 / 6]


def test_a_clamp_is_counted():
    program = assemble(SMALL)
    memory = program.initial.copy()
    counts = []
    for degree in (-0.5, 0.0, 1.0, 1.5):
        memory[1] = degree
        evaluate_once(program, memory)
        counts.append(memory[program.layout.clamps])
    assert counts == [1.0, 0.0, 0.0, 1.0]


def test_labels_are_unique_and_say_their_rule_block_where_there_are_several():
    def rules(*labels):
        return tuple(rule(label, every(("x", "low")), ("y", "small")) for label in labels)

    def labelled(*rule_blocks):
        return unique_labels(block({}, (), *rule_blocks))

    assert labelled(RuleBlock(name="a", rules=rules("1", "1", "", "1"))) == ("1", "1 (2)", "3", "1 (3)")
    assert labelled(RuleBlock(name="a", rules=rules("1")), RuleBlock(name="", rules=rules("1", "x"))) == (
        "a.1",
        "2.1",
        "2.x",
    )


def test_only_rules_that_can_fire_are_visited():
    program = assemble(CRANE)
    ints = program.ints.copy()
    ints[JOINT] = 0
    record = next(at for at in ints[ints[RULE] : ints[RULE] + 32] if ints[at + RULE_DEGREE] == 9)
    ints[record + RULE_DEGREE] = 0  # rule 6 now betrays itself: it overwrites the distance
    for distance, fires in ((30.0, False), (0.0, True)):
        memory = program.initial.copy()
        memory[:2] = distance, 0.0
        evaluate_once(replace(program, ints=ints), memory)
        assert bool(memory[0] != distance) is fires


def test_a_block_without_rules_or_terms_is_evaluated_to_its_default():
    empty = block({"x": ()}, (output("y", singleton("s", 3), default=2.0),))
    program = assemble(empty)
    memory = program.initial.copy()
    evaluate_once(program, memory)
    assert memory[: program.recorded].tolist() == [0.0, 2.0, 0.0]


def test_of_hundreds_of_rules_those_that_fire_are_found_and_forgotten():
    peaks = tuple(float(n) for n in range(-10, 10))
    base = tabulated({"a": peaks, "b": peaks}, lambda a, b: 2.0 * a - b)
    program = assemble(base)
    assert program.ints[SUMMARY] > 0
    memory = program.initial.copy()
    random = np.random.default_rng(3)
    for a, b in random.uniform(-11, 10, (300, 2)).round(1):
        memory[:2] = a, b
        evaluate_once(program, memory)
        assert abs(memory[2] - (2 * np.clip(a, -10, 9) - np.clip(b, -10, 9))) <= 1e-13
        degrees = memory[program.degrees_at : program.recorded]
        assert 1 <= np.count_nonzero(degrees) <= 4
        assert abs(degrees.sum() - 1.0) <= 1e-14


def test_hundreds_of_rules_of_which_none_can_fire_give_the_default():
    terms = tuple(points(f"t{n}", (n, 0), (n + 0.5, 1), (n + 1, 0)) for n in range(20))
    rules = tuple(
        rule(f"{i} {j}", every(("a", f"t{i}"), ("b", f"t{j}")), ("y", "s"))
        for i in range(20)
        for j in range(20)
    )
    base = block(
        {"a": terms, "b": terms},
        (output("y", singleton("s", 1), default=7.0),),
        RuleBlock(name="r", rules=rules),
    )
    program = assemble(base)
    memory = program.initial.copy()
    for a, value in ((0.5, 1.0), (-1.0, 7.0), (19.5, 1.0), (30.0, 7.0)):
        memory[:2] = a, 0.5
        evaluate_once(program, memory)
        assert memory[2] == value


AREAS = block(
    {"x": (Term("far", Points((Point("m", 0.0), Point(10.0, 1.0)))),)},
    (
        output("y", points("t", (0, 0), (1, 1), (2, 0)), default=None, method=Method.COA),
        output("z", Term("u", Points((Point("m", 0.0), Point(5.0, 1.0)))), method=Method.RM),
        output("w", Term("s", Singleton("m")), singleton("v", 2), method=Method.LM),
    ),
    RuleBlock(
        name="r",
        accumulation=Accumulation.BSUM,
        rules=(
            rule("1", every(("x", "far")), ("y", "t", 0.5), ("z", "u"), ("l", None)),
            rule("2", Not(Degree("l")), ("y", "t"), ("w", "s")),
        ),
    ),
    more_inputs=(Variable("m"),),
    name="areas",
)

SHOWN_AREAS = """\
x IS far: (m, 0) (10, 1)

rules
  1: MIN [x IS far]
      max m12
      max m14
      sum m17
  2: code [so far accumulated l; NOT]
      max m13
      sum m15

outputs
  y: CoA, range 0 .. 2, DEFAULT NC
      BSUM
          0.5 · MIN(m12, μ) + 1 · MIN(m13, μ) of (0, 0) (1, 1) (2, 0)
  z: RM, range the hull of its points, DEFAULT 0
      m418 = (m, 0) (5, 1)
      BSUM
          1 · MIN(m14, μ) of m418
  w: LM, BSUM at m15, places m, 2, DEFAULT 0"""


def test_moved_terms_and_areas_can_be_looked_at():
    assert program_text(assemble(AREAS)).split("\n\n", 2)[2] == SHOWN_AREAS

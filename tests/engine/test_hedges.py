"""Hedges: formulae of the Open Level on degrees, the last one first, and rules that masks may leave out."""

from dataclasses import replace
from math import sqrt

import pytest

from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.entries import evaluate_once
from fcl_sim.engine.evaluate import evaluate
from fcl_sim.engine.explain import explain
from fcl_sim.engine.show import program_text
from fcl_sim.model import (
    Accumulation,
    And,
    AndOperator,
    Conclusion,
    Hedge,
    Is,
    Method,
    Not,
    Or,
    Rule,
    RuleBlock,
)
from tests.engine.bases import block, output, points, rule, singleton

RISING = (points("t", (0, 0), (1, 1)),)

FORMULAE = {
    Hedge.VERY: lambda a: a * a,
    Hedge.EXTREMELY: lambda a: 2 * a * a if a <= 0.5 else 1 - 2 * (1 - a) ** 2,
    Hedge.SOMEWHAT: sqrt,
    Hedge.SELDOM: lambda a: sqrt(a / 2) if a <= 0.5 else 1 - sqrt((1 - a) / 2),
    Hedge.ANY: lambda _: 1.0,
    Hedge.NOT: lambda a: 1 - a,
}

PLACES = (-1.0, 0.0, 0.1, 0.25, 0.5, 0.625, 0.9, 1.0, 2.0)


def hedged(*hedges, term="t", variable="x"):
    return Is(variable, term, hedges=hedges)


def base(condition, inputs=("x",), **settings):
    rules = (rule("1", condition, ("y", "s")),)
    made = block(
        dict.fromkeys(inputs, RISING), (output("y", singleton("s", 1)),), RuleBlock(name="r", rules=rules)
    )
    return replace(made, rule_blocks=(replace(made.rule_blocks[0], **settings),))


def degree(condition, **values):
    program = assemble(base(condition, tuple(values)))
    memory = program.initial.copy()
    memory[: len(values)] = list(values.values())
    evaluate_once(program, memory)
    return memory[program.degrees_at]


@pytest.mark.parametrize("hedge", Hedge)
@pytest.mark.parametrize("x", PLACES)
def test_a_hedge_is_its_formula(hedge, x):
    a = min(1.0, max(0.0, x))
    assert degree(hedged(hedge), x=x) == pytest.approx(FORMULAE[hedge](a), rel=1e-15, abs=1e-16)
    assert degree(Not(hedged(hedge)), x=x) == pytest.approx(1 - FORMULAE[hedge](a), rel=1e-15, abs=1e-16)


def test_the_last_hedge_is_applied_first():
    assert degree(hedged(Hedge.VERY, Hedge.NOT), x=0.25) == 0.5625
    assert degree(hedged(Hedge.NOT, Hedge.VERY), x=0.25) == 0.9375
    assert degree(hedged(Hedge.NOT, Hedge.ANY), x=0.25) == 0.0
    assert degree(hedged(Hedge.ANY, Hedge.NOT), x=0.25) == 1.0


def test_any_may_stand_without_a_term():
    assert degree(hedged(Hedge.ANY, term=""), x=0.25) == 1.0
    assert degree(And((hedged(Hedge.ANY, term=""), Is("z", "t"))), x=0.0, z=0.25) == 0.25


def test_hedges_stand_within_and_or_and_not():
    condition = Or((And((hedged(Hedge.VERY), hedged(Hedge.SOMEWHAT, variable="z"))), Not(hedged(Hedge.NOT))))
    assert degree(condition, x=0.5, z=0.01) == 0.5
    assert degree(And((hedged(Hedge.VERY), hedged(Hedge.SOMEWHAT, variable="z"))), x=0.5, z=0.01) == 0.1


def test_what_is_near_1_keeps_its_digits():
    assert degree(hedged(Hedge.NOT, Hedge.VERY, Hedge.NOT), x=1e-12) == pytest.approx(2e-12, rel=1e-11)
    assert degree(hedged(Hedge.NOT, Hedge.SOMEWHAT, Hedge.NOT), x=1e-12) == pytest.approx(5e-13, rel=1e-11)


def test_a_hedge_before_a_concluded_term_takes_what_rules_have_accumulated():
    rules = (
        rule("1", Is("x", "t"), ("y", "s")),
        rule("2", Is("y", "s", hedges=(Hedge.VERY,)), ("z", "s")),
    )
    outputs = (output("y", singleton("s", 1)), output("z", singleton("s", 1)))
    program = assemble(block({"x": RISING}, outputs, RuleBlock(name="r", rules=rules)))
    memory = program.initial.copy()
    memory[0] = 0.5
    evaluate_once(program, memory)
    assert memory[program.degrees_at + 1] == 0.25


def test_explain_shows_the_hedges_and_their_formula():
    condition = And((hedged(Hedge.VERY, Hedge.NOT), hedged(Hedge.ANY, term="")))
    made = base(condition, and_operator=AndOperator.PROD)
    program = assemble(made)
    memory = program.initial.copy()
    memory[0] = 0.25
    told = explain(made, program, memory).aggregated[0]
    assert (told.condition, told.formula) == ("x IS very not t AND x IS any", "PROD(very(not(0.25)), 1)")
    assert "x IS t; NOT; very; any; PROD" in program_text(program)


def test_one_rule_that_never_fires_leaves_the_default():
    made = base(hedged(Hedge.VERY, Hedge.NOT, Hedge.ANY))
    assert evaluate(assemble(made), {"x": 0.5}).outputs["y"] == 0.0


# -- in conclusions

DEGREES_OF = (points("t", (0, 0), (1, 1)),)


def with_hedges(term, weight, *hedges):
    return Conclusion("y", term, weight, hedges=hedges)


CONCLUDED = (Hedge.VERY, Hedge.EXTREMELY, Hedge.SOMEWHAT, Hedge.SELDOM)


def balance(accumulation, *conclusions):
    made = RuleBlock(
        name="r",
        accumulation=accumulation,
        rules=tuple(Rule("1", Is("x", "t"), (each,)) for each in conclusions),
    )
    return block({"x": DEGREES_OF}, (output("y", singleton("s", 1), singleton("z", 0)),), made)


@pytest.mark.parametrize("hedge", CONCLUDED)
@pytest.mark.parametrize("x", [0.1, 0.25, 0.5, 0.625, 0.9, 1.0])
def test_a_hedge_in_a_conclusion_changes_the_rule_s_degree_before_its_weight(hedge, x):
    base = balance(Accumulation.MAX, with_hedges("s", 0.5, hedge), with_hedges("z", 0.25))
    hedged_degree = 0.5 * FORMULAE[hedge](x)
    found = evaluate(assemble(base), {"x": x}).outputs["y"]
    assert found == pytest.approx(hedged_degree / (hedged_degree + 0.25 * x), rel=1e-15)


def test_the_last_hedge_of_a_conclusion_is_applied_first():
    base = balance(
        Accumulation.MAX, with_hedges("s", 1.0, Hedge.EXTREMELY, Hedge.SOMEWHAT), with_hedges("z", 1.0)
    )
    degree = 1 - 2 * (1 - sqrt(0.36)) ** 2
    assert evaluate(assemble(base), {"x": 0.36}).outputs["y"] == pytest.approx(
        degree / (degree + 0.36), rel=1e-14
    )


@pytest.mark.parametrize(
    ("accumulation", "expected"),
    [
        (Accumulation.MAX, 0.5),
        (Accumulation.BSUM, 0.75),
        (Accumulation.SUM, 0.75),
        (Accumulation.ASUM, 0.625),
    ],
)
def test_hedged_conclusions_accumulate_with_the_others(accumulation, expected):
    base = balance(
        accumulation, with_hedges("s", 1.0, Hedge.VERY), with_hedges("s", 1.0), with_hedges("z", 1.0)
    )
    found = evaluate(assemble(base), {"x": 0.5}).outputs["y"]
    assert found == pytest.approx(expected / (expected + 0.5), rel=1e-15)


def test_an_area_is_cut_off_at_the_hedged_degree():
    area = output("y", points("s", (0, 0), (1, 1)), method=Method.LM)
    made = RuleBlock(name="r", rules=(Rule("1", Is("x", "t"), (with_hedges("s", 1.0, Hedge.VERY),)),))
    base = block({"x": DEGREES_OF}, (area,), made)
    assert evaluate(assemble(base), {"x": 0.5}).outputs["y"] == 0.25


def test_a_hedged_conclusion_is_explained_and_shown():
    base = balance(Accumulation.ASUM, with_hedges("s", 0.5, Hedge.SELDOM, Hedge.VERY), with_hedges("z", 1.0))
    program = assemble(base)
    memory = program.initial.copy()
    memory[0] = 0.5
    told = explain(base, program, memory)
    seldom = sqrt(0.25 / 2)
    assert [each.activated for each in told.activated] == [pytest.approx(seldom), 0.5]
    assert told.activated[0].degree == pytest.approx(0.5 * seldom)
    assert told.accumulated[0].degrees[0].degree == pytest.approx(0.5 * seldom)
    assert "seldom very: ASUM" in program_text(program)


def test_what_later_conditions_ask_for_counts_hedges():
    rules = (
        Rule("1", Is("x", "t"), (with_hedges("s", 1.0, Hedge.VERY),)),
        Rule("2", Is("y", "s"), (with_hedges("z", 1.0),)),
    )
    base = block(
        {"x": DEGREES_OF},
        (output("y", singleton("s", 1), singleton("z", 0)),),
        RuleBlock(name="r", rules=rules),
    )
    program = assemble(base)
    memory = program.initial.copy()
    memory[0] = 0.5
    told = explain(base, program, memory)
    assert told.aggregated[1].degree == 0.25
    assert told.aggregated[1].subconditions[0].degree == 0.25

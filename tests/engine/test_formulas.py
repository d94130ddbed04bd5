"""Formulae as terms of outputs: singletons whose place is calculated (Takagi-Sugeno)."""

from dataclasses import replace
from math import exp, isnan, sin

import pytest

from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.evaluate import evaluate
from fcl_sim.engine.explain import explain
from fcl_sim.engine.show import program_text
from fcl_sim.model import (
    Call,
    Formula,
    Function,
    Is,
    Method,
    Not,
    Number,
    Operation,
    Operator,
    Reference,
    RuleBlock,
    Term,
    Variable,
)
from tests.engine.bases import block, output, points, rule, singleton

T = (points("t", (0, 0), (1, 1)),)
X, Z, Y = Reference("x"), Reference("z"), Reference("y")


def plus(*parts):
    return Operation(Operator.PLUS, parts)


def times(*parts):
    return Operation(Operator.TIMES, parts)


def base(*terms, method=Method.COGS, **settings):
    rules = (
        rule("1", Is("x", "t"), ("y", terms[0].name)),
        rule("2", Not(Is("x", "t")), ("y", terms[-1].name)),
    )
    out = replace(output("y", *terms, method=method, default=None), **settings)
    return block({"x": T}, (out,), RuleBlock(name="r", rules=rules), more_inputs=(Variable("z"),))


def term(expression, name="f"):
    return Term(name, Formula(expression))


def value(expression, x, z, **previous):
    return float(evaluate(assemble(base(term(expression))), {"x": x, "z": z}, previous or None).outputs["y"])


def test_a_formula_is_calculated_from_the_inputs():
    assert value(plus(times(Number(2.0), X), times(Number(3.0), Z), Number(1.0)), 0.5, 4.0) == 14.0
    assert value(Operation(Operator.MINUS, (X, Z, Number(2.0))), 0.5, 4.0) == -5.5
    assert value(Operation(Operator.MINUS, (Z,)), 0.5, 4.0) == -4.0
    assert (
        value(Operation(Operator.POWER, (Z, Operation(Operator.OVER, (Number(1.0), Number(2.0))))), 1, 9)
        == 3.0
    )
    assert value(Call(Function.MAX, (X, Z, Number(7.0))), 0.5, 4.0) == 7.0
    wanted = exp(sin(4.0)) % 2
    mod = Operation(Operator.MODULUS, (Call(Function.EXP, (Call(Function.SIN, (Z,)),)), Number(2.0)))
    assert value(mod, 0.5, 4.0) == pytest.approx(wanted, rel=1e-14)


def test_a_formula_may_take_what_the_output_was():
    assert value(plus(Y, Number(1.0)), 0.5, 0.0, y=41.0) == 42.0


def test_formulae_are_weighed_by_their_degrees():
    made = base(term(times(Number(10.0), Z)), singleton("s", 4), term(Z, "g"))
    assert evaluate(assemble(made), {"x": 0.25, "z": 8.0}).outputs["y"] == 0.25 * 80 + 0.75 * 8
    summed = replace(made, defuzzifications=(replace(made.defuzzifications[0], method=Method.SUM),))
    assert evaluate(assemble(summed), {"x": 0.25, "z": 8.0}).outputs["y"] == 26.0
    for method, wanted in ((Method.LM, 8.0), (Method.RM, 80.0), (Method.MM, 44.0)):
        most = replace(made, defuzzifications=(replace(made.defuzzifications[0], method=method),))
        assert evaluate(assemble(most), {"x": 0.5, "z": 8.0}).outputs["y"] == wanted


def test_what_has_no_number_counts_only_where_its_rule_fires():
    root = Call(Function.SQRT, (Z,))
    made = assemble(base(term(root), singleton("s", 4)))
    assert evaluate(made, {"x": 0.0, "z": -1.0}).outputs["y"] == 4.0
    assert isnan(evaluate(made, {"x": 0.5, "z": -1.0}).outputs["y"])


def test_explain_and_show_program_tell_the_place():
    made = base(term(plus(X, Z)), singleton("s", 4))
    program = assemble(made)
    memory = program.initial.copy()
    memory[:2] = 0.5, 3.0
    assert explain(made, program, memory).defuzzified[0].places == (3.5, 4.0)
    assert "places place y IS f, 4" in program_text(program)

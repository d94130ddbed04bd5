"""Settings of the Open Level: ENABLED, LOCK, further defaults and methods."""

from dataclasses import replace
from math import exp, isnan, nan

import numpy as np
import pytest

from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.evaluate import evaluate
from fcl_sim.engine.explain import Origin, explain
from fcl_sim.engine.instance import Instance
from fcl_sim.engine.show import program_text
from fcl_sim.model import (
    Curve,
    CurveKind,
    Is,
    Method,
    Not,
    Point,
    Points,
    RuleBlock,
    Singletons,
    Term,
    Variable,
)
from tests.engine.bases import block, output, points, rule, singleton

TERM = points("t", (0, 0), (1, 1))
RULES = RuleBlock(name="r", rules=(rule("1", Is("x", "t"), ("y", "s")),))
AREA = points("s", (0, 0), (10, 1), (20, 0))


def plain(*terms, rules=RULES, **settings):
    made = output("y", *(terms or (singleton("s", 10),)))
    return block({"x": (TERM,)}, (replace(made, **settings),), rules)


def given_out(base, x, **previous):
    return float(evaluate(assemble(base), {"x": x}, previous or None).outputs["y"])


def clamped(*terms, limits=(0.25, 0.75), condition=None, more=()):
    rules = replace(RULES, rules=(rule("1", condition or Is("x", terms[0].name), ("y", "s")),))
    base = block({"x": terms}, (output("y", singleton("s", 10), method=Method.SUM),), rules, more_inputs=more)
    own = replace(base.fuzzifications[0], clamped=True)
    inputs = (replace(base.inputs[0], range=limits), *base.inputs[1:])
    return replace(base, fuzzifications=(own,), inputs=inputs)


def test_a_default_may_be_no_number():
    assert isnan(given_out(plain(default=nan), 0.0))
    assert given_out(plain(default=nan), 0.5) == 10.0


@pytest.mark.parametrize("default", [3.0, nan])
def test_a_held_output_gives_its_default_only_before_the_first_active_rule(default):
    base = plain(default=default, held=True)
    instance = Instance(base, assemble(base))
    values = []
    for x in (0.0, 1.0, 0.0):
        instance(x=x)
        values.append(instance.y)
    assert values == pytest.approx([default, 10.0, 10.0], nan_ok=True)
    assert given_out(base, 0.0) == pytest.approx(default, nan_ok=True)
    assert given_out(base, 0.0, y=4.0) == 4.0
    program = assemble(base)
    assert explain(base, program, program.initial.copy()).defuzzified[0].origin is Origin.PREVIOUS


@pytest.mark.parametrize(("term", "wanted"), [(singleton("s", 100), 40.0), (singleton("s", -5), 5.0)])
def test_a_locked_result_lies_within_the_range(term, wanted):
    base = plain(term, range=(5.0, 40.0), clamped=True, default=99.0)
    assert given_out(base, 1.0) == wanted
    assert given_out(base, 0.0) == 99.0
    assert "DEFAULT 99, result within 5 .. 40" in program_text(assemble(base))


def test_an_area_may_be_locked():
    base = plain(AREA, method=Method.RM, range=(0.0, 20.0), clamped=True)
    assert given_out(base, 0.5) == 15.0


def test_an_output_that_is_not_enabled_gives_its_default():
    for term in (singleton("s", 10), AREA):
        base = plain(term, enabled=False, default=7.0, method=Method.COG)
        assert given_out(base, 1.0) == 7.0


def test_a_rule_block_that_is_not_enabled_concludes_nothing():
    other = replace(RULES, name="q", enabled=False, rules=(rule("2", Not(Is("x", "t")), ("y", "u")),))
    base = block({"x": (TERM,)}, (output("y", singleton("s", 10), singleton("u", 30)),), RULES, other)
    program = assemble(base)
    assert evaluate(program, {"x": 0.5}).outputs["y"] == 10.0
    memory = program.initial.copy()
    memory[0] = 0.5
    assert explain(base, program, memory).aggregated[1].degree == 0.0


def test_an_input_that_is_not_enabled_has_degrees_of_0():
    base = plain(rules=replace(RULES, rules=(rule("1", Not(Is("x", "t")), ("y", "s")),)))
    off = replace(base, fuzzifications=(replace(base.fuzzifications[0], enabled=False),))
    program = assemble(off)
    memory = program.initial.copy()
    memory[0] = 0.75
    told = explain(off, program, memory)
    assert (told.fuzzified[0].degrees[0].degree, told.aggregated[0].degree) == (0.0, 1.0)


@pytest.mark.parametrize("x", [-3.0, 0.25, 0.5, 0.75, 7.0])
def test_a_locked_input_is_taken_no_further_than_its_range(x):
    near = min(0.75, max(0.25, x))
    bell = Term("t", Curve(CurveKind.GAUSSIAN, (0.0, 1.0)))
    moved = Term("t", Points((Point("m", 0.0), Point(1.0, 1.0))))
    assert given_out(clamped(TERM), x) == 10 * near
    assert given_out(clamped(bell), x) == pytest.approx(10 * exp(-near * near / 2))
    found = evaluate(assemble(clamped(moved, more=(Variable("m"),))), {"x": x, "m": 0.0})
    assert found.outputs["y"] == 10 * near


def test_an_edge_at_the_limit_of_a_locked_input_holds_beyond_it():
    edge = points("t", (0, 1), (0.25, 1), (0.25, 0), (0.75, 0), (0.75, 0.5), (0.75, 0))
    assert [given_out(clamped(edge), x) for x in (-1.0, 0.25, 0.5, 0.75, 2.0)] == [10, 10, 0, 5, 5]
    single = Term("t", Singletons((Point(0.25, 1.0), Point(9.0, 1.0))))
    assert [given_out(clamped(single), x) for x in (-1.0, 0.5, 9.0)] == [10, 0, 0]


def test_the_sum_of_singletons_is_not_divided():
    rules = replace(RULES, rules=(*RULES.rules, rule("2", Not(Is("x", "t")), ("y", "u", 0.5))))
    base = plain(singleton("s", 10), singleton("u", 4), method=Method.SUM, rules=rules)
    xs = np.array([0.0, 0.25, 1.0])
    assert evaluate(assemble(base), {"x": xs}).outputs["y"].tolist() == [2.0, 4.0, 10.0]
    assert "COGSS, MAX" in program_text(assemble(base))

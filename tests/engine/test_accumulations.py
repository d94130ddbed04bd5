"""Accumulation of singletons by the sums and S-norms of the Open Level."""

from dataclasses import replace
from fractions import Fraction
from functools import reduce
from itertools import pairwise

import pytest

from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.entries import evaluate_once
from fcl_sim.engine.explain import explain
from fcl_sim.engine.show import program_text
from fcl_sim.model import Accumulation, Activation, Is, Method, Not, RuleBlock
from tests.engine.bases import block, output, points, rule, singleton

NORMS = {
    Accumulation.SUM: lambda a, b: a + b,
    Accumulation.ASUM: lambda a, b: a + b - a * b,
    Accumulation.HSUM: lambda a, b: (a + b - 2 * a * b) / (1 - a * b) if a * b != 1 else Fraction(1),
    Accumulation.ESUM: lambda a, b: (a + b) / (1 + a * b),
    Accumulation.DSUM: lambda a, b: max(a, b) if min(a, b) == 0 else Fraction(1),
    Accumulation.NMAX: lambda a, b: max(a, b) if a + b < 1 else Fraction(1),
}
TERM = (points("t", (0, 0), (1, 1)),)
SINGLE = singleton("s", 8)
WEIGHTS = (1.0, 0.5, 0.25)


def base(kind, *, activation=Activation.MIN, term=SINGLE, method=Method.SUM):
    rules = tuple(rule(str(n), Is("x", "t"), ("y", "s", weight)) for n, weight in enumerate(WEIGHTS))
    asked = rule("4", Is("y", "s"), ("z", "s"))
    ruled = RuleBlock(name="r", accumulation=kind, activation=activation, rules=(*rules, asked))
    outputs = (output("y", term, method=method), output("z", singleton("s", 1)))
    return block({"x": TERM}, (replace(outputs[0], range=(0.0, 8.0)), outputs[1]), ruled)


def memory_of(program, x):
    memory = program.initial.copy()
    memory[0] = x
    evaluate_once(program, memory)
    return memory


@pytest.mark.parametrize("kind", NORMS)
@pytest.mark.parametrize("x", [0.0, 1e-9, 0.3, 0.5, 0.75, 1.0])
def test_singletons_accumulate_by_the_formula(kind, x):
    made = base(kind)
    exact = float(reduce(NORMS[kind], (Fraction(x) * Fraction(weight) for weight in WEIGHTS)))
    program = assemble(made)
    memory = memory_of(program, x)
    assert memory[program.layout.accumulated["y", "s"]] == pytest.approx(exact, rel=1e-14, abs=1e-15)
    assert memory[program.outputs_at] == pytest.approx(8 * exact, rel=1e-14, abs=1e-14)
    assert memory[program.degrees_at + 3] == pytest.approx(min(1.0, exact), rel=1e-14, abs=1e-15)
    told = explain(made, program, program.initial.copy())
    assert told.accumulated[0].algorithms == (str(kind),)


def test_the_activation_of_singletons_does_not_matter():
    found = [memory_of(assemble(base(Accumulation.ASUM, activation=each)), 0.4)[1] for each in Activation]
    assert all(a == b for a, b in pairwise(found))


def test_the_sum_of_areas_is_not_bounded():
    # CoG of a multiple is that of the term itself
    area = points("s", (0, 1), (4, 1), (8, 0))
    once = base(Accumulation.SUM, term=area, method=Method.COG, activation=Activation.PROD)
    memory = memory_of(assemble(once), 1.0)
    assert memory[1] == pytest.approx((4 * 2 + 2 * (4 + 4 / 3)) / 6, rel=1e-14)
    told = explain(once, assemble(once), memory_of(assemble(once), 1.0))
    assert max(degree for _, degree in told.accumulated[0].area) == 1.75


def test_explain_tells_what_others_have_accumulated():
    rules = (
        rule("1", Is("x", "t"), ("v", "s")),
        rule("2", Not(Is("x", "t")), ("v", "s")),
    )
    made = block(
        {"x": TERM},
        (output("y", singleton("s", 1)),),
        RuleBlock(name="r", accumulation=Accumulation.ESUM, rules=rules),
    )
    program = assemble(made)
    memory = program.initial.copy()
    memory[0] = 0.5
    told = {each.variable: each.degrees for each in explain(made, program, memory).accumulated}
    assert told["v"][0].degree == pytest.approx(0.8, rel=1e-15)


def test_show_program_names_the_norm():
    text = program_text(assemble(base(Accumulation.HSUM)))
    assert "      HSUM m" in text
    assert "COGSS, S-norm at" in text

"""AND and OR by the norms of the Open Level, against their formulae in fractions."""

from dataclasses import replace
from fractions import Fraction
from itertools import product

import pytest

from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.entries import evaluate_once
from fcl_sim.model import And, AndOperator, Is, Not, Or, OrOperator, RuleBlock
from tests.engine.bases import block, output, points, rule, singleton

T_NORMS = {
    AndOperator.HPROD: lambda a, b: a * b / (a + b - a * b) if a + b else Fraction(0),
    AndOperator.EPROD: lambda a, b: a * b / (2 - (a + b - a * b)),
    AndOperator.DPROD: lambda a, b: min(a, b) if max(a, b) == 1 else Fraction(0),
    AndOperator.NMIN: lambda a, b: min(a, b) if a + b > 1 else Fraction(0),
}
S_NORMS = {
    OrOperator.HSUM: lambda a, b: (a + b - 2 * a * b) / (1 - a * b) if a * b != 1 else Fraction(1),
    OrOperator.ESUM: lambda a, b: (a + b) / (1 + a * b),
    OrOperator.DSUM: lambda a, b: max(a, b) if min(a, b) == 0 else Fraction(1),
    OrOperator.NMAX: lambda a, b: max(a, b) if a + b < 1 else Fraction(1),
}
DEGREES = (0.0, 1e-300, 1e-9, 0.125, 0.375, 0.5, 0.625, 0.9, 1.0)
TERM = (points("t", (0, 0), (1, 1)),)
X, Z = Is("x", "t"), Is("z", "t")


def degree(condition, x, z, **operators):
    rules = RuleBlock(name="r", rules=(rule("1", condition, ("y", "s")),))
    base = block({"x": TERM, "z": TERM}, (output("y", singleton("s", 1)),), replace(rules, **operators))
    program = assemble(base)
    memory = program.initial.copy()
    memory[:2] = x, z
    evaluate_once(program, memory)
    return memory[program.degrees_at]


@pytest.mark.parametrize("operator", T_NORMS)
def test_and_is_its_formula(operator):
    for x, z in product(DEGREES, repeat=2):
        exact = T_NORMS[operator](Fraction(x), Fraction(z))
        ours = degree(And((X, Z)), x, z, and_operator=operator)
        assert ours == pytest.approx(float(exact), rel=1e-15, abs=1e-320), (x, z)
        ours = degree(Not(And((X, Z))), x, z, and_operator=operator)
        assert ours == pytest.approx(float(1 - exact), rel=1e-15), (x, z)


@pytest.mark.parametrize("operator", S_NORMS)
def test_or_is_its_formula(operator):
    for x, z in product(DEGREES, repeat=2):
        exact = S_NORMS[operator](Fraction(x), Fraction(z))
        ours = degree(Or((X, Z)), x, z, or_operator=operator)
        assert ours == pytest.approx(float(exact), rel=1e-15, abs=1e-320), (x, z)


def test_three_arguments_are_taken_from_left_to_right():
    condition = And((X, Z, Not(X)))
    exact = T_NORMS[AndOperator.HPROD]
    first = exact(Fraction(0.25), Fraction(0.5))
    wanted = float(exact(first, Fraction(0.75)))
    assert degree(condition, 0.25, 0.5, and_operator=AndOperator.HPROD) == pytest.approx(wanted, rel=1e-15)

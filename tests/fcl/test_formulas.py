"""Formulae: what binds what, which functions there are, and that nothing is evaluated (S15)."""

import math
import operator

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim import fcl
from fcl_sim.model import Call, Formula, Function, Number, Operation, Operator, Reference
from tests.fcl.texts import block, changed

VALUES = {"temp": 2.5, "level": 0.75}
OPERATIONS = {
    Operator.PLUS: lambda *a: math.fsum(a),
    Operator.TIMES: lambda *a: math.prod(a),
    Operator.OVER: lambda a, b: a / b,
    Operator.POWER: lambda a, b: a**b,
    Operator.MODULUS: math.fmod,
    Operator.MINUS: lambda a, *b: a - b[0] if b else -a,
}


def formula(written):
    shape = block(changed(("inlet := 100", f"inlet := {written}"))).defuzzifications[0].terms[1].shape
    assert isinstance(shape, Formula)
    return shape.expression


def value(expression):
    """Return the value of an expression; this is the test's own reading of the tree."""
    match expression:
        case Number():
            return expression.value
        case Reference():
            return VALUES[expression.variable]
        case Operation():
            return OPERATIONS[expression.operator](*map(value, expression.arguments))
        case Call():
            own = {"ln": math.log, "abs": abs, "max": max, "min": min, "neq": operator.ne}
            others = [getattr(each, expression.function, None) for each in (math, operator)]
            function = own.get(expression.function) or next(filter(None, others))
            return function(*map(value, expression.arguments))


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ("1 + 2 * 3", 7),
        ("(1 + 2) * 3", 9),
        ("10 - 3 - 2", 5),
        ("100 / 10 / 5", 2),
        ("2 ^ 3 ^ 2", 512),
        ("-2 ^ 2", -4),
        ("2 ^ -1", 0.5),
        ("7 % 4 * 2", 6),
        ("- - 3", 3),
        ("+3 - -2", 5),
        ("temp*2-level", 4.25),
        ("SIN(0) + Cos(0)", 1),
        ("max(1, temp, 2) + min(level, 1)", 3.25),
        ("pow(2, 3) + atan2(0, 1)", 8),
        ("sqrt(16) % 3", 1),
        ("2 + fmod(7, 4)", 5),
        ("FMOD(7, 4) ^ 2", 9),
        ("pi", math.pi),
        ("ln(exp(2))", 2),
        ("abs(-3) + fabs(-4)", 7),
        ("gt(temp, 2) + 10 * lt(temp, 2) + 100 * eq(temp, 2.5)", 101),
        ("ge(2, 2) + 10 * le(3, 2) + 100 * neq(1, 2)", 101),
        ("acosh(cosh(2)) + asinh(sinh(3)) + atanh(tanh(0.5)) + exp(log1p(2))", 8.5),
    ],
)
def test_a_formula_means_what_algebra_says(written, expected):
    assert value(formula(f"FUNCTION {written}")) == pytest.approx(expected)


def test_the_logarithm_is_decimal_in_one_family_and_natural_in_the_other():
    assert formula("FUNCTION LOG(temp)") == Call(Function.LOG10, (Reference("temp"),))
    assert formula("Function log(temp)") == Call(Function.LN, (Reference("temp"),))


LEAVES = st.sampled_from([("1", 1.0), ("2.5", 2.5), *VALUES.items()])
SIGNS = {"+": lambda a, b: a + b, "-": lambda a, b: a - b, "*": lambda a, b: a * b}


def combined(parts):
    (left, a), sign, (right, b) = parts
    return f"({left}{sign} {right})", SIGNS[sign](a, b)


@given(st.recursive(LEAVES, lambda each: st.tuples(each, st.sampled_from("+-*"), each).map(combined)))
def test_any_formula_of_sums_and_products_has_the_value_that_algebra_gives_it(drawn):
    written, expected = drawn
    assert value(formula(f"FUNCTION {written}")) == pytest.approx(expected)


def test_linear_is_a_sum_over_the_inputs_in_their_order():
    expected = Operation(
        Operator.PLUS,
        (
            Operation(Operator.TIMES, (Number(0.5), Reference("temp"))),
            Operation(Operator.TIMES, (Number(-2), Reference("level"))),
            Number(10),
        ),
    )
    assert formula("Linear 0.5 -2 10") == expected
    assert formula("Linear (0.5, -2, 10)") == expected


def test_linear_may_have_fewer_coefficients_than_there_are_inputs():
    assert formula("Linear 0.5") == Operation(Operator.TIMES, (Number(0.5), Reference("temp")))


def test_no_name_outside_of_the_rule_base_can_be_called():
    (error,) = fcl.read(changed(("inlet := 100", "inlet := FUNCTION open(temp)"))).errors
    assert error.message == "`open` is not a function"
    assert error.hint.startswith("functions are abs, acos, acosh, asin")

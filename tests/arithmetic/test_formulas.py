"""Operators and functions of formulae: those of mathematics, and what has no number."""

import math
from math import inf, isnan, nan

import pytest

from fcl_sim.arithmetic import formulas as f
from fcl_sim.arithmetic.formulas import of_one, of_two

XS = (-1e300, -710.0, -2.5, -1.0, -0.5, 0.0, 0.25, 0.5, 0.49999999999999994, 1.0, 2.5, 3.0, 709.0, 1e17)

ONE = {
    f.ABS: abs,
    f.ACOS: math.acos,
    f.ASIN: math.asin,
    f.ATAN: math.atan,
    f.CEIL: math.ceil,
    f.COS: math.cos,
    f.COSH: math.cosh,
    f.EXP: math.exp,
    f.FLOOR: math.floor,
    f.LN: math.log,
    f.LOG10: math.log10,
    f.ROUND: lambda a: math.copysign(math.floor(abs(a) + 0.5) if abs(a) != XS[8] else 0, a),
    f.SIN: math.sin,
    f.SINH: math.sinh,
    f.SQRT: math.sqrt,
    f.TAN: math.tan,
    f.TANH: math.tanh,
    f.OPPOSITE: lambda a: -a,
    f.ACOSH: math.acosh,
    f.ASINH: math.asinh,
    f.ATANH: lambda a: math.copysign(inf, a) if abs(a) == 1.0 else math.atanh(a),
    f.LOG1P: lambda a: -inf if a == -1.0 else math.log1p(a),
}
TWO = {
    f.POWER: math.pow,
    f.MODULUS: math.fmod,
    f.TIMES: lambda a, b: a * b,
    f.OVER: lambda a, b: a / b,
    f.PLUS: lambda a, b: a + b,
    f.MINUS: lambda a, b: a - b,
    f.ATAN2: math.atan2,
    f.MAX: max,
    f.MIN: min,
    f.EQ: lambda a, b: float(a == b),
    f.NEQ: lambda a, b: float(a != b),
    f.LT: lambda a, b: float(a < b),
    f.LE: lambda a, b: float(a <= b),
    f.GT: lambda a, b: float(a > b),
    f.GE: lambda a, b: float(a >= b),
}


@pytest.mark.parametrize("code", ONE)
def test_of_one_number(code):
    for x in XS:
        try:
            wanted = float(ONE[code](x))
        except ValueError:
            wanted = -inf if x == 0.0 and code in (f.LN, f.LOG10) else nan
        except OverflowError:
            wanted = -inf if code == f.SINH and x < 0 else inf
        assert of_one(code, x) == pytest.approx(wanted, rel=1e-15, nan_ok=True), x


@pytest.mark.parametrize("code", TWO)
def test_of_two_numbers(code):
    for a in XS:
        for b in XS:
            try:
                wanted = TWO[code](a, b)
            except ZeroDivisionError:
                wanted = nan if a == 0.0 else math.copysign(inf, a)
            except ValueError:
                wanted = inf if code == f.POWER and a == 0.0 else nan
            except OverflowError:
                wanted = -inf if a < 0.0 and math.fmod(b, 2.0) != 0.0 else inf
            assert of_two(code, a, b) == pytest.approx(wanted, rel=1e-13, nan_ok=True), (a, b)


def test_no_number_stays_none():
    codes = (f.TIMES, f.OVER, f.PLUS, f.MAX, f.MIN, f.MODULUS, f.EQ, f.NEQ, f.LT, f.LE, f.GT, f.GE)
    assert all(isnan(of_two(code, nan, 1.0)) for code in codes)
    assert all(isnan(of_two(code, 1.0, nan)) for code in (f.EQ, f.NEQ, f.LT, f.LE, f.GT, f.GE))
    assert all(isnan(of_one(code, inf)) for code in (f.SIN, f.FLOOR, f.SQRT, f.ASINH))

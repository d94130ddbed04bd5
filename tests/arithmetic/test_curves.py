"""Smooth curves against their formulae as the model states them, with as many digits as it takes."""

from decimal import Decimal, localcontext
from math import cos, exp, inf, nan, pi

import pytest

from fcl_sim.arithmetic.curves import CODES, PARAMETERS, curve_degree
from fcl_sim.model import CurveKind

CASES = {
    CurveKind.GAUSSIAN: (1.0, 0.5),
    CurveKind.GAUSSIAN_PRODUCT: (1.0, 0.5, 1.5, 2.0),
    CurveKind.BELL: (2.0, 1.5, 0.25),
    CurveKind.SIGMOID: (3.0, 0.5),
    CurveKind.SIGMOID_DIFFERENCE: (5.0, -1.0, 4.0, 2.0),
    CurveKind.SIGMOID_DISTANCE: (5.0, 2.0, 4.0, -1.0),
    CurveKind.SIGMOID_PRODUCT: (5.0, -1.0, -4.0, 2.0),
    CurveKind.COSINE: (2.0, 0.5),
    CurveKind.Z_SHAPE: (-1.0, 2.0),
    CurveKind.S_SHAPE: (-1.0, 2.0),
    CurveKind.PI_SHAPE: (-2.0, -1.0, 1.0, 2.5),
    CurveKind.SPIKE: (0.5, 8.0),
    CurveKind.CONCAVE: (0.5, 1.5),
}
XS = (-3.0, -1.5, -1.0, -0.3, 0.0, 0.25, 0.5, 0.75, 1.0, 1.2, 1.5, 1.9, 2.0, 2.5, 4.0)


def s(x, g, t):
    return 1 / (1 + exp(-g * (x - t)))


def e(x, m, d):
    return exp(-((x - m) ** 2) / (2 * d * d))


def z(x, a, b):
    u = (x - a) / (b - a)
    return 1 if u <= 0 else 0 if u >= 1 else 1 - 2 * u * u if u <= 0.5 else 2 * (1 - u) ** 2


def concave(x, i, end):
    if i <= end:
        return (end - i) / (2 * end - i - x) if x < end else 1
    return (i - end) / (i - 2 * end + x) if x > end else 1


FORMULAE = {
    CurveKind.GAUSSIAN: e,
    CurveKind.GAUSSIAN_PRODUCT: lambda x, m, d, n, f: (
        (e(x, m, d) if x < m else 1) * (e(x, n, f) if x > n else 1)
    ),
    CurveKind.BELL: lambda x, w, b, c: 1 / (1 + abs((x - c) / w) ** (2 * b)),
    CurveKind.SIGMOID: s,
    CurveKind.SIGMOID_DIFFERENCE: lambda x, g, t, h, r: max(0, s(x, g, t) - s(x, h, r)),
    CurveKind.SIGMOID_DISTANCE: lambda x, g, t, h, r: abs(s(x, g, t) - s(x, h, r)),
    CurveKind.SIGMOID_PRODUCT: lambda x, g, t, h, r: s(x, g, t) * s(x, h, r),
    CurveKind.COSINE: lambda x, w, c: (1 + cos(pi * (x - c) / w)) / 2 if abs(x - c) <= w else 0,
    CurveKind.Z_SHAPE: z,
    CurveKind.S_SHAPE: lambda x, a, b: 1 - z(x, a, b),
    CurveKind.PI_SHAPE: lambda x, a, b, c, d: (1 - z(x, a, b)) * z(x, c, d),
    CurveKind.SPIKE: lambda x, c, w: exp(-abs(10 * (x - c) / w)),
    CurveKind.CONCAVE: concave,
}


def degree(kind, x, parameters, height=1.0):
    filled = (*parameters, *([0.0] * (PARAMETERS - len(parameters))))
    return curve_degree(CODES[kind], x, *filled, height)


@pytest.mark.parametrize("kind", CurveKind)
def test_a_curve_is_its_formula(kind):
    for x in XS:
        wanted = FORMULAE[kind](x, *CASES[kind])
        assert degree(kind, x, CASES[kind])[0] == pytest.approx(wanted, abs=1e-15), x
        assert degree(kind, x, CASES[kind])[1] == pytest.approx(1 - wanted, abs=1e-15), x
        assert degree(kind, x, CASES[kind], 0.75)[0] == pytest.approx(0.75 * wanted, abs=1e-15), x
        assert sum(degree(kind, x, CASES[kind], 0.75)) == pytest.approx(1.0, abs=1e-15), x


def test_a_concave_curve_may_fall():
    for x in XS:
        ours = degree(CurveKind.CONCAVE, x, (1.5, 0.5))[0]
        assert ours == pytest.approx(concave(x, 1.5, 0.5), abs=1e-15)


@pytest.mark.parametrize("x", [1e-9, 1e-4, 9.0])
def test_a_complement_keeps_its_own_digits(x):
    with localcontext(prec=60):
        exact = 1 - (-(Decimal(x) ** 2) / 2).exp()
    assert degree(CurveKind.GAUSSIAN, x, (0.0, 1.0))[1] == pytest.approx(float(exact), rel=1e-15)


@pytest.mark.parametrize("kind", CurveKind)
@pytest.mark.parametrize("x", [-1e300, 0.0, 1.0, 1e300])
@pytest.mark.parametrize("parameters", [(0.0,) * 4, (1.0, 0.0, 1.0, 0.0), (1.0, 1.0, 1.0, 1.0)])
def test_what_parameters_make_of_no_meaning_is_a_degree_all_the_same(kind, x, parameters):
    ours, complement = degree(kind, x, parameters)
    assert 0.0 <= ours <= 1.0
    assert ours + complement == 1.0


@pytest.mark.parametrize("x", [inf, nan])
def test_no_degree_is_not_a_number(x):
    assert degree(CurveKind.SIGMOID, x, (0.0, 0.0)) == (0.0, 1.0)

"""Hypothesis strategies for membership functions, as the reader makes them."""

from hypothesis import strategies as st

from fcl_sim.model import (
    Call,
    Curve,
    CurveKind,
    Formula,
    Function,
    Number,
    Operation,
    Operator,
    Point,
    Points,
    Reference,
    Singleton,
    Singletons,
)

NUMBERS = st.one_of(
    st.integers(-1000, 1000).map(float),
    st.decimals(-100, 100, places=3).map(float),
    st.floats(allow_nan=False, allow_infinity=False),
)
DEGREES = st.one_of(st.sampled_from((0.0, 1.0, 0.5)), st.floats(0.0, 1.0))
WIDTHS = st.one_of(st.integers(1, 100).map(float), st.floats(0.0, exclude_min=True, allow_infinity=False))

PLAIN = {
    CurveKind.GAUSSIAN: "xw",
    CurveKind.GAUSSIAN_PRODUCT: "xwxw",
    CurveKind.BELL: "wxx",
    CurveKind.SIGMOID: "xx",
    CurveKind.SIGMOID_DIFFERENCE: "xxxx",
    CurveKind.SIGMOID_DISTANCE: "xxxx",
    CurveKind.SIGMOID_PRODUCT: "xxxx",
    CurveKind.COSINE: "wx",
    CurveKind.SPIKE: "xw",
}
"""Parameters of curves: `w` is a width, `x` any number."""
RISING = {CurveKind.Z_SHAPE: 1, CurveKind.S_SHAPE: 1, CurveKind.PI_SHAPE: 2}
"""How many rising pairs of parameters a curve has."""
WITHOUT_HEIGHT = (CurveKind.SIGMOID_DIFFERENCE, CurveKind.COSINE)

OF_TWO = [Function[name] for name in ("ATAN2", "POW", "EQ", "NEQ", "LT", "LE", "GT", "GE")]
"""Functions of two arguments."""
OF_ONE = [each for each in Function if each not in {*OF_TWO, Function.MAX, Function.MIN}]
"""Functions of one argument."""


def abscissae(inputs):
    return st.one_of(NUMBERS, st.sampled_from(inputs))


@st.composite
def points(draw, inputs):
    """Draw points whose constant abscissae do not fall."""
    xs = draw(st.lists(abscissae(inputs), min_size=1, max_size=8))
    constant = iter(sorted(each for each in xs if not isinstance(each, str)))
    ordered = [each if isinstance(each, str) else next(constant) for each in xs]
    return tuple(Point(each, draw(DEGREES)) for each in ordered)


@st.composite
def curves(draw, inputs):
    kind = draw(st.sampled_from(CurveKind))
    if kind in PLAIN:
        widths = WIDTHS if kind is CurveKind.COSINE else WIDTHS | st.sampled_from(inputs)
        parameters = [draw(widths if each == "w" else abscissae(inputs)) for each in PLAIN[kind]]
    elif kind in RISING:
        pair = st.tuples(NUMBERS, NUMBERS).map(sorted).filter(lambda each: each[0] < each[1])
        parameters = [each for _ in range(RISING[kind]) for each in draw(pair)]
    else:
        parameters = draw(st.lists(abscissae(inputs), min_size=2, max_size=2, unique=True))
    height = 1.0 if kind in WITHOUT_HEIGHT else draw(st.just(1.0) | DEGREES.filter(bool))
    return Curve(kind, tuple(parameters), height)


def areas(inputs, *, of_output=False):
    """Draw shapes with an area; an input may have single values as well."""
    shapes = [points(inputs).map(Points), points(inputs).map(Points), curves(inputs)]
    return st.one_of(*shapes, *([] if of_output else [points(inputs).map(Singletons)]))


def singletons(inputs, outputs):
    """Draw shapes that are single values."""
    single = abscissae(inputs).map(Singleton)
    formulas = expressions((*inputs, *outputs)).map(Formula)
    return st.one_of(single, single, points(inputs).map(Singletons), formulas)


def expressions(names):
    """Draw expressions as they are read: a sum that begins with a sum is one, and `-1` is a number."""
    leaves = st.one_of(NUMBERS.map(Number), st.sampled_from(names).map(Reference))
    return st.recursive(leaves, _joined, max_leaves=10)


def _joined(inner):
    joining = st.sampled_from((Operator.PLUS, Operator.TIMES))
    between = st.sampled_from((Operator.MINUS, Operator.OVER, Operator.MODULUS, Operator.POWER))
    return st.one_of(
        st.builds(Operation, between, st.tuples(inner, inner)),
        st.builds(Operation, joining, several(inner)).filter(_is_read),
        st.builds(Operation, st.just(Operator.MINUS), st.tuples(inner)).filter(_is_read),
        st.builds(Call, st.sampled_from(OF_ONE), st.tuples(inner)),
        st.builds(Call, st.sampled_from(OF_TWO), st.tuples(inner, inner)),
        st.builds(Call, st.sampled_from((Function.MAX, Function.MIN)), several(inner)),
    )


def several(inner):
    return st.lists(inner, min_size=2, max_size=3).map(tuple)


def _is_read(operation):
    first = operation.arguments[0]
    if operation.operator is Operator.MINUS:
        return not isinstance(first, Number)
    return not (isinstance(first, Operation) and first.operator is operation.operator)

"""Units of formulae: what fits, what comes of it, and what is said of what does not."""

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.diagnostics import InputFault
from fcl_sim.formula.functions import ANY, FUNCTIONS
from fcl_sim.formula.parse import Parser
from fcl_sim.formula.resolve import Resolver, root
from fcl_sim.formula.text import plain
from fcl_sim.formula.tokens import Kind, scan
from fcl_sim.formula.tree import Arithmetic, Number, Signal, signals
from fcl_sim.formula.write import written
from fcl_sim.units import Quantity, parse_unit

UNITS = {
    "x": "m",
    "far": "km",
    "t": "s",
    "v": "m/s",
    "w": "deg",
    "n": "1",
    "share": "%",
    "k": "K",
    "hot": "degC",
    "cold": "degC",
    "block.area": "m2",
}


def parsed(text):
    parser = Parser(scan(plain(text)))
    found = parser.inner()
    parser.ended()
    return found


def found(text):
    try:
        return parsed(text), ()
    except InputFault as fault:
        return None, fault.diagnostics


def resolved(text):
    resolver = Resolver({name: parse_unit(unit) for name, unit in UNITS.items()})
    return resolver.number(parsed(text)), resolver.faults


@pytest.mark.parametrize(
    ("text", "unit"),
    [
        ("x - 6 s * v", "m"),
        ("far + x", "km"),
        ("2 cm + x", "m"),
        ("x / t / t", "m/s2"),
        ("v * t - -x", "m"),
        ("sqrt(block.area)", "m"),
        ("sqrt(v * v)", "m/s"),
        ("sqrt(n)", ""),
        ("pow(v, 2)", "m2/s2"),
        ("pow(x, -1)", "1/m"),
        ("pow(n, t / 1 s)", ""),
        ("sin(w) + cos(1 rad)", ""),
        ("atan2(x, far)", "rad"),
        ("acos(share)", "rad"),
        ("mod(x, 1 cm)", "m"),
        ("max(x, far, 3 m)", "m"),
        ("abs(-k)", "K"),
        ("hot - cold", "K"),
        ("hot - 20 degC", "K"),
        ("hot - k", "degC"),
        ("k + hot", "degC"),
        ("(hot - cold) / t", "K/s"),
        ("exp(-t / 3 s) * 4 kW", "kW"),
        ("floor(x / 1 m) * 1 m", "m"),
        ("tanh(share)", ""),
    ],
)
def test_the_unit_of_a_formula_follows(text, unit):
    sized, faults = resolved(text)
    assert faults == []
    assert sized[1].same_as(parse_unit(unit))


@pytest.mark.parametrize(
    ("text", "symbol"), [("v * t", "m"), ("x / t", "m/s"), ("v / t", "m/s2"), ("v * t * 2 + 5 mm", "m")]
)
def test_a_product_has_the_name_that_a_signal_has_for_its_unit(text, symbol):
    sized, _ = resolved(text)
    assert sized[1].symbol == symbol


def test_what_is_added_to_a_product_is_told_in_a_unit_that_reads_well():
    resolver = Resolver({name: parse_unit(unit) for name, unit in {"x": "m", "m": "kg", "g": "m/s2"}.items()})
    sized = resolver.number(parsed("m * g / 5400 N/m + 5 mm - x"))
    assert written(sized[0]) == "(((m * g) / 5400 N/m) + 0.005 m) - x"


@pytest.mark.parametrize(
    ("text", "at", "message"),
    [
        ("x + t", "t", "`x` is in m, and `t` is in s"),
        ("x + 3", "3", "`x` is in m, and `3` has no unit"),
        ("x * y", "y", "there is no signal called `y`"),
        ("sin(n)", "n", "`sin` takes an angle, and `n` is in 1"),
        ("exp(x / far * t)", "x / far * t", "`exp` takes a plain number, and `(x / far) * t` is in m s/km"),
        ("ln(x)", "x", "`ln` takes a plain number, and `x` is in m"),
        ("round(w)", "w", "`round` takes a plain number, and `w` is in deg"),
        ("asin(w)", "w", "`asin` takes a plain number, and `w` is in deg"),
        ("sqrt(x)", "x", "the root of m is no unit"),
        ("pow(x, 0.5)", "0.5", "`x` is in m, so its exponent is a whole number"),
        ("pow(x, n)", "n", "`x` is in m, so its exponent is a whole number"),
        ("pow(x, 99)", "99", "`x` is in m, so its exponent is a whole number"),
        ("pow(n, x)", "x", "`pow` takes a plain number, and `x` is in m"),
        ("atan2(x, t)", "t", "`x` is in m, and `t` is in s"),
        ("max(x, 1)", "1", "`x` is in m, and `1` has no unit"),
        ("k - hot", "hot", "`k` is in K, and `hot` is in degC"),
        ("max(hot, k)", "k", "`hot` is in degC, and `k` is in K"),
    ],
)
def test_what_does_not_fit_is_told_where_it_stands(text, at, message):
    sized, faults = resolved(text)
    assert sized is None
    assert [each.message for each in faults] == [message]
    assert faults[0].places[0].span.text == at
    assert faults[0].hint


def test_every_fault_of_units_is_told():
    assert len(resolved("sin(x) + ln(t) * y")[1]) == 3


@pytest.mark.parametrize(
    ("text", "at", "message"),
    [
        ("", "", "a number, a signal or `(` is wanted here, not the end of the formula"),
        ("x +", "", "a number, a signal or `(` is wanted here, not the end of the formula"),
        ("(x", "", "`)` is missing, before the end of the formula"),
        ("x y", "y", "`y` does not belong here: the formula has ended before it"),
        ("x < 3 m", "<", "`<` does not belong here: the formula has ended before it"),
        ("x ^ 2", "^", "`^` has no meaning in a formula"),
        ("x = 2", "=", "`=` has no meaning in a formula"),
        ("sine(x)", "sine", "there is no function called `sine`"),
        ("__import__(x)", "__import__", "there is no function called `__import__`"),
        ("pow(x)", "pow(x)", "`pow` takes two numbers, and here are 1"),
        ("sin(w, w)", "sin(w, w)", "`sin` takes one number, and here are 2"),
        ("max(x)", "max(x)", "`max` takes two numbers or more, and here are 1"),
        ("3 furlong", "furlong", "there is no unit `furlong`"),
        ("(" * 40 + "x" + ")" * 40, "(", "more than 30 operators stand within each other"),
        ("x" + " + x" * 2000, "x", "the formula has more than 2000 words"),
    ],
)
def test_what_cannot_be_read_is_told_where_it_stands(text, at, message):
    with pytest.raises(InputFault) as fault:
        parsed(text)
    (told,) = fault.value.diagnostics
    assert told.message == message
    assert told.places[0].span.text == at


SPAN = plain(" ").span(0, 1)
leaves = st.one_of(
    st.sampled_from(sorted(UNITS)).map(lambda name: Signal(name, SPAN)),
    st.builds(
        lambda value, unit: Number(Quantity(value, parse_unit(unit)), SPAN),
        st.floats(-1e6, 1e6).map(lambda value: value + 0.0),
        st.sampled_from(["", "m", "kW", "1/s", "m/s2"]),
    ),
)


def calls(name, arguments):
    return arguments.map(lambda given: Arithmetic(name, tuple(given), SPAN))


def deeper(inner):
    named = [
        calls(name, st.lists(inner, min_size=each.arguments or 2, max_size=each.arguments or 4))
        for name, each in FUNCTIONS.items()
    ]
    signed = st.builds(
        Arithmetic, st.just("negative"), st.tuples(calls("abs", st.tuples(inner))), st.just(SPAN)
    )
    joined = [calls(symbol, st.tuples(inner, inner)) for symbol in "+-*/"]
    return st.one_of(*named, *joined, signed)


@given(st.recursive(leaves, deeper, max_leaves=8))
def test_a_formula_written_and_read_again_is_the_same(tree):
    assert parsed(written(tree)) == tree


@given(st.text(alphabet="xtv+-*/(), .3e`mspow^<sinqrt\n", max_size=30))
def test_a_text_is_a_formula_or_a_fault_with_a_place(text):
    tree, faults = found(text)
    if tree is None:
        assert faults
        assert all(each.places for each in faults)
        return
    tokens = scan(plain(text))
    names = [each for each, after in pairwise(tokens) if each.kind is Kind.NAME and after.text != "("]
    quoted = [each for each in tokens if each.kind is Kind.QUOTED]
    assert sorted(signals(tree)) == sorted(each.text for each in [*names, *quoted])


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_function_takes_its_number_of_arguments_and_no_other(name):
    wanted = FUNCTIONS[name].arguments
    for count in range(1, 5):
        text = f"{name}({', '.join(['n'] * count)})"
        if count == wanted or (wanted == ANY and count > 1):
            assert isinstance(parsed(text), Arithmetic)
        else:
            with pytest.raises(InputFault):
                parsed(text)


@pytest.mark.parametrize("unit", ["m", "m/s2", "N", "kW s", "1/s"])
def test_a_root_squared_is_the_unit_again(unit):
    square = parse_unit(unit) ** 2
    assert (root(square) ** 2).same_as(square)

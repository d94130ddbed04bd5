"""Units are read exactly, meet only their own kind, and say what is wrong otherwise."""

import math
from fractions import Fraction

import pint
import pytest
from hypothesis import given
from hypothesis import strategies as st

from docs.units import page as units_page
from fcl_sim.diagnostics.unit_notations import IN_WORDS, OTHER_UNITS
from fcl_sim.units import (
    ACCEPTED_SPELLINGS,
    ONE,
    OTHER_SPELLINGS,
    PREFIXED,
    PREFIXES,
    SYMBOLS,
    Quantity,
    UnitError,
    nanoseconds,
    parse_quantity,
    parse_unit,
)

PLAIN = sorted(SYMBOLS)
PREFIXED_SYMBOLS = sorted(prefix + base for prefix in PREFIXES for base in PREFIXED)
exponents = st.integers(-3, 3).filter(bool)
products = st.lists(st.tuples(st.sampled_from(PLAIN + PREFIXED_SYMBOLS), exponents), min_size=1, max_size=4)
without_celsius = st.lists(
    st.tuples(st.sampled_from([each for each in PLAIN if each != "degC"]), exponents), min_size=1, max_size=4
)
numbers = st.floats(allow_nan=False, allow_infinity=False)


def written(powers: list[tuple[str, int]]) -> str:
    return " ".join(f"{name}^{exponent}" for name, exponent in powers)


@pytest.mark.parametrize(
    ("text", "factor"),
    [
        ("", 1.0),
        ("1", 1.0),
        ("%", 0.01),
        ("t", 1000.0),
        ("kg", 1.0),
        ("mm", 1e-3),
        ("ms", 1e-3),
        ("min", 60.0),
        ("h", 3600.0),
        ("kN", 1000.0),
        ("l", 1e-3),
        ("bar", 1e5),
        ("deg", math.pi / 180),
        ("m/min", 1 / 60),
        ("kN s/m", 1000.0),
        ("N s/m", 1.0),
        ("m/s2", 1.0),
        ("1/s", 1.0),
        ("km/h", 1 / 3.6),
        ("µs", 1e-6),
        ("rpm", math.pi / 30),
    ],
)
def test_a_unit_has_its_si_factor(text: str, factor: float) -> None:
    assert parse_unit(text).factor == pytest.approx(factor, rel=1e-15)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("m/s2", "m/s^2"),
        ("m/s2", "m/s**2"),
        ("m/s", "m s-1"),
        ("N s", "kg m/s"),
        ("W/m2 K", "W/m2/K"),
        ("N*m", "J"),
        ("kW", "kJ/s"),
        ("l", "dm3"),
        ("°C", "degC"),
        ("°/s", "deg/s"),
        ("  kN   s / m ", "kN s/m"),
    ],
)
def test_different_writings_are_the_same_unit(one: str, other: str) -> None:
    assert parse_unit(one).same_as(parse_unit(other))


@pytest.mark.parametrize(
    ("one", "other"), [("m", "mm"), ("rad", ""), ("rad/s", "Hz"), ("K", "degC"), ("s", "1/s"), ("deg", "rad")]
)
def test_different_units_are_told_apart(one: str, other: str) -> None:
    assert not parse_unit(one).same_as(parse_unit(other))


@given(products)
def test_the_symbol_of_a_unit_reads_back(powers: list[tuple[str, int]]) -> None:
    unit = parse_unit(written(powers))
    again = parse_unit(unit.symbol)
    assert again.same_as(unit)
    assert again.symbol == unit.symbol


@given(products, products)
def test_dividing_undoes_multiplying(one: list[tuple[str, int]], other: list[tuple[str, int]]) -> None:
    left, right = parse_unit(written(one)), parse_unit(written(other))
    assert (left * right / right).same_as(left)
    assert (left / left).same_as(ONE)
    assert (left * right).same_as(right * left)


@pytest.fixture(scope="module")
def registry() -> pint.UnitRegistry[float]:
    return pint.UnitRegistry(system="mks")


PINT_NAMES = {"Ohm": "ohm", "t": "tonne", "l": "liter", "d": "day", "h": "hour", "%": "percent", "g": "gram"}


@given(without_celsius)
def test_pint_computes_the_same_factor(
    registry: pint.UnitRegistry[float], powers: list[tuple[str, int]]
) -> None:
    theirs = registry.Quantity(1.0, "")
    for name, exponent in powers:
        theirs = theirs * registry.Quantity(1.0, PINT_NAMES.get(name, name)) ** exponent
    assert parse_unit(written(powers)).factor == pytest.approx(theirs.to_base_units().magnitude, rel=1e-12)


PREFIX_NAMES = {"G": "giga", "M": "mega", "k": "kilo", "h": "hecto"}
PREFIX_NAMES |= {"d": "deci", "c": "centi", "m": "milli", "u": "micro", "n": "nano"}


@pytest.mark.parametrize("prefixed", [each for each in PREFIXED_SYMBOLS if each not in PLAIN])
def test_pint_knows_the_same_prefixes(registry: pint.UnitRegistry[float], prefixed: str) -> None:
    prefix, base = prefixed[0], prefixed[1:]
    name = PREFIX_NAMES[prefix] + {**PINT_NAMES, "s": "second"}.get(base, base)
    theirs = registry.Quantity(1.0, name).to_base_units().magnitude
    assert parse_unit(prefixed).factor == pytest.approx(theirs, rel=1e-12)


@given(numbers, st.sampled_from(["s", "ms", "m/s", "kN", "deg", "%", "degC", ""]))
def test_a_written_quantity_reads_back_to_the_last_bit(value: float, unit: str) -> None:
    quantity = Quantity(value, parse_unit(unit))
    again = parse_quantity(str(quantity))
    assert again.value == value
    assert again.unit.same_as(quantity.unit)


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("-6 s", "s", -6.0),
        ("50ms", "s", 0.05),
        ("20 t", "kg", 20_000.0),
        ("0.1 m", "mm", 100.0),
        ("5 %", "", 0.05),
        ("180 deg", "rad", math.pi),
        ("+.5e1 kN", "N", 5000.0),
        ("150 m/min", "m/s", 2.5),
        ("1.5", "", 1.5),
    ],
)
def test_a_quantity_converts(text: str, unit: str, value: float) -> None:
    assert parse_quantity(text).to(unit) == value


def test_a_number_alone_is_dimensionless() -> None:
    assert parse_quantity(1.5) == Quantity(1.5, ONE)
    assert parse_quantity(2).to("") == 2.0


@given(st.integers(-(2**52), 2**52))
def test_times_are_exact_in_nanoseconds(ticks: int) -> None:
    assert nanoseconds(parse_quantity(f"{ticks} ns")) == ticks
    sign, size = "-" if ticks < 0 else "", abs(ticks)
    assert nanoseconds(parse_quantity(f"{sign}{size // 1000}.{size % 1000:03} us")) == ticks


def test_a_tenth_of_a_second_is_exact() -> None:
    assert nanoseconds(parse_quantity("0.1 s")) == 100_000_000
    assert nanoseconds(parse_quantity("1 h")) == 3_600_000_000_000
    assert parse_unit("ms").scale == Fraction(1, 1000)


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("20 U/min", "did you mean `rpm`?"),
        ("20 Umdr/min", "did you mean `rpm`?"),
        ("20 u / min", "did you mean `rpm`?"),
        ("20 rev/min", "did you mean `rpm`?"),
        ("20 RPM", "did you mean `rpm`?"),
        ("5 Sek", "did you mean `s`?"),
        ("5 hrs", "did you mean `h`?"),
        ("5 Std", "did you mean `h`?"),
        ("5 m/sec", "did you mean `s`?"),
        ("90 Grad", "did you mean `deg`?"),
        ("20 Celsius", "did you mean `degC`?"),
        ("20 ° C", "did you mean `degC`?"),
        ("30 Prozent", "did you mean `%`?"),
        ("30 kp", "1 kp is 9.80665 N"),
        ("100 PS", "1 PS is 735.49875 W"),
        ("5 U", "units are written as m, kg, s, min, N, kW, deg, K, degC, bar, %"),
    ],
)
def test_what_people_write_elsewhere_leads_to_our_unit(text: str, hint: str) -> None:
    with pytest.raises(UnitError) as caught:
        parse_quantity(text)
    assert caught.value.hint == hint


def test_every_hint_names_a_unit_that_is_read_and_meets_what_was_meant() -> None:
    for other, own in {**OTHER_SPELLINGS, **IN_WORDS}.items():
        parse_unit(own)
        assert other in ACCEPTED_SPELLINGS or other not in SYMBOLS
    for own in OTHER_UNITS.values():
        parse_quantity(own)


def test_a_speed_of_rotation_is_not_a_frequency() -> None:
    with pytest.raises(UnitError) as caught:
        parse_quantity("20 1/min").to("rpm")
    assert caught.value.hint == "1/min counts no angle: revolutions per minute are written in rpm"


@pytest.mark.parametrize(
    ("text", "message", "hint"),
    [
        ("5 Kw", "there is no unit `Kw`", "did you mean `kW`?"),
        ("5 Nm", "there is no unit `Nm`", "did you mean `N m`?"),
        ("5 sec", "there is no unit `sec`", "did you mean `s`?"),
        ("0,5 s", "`0,5 s` is not a quantity", "the decimal separator is a point: `0.5 s`"),
        ("fast", "`fast` is not a quantity", 'write a number and a unit, as in "50 ms"'),
        ("", "an empty text is not a quantity", 'write a number and a unit, as in "50 ms"'),
        ("5 m/", "`m/` is not a unit: a symbol is missing", "write units as in m/s2 or kN s/m"),
        ("5 m//s", "`m//s` is not a unit: a symbol is missing", "write units as in m/s2 or kN s/m"),
        ("5 m#", "`m#` is not a unit: `m#` cannot be read", "write units as in m/s2 or kN s/m"),
        ("1e999 m", "`1e999 m` is not a finite number", ""),
        ("nan m", "`nan m` is not a quantity", 'write a number and a unit, as in "50 ms"'),
        (
            "5 furlongs",
            "there is no unit `furlongs`",
            "units are written as m, kg, s, min, N, kW, deg, K, degC, bar, %",
        ),
    ],
)
def test_what_is_no_quantity_is_refused_with_the_mend(text: str, message: str, hint: str) -> None:
    with pytest.raises(UnitError) as caught:
        parse_quantity(text)
    assert (str(caught.value), caught.value.hint) == (message, hint)


@pytest.mark.parametrize(
    ("text", "unit", "message", "hint"),
    [
        ("5 s", "m", "5 s does not convert to m", "write it in m, or in a unit that converts to it"),
        ("5", "m", "5 does not convert to m", "write it in m, or in a unit that converts to it"),
        ("1e308 km", "m", "1e+308 km is beyond what a number in m can hold", ""),
        ("5 m", "", "5 m does not convert to a plain number", "write the number alone"),
    ],
)
def test_units_that_do_not_meet_are_refused(text: str, unit: str, message: str, hint: str) -> None:
    with pytest.raises(UnitError) as caught:
        parse_quantity(text).to(unit)
    assert (str(caught.value), caught.value.hint) == (message, hint)


def test_celsius_meets_only_itself() -> None:
    assert parse_quantity("20 degC").to("°C") == 20.0
    with pytest.raises(UnitError, match="20 degC does not convert to K") as caught:
        parse_quantity("20 degC").to("K")
    assert caught.value.hint.startswith("degC is a scale of its own")


@pytest.mark.parametrize(
    ("one", "other"),
    [("%/degC", "%/K"), ("degC/s", "K/s"), ("W/m2 degC", "W/m2 K"), ("degC2", "K2"), ("degC2", "degC K")],
)
def test_in_a_product_degrees_celsius_count_differences_as_kelvins_do(one: str, other: str) -> None:
    assert parse_unit(one).same_as(parse_unit(other))
    assert parse_quantity(f"3 {one}").to(other) == 3.0


def test_what_a_gain_per_kelvin_makes_of_a_temperature_in_celsius_has_no_temperature_left() -> None:
    made = parse_unit("%/K") * parse_unit("degC")
    assert made.same_as(parse_unit("%"))
    assert made.symbol == "%"
    assert (parse_unit("K/s") * parse_unit("s")).symbol == "K"
    assert (parse_unit("degC") / parse_unit("s") * parse_unit("s")).same_as(parse_unit("K"))


@pytest.mark.parametrize(
    ("text", "message"),
    [("5 m", "5 m is not a time"), ("0.5 ns", "0.5 ns is not a whole number of nanoseconds")],
)
def test_what_the_clock_cannot_count_is_refused(text: str, message: str) -> None:
    with pytest.raises(UnitError, match=message):
        nanoseconds(parse_quantity(text))


def test_the_page_on_units_says_of_each_what_it_is() -> None:
    rows = [row.strip("| ").split(" | ") for row in units_page().splitlines() if row.startswith("| `")]
    told = {row[0].strip("`"): row[2].replace("π/", f"{math.pi!r}/") for row in rows if len(row) > 2}
    assert set(told) == set(SYMBOLS)
    for symbol, written in told.items():
        number, _, base = written.partition(" ")
        numerator, _, denominator = number.partition("/")
        factor = float(numerator) / float(denominator or 1)
        assert Quantity(1.0, parse_unit(symbol)).to(base) == pytest.approx(factor, rel=1e-15)

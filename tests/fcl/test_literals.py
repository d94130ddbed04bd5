"""Literals of IEC 61131-3 B.1.2 (S14)."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.diagnostics import Source
from fcl_sim.fcl import scan
from fcl_sim.fcl.literals import LiteralError, number


def value(text):
    token, _ = scan(Source("t", text)).tokens
    return number(token)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("0", 0.0),
        ("1_000.25", 1000.25),
        ("1.5E-2", 0.015),
        ("1E1_0", 1e10),
        (".5", 0.5),
        ("5.", 5.0),
        ("2#1010_0101", 165.0),
        ("8#17", 15.0),
        ("16#fF", 255.0),
        ("4.800000000000001", 4.800000000000001),
    ],
)
def test_numbers_have_the_value_that_the_standard_gives_them(text, expected):
    assert value(text) == (expected, "")


@pytest.mark.parametrize(
    ("text", "expected", "type_name"),
    [
        ("REAL#1.5", 1.5, "REAL"),
        ("real#-1.5e1", -15.0, "REAL"),
        ("INT#-5", -5.0, "INT"),
        ("INT#16#0A", 10.0, "INT"),
        ("BOOL#1", 1.0, "BOOL"),
        ("BOOL#TRUE", 1.0, "BOOL"),
        ("bool#false", 0.0, "BOOL"),
    ],
)
def test_typed_literals_name_their_type(text, expected, type_name):
    assert value(text) == (expected, type_name)


@pytest.mark.parametrize(
    ("text", "message", "hint"),
    [
        ("1__0", "`1__0` is not a number", "an underscore stands between two digits"),
        ("1_", "`1_` is not a number", "an underscore stands between two digits"),
        ("1.2.3", "`1.2.3` is not a number", "a number has one decimal point"),
        ("5mm", "`5mm` is not a number", "a number has no unit and no letters"),
        ("0xFF", "`0xFF` is not a number", "a hexadecimal number is written 16#1F"),
        ("3#12", "`3#12` is not a number", "the bases are 2#, 8# and 16#"),
        ("8#9", "`8#9` has a digit that base 8 has not", ""),
        ("2#", "`2#` is not a number", "digits of the base follow #"),
        ("16#FG", "`16#FG` is not a number", "digits of the base follow #"),
        ("T#5s", "`T#5s` is a time or a date, not a number", ""),
        ("STRING#5", "`STRING` is not a data type that a number can have", ""),
        ("1E400", "`1E400` is too large for a number (the largest is 1.8E308)", ""),
    ],
)
def test_what_is_no_number_is_refused_with_its_reason(text, message, hint):
    with pytest.raises(LiteralError) as caught:
        value(text)
    assert (str(caught.value), caught.value.hint) == (message, hint)


@pytest.mark.parametrize("text", ["9" * 10_000, "16#" + "F" * 10_000])
def test_a_literal_of_ten_thousand_digits_is_too_large_and_not_a_crash(text):
    with pytest.raises(LiteralError, match="too large"):
        value(text)


@given(st.floats(min_value=0, allow_nan=False, allow_infinity=False))
def test_a_number_written_with_all_its_digits_is_read_back_exactly(number_written):
    read, _ = value(repr(number_written))
    assert read == number_written
    assert math.copysign(1, read) == 1


@given(st.integers(0, 2**53), st.sampled_from([(2, "b"), (8, "o"), (16, "X")]))
def test_based_integers_are_read_exactly(whole, base):
    assert value(f"{base[0]}#{whole:{base[1]}}") == (float(whole), "")

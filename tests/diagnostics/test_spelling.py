"""Nearest names."""

import pytest

from fcl_sim.diagnostics.spelling import listed, nearest

POWER = ("neg_high", "neg_medium", "zero", "pos_medium", "pos_high")


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("pos_big", "pos_high"),
        ("pos_hihg", "pos_high"),
        ("POS_HIGH", "pos_high"),
        ("zeor", "zero"),
        ("neg_med", "neg_medium"),
        ("warm", None),
        ("x", None),
    ],
)
def test_the_name_that_was_meant_is_found(name, meant):
    assert nearest(name, POWER) == meant


def test_without_names_there_is_none_near():
    assert nearest("zero", ()) is None


@pytest.mark.parametrize(
    ("names", "text"),
    [
        ([], ""),
        (["a"], "a"),
        (["a", "b"], "a or b"),
        (["a", "b", "c"], "a, b or c"),
        (list("abcdefgh"), "a, b, c, d, e, f, g or h"),
        (list("abcdefghij"), "a, b, c, d, e, f, g, h … (2 more)"),
    ],
)
def test_names_are_listed_as_one_says_them(names, text):
    assert listed(names) == text

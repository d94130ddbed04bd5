"""Values of words: BOOL, INT, REAL and the structures of degrees, between Python and a block's arrays."""

from collections.abc import Iterator
from math import isfinite
from operator import index
from typing import Any, NamedTuple

import numpy as np

from fcl_sim.arithmetic.integer import INT_LEAST, INT_MOST, fits_int

REAL_MOST = float(np.finfo(np.float32).max)


class FUZ_MD_INT(NamedTuple):  # noqa: N801  the manual's name
    """Degrees of up to nine terms in INT, and how many of them are used (p. 47)."""

    n: int = 0
    term1: int = 0
    term2: int = 0
    term3: int = 0
    term4: int = 0
    term5: int = 0
    term6: int = 0
    term7: int = 0
    term8: int = 0
    term9: int = 0


class FUZ_MD_REAL(NamedTuple):  # noqa: N801
    """Degrees of up to nine terms in REAL, and how many of them are used (p. 47)."""

    n: int = 0
    term1: float = 0.0
    term2: float = 0.0
    term3: float = 0.0
    term4: float = 0.0
    term5: float = 0.0
    term6: float = 0.0
    term7: float = 0.0
    term8: float = 0.0
    term9: float = 0.0


Value = bool | int | float | FUZ_MD_INT | FUZ_MD_REAL


def data_type(word: str, number: str) -> str:
    """Return BOOL, INT or REAL for a word of a block whose numbers are `number`."""
    if word == "ZERO_Y":
        return "BOOL"
    return "INT" if word == "MD.n" else number


def members(name: str, value: Any, number: str) -> Iterator[tuple[str, Any]]:
    """Yield the words of a structure and their values; TypeError for what is no FUZ_MD structure."""
    kind = FUZ_MD_INT if number == "INT" else FUZ_MD_REAL
    if not isinstance(value, kind):
        raise TypeError(f"{name} must be a {kind.__name__}, not {type(value).__name__}")
    for member, each in zip(kind._fields, value, strict=True):
        yield f"{name}.{member}", each


def number_of(word: str, value: Any, kind: str) -> float:
    """Return `value` as what a block's array holds; TypeError or ValueError says what does not fit."""
    if kind == "REAL":
        return _real(word, value)
    try:
        whole = index(value)
    except TypeError:
        raise TypeError(f"{word} must be {_called(kind)}, not {type(value).__name__}") from None
    if kind == "BOOL" and whole not in {0, 1}:
        raise ValueError(f"{word} is {whole}; a BOOL is 0 or 1")
    if not fits_int(whole):
        raise ValueError(f"{word} is {whole}; an INT lies in {INT_LEAST} .. {INT_MOST}")
    return whole


def _real(word: str, value: Any) -> float:
    try:
        finite = isfinite(value)
    except TypeError:
        raise TypeError(f"{word} must be a number, not {type(value).__name__}") from None
    except OverflowError:  # an int beyond every float
        finite = False
    if not finite:
        raise ValueError(f"{word} is {value}")
    if abs(value) > REAL_MOST:
        raise ValueError(f"{word} is {value}; a REAL reaches to {REAL_MOST:g}")
    return float(value)


def _called(kind: str) -> str:
    return "True or False" if kind == "BOOL" else "a whole number"


def value_of(number: float, kind: str) -> bool | int | float:
    """Return what a block's array holds as a value of its data type."""
    if kind == "BOOL":
        return bool(number)
    return int(number) if kind == "INT" else float(number)

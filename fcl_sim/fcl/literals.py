"""Numeric literals → numbers (IEC 61131-3 B.1.2, S14)."""

import math
import re

from fcl_sim.fcl.tokens import Kind, Token
from fcl_sim.model import DataType

_TYPES = frozenset(DataType)
_DURATIONS = frozenset(("T", "TIME", "LT", "LTIME", "D", "DATE", "TOD", "DT", "TIME_OF_DAY", "DATE_AND_TIME"))
_DIGITS = r"\d+(?:_\d+)*"
_DECIMAL = re.compile(
    rf"[+-]?(?:{_DIGITS}\.?(?:{_DIGITS})?|\.{_DIGITS})(?:[eE][+-]?{_DIGITS})?",
    re.ASCII,
)
_BASED = re.compile(r"(2|8|16)#([0-9A-Fa-f]+(?:_[0-9A-Fa-f]+)*)", re.ASCII)
_BOOLEANS = {"TRUE": 1.0, "FALSE": 0.0}


class LiteralError(ValueError):
    """A literal that is none; the message says why, `hint` what would be right."""

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.hint = hint


def number(token: Token) -> tuple[float, str]:
    """Return the value of a literal and the type that it names, in capitals, or an empty text.

    Raise `LiteralError` for a word that is no number, or one beyond binary64.
    """
    head, _, tail = token.text.partition("#")
    if token.kind is Kind.LITERAL and not head[0].isdigit():
        return _typed(token, head.upper(), tail)
    return _untyped(token, token.text), ""


def _typed(token: Token, type_name: str, body: str) -> tuple[float, str]:
    if type_name in _DURATIONS:
        raise LiteralError(f"{token.shown} is a time or a date, not a number")
    if type_name not in _TYPES:
        raise LiteralError(f"`{type_name}` is not a data type that a number can have")
    if type_name == "BOOL" and body.upper() in _BOOLEANS:
        return _BOOLEANS[body.upper()], type_name
    return _untyped(token, body), type_name


def _untyped(token: Token, text: str) -> float:
    if _DECIMAL.fullmatch(text):
        value = float(text)
    else:
        sign = -1.0 if text.startswith("-") else 1.0
        value = sign * _based(token, text.lstrip("+-"))
    if math.isinf(value):
        raise LiteralError(f"{token.shown} is too large for a number (the largest is 1.8E308)")
    return value


def _based(token: Token, text: str) -> float:
    match = _BASED.fullmatch(text)
    if match:
        base, digits = int(match[1]), match[2].replace("_", "")
        try:
            return float(int(digits, base))
        except OverflowError:
            return math.inf
        except ValueError:
            raise LiteralError(f"{token.shown} has a digit that base {base} has not") from None
    head, mark, _ = text.partition("#")
    if mark and head not in {"2", "8", "16"}:
        raise LiteralError(f"{token.shown} is not a number", "the bases are 2#, 8# and 16#")
    raise LiteralError(
        f"{token.shown} is not a number", "digits of the base follow #" if mark else _advice(text)
    )


def _advice(text: str) -> str:
    if text[:2] in {"0x", "0X"}:
        return "a hexadecimal number is written 16#1F"
    if "_" in text:
        return "an underscore stands between two digits"
    if text.count(".") > 1:
        return "a number has one decimal point"
    if text[:1].isdigit():
        return "a number has no unit and no letters"
    return ""

"""Numbers, and names that stand for numbers."""

from fcl_sim.fcl.cursor import Astray, Cursor
from fcl_sim.fcl.literals import LiteralError
from fcl_sim.fcl.literals import number as literal_number
from fcl_sim.fcl.tokens import Kind, Token
from fcl_sim.fcl.tree import Number, Value

_LITERALS = (Kind.NUMBER, Kind.LITERAL, Kind.MIXED)
_BOOLEANS = {"TRUE": 1.0, "FALSE": 0.0}
_AFTER_VALUE = frozenset((",", ")", ";", ".."))


def value(cursor: Cursor, what: str) -> Value:
    """Read `value ::= numeric_literal | variable_name`."""
    if cursor.token.kind is Kind.NAME:
        return cursor.name(what, _AFTER_VALUE)
    return number(cursor, what)


def number(cursor: Cursor, what: str) -> Number:
    """Read `numeric_literal ::= ['+' | '-'] (integer_literal | real_literal)` (IEC 61131-3 B.1.2.1)."""
    start = cursor.token.start
    sign = cursor.take("-") or cursor.take("+")
    if cursor.token.kind not in _LITERALS:
        raise cursor.stray(f"{what} is expected")
    token = cursor.advance()
    magnitude, type_name = _convert(cursor, token)
    signed = -magnitude if sign is not None and sign.key == "-" else magnitude
    return Number(signed, start, token.end, type_name)


def constant(cursor: Cursor, what: str) -> Number:
    """Read `constant ::= numeric_literal | 'TRUE' | 'FALSE'` (IEC 61131-3 B.1.2)."""
    token = cursor.token
    if token.key in _BOOLEANS:
        cursor.advance()
        return Number(_BOOLEANS[token.key], token.start, token.end, "BOOL")
    return number(cursor, what)


def _convert(cursor: Cursor, token: Token) -> tuple[float, str]:
    try:
        return literal_number(token)
    except LiteralError as error:
        cursor.findings.error("FCL113", str(error), token, hint=error.hint)
        raise Astray from None

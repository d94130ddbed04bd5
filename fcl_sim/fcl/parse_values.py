"""Numbers, and names that stand for numbers."""

import math

from fcl_sim.fcl.cursor import Astray, Cursor
from fcl_sim.fcl.literals import LiteralError
from fcl_sim.fcl.literals import number as literal_number
from fcl_sim.fcl.tokens import Kind, Token
from fcl_sim.fcl.tree import Number, Value

_LITERALS = (Kind.NUMBER, Kind.LITERAL, Kind.MIXED)
_BOOLEANS = {"TRUE": 1.0, "FALSE": 0.0}
EXTREMES = {"INF": math.inf, "INFINITY": math.inf, "NAN": math.nan}
"""What stands for no finite number (S15): names where a variable can be meant and is declared (S1a)."""
_AFTER_VALUE = frozenset((",", ")", ";", ".."))


def value(cursor: Cursor, what: str) -> Value:
    """Read `value ::= numeric_literal | variable`."""
    if cursor.token.kind is Kind.NAME:
        return variable(cursor, what, _AFTER_VALUE)
    return number(cursor, what)


def at_value(token: Token) -> bool:
    """Return whether `token` can begin a value."""
    return token.kind is Kind.NAME or token.kind in _LITERALS or token.key in {"-", "+"}


def variable(cursor: Cursor, what: str, follow: frozenset[str] = frozenset()) -> Token:
    """Read `variable ::= variable_name ['.' member_name]`: a member is a variable of its own (S7).

    Return one token for the whole of it.
    """
    name = cursor.name(what, follow | {"."})
    if cursor.token.key != "." or cursor.ahead().kind is not Kind.NAME:
        return name
    cursor.advance()
    member = cursor.advance()
    text = f"{name.text}.{member.text}"
    return Token(Kind.NAME, text, text.upper(), name.start)


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


def limit(cursor: Cursor, what: str) -> Number:
    """Read `limit ::= numeric_literal | ['+' | '-'] ('INF' | 'NAN')`; the latter are fuzzylite's (S15)."""
    token = cursor.token
    if not at_extreme(cursor):
        return number(cursor, what)
    if token.kind is not Kind.NAME:
        cursor.advance()
    extreme = EXTREMES[cursor.advance().key]
    return Number(-extreme if token.key == "-" else extreme, token.start, cursor.last.end)


def at_extreme(cursor: Cursor) -> bool:
    """Return whether infinity or NaN comes next, with or without a sign."""
    signed = cursor.token.key in {"-", "+"}
    return (cursor.ahead() if signed else cursor.token).key in EXTREMES


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

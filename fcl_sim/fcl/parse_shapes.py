"""Membership functions by name, in the spellings of both families (Open Level, S15)."""

from collections.abc import Sequence
from itertools import pairwise

from fcl_sim.fcl.cursor import Cursor
from fcl_sim.fcl.parse_expressions import expression
from fcl_sim.fcl.parse_values import at_extreme, at_value, limit, value
from fcl_sim.fcl.tokens import Kind
from fcl_sim.fcl.tree import Formula, Named, Value

_OF_PAIRS = frozenset(("SINGLETONS", "DISCRETE"))
_PARAMETER = "a parameter, a number or the name of a variable,"


def at_shape(cursor: Cursor) -> bool:
    """Return whether a name comes next, and what could be its parameters."""
    following = cursor.ahead()
    return following.key == "(" or (at_value(following) and not cursor.at_statement(1))


def shape(cursor: Cursor) -> Named | Formula:
    """Read `shape ::= 'FUNCTION' expression | shape_name group {[','] group}` (S15).

    Which shapes there are is the resolver's knowledge. In fuzzylite's `Function`
    LOG is the natural logarithm.
    """
    name = cursor.advance()
    if name.key == "FUNCTION":
        made = expression(cursor, natural=name.text == "Function")
        return Formula(name, made, cursor.last.end)
    values = [*_group(cursor)]
    while (
        cursor.take(",") or cursor.token.key == "(" or (at_value(cursor.token) and not cursor.at_statement())
    ):
        values += _group(cursor)
    if name.key not in _OF_PAIRS:
        _refuse_decimal_comma(cursor, values)
    return Named(name, tuple(values), cursor.last.end)


def _refuse_decimal_comma(cursor: Cursor, values: Sequence[Value]) -> None:
    """Refuse numbers that a comma joins where blanks part the others: `0,25 0,5` would be four."""
    gaps = [cursor.source.text[before.end : after.start] for before, after in pairwise(values)]
    if "," in gaps and any(not gap.strip() for gap in gaps):
        raise cursor.refuse(
            "FCL212",
            "these parameters are parted by blanks and by commas",
            cursor.since(values[0].start),
            hint="a decimal fraction is written with a point: 0.5",
        )


def _group(cursor: Cursor) -> list[Value]:
    """Read `group ::= parameter | '(' parameter {[','] parameter} ')'`."""
    if not cursor.take("("):
        return [_parameter(cursor)]
    values = [_parameter(cursor)]
    while cursor.take(",") or at_value(cursor.token):
        values.append(_parameter(cursor))
    if not cursor.take(")"):
        raise cursor.stray("`)` is expected behind the parameters", code="FCL207")
    return values


def _parameter(cursor: Cursor) -> Value:
    """Read `parameter ::= value | limit`; whether INF is a variable is the resolver's knowledge (S1a)."""
    if cursor.token.kind is not Kind.NAME and at_extreme(cursor):
        return limit(cursor, _PARAMETER)
    return value(cursor, _PARAMETER)

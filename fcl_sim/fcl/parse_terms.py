"""TERM: linguistic terms and their membership functions (5.2.2, 5.2.3)."""

from fcl_sim.fcl.cursor import Astray, Cursor
from fcl_sim.fcl.parse_shapes import at_shape, shape
from fcl_sim.fcl.parse_values import value
from fcl_sim.fcl.tokens import Kind
from fcl_sim.fcl.tree import Pair, Shape, Term

_AFTER_NAME = frozenset((":=", ":", "="))


def term(cursor: Cursor) -> Term:
    """Read `linguistic_term ::= 'TERM' term_name ':=' membership_function ';'` (5.4.1).

    A term whose membership function cannot be read keeps its name.
    """
    cursor.advance()
    name = cursor.name("the name of a term", _AFTER_NAME)
    try:
        cursor.expect(":=", "the name of the term", instead=(":", "="))
        function = membership_function(cursor)
        cursor.end_statement()
    except Astray:
        cursor.skip_statement()
        return Term(name, None)
    return Term(name, function)


def membership_function(cursor: Cursor) -> Shape:
    """Read `membership_function ::= points | value | shape` (5.4.1, S15)."""
    what = "a point in parentheses, a number or the name of a variable"
    if cursor.token.key == "(":
        return points(cursor)
    if cursor.at_statement():
        raise cursor.stray(f"{what} is expected", code="FCL209")
    if cursor.token.kind is Kind.NAME and at_shape(cursor):
        return shape(cursor)
    return value(cursor, what)


def points(cursor: Cursor) -> tuple[Pair, ...]:
    """Read `points ::= point {[','] point}`; the comma is optional (S2)."""
    pairs = [point(cursor)]
    while cursor.token.key in {",", "("}:
        cursor.take(",")
        pairs.append(point(cursor))
    return tuple(pairs)


def point(cursor: Cursor) -> Pair:
    """Read `point ::= '(' value ',' value ')'` (5.2.2)."""
    opening = cursor.token
    if not cursor.take("("):
        raise cursor.stray("a point in parentheses is expected")
    x = value(cursor, "the abscissa of a point, a number or the name of a variable,")
    cursor.expect(",", "the abscissa of the point", instead=(";",))
    degree = value(cursor, "the degree of membership of a point, a number from 0 to 1,")
    if cursor.token.key == "," and cursor.ahead().kind is Kind.NUMBER:
        _refuse_decimal_comma(cursor, opening.start)
    if not cursor.take(")"):
        raise cursor.stray("`)` is expected at the end of the point", code="FCL207")
    return Pair(x, degree, opening.start, cursor.last.end)


def _refuse_decimal_comma(cursor: Cursor, start: int) -> None:
    while cursor.token.key == "," or cursor.token.kind is Kind.NUMBER:
        cursor.advance()
    cursor.take(")")
    raise cursor.refuse(
        "FCL212",
        "a point has an abscissa and a degree, no more",
        cursor.since(start),
        hint="a decimal fraction is written with a point: 0.5",
    )

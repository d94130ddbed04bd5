"""Settings: a keyword, a colon, and what is chosen (5.2.3, 5.2.4, 5.4.1)."""

from fcl_sim.fcl.cursor import Astray, Cursor
from fcl_sim.fcl.parse_values import at_extreme, limit
from fcl_sim.fcl.tokens import Kind, Token
from fcl_sim.fcl.tree import Default, Flags, Number, Range, Setting


def choice(cursor: Cursor, key: str, what: str, also: tuple[str, ...] = ()) -> Setting:
    """Read a choice by keyword (5.4.1). Which algorithms there are is the resolver's knowledge.

    `defuzzification_method ::= 'METHOD' ':' algorithm ';'`

    `activation_method ::= 'ACT' ':' algorithm ';'`

    `accumulation_method ::= 'ACCU' ':' algorithm ';'`

    `enabled ::= 'ENABLED' ':' ('TRUE' | 'FALSE') ';'`

    `operator_definition ::= 'AND' ':' algorithm (';' | 'OR' ':' algorithm ';')
    | 'OR' ':' algorithm (';' | 'AND' ':' algorithm ';')`: a keyword of `also` may
    follow without a semicolon (S10).
    """
    keyword = cursor.advance()
    try:
        cursor.expect(":", key, instead=(":=", "="))
        chosen = cursor.name(what, frozenset((";",)))
        if cursor.token.key not in also:
            cursor.end_statement()
    except Astray:
        return _unread(cursor, key, keyword)
    return Setting(key, keyword, chosen)


def default_value(cursor: Cursor) -> Setting:
    """Read a default value (5.4.1, S15).

    `default_value ::= 'DEFAULT' ':=' ('NC' | (numeric_literal | 'NAN') ['|' 'NC']) ';'`
    """
    keyword = cursor.advance()
    try:
        cursor.expect(":=", "DEFAULT", instead=(":", "="))
        chosen = _default(cursor)
        cursor.end_statement()
    except Astray:
        return _unread(cursor, "DEFAULT", keyword)
    return Setting("DEFAULT", keyword, chosen)


def _default(cursor: Cursor) -> Token | Number | Default:
    token = cursor.token
    if token.kind is Kind.NAME and not at_extreme(cursor):
        cursor.advance()
        if token.key != "NC":
            message = f"a number or NC is expected after DEFAULT, not {token.shown}"
            raise cursor.refuse("FCL201", message, token)
        return token
    found = limit(cursor, "a number or NC")
    if not cursor.take("|"):
        return found
    if not cursor.take("NC"):
        raise cursor.stray("NC is expected after `|`")
    return Default(found)


def output_range(cursor: Cursor) -> Setting:
    """Read `range ::= 'RANGE' limits ';'` (5.2.3, 5.4.1, S3)."""
    keyword = cursor.advance()
    try:
        found = limits(cursor)
        cursor.end_statement()
    except Astray:
        return _unread(cursor, "RANGE", keyword)
    return Setting("RANGE", keyword, found)


def limits(cursor: Cursor) -> Range:
    """Read `limits ::= [':='] '(' limit '..' limit ')' | ':=' limit '..' limit` (S3)."""
    if cursor.token.key != "(":
        cursor.expect(":=", "RANGE", instead=(":", "="))
    opened = cursor.take("(")
    low = limit(cursor, "the lower limit of the range, a number,")
    cursor.expect("..", "the lower limit", instead=(",",))
    high = limit(cursor, "the upper limit of the range, a number,")
    if opened is not None:
        cursor.expect(")", "the upper limit")
    return Range(low, high)


def lock(cursor: Cursor) -> Setting:
    """Read `lock ::= 'LOCK' ':' flag {'|' flag} ';'` (S15).

    `flag ::= 'PREVIOUS' | 'VALID' | 'RANGE'`; VALID is that of older files.
    """
    keyword = cursor.advance()
    try:
        cursor.expect(":", "LOCK", instead=(":=", "="))
        words = [cursor.name("PREVIOUS or RANGE")]
        while cursor.take("|") or cursor.take(","):
            words.append(cursor.name("PREVIOUS or RANGE"))
        cursor.end_statement()
    except Astray:
        return _unread(cursor, "LOCK", keyword)
    return Setting("LOCK", keyword, Flags(tuple(words)))


def _unread(cursor: Cursor, key: str, keyword: Token) -> Setting:
    cursor.skip_statement()
    return Setting(key, keyword, None)

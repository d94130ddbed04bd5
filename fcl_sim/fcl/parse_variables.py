"""FUZZIFY and DEFUZZIFY (5.2.2, 5.2.3)."""

from fcl_sim.fcl.cursor import Astray, Cursor
from fcl_sim.fcl.parse_terms import term
from fcl_sim.fcl.parse_values import number
from fcl_sim.fcl.sections import statements
from fcl_sim.fcl.tokens import Kind, Token
from fcl_sim.fcl.tree import Defuzzify, Fuzzify, Range, Setting, Term

_AFTER_NAME = frozenset(("TERM", "METHOD", "END_FUZZIFY", "END_DEFUZZIFY"))


def fuzzify(cursor: Cursor) -> Fuzzify:
    """Read `fuzzify_block ::= 'FUZZIFY' variable_name {linguistic_term} 'END_FUZZIFY'` (5.4.1)."""
    opening = cursor.advance()
    variable = section_name(cursor, "the name of an input variable")
    terms: list[Term] = []
    damaged = statements(
        cursor,
        opening,
        "END_FUZZIFY",
        {"TERM": lambda at: terms.append(term(at)), "RANGE": _refuse_range},
    )
    damaged = damaged or variable is None
    return Fuzzify(opening=opening, variable=variable, terms=tuple(terms), damaged=damaged)


def defuzzify(cursor: Cursor) -> Defuzzify:
    """Read `defuzzify_block ::= 'DEFUZZIFY' f_variable_name {statement} 'END_DEFUZZIFY'` (5.4.1).

    `statement ::= range | linguistic_term | defuzzification_method | default_value`, in any order (S3).
    """
    opening = cursor.advance()
    variable = section_name(cursor, "the name of an output variable")
    terms: list[Term] = []
    settings: list[Setting] = []
    damaged = statements(
        cursor,
        opening,
        "END_DEFUZZIFY",
        {
            "RANGE": lambda at: settings.append(output_range(at)),
            "TERM": lambda at: terms.append(term(at)),
            "METHOD": lambda at: settings.append(choice(at, "METHOD", "a method of defuzzification")),
            "DEFAULT": lambda at: settings.append(default_value(at)),
            "ACCU": _refuse_accumulation,
        },
    )
    return Defuzzify(
        opening=opening,
        variable=variable,
        terms=tuple(terms),
        settings=tuple(settings),
        damaged=damaged or variable is None,
    )


def section_name(cursor: Cursor, what: str) -> Token | None:
    """Return the name behind a section's keyword, or None, once that has been reported."""
    try:
        name = cursor.name(what, _AFTER_NAME)
    except Astray:
        cursor.skip_line()
        return None
    cursor.take(";")
    return name


def choice(cursor: Cursor, key: str, what: str, also: tuple[str, ...] = ()) -> Setting:
    """Read `choice ::= keyword ':' keyword ';'` for METHOD, AND, OR, ACT and ACCU (5.4.1).

    Which algorithms there are is the resolver's knowledge. A keyword of `also`
    may follow without a semicolon (S10).
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
    """Read `default_value ::= 'DEFAULT' ':=' (numeric_literal | 'NC') ';'` (5.4.1)."""
    keyword = cursor.advance()
    try:
        cursor.expect(":=", "DEFAULT", instead=(":", "="))
        chosen = cursor.advance() if cursor.token.kind is Kind.NAME else number(cursor, "a number or NC")
        if isinstance(chosen, Token) and chosen.key != "NC":
            raise _refused_default(cursor, chosen)
        cursor.end_statement()
    except Astray:
        return _unread(cursor, "DEFAULT", keyword)
    return Setting("DEFAULT", keyword, chosen)


def output_range(cursor: Cursor) -> Setting:
    """Read `range ::= 'RANGE' [':='] '(' numeric_literal '..' numeric_literal ')' ';'` (5.2.3, 5.4.1, S3)."""
    keyword = cursor.advance()
    try:
        if cursor.token.key != "(":
            cursor.expect(":=", "RANGE", instead=(":", "="))
        cursor.expect("(", "RANGE")
        low = number(cursor, "the lower limit of the range, a number,")
        cursor.expect("..", "the lower limit", instead=(",",))
        high = number(cursor, "the upper limit of the range, a number,")
        cursor.expect(")", "the upper limit")
        cursor.end_statement()
    except Astray:
        return _unread(cursor, "RANGE", keyword)
    return Setting("RANGE", keyword, Range(low, high))


def _unread(cursor: Cursor, key: str, keyword: Token) -> Setting:
    cursor.skip_statement()
    return Setting(key, keyword, None)


def _refused_default(cursor: Cursor, chosen: Token) -> Astray:
    if chosen.key == "NAN":
        return cursor.refuse("FCL290", "NaN as a default value is not read by this version", chosen)
    return cursor.refuse("FCL201", f"a number or NC is expected after DEFAULT, not {chosen.shown}", chosen)


def _refuse_range(cursor: Cursor) -> None:
    raise cursor.refuse("FCL290", "RANGE of an input is not read by this version", cursor.advance())


def _refuse_accumulation(cursor: Cursor) -> None:
    raise cursor.refuse(
        "FCL290",
        "ACCU of a single output is not read by this version",
        cursor.advance(),
        hint="write ACCU in the rule block (5.2.4)",
    )

"""FUZZIFY and DEFUZZIFY (5.2.2, 5.2.3)."""

from fcl_sim.fcl.cursor import Astray, Cursor
from fcl_sim.fcl.keywords import SETTINGS
from fcl_sim.fcl.parse_settings import choice, default_value, lock, output_range
from fcl_sim.fcl.parse_terms import term
from fcl_sim.fcl.parse_values import variable
from fcl_sim.fcl.sections import statements
from fcl_sim.fcl.tokens import Token
from fcl_sim.fcl.tree import Defuzzify, Fuzzify, Setting, Term

_AFTER_NAME = frozenset(("TERM", "METHOD", "END_FUZZIFY", "END_DEFUZZIFY"))


def fuzzify(cursor: Cursor) -> Fuzzify:
    """Read `fuzzify_block ::= 'FUZZIFY' variable {fuzzify_statement} 'END_FUZZIFY'` (5.4.1).

    `fuzzify_statement ::= linguistic_term | range | lock | enabled`; all but the first are Open Level.
    """
    opening = cursor.advance()
    name = section_name(cursor, "the name of an input variable")
    terms: list[Term] = []
    settings: list[Setting] = []
    damaged = statements(
        cursor,
        opening,
        "END_FUZZIFY",
        {
            "TERM": lambda at: terms.append(term(at)),
            "RANGE": lambda at: settings.append(output_range(at)),
            "LOCK": lambda at: settings.append(lock(at)),
            "ENABLED": lambda at: settings.append(choice(at, "ENABLED", "TRUE or FALSE")),
        },
    )
    return Fuzzify(
        opening=opening,
        variable=name,
        terms=tuple(terms),
        settings=tuple(settings),
        damaged=damaged or name is None,
    )


def defuzzify(cursor: Cursor) -> Defuzzify:
    """Read `defuzzify_block ::= 'DEFUZZIFY' variable {defuzzify_statement} 'END_DEFUZZIFY'` (5.4.1).

    `defuzzify_statement ::= linguistic_term | range | defuzzification_method | default_value
    | accumulation_method | lock | enabled`, in any order (S3, S8); the last two are Open Level.
    """
    opening = cursor.advance()
    name = section_name(cursor, "the name of an output variable")
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
            "ACCU": lambda at: settings.append(choice(at, "ACCU", "a method of accumulation")),
            "LOCK": lambda at: settings.append(lock(at)),
            "ENABLED": lambda at: settings.append(choice(at, "ENABLED", "TRUE or FALSE")),
        },
    )
    return Defuzzify(
        opening=opening,
        variable=name,
        terms=tuple(terms),
        settings=tuple(settings),
        damaged=damaged or name is None,
    )


def section_name(cursor: Cursor, what: str) -> Token | None:
    """Return the name behind a section's keyword, or None, once that has been reported."""
    try:
        if cursor.ahead().key in SETTINGS.get(cursor.token.key, ()):
            raise cursor.stray(f"{what} is expected", code="FCL209")
        name = variable(cursor, what, _AFTER_NAME)
    except Astray:
        cursor.skip_line()
        return None
    cursor.take(";")
    return name

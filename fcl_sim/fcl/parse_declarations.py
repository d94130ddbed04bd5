"""VAR_INPUT, VAR_OUTPUT and VAR (5.2.1; IEC 61131-3 B.1.4.3)."""

from fcl_sim.fcl.cursor import Astray, Cursor
from fcl_sim.fcl.keywords import ENDS, SECTIONS
from fcl_sim.fcl.parse_values import constant
from fcl_sim.fcl.sections import closes
from fcl_sim.fcl.tokens import Kind, Token
from fcl_sim.fcl.tree import Declaration, Declarations, Number

OTHER_KINDS = frozenset(("VAR_IN_OUT", "VAR_EXTERNAL", "VAR_GLOBAL", "VAR_TEMP"))

_QUALIFIERS = frozenset(("RETAIN", "NON_RETAIN", "CONSTANT"))
_AFTER_NAME = frozenset((":", ","))
_NO_NAMES = ENDS | SECTIONS | {"FUNCTION_BLOCK"}


def declarations(cursor: Cursor) -> Declarations:
    """Read `declarations ::= ('VAR_INPUT' | 'VAR_OUTPUT' | 'VAR') [qualifier] {declaration} 'END_VAR'`."""
    opening = cursor.advance()
    if opening.key in OTHER_KINDS:
        cursor.findings.error(
            "FCL219",
            f"a fuzzy function block has no {opening.key}",
            opening,
            hint="its interface is VAR_INPUT and VAR_OUTPUT, its own variables stand in VAR (5.2.1)",
        )
    _qualifier(cursor)
    variables: list[Declaration] = []
    damaged = False
    while _is_declared(cursor) or not closes(cursor, opening, "END_VAR"):
        if cursor.take(";"):
            continue
        before = cursor.token
        try:
            variables += _declaration(cursor)
        except Astray:
            damaged = True
            cursor.leave(before)
            _skip(cursor)
    return Declarations(opening=opening, variables=tuple(variables), damaged=damaged or cursor.at_early_end())


def _qualifier(cursor: Cursor) -> None:
    token = cursor.token
    if token.key in _QUALIFIERS and not _is_declared(cursor):
        cursor.findings.warning("FCL220", f"{token.key} has no effect here", token)
        cursor.advance()


def _is_declared(cursor: Cursor) -> bool:
    """Return whether a name comes next even if it looks like a keyword."""
    return cursor.token.kind is Kind.NAME and cursor.ahead().key in _AFTER_NAME


def _declaration(cursor: Cursor) -> list[Declaration]:
    """Read `declaration ::= variable_name {',' variable_name} ':' data_type [':=' constant] ';'`."""
    names = [cursor.name("the name of a variable", _AFTER_NAME, begins=True)]
    while cursor.take(","):
        names.append(cursor.name("the name of a variable", _AFTER_NAME))
    type_name: Token | None = None
    initial: Number | None = None
    try:
        cursor.expect(":", "the name of the variable", instead=(":=", "="))
        if _is_declared(cursor):
            raise cursor.stray("a data type is expected", code="FCL209")
        type_name = cursor.name("a data type")
        if cursor.token.key in {":=", ":", "="}:
            cursor.expect(":=", "the data type", instead=(":", "="))
            initial = constant(cursor, "an initial value")
        if cursor.token.key == "RANGE":
            raise cursor.refuse("FCL290", "RANGE in a declaration is not read by this version", cursor.token)
        cursor.end_statement(begins=_is_declared(cursor))
    except Astray:
        _skip(cursor)
    return [Declaration(name, type_name, initial) for name in names]


def _skip(cursor: Cursor) -> None:
    """Go on behind the next `;`, or before the next declaration or section."""
    while cursor.token.kind is not Kind.END:
        begins = cursor.starts_line() and _is_declared(cursor)
        if cursor.take(";") or begins or cursor.token.key in _NO_NAMES:
            return
        cursor.advance()

"""VAR_INPUT, VAR_OUTPUT and VAR (5.2.1; IEC 61131-3 B.1.4.3)."""

from dataclasses import replace

from fcl_sim.fcl.cursor import Astray, Cursor
from fcl_sim.fcl.keywords import ENDS, SECTIONS
from fcl_sim.fcl.parse_settings import limits
from fcl_sim.fcl.parse_values import constant
from fcl_sim.fcl.sections import closes
from fcl_sim.fcl.tokens import Kind, Token
from fcl_sim.fcl.tree import Declaration, Declarations, Number, Range, Structure

OTHER_KINDS = frozenset(("VAR_IN_OUT", "VAR_EXTERNAL", "VAR_GLOBAL", "VAR_TEMP"))

_QUALIFIERS = frozenset(("RETAIN", "NON_RETAIN", "CONSTANT"))
_AFTER_NAME = frozenset((":", ","))
_NO_NAMES = ENDS | SECTIONS | {"FUNCTION_BLOCK"}
_NO_MEMBER = (ENDS | SECTIONS | {"FUNCTION_BLOCK"}) - {"END_STRUCT"}
_RANGES = frozenset((":=", "("))


def declarations(cursor: Cursor) -> Declarations:
    """Read a section of variables, with a qualifier or without.

    `declarations ::= ('VAR_INPUT' | 'VAR_OUTPUT' | 'VAR') {declaration ['RANGE' limits ';']} 'END_VAR'`
    """
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
    last = 0
    damaged = False
    while _is_declared(cursor) or not closes(cursor, opening, "END_VAR"):
        if cursor.take(";"):
            continue
        before = cursor.token
        try:
            if _at_range(cursor):
                _later_range(cursor, variables, last)
            else:
                last = len(variables)
                variables += declaration(cursor)
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


def _at_range(cursor: Cursor) -> bool:
    return cursor.token.key == "RANGE" and cursor.ahead().key in _RANGES


def _later_range(cursor: Cursor, variables: list[Declaration], last: int) -> None:
    """Read a range that stands behind the semicolon of its declaration, as jFuzzyLogic has it.

    It belongs to the variables from `last` on.
    """
    keyword = cursor.advance()
    if last == len(variables):
        hint = "RANGE stands behind the declaration that it belongs to"
        raise cursor.refuse("FCL204", "there is no declaration before this RANGE", keyword, hint)
    if variables[last].range is not None:
        raise cursor.refuse("FCL333", "RANGE is given twice", keyword)
    found = limits(cursor)
    cursor.end_statement(begins=_is_declared(cursor))
    variables[last:] = [replace(each, range=found) for each in variables[last:]]


def declaration(cursor: Cursor, *, member: bool = False) -> list[Declaration]:
    """Read the declaration of one variable or more; a `member` of a structure is no structure.

    `declaration ::= variable_name {',' variable_name} ':' (data_type | unnamed_structure)
    ['(' limit '..' limit ')'] [':=' constant] ['RANGE' limits] ';'`
    """
    names = [cursor.name("the name of a variable", _AFTER_NAME, begins=True)]
    while cursor.take(","):
        names.append(cursor.name("the name of a variable", _AFTER_NAME))
    type_name: Token | Structure | None = None
    initial: Number | None = None
    found: Range | None = None
    try:
        cursor.expect(":", "the name of the variable", instead=(":=", "="))
        if _is_declared(cursor):
            raise cursor.stray("a data type is expected", code="FCL209")
        type_name = _type(cursor, member=member)
        if cursor.token.key == "(":
            found = limits(cursor)
        if cursor.token.key in {":=", ":", "="}:
            cursor.expect(":=", "the data type", instead=(":", "="))
            initial = constant(cursor, "an initial value")
        if _at_range(cursor):
            cursor.advance()
            found = limits(cursor)
        cursor.end_statement(begins=_is_declared(cursor))
    except Astray:
        _skip(cursor)
    return [Declaration(name, type_name, initial, found) for name in names]


def _ends(cursor: Cursor) -> bool:
    return cursor.token.key == "END_STRUCT" or cursor.token.key in _NO_MEMBER


def _type(cursor: Cursor, *, member: bool) -> Token | Structure:
    if cursor.token.key != "STRUCT":
        return cursor.name("a data type")
    if not member:
        return structure(cursor)
    keyword = cursor.token
    depth = 0
    while not (cursor.token.kind is Kind.END or cursor.token.key in _NO_MEMBER):
        depth += {"STRUCT": 1, "END_STRUCT": -1}.get(cursor.advance().key, 0)
        if depth == 0:
            break
    hint = "members of structures are numbers"
    raise cursor.refuse("FCL305", "a structure stands within a structure", keyword, hint)


def structure(cursor: Cursor, name: Token | None = None) -> Structure:
    """Read a structure; its `name` is what stands before the colon, if anything does (S7).

    `structure ::= 'STRUCT' type_name [';'] {declaration} 'END_STRUCT'` (Annex D)

    `unnamed_structure ::= 'STRUCT' {declaration} 'END_STRUCT'` (IEC 61131-3 B.1.3.3)
    """
    keyword = cursor.advance()
    if name is None and cursor.token.kind is Kind.NAME and not (_is_declared(cursor) or _ends(cursor)):
        name = cursor.advance()
        cursor.take(";")
    members: list[Declaration] = []
    while _is_declared(cursor) or not closes(cursor, keyword, "END_STRUCT", _NO_MEMBER):
        if cursor.take(";"):
            continue
        before = cursor.token
        try:
            members += declaration(cursor, member=True)
        except Astray:
            cursor.leave(before)
            _skip(cursor)
    return Structure(keyword, name, tuple(members))


def _skip(cursor: Cursor) -> None:
    """Go on behind the next `;`, or before the next declaration or section."""
    while cursor.token.kind is not Kind.END:
        begins = cursor.starts_line() and _is_declared(cursor)
        if cursor.take(";") or begins or cursor.token.key in _NO_NAMES:
            return
        cursor.advance()

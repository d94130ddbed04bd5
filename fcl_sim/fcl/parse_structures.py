"""TYPE: structure types (Annex D; IEC 61131-3 B.1.3.3; S7)."""

from fcl_sim.fcl.cursor import Astray, Cursor
from fcl_sim.fcl.parse_declarations import structure
from fcl_sim.fcl.sections import closes
from fcl_sim.fcl.tree import Structure, Structures


def structures(cursor: Cursor) -> Structures:
    """Read `types ::= 'TYPE' {type} 'END_TYPE' | structure [';']` (S7).

    `type ::= structure [';'] | type_name ':' unnamed_structure [';']`: Annex D
    has the name behind STRUCT, its committee draft has no TYPE.
    """
    opening = cursor.token
    if opening.key == "STRUCT":
        found = structure(cursor)
        cursor.take(";")
        return Structures(opening=opening, structures=(found,), damaged=cursor.at_early_end())
    cursor.advance()
    types: list[Structure] = []
    damaged = False
    while not closes(cursor, opening, "END_TYPE"):
        if cursor.take(";"):
            continue
        before = cursor.token
        try:
            types.append(_type(cursor))
        except Astray:
            damaged = True
            cursor.leave(before)
            _skip(cursor)
    return Structures(opening=opening, structures=tuple(types), damaged=damaged or cursor.at_early_end())


def _type(cursor: Cursor) -> Structure:
    name = None
    if cursor.token.key != "STRUCT":
        name = cursor.name("STRUCT, or the name of a structure type")
        cursor.expect(":", "the name of the type", instead=(":=", "="))
    if cursor.token.key != "STRUCT":
        hint = "a type of this language is a structure: STRUCT member: REAL; END_STRUCT"
        raise cursor.stray("STRUCT is expected", hint)
    return structure(cursor, name)


def _skip(cursor: Cursor) -> None:
    """Go on before the next STRUCT, or where the section ends."""
    while not (cursor.token.key == "STRUCT" or cursor.at_statement()):
        cursor.advance()

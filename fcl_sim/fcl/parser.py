"""Tokens → syntax tree: generous, and never in doubt where to go on (5.4.1)."""

from collections.abc import Mapping
from dataclasses import dataclass

from fcl_sim.diagnostics import Diagnostic, Span
from fcl_sim.fcl.cursor import Astray, Cursor
from fcl_sim.fcl.findings import Stretch
from fcl_sim.fcl.keywords import ENDS, SECTIONS
from fcl_sim.fcl.parse_declarations import OTHER_KINDS, declarations
from fcl_sim.fcl.parse_rules import rule_block
from fcl_sim.fcl.parse_structures import structures
from fcl_sim.fcl.parse_variables import defuzzify, fuzzify
from fcl_sim.fcl.sections import Reader, closes, guess, report_unclosed
from fcl_sim.fcl.tokens import Kind, Scan, Token
from fcl_sim.fcl.tree import Block, Heading, Options, Section, Structures, Tree
from fcl_sim.model import Note

_END = "END_FUNCTION_BLOCK"
_NO_NAME = SECTIONS | ENDS | {"FUNCTION_BLOCK"}
_AFTER_NAME = _NO_NAME | {";"}
_NEXT_BLOCK = frozenset(("FUNCTION_BLOCK",))
_NEXT_SECTION = SECTIONS | {"FUNCTION_BLOCK", _END}
_TYPES = frozenset(("TYPE", "STRUCT"))
_ALIKE = {"OPTION": "OPTIONS"} | dict.fromkeys(OTHER_KINDS, "VAR")
"""Sections that are read like another one."""
_OPTION_ENDS = ("END_OPTIONS", "END_OPTION")


@dataclass(frozen=True, slots=True)
class Parsing:
    """The product of the parser: a tree of whatever could be read."""

    tree: Tree
    diagnostics: tuple[Diagnostic, ...]
    notes: tuple[Note, ...]


def parse(scan: Scan) -> Parsing:
    """Return the syntax tree of a text, `text ::= {types} function_block {function_block}` (S16)."""
    cursor = Cursor(scan)
    blocks: list[Block] = []
    verbatim: list[Span] = []
    types: list[Structures] = []
    while cursor.token.kind is not Kind.END:
        if cursor.token.key in _TYPES and cursor.ahead().kind is Kind.NAME:
            types.append(structures(cursor))
        elif _begins_block(cursor, first=not blocks):
            blocks.append(function_block(cursor))
        else:
            verbatim.append(_pass_over(cursor, first=not blocks))
    if not blocks and not cursor.in_open_comment():
        is_empty = scan.tokens[0].kind is Kind.END
        message = "this text is empty" if is_empty else "there is no FUNCTION_BLOCK in this text"
        hint = "a rule base is `FUNCTION_BLOCK name` … `END_FUNCTION_BLOCK`"
        cursor.findings.error("FCL205", message, Stretch(0, 0), hint)
    inside = [each for block in blocks for each in block.sections if isinstance(each, Options)]
    verbatim += [cursor.findings.span(each) for each in inside]
    tree = Tree(source=scan.source, blocks=tuple(blocks), verbatim=tuple(verbatim), types=tuple(types))
    return Parsing(tree, cursor.findings.diagnostics(), tuple(cursor.findings.notes))


def function_block(cursor: Cursor) -> Block:
    """Read a function block (5.4.1).

    `function_block ::= 'FUNCTION_BLOCK' function_block_name {section} 'END_FUNCTION_BLOCK' [';']`

    `section ::= declarations | types | fuzzify_block | defuzzify_block | rule_block | option_block`

    The name may be missing, and need not be an identifier (S11, S17). A text
    that begins with a section is read as if the heading stood there.
    """
    opening = cursor.token
    heading = None
    if opening.key in SECTIONS:
        hint = "write `FUNCTION_BLOCK name`"
        cursor.findings.error("FCL205", f"FUNCTION_BLOCK is expected before {opening.key}", opening, hint)
    else:
        cursor.advance()
        heading = _heading(cursor, opening)
    sections: list[Section] = []
    readers: dict[str, Reader] = {
        "VAR_INPUT": lambda at: sections.append(declarations(at)),
        "VAR_OUTPUT": lambda at: sections.append(declarations(at)),
        "VAR": lambda at: sections.append(declarations(at)),
        "FUZZIFY": lambda at: sections.append(fuzzify(at)),
        "DEFUZZIFY": lambda at: sections.append(defuzzify(at)),
        "RULEBLOCK": lambda at: sections.append(rule_block(at)),
        "OPTIONS": lambda at: sections.append(options(at)),
        "TYPE": lambda at: sections.append(structures(at)),
        "STRUCT": lambda at: sections.append(structures(at)),
    }
    damaged = False
    while not closes(cursor, opening, _END, _NEXT_BLOCK, ENDS):
        if cursor.take(";"):
            continue
        damaged |= not _read_section(cursor, opening, readers)
    cursor.take(";")
    damaged |= cursor.at_early_end()
    return Block(opening=opening, heading=heading, sections=tuple(sections), damaged=damaged)


def _read_section(cursor: Cursor, opening: Token, readers: Mapping[str, Reader]) -> bool:
    """Read a section, or pass over what is none, up to the next one; return whether it was one."""
    token = cursor.token
    try:
        reader = readers.get(_ALIKE.get(token.key, token.key))
        if reader is None and token.key in ENDS:
            message = f"{token.shown} closes nothing: no such section is open"
            raise cursor.refuse("FCL203", message, token)
        (reader or guess(cursor, opening, _END, readers))(cursor)
    except Astray:
        while cursor.token.key not in _NEXT_SECTION and cursor.token.kind is not Kind.END:
            cursor.advance()
        return False
    return True


def options(cursor: Cursor) -> Options:
    """Read what only its writer understands (Table 7, S4).

    `option_block ::= 'OPTION' any_text 'END_OPTION' | 'OPTIONS' any_text 'END_OPTIONS'`
    """
    opening = cursor.advance()
    while cursor.token.key not in _OPTION_ENDS:
        if cursor.token.kind is Kind.END or cursor.token.key in {_END, "FUNCTION_BLOCK"}:
            report_unclosed(cursor, opening, f"END_{opening.key}")
            break
        cursor.advance()
    end = cursor.token.start
    if cursor.token.key in _OPTION_ENDS:
        cursor.advance()
    return Options(cursor.source.text[opening.end : end].replace("\r\n", "\n"), opening.end, end)


def _begins_block(cursor: Cursor, *, first: bool) -> bool:
    token = cursor.token
    if token.key == "FUNCTION_BLOCK" or (first and token.key in SECTIONS):
        return True
    is_word = token.kind is Kind.NAME and not token.key.startswith("END")
    if is_word and cursor.findings.near(token.key, ("FUNCTION_BLOCK",)):
        message = f"{token.shown} is not a keyword"
        cursor.findings.error("FCL204", message, token, hint="did you mean FUNCTION_BLOCK?")
        return True
    return False


def _heading(cursor: Cursor, opening: Token) -> Heading | None:
    """Return the name: what stands up to the end of its line, identifier or not (S11, S17)."""
    first = cursor.token
    if first.kind is Kind.STRAY:
        return None
    if first.key in _NO_NAME or first.kind is Kind.END:
        hint = "the file's name is taken"
        cursor.findings.warning("FCL216", "this function block has no name", opening, hint)
        return None
    cursor.advance()
    words = 1
    while not (
        cursor.token.key in _AFTER_NAME or cursor.token.kind in {Kind.STRAY, Kind.END} or cursor.starts_line()
    ):
        cursor.advance()
        words += 1
    heading = Heading(cursor.words(first.start), first.start, cursor.last.end)
    if words > 1 or first.kind is not Kind.NAME:
        message = "the function block's name is not an identifier (Open Level)"
        cursor.findings.note("FCL221", message, heading)
    return heading


def _pass_over(cursor: Cursor, *, first: bool) -> Span:
    """Go on at the next function block; what is passed over is not FCL (S15b)."""
    token = cursor.token
    while cursor.token.kind is not Kind.END and cursor.token.key != "FUNCTION_BLOCK":
        cursor.advance()
    stretch = Stretch(token.start, cursor.token.start)
    if token.key in SECTIONS:
        message = f"{token.key} stands behind END_FUNCTION_BLOCK and belongs to no function block"
        cursor.findings.error("FCL211", message, token)
    elif first and cursor.token.kind is not Kind.END:
        hint = "text that is not FCL stands in comments: (* … *)"
        cursor.findings.error("FCL211", "this stands before FUNCTION_BLOCK", token, hint)
    elif not first and token.kind is not Kind.STRAY:
        cursor.findings.warning("FCL210", "text behind END_FUNCTION_BLOCK is ignored", token)
    return cursor.findings.span(stretch)

"""What every section has in common: statements up to its END, whatever is wrong in between."""

from collections.abc import Callable, Mapping

from fcl_sim.diagnostics.spelling import listed
from fcl_sim.fcl.cursor import Astray, Cursor, is_joined_rule
from fcl_sim.fcl.keywords import SECTIONS
from fcl_sim.fcl.tokens import Kind, Token

Reader = Callable[[Cursor], None]

_OUTER = SECTIONS | {"FUNCTION_BLOCK", "END_FUNCTION_BLOCK"}
_HOMES = {
    "TERM": "FUZZIFY or DEFUZZIFY",
    "METHOD": "DEFUZZIFY",
    "DEFAULT": "DEFUZZIFY",
    "RANGE": "DEFUZZIFY",
    "AND": "RULEBLOCK",
    "OR": "RULEBLOCK",
    "ACT": "RULEBLOCK",
    "ACCU": "RULEBLOCK",
    "RULE": "RULEBLOCK",
    "IF": "RULEBLOCK",
}


def statements(cursor: Cursor, opening: Token, end: str, readers: Mapping[str, Reader]) -> bool:
    """Read statements, each by its first keyword, up to and with the keyword `end`.

    Return whether something was passed over, so that what is absent may have
    been meant.
    """
    damaged = False
    while not closes(cursor, opening, end):
        if cursor.take(";"):
            continue
        before = cursor.token
        try:
            reader = readers.get(_keyword(cursor)) or guess(cursor, opening, end, readers)
            reader(cursor)
        except Astray:
            damaged = True
            cursor.leave(before)
            cursor.skip_statement()
    return damaged or cursor.at_early_end()


def closes(
    cursor: Cursor,
    opening: Token,
    end: str,
    outer: frozenset[str] = _OUTER,
    ends: frozenset[str] = frozenset(),
) -> bool:
    """Return whether the section that `opening` began is over; take its END.

    Where a keyword of `outer` comes instead, the section was not closed. Another
    END, or a misspelt one, is reported and taken for it, unless it is one of
    `ends`.
    """
    token = cursor.token
    if token.key == end:
        cursor.advance()
        return True
    if token.kind is Kind.END or token.key in outer:
        report_unclosed(cursor, opening, end)
        return True
    if token.key.startswith("END") and token.key not in ends:
        cursor.findings.error(
            "FCL203", f"{opening.key} is closed by {end}, not by {token.shown}", token, hint=f"write {end}"
        )
        cursor.advance()
        return True
    return False


def report_unclosed(cursor: Cursor, opening: Token, end: str) -> None:
    """Say that `end` is missing before the next token; the end of the text is said once."""
    token = cursor.token
    if token.kind is not Kind.END:
        message = f"{opening.key} is not closed"
        before = cursor.findings.place(token, f"{end} is expected before this")
        cursor.findings.error("FCL202", message, opening, hint=f"write {end}", related=(before,))
    elif not (cursor.ended or cursor.in_open_comment()):
        cursor.ended = True
        message = f"{opening.key} is not closed when the text ends"
        cursor.findings.error("FCL202", message, opening, hint=f"write {end}")


def _keyword(cursor: Cursor) -> str:
    if is_joined_rule(cursor.token, cursor.ahead()):
        return "RULE"
    return cursor.token.key


def guess(cursor: Cursor, opening: Token, end: str, readers: Mapping[str, Reader]) -> Reader:
    """Report a word that begins no statement here; return the reader of the one that was probably meant."""
    token = cursor.token
    if token.kind is Kind.STRAY:
        raise Astray
    message = f"{token.shown} does not begin a statement of {opening.key}"
    if token.key == "RULE" and cursor.ahead().key == "BLOCK":
        raise cursor.refuse("FCL204", message, token, hint="write RULEBLOCK in one word")
    if token.key in _HOMES:
        raise cursor.refuse("FCL204", message, token, hint=f"{token.key} stands in {_HOMES[token.key]}")
    meant = cursor.findings.near(token.key, readers)
    if meant is None:
        raise cursor.refuse("FCL204", message, token, hint=f"valid here: {listed([*readers, end])}")
    cursor.findings.error("FCL204", message, token, hint=f"did you mean {meant}?")
    return readers[meant]

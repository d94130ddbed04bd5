"""Conditions of rules: AND, OR, NOT and parentheses, by priority (5.2.4, Table 6)."""

from dataclasses import dataclass, field

from fcl_sim.fcl.cursor import Astray, Cursor
from fcl_sim.fcl.keywords import HEDGES
from fcl_sim.fcl.parse_values import variable
from fcl_sim.fcl.tokens import Kind, Token
from fcl_sim.fcl.tree import And, Condition, Group, Is, Member, Not, Or

DEEPEST = 50
"""Parentheses and NOT within one another: what is deeper is refused."""

_AFTER_VARIABLE = frozenset(("IS", "=", ".", "AND", "OR", "THEN", ")"))
_BEFORE_VARIABLE = frozenset(("IF", "AND", "OR", "NOT", "("))
_AFTER_TERM = frozenset(("AND", "OR", "THEN", ")"))


@dataclass(slots=True)
class _Level:
    """What has been read within one pair of parentheses."""

    opening: Token | None = None
    alternatives: list[Condition] = field(default_factory=list)
    operands: list[Condition] = field(default_factory=list)
    negations: list[Token] = field(default_factory=list)

    def add(self, operand: Condition) -> None:
        """Add an operand, with the NOTs that stand before it."""
        while self.negations:
            operand = Not(self.negations.pop(), operand)
        self.operands.append(operand)

    def end_alternative(self) -> None:
        """Close what AND has joined: OR binds less."""
        self.alternatives.append(_joined(self.operands, And))
        self.operands = []

    def end(self) -> Condition:
        """Return the whole of it."""
        self.end_alternative()
        return _joined(self.alternatives, Or)


def condition(cursor: Cursor) -> Condition:
    """Read `condition ::= factor {('AND' | 'OR') factor}` (5.4.1).

    `factor ::= {'NOT'} (subcondition | '(' condition ')')`. AND binds before OR
    (Table 6). Read with a stack of its own, so that no text exhausts Python's.
    """
    levels = [_Level()]
    while True:
        _prefixes(cursor, levels)
        levels[-1].add(subcondition(cursor))
        while len(levels) > 1 and cursor.take(")"):
            closed = levels.pop()
            levels[-1].add(Group(closed.opening or cursor.last, closed.end()))
        if cursor.take("OR"):
            levels[-1].end_alternative()
        elif not cursor.take("AND"):
            break
    if len(levels) > 1:
        _refuse_unclosed(cursor, levels[-1].opening)
    return levels[0].end()


def astray(cursor: Cursor, wanted: str) -> Astray:
    """Report what follows a subcondition where one of `wanted` is expected; return what to raise."""
    word, following = cursor.last, cursor.token
    is_pair = word.kind is following.kind is Kind.NAME and cursor.ahead().key in _AFTER_TERM
    if is_pair and cursor.ahead(-2).key not in _BEFORE_VARIABLE:
        near = cursor.findings.near(word.key, HEDGES)
        if near:
            message = f"{word.shown} before the term {following.shown} is not a hedge"
            return cursor.refuse("FCL201", message, word, f"did you mean {near.lower()}?")
    if cursor.ahead(-2).key in _BEFORE_VARIABLE:
        hint = f"write `{word.text} IS {following.text}`" if cursor.ahead().key in _AFTER_TERM else ""
        message = f"IS, {wanted} is expected after {word.shown}"
        return cursor.stray(message, lambda: _advice(cursor) or hint)
    return cursor.stray(f"{wanted} is expected after a subcondition", lambda: _advice(cursor))


def _advice(cursor: Cursor) -> str:
    if cursor.token.key == "XOR":
        return "write (a AND NOT b) OR (NOT a AND b)"
    near = cursor.findings.near(cursor.token.key, ("AND", "OR", "THEN"))
    return f"did you mean {near}?" if near else ""


def _joined(arguments: list[Condition], kind: type[And] | type[Or]) -> Condition:
    return arguments[0] if len(arguments) == 1 else kind(tuple(arguments))


def _prefixes(cursor: Cursor, levels: list[_Level]) -> None:
    """Take NOT and opening parentheses."""
    while True:
        token = cursor.token
        if token.key == "(":
            levels.append(_Level(opening=token))
        elif token.key == "NOT" and cursor.ahead().key != "IS":
            levels[-1].negations.append(token)
        else:
            return
        if len(levels) - 1 + sum(len(each.negations) for each in levels) > DEEPEST:
            raise cursor.refuse("FCL208", f"this condition is nested more than {DEEPEST} levels deep", token)
        cursor.advance()


def subcondition(cursor: Cursor) -> Condition:
    """Read a subcondition (5.4.1), or Annex D's member of a structure (S7).

    `subcondition ::= variable | variable_name '=' member_name
    | variable 'IS' ['NOT'] {hedge} (term_name | 'ANY')`
    """
    name = variable(cursor, "the name of a variable", _AFTER_VARIABLE)
    if cursor.token.key == "IS":
        return _is(cursor, name)
    if cursor.token.key == "." and cursor.ahead().key == "=":
        cursor.advance()
    if cursor.take("="):
        if cursor.token.key == "=":
            raise cursor.refuse(
                "FCL201", "IS is expected, not `==`", cursor.token, f"write `{name.text} IS …`"
            )
        member = cursor.name("the name of a member", _AFTER_TERM)
        return Member(name, member, name.start, member.end)
    return name


def _is(cursor: Cursor, name: Token) -> Is:
    cursor.advance()
    negation = cursor.take("NOT")
    hedges: list[Token] = []
    while _at_hedge(cursor):
        hedges.append(cursor.advance())
        if len(hedges) > DEEPEST:
            raise cursor.refuse("FCL208", f"there are more than {DEEPEST} hedges here", cursor.last)
    if cursor.token.key == "(":
        hint = f"write ({name.text} IS … OR {name.text} IS …)"
        raise cursor.stray(f"a term of {name.shown} is expected", hint, code="FCL209")
    term = cursor.name(f"a term of {name.shown}", _AFTER_TERM)
    return Is(name, negation, term, name.start, cursor.last.end, tuple(hedges))


def _at_hedge(cursor: Cursor) -> bool:
    """Return whether a hedge comes next: a term may have the name of one (S1a).

    `hedge ::= 'VERY' | 'EXTREMELY' | 'SOMEWHAT' | 'SELDOM' | 'ANY' | 'NOT'`
    """
    token, following = cursor.token, cursor.ahead()
    if token.key == "NOT":
        return True
    return token.key in HEDGES and following.kind is Kind.NAME and following.key not in _AFTER_TERM


def _refuse_unclosed(cursor: Cursor, opening: Token | None) -> None:
    """Report a parenthesis that is open where the condition ends; anything but its end is what is wrong."""
    token = cursor.token
    ends = token.key in {"THEN", ";"} or cursor.at_statement()
    if opening is None or not ends:
        raise astray(cursor, "AND, OR or `)`")
    cursor.findings.error(
        "FCL207",
        "this parenthesis is not closed",
        opening,
        hint="write `)` before THEN, or where the parenthesis is meant to end",
        related=(cursor.findings.place(token, "`)` is expected before this"),),
    )
    if token.key != "THEN":
        raise Astray

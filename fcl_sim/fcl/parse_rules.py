"""RULEBLOCK and its rules (5.2.4)."""

import re

from fcl_sim.fcl.cursor import Astray, Cursor, is_joined_rule
from fcl_sim.fcl.findings import Spanned, Stretch
from fcl_sim.fcl.keywords import CONCLUDED_HEDGES, HEDGES
from fcl_sim.fcl.parse_conditions import DEEPEST, astray, condition
from fcl_sim.fcl.parse_settings import choice
from fcl_sim.fcl.parse_values import value, variable
from fcl_sim.fcl.sections import statements
from fcl_sim.fcl.tokens import Kind, Token
from fcl_sim.fcl.tree import Conclusion, Rule, RuleBlock, Setting

_WORDS = (Kind.NAME, Kind.NUMBER, Kind.MIXED)
_BEGINS_STATEMENT = frozenset(("AND", "OR", "ACT", "ACCU", "ENABLED", "RULE", "IF"))
_AFTER_VARIABLE = frozenset(("IS", "WITH", ",", ";", "AND", ")"))
_AFTER_TERM = frozenset(("WITH", ",", ";", "AND", ")"))


LONGEST_LABEL = 8
"""In words, of a label that is taken for one although it is none."""


def rule_block(cursor: Cursor) -> RuleBlock:
    """Read `rule_block ::= 'RULEBLOCK' rule_block_name {rule_block_statement} 'END_RULEBLOCK'` (5.4.1).

    `rule_block_statement ::= operator_definition | activation_method | accumulation_method | enabled | rule`;
    ENABLED is Open Level.
    """
    opening = cursor.advance()
    name, damaged = _block_name(cursor, opening)
    settings: list[Setting] = []
    rules: list[Rule] = []
    damaged |= statements(
        cursor,
        opening,
        "END_RULEBLOCK",
        {
            "AND": lambda at: settings.append(choice(at, "AND", "an algorithm for AND", also=("OR",))),
            "OR": lambda at: settings.append(choice(at, "OR", "an algorithm for OR", also=("AND",))),
            "ACT": lambda at: settings.append(choice(at, "ACT", "a method of activation")),
            "ACCU": lambda at: settings.append(choice(at, "ACCU", "a method of accumulation")),
            "ENABLED": lambda at: settings.append(choice(at, "ENABLED", "TRUE or FALSE")),
            "RULE": lambda at: rules.append(_rule(at, len(rules) + 1)),
            "IF": lambda at: rules.append(_bare_rule(at, len(rules) + 1)),
        },
    )
    return RuleBlock(
        opening=opening, name=name, settings=tuple(settings), rules=tuple(rules), damaged=damaged
    )


def _block_name(cursor: Cursor, opening: Token) -> tuple[Token | None, bool]:
    """Return the name, and whether there is something in its place that is none."""
    token = cursor.token
    begins = token.key in _BEGINS_STATEMENT and cursor.ahead().key == ":"
    if begins or token.key in {"RULE", "IF", "END_RULEBLOCK"} or is_joined_rule(token, cursor.ahead()):
        hint = "write `RULEBLOCK No1`"
        cursor.findings.warning("FCL218", "this rule block has no name", opening, hint)
        return None, False
    try:
        is_number = token.kind in {Kind.NUMBER, Kind.MIXED} and not cursor.starts_line()
        name = cursor.advance() if is_number else cursor.name("the name of a rule block")
    except Astray:
        cursor.skip_line()
        return None, True
    if is_number or _is_longer(cursor):
        while _is_longer(cursor):
            cursor.advance()
        words = cursor.words(name.start)
        name = Token(Kind.NAME, words, words.upper(), name.start)
        cursor.findings.feature("rule block name", f"`{words}`", name)
    cursor.take(";")
    return name, False


def _is_longer(cursor: Cursor) -> bool:
    """Return whether what comes next belongs to a name of several words (S15)."""
    token = cursor.token
    words = token.kind in _WORDS or token.key in {"-", "."}
    return words and not (cursor.starts_line() or cursor.at_statement() or token.key == "IF")


def _rule(cursor: Cursor, number: int) -> Rule:
    """Read `rule ::= 'RULE' label ':' 'IF' condition 'THEN' conclusion ';'` (5.4.1)."""
    joined = is_joined_rule(cursor.token, cursor.ahead())
    keyword = cursor.advance()
    label = keyword.text[len("RULE") :].lstrip("_") if joined else _label(cursor, keyword)
    _rest_of_label(cursor, keyword)
    heading_end = cursor.last.end
    if cursor.token.key == "IF":
        cursor.report("`:` is expected after the label of the rule")
    else:
        cursor.expect(":", "the label of the rule", instead=(":=", ";", ".", ","))
    if not cursor.take("IF"):
        raise cursor.stray("IF is expected after the label of the rule")
    return _body(cursor, Stretch(keyword.start, heading_end), label or str(number))


def _label(cursor: Cursor, keyword: Token) -> str:
    """Read the label: any run of letters, digits and underscores (S5; 5.4.1 has an integer)."""
    label = ""
    end = cursor.token.start
    while cursor.token.kind in _WORDS and cursor.token.start == end and cursor.token.key != "IF":
        end = cursor.token.end
        label += cursor.advance().text
    if not label and cursor.token.key not in {":", "IF"}:
        raise cursor.stray("the label of a rule is expected")
    if not label:
        cursor.findings.warning("FCL217", "this rule has no label", keyword, hint="write `RULE 1: IF …`")
    return label


def _rest_of_label(cursor: Cursor, keyword: Token) -> None:
    """Report a label that goes on behind another sign, such as `3-a`, and go on at its colon."""
    steps = 0
    while cursor.ahead(steps).key not in {":", "IF"} and steps < LONGEST_LABEL:
        steps += 1
    if steps == 0 or cursor.ahead(steps).key != ":" or cursor.ahead(steps + 1).key != "IF":
        return
    start, is_known = cursor.token.start, False
    while cursor.token.key != ":":
        is_known |= cursor.advance().kind is Kind.STRAY
    if is_known:
        return
    hint = f"write `RULE {re.sub(r'[^0-9A-Za-z]+', '_', cursor.words(keyword.end))}: IF …`"
    message = "the label of a rule is a run of letters, digits and underscores"
    cursor.findings.error("FCL201", message, cursor.since(start), hint)


def _bare_rule(cursor: Cursor, number: int) -> Rule:
    token = cursor.advance()
    cursor.findings.error("FCL213", "a rule begins with RULE and a label", token, hint="write `RULE 1: IF …`")
    return _body(cursor, token, str(number))


def _body(cursor: Cursor, heading: Spanned, label: str) -> Rule:
    """Read what follows IF; `heading` is what stands before the colon."""
    rule_condition = condition(cursor)
    if not cursor.take("THEN"):
        raise astray(cursor, "AND, OR or THEN")
    conclusions = conclusion(cursor)
    end = cursor.last.end
    if cursor.token.key == "ELSE":
        raise cursor.refuse("FCL201", "FCL has no ELSE", cursor.token, "write another rule: IF NOT … THEN …")
    cursor.end_statement()
    return Rule(
        label=label,
        condition=rule_condition,
        conclusions=conclusions,
        start=heading.start,
        heading_end=heading.end,
        end=end,
    )


def conclusion(cursor: Cursor) -> tuple[Conclusion, ...]:
    """Read `conclusion ::= part {(',' | 'AND') part}` with `part ::= subconclusion | '(' conclusion ')'`.

    AND in place of the comma is noted (S6); parentheses around a subconclusion,
    or around all of them, are Open Level.
    """
    parts: list[Conclusion] = []
    opened: list[Token] = []
    while True:
        _open(cursor, opened)
        parts.append(subconclusion(cursor))
        while opened and cursor.take(")"):
            opened.pop()
        token = cursor.token
        if token.key == "AND" and cursor.ahead().key != ":":
            message = "subconclusions are joined by AND: the grammar wants a comma"
            cursor.findings.note("FCL214", message, token)
        elif token.key == "OR" and cursor.ahead().key != ":":
            hint = "write a comma, or two rules"
            raise cursor.refuse("FCL215", "subconclusions cannot be joined by OR", token, hint)
        elif token.key != ",":
            break
        cursor.advance()
    if opened:
        hint = "write `)` behind the conclusion"
        raise cursor.refuse("FCL207", "this parenthesis is not closed", opened[-1], hint)
    return tuple(parts)


def _open(cursor: Cursor, opened: list[Token]) -> None:
    """Take opening parentheses, as pyfuzzy writes them."""
    while cursor.token.key == "(":
        if len(opened) == DEEPEST:
            message = f"this conclusion is nested more than {DEEPEST} levels deep"
            raise cursor.refuse("FCL208", message, cursor.token)
        cursor.findings.feature("conclusion", "a conclusion in parentheses", cursor.token)
        opened.append(cursor.advance())


def subconclusion(cursor: Cursor) -> Conclusion:
    """Read a subconclusion (5.4.1, S12); `=` is fuzzylite's.

    `subconclusion ::= variable [('IS' | '=') {concluded_hedge} term_name] ['WITH' weighting_factor]`

    `concluded_hedge ::= 'VERY' | 'EXTREMELY' | 'SOMEWHAT' | 'SELDOM'` (Open Level);
    `weighting_factor ::= value`
    """
    name = variable(cursor, "the name of an output variable", _AFTER_VARIABLE)
    term = None
    weight = None
    hedges: list[Token] = []
    goes_on = cursor.token.kind is Kind.NAME and not (cursor.starts_line() or cursor.at_statement())
    if goes_on and cursor.token.key not in {*_AFTER_VARIABLE, "OR", "ELSE"}:
        raise cursor.stray(f"IS is expected after {name.shown}", f"write `{name.text} IS …`")
    if _takes_is(cursor):
        while _at_hedge(cursor):
            hedges.append(_concluded_hedge(cursor))
            if len(hedges) > DEEPEST:
                raise cursor.refuse("FCL208", f"there are more than {DEEPEST} hedges here", cursor.last)
        term = cursor.name(f"a term of {name.shown}", _AFTER_TERM)
    if cursor.take("WITH"):
        weight = value(cursor, "a weighting factor, a number from 0 to 1 or the name of a variable,")
    return Conclusion(name, term, weight, name.start, cursor.last.end, tuple(hedges))


def _takes_is(cursor: Cursor) -> bool:
    """Take IS, or the `=` of older files of fuzzylite."""
    if cursor.token.key == "=" and cursor.ahead().kind is Kind.NAME:
        cursor.findings.feature("equals", "= in place of IS", cursor.token)
        cursor.advance()
        return True
    return cursor.take("IS") is not None


def _at_hedge(cursor: Cursor) -> bool:
    """Return whether a hedge comes next: a term may have the name of one (S1a)."""
    if cursor.token.key == "NOT":
        return True
    following = cursor.ahead()
    goes_on = following.kind is Kind.NAME and following.key not in _AFTER_TERM
    return cursor.token.key in HEDGES and goes_on and not cursor.at_statement(1)


def _concluded_hedge(cursor: Cursor) -> Token:
    """Take a hedge; refuse those after which a rule that does not fire would conclude."""
    token = cursor.token
    if token.key == "NOT":
        hint = "name the term that is meant"
        raise cursor.refuse("FCL215", "a conclusion cannot be negated", token, hint)
    if token.key not in CONCLUDED_HEDGES:
        message = f"a conclusion cannot have the hedge {token.shown}: the rule's degree would not count"
        raise cursor.refuse("FCL215", message, token, "leave it out; WITH weights a conclusion")
    return cursor.advance()

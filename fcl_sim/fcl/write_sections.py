"""FUZZIFY, DEFUZZIFY and RULEBLOCK → text (5.2.2 to 5.2.4)."""

from collections.abc import Iterator, Sequence

from fcl_sim.diagnostics import Span
from fcl_sim.fcl.comments import Comments
from fcl_sim.fcl.outline import END, HEAD
from fcl_sim.fcl.resolve_settings import PAIRS
from fcl_sim.fcl.write_declarations import limits
from fcl_sim.fcl.write_lines import INDENT, WIDTH, Line
from fcl_sim.fcl.write_numbers import number
from fcl_sim.fcl.write_rules import rule_lines
from fcl_sim.fcl.write_terms import term_lines
from fcl_sim.model import (
    Activation,
    And,
    Condition,
    Defuzzification,
    Fuzzification,
    Not,
    Or,
    RuleBlock,
    Term,
    Variable,
)


def fuzzify(
    section: Fuzzification, variable: Variable | None, comments: Comments, *, terse: bool
) -> Iterator[Line]:
    """Yield a section FUZZIFY; it has the range of its variable where the text has it there."""
    span = section.span
    yield _head("FUZZIFY", section.variable, span, comments)
    if section.clamped:
        yield _setting("LOCK", "LOCK: RANGE", span, comments)
    yield from _enabled(span, comments, enabled=section.enabled, terse=terse)
    if variable is not None and variable.range is not None and comments.part(span, "RANGE") is not None:
        yield _setting("RANGE", limits(variable.range), span, comments)
    yield from _terms(section.terms, comments)
    yield _end("END_FUZZIFY", span, comments)


def defuzzify(section: Defuzzification, comments: Comments, *, terse: bool) -> Iterator[Line]:
    """Yield a section DEFUZZIFY: range, terms, method, default value, and what is Open Level."""
    span = section.span
    yield _head("DEFUZZIFY", section.variable, span, comments)
    yield from _enabled(span, comments, enabled=section.enabled, terse=terse)
    if section.range is not None:
        yield _setting("RANGE", limits(section.range), span, comments)
    yield from _terms(section.terms, comments)
    yield _setting("METHOD", f"METHOD: {section.method}", span, comments)
    default = "NC" if section.default is None else number(section.default)
    if section.held and section.default is not None:
        default += " | NC"
    yield _setting("DEFAULT", f"DEFAULT := {default}", span, comments)
    if section.accumulation is not None:
        yield _setting("ACCU", f"ACCU: {section.accumulation}", span, comments)
    locked = ["PREVIOUS"] * (section.held and section.default is None) + ["RANGE"] * section.clamped
    if locked:
        yield _setting("LOCK", f"LOCK: {' | '.join(locked)}", span, comments)
    yield _end("END_DEFUZZIFY", span, comments)


def rule_block(block: RuleBlock, comments: Comments, *, terse: bool) -> Iterator[Line]:
    """Yield a section RULEBLOCK: operators, activation, accumulation, rules.

    Unless `terse`, OR and ACT are written where the text has them.
    """
    span = block.span
    yield _head("RULEBLOCK", block.name, span, comments)
    yield from _enabled(span, comments, enabled=block.enabled, terse=terse)
    yield _setting("AND", f"AND: {block.and_operator}", span, comments)
    is_pair = PAIRS[block.and_operator] is block.or_operator
    joins = any(_has_or(each.condition) for each in block.rules)
    if not is_pair or joins or not (terse or comments.part(span, "OR") is None):
        yield _setting("OR", f"OR: {block.or_operator}", span, comments)
    if block.activation is not Activation.MIN or not (terse or comments.part(span, "ACT") is None):
        yield _setting("ACT", f"ACT: {block.activation}", span, comments)
    yield _setting("ACCU", f"ACCU: {block.accumulation}", span, comments)
    for rule in block.rules:
        lines = rule_lines(rule, WIDTH - INDENT)
        yield Line(code=tuple(lines), indent=INDENT, number=comments.number(rule.span))
    yield _end("END_RULEBLOCK", span, comments)


def _head(keyword: str, name: str, span: Span | None, comments: Comments) -> Line:
    return Line(code=(f"{keyword} {name}",), number=comments.part(span, HEAD), blank=True)


def _end(keyword: str, span: Span | None, comments: Comments) -> Line:
    return Line(code=(keyword,), inner=INDENT, number=comments.part(span, END), blank=False)


def _setting(key: str, text: str, span: Span | None, comments: Comments) -> Line:
    return Line(code=(f"{text};",), indent=INDENT, number=comments.part(span, key))


def _enabled(span: Span | None, comments: Comments, *, enabled: bool, terse: bool) -> Iterator[Line]:
    """Yield ENABLED where it says no, or where the text has it."""
    if not enabled:
        yield _setting("ENABLED", "ENABLED: FALSE", span, comments)
    elif not (terse or comments.part(span, "ENABLED") is None):
        yield _setting("ENABLED", "ENABLED: TRUE", span, comments)


def _terms(terms: Sequence[Term], comments: Comments) -> Iterator[Line]:
    """Yield terms, their `:=` below each other."""
    name_width = max((len(each.name) for each in terms), default=0)
    for term in terms:
        lines = term_lines(term, name_width, WIDTH - INDENT)
        yield Line(code=tuple(lines), indent=INDENT, number=comments.number(term.span))


def _has_or(condition: Condition) -> bool:
    match condition:
        case Or():
            return True
        case Not():
            return _has_or(condition.argument)
        case And():
            return any(_has_or(each) for each in condition.arguments)
    return False

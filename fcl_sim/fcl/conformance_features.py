"""Model → what it uses of Tables 8, 9 and 10, and where (clause 6.1)."""

from collections.abc import Container, Iterator
from dataclasses import dataclass
from math import isnan

from fcl_sim.diagnostics import Span
from fcl_sim.fcl.conformance_conditions import Use, used_in_rule
from fcl_sim.fcl.conformance_elements import ELEMENTS, YES, Choice, known
from fcl_sim.fcl.conformance_tables import ROWS, SHAPES, TABLES, Row
from fcl_sim.fcl.features import FEATURES
from fcl_sim.model import (
    AndOperator,
    Curve,
    Defuzzification,
    Formula,
    FunctionBlock,
    Fuzzification,
    Level,
    Note,
    OrOperator,
    Points,
    RuleBlock,
    Singleton,
    Singletons,
    Term,
)

BASIC_POINTS, MOST_POINTS = 3, 4
"""Points of a term in Table 8 and in Table 9."""

# fmt: off
TOLD_BY_MODEL = frozenset((
    "accumulation", "default", "degree", "enabled", "formula", "hedge", "points",
    "singletons", "structure",
    "line comment",  # a figure of Table 11
    "FCL336",  # without RANGE, the standard takes that of the data type
    "FCL342",  # AND and OR that are no pair are both in the tables
))
# fmt: on
"""Kinds of notes that the model says as well, or that are no feature of Tables 8 to 10."""


PAIRS = dict(zip(AndOperator, OrOperator, strict=True))
"""Table 3, and de Morgan's pairs of the Open Level."""


@dataclass(frozen=True, slots=True)
class Feature:
    """Something of a row that a function block uses, and every place where it does.

    `key` and `value` are an element of `ELEMENTS`; `key` is empty where the row
    is a matter of counts or of writing. Places are empty for a model that comes
    from no text.
    """

    row: Row
    words: str
    places: tuple[Span, ...]
    key: str = ""
    value: str = ""


def features(block: FunctionBlock) -> tuple[Feature, ...]:
    """Return what a function block uses, in the order of the tables, each feature once."""
    places: dict[tuple[str, str, str, str], dict[Span, None]] = {}
    for use in _uses(block):
        row, words = use.row, use.words
        if use.key:
            element = ELEMENTS[use.key]
            row, words = element.row(use.value).name, element.said(use.value)
        found = places.setdefault((row, words, use.key, use.value), {})
        if use.span is not None:
            found[use.span] = None
    order = list(ROWS)
    made = [
        Feature(ROWS[row], words, tuple(spans), key, value)
        for (row, words, key, value), spans in places.items()
    ]
    return tuple(sorted(made, key=lambda each: order.index(each.row.name)))


def level(block: FunctionBlock) -> Level:
    """Return the lowest conformance level that has everything a function block uses."""
    tables = [each.row.table for each in features(block)]
    return next(rows[0].level for table, rows in reversed(TABLES.items()) if table in tables or table == 8)


def _uses(block: FunctionBlock) -> Iterator[Use]:
    yield from (Use("VAR", YES, each.span) for each in block.variables)
    yield from (Use("structures", YES, each.span) for each in block.structures)
    for each in (*block.inputs, *block.variables):
        if each.range is not None and each.span is None:
            yield Use("input_ranges", YES)
    for fuzzification in block.fuzzifications:
        yield from _of_input(fuzzification)
    locked = any(note.code == "lock" for note in block.notes)
    for defuzzification in block.defuzzifications:
        yield from _of_output(defuzzification, locked=locked)
    for number, rule_block in enumerate(block.rule_blocks):
        if number:
            yield Use(span=rule_block.span, row="rule blocks", words="several rule blocks")
        yield from _of_rule_block(rule_block, block)
    if block.options and block.span is None:
        yield Use("OPTIONS", YES)
    for note in block.notes:
        yield from _of_note(note)


# -- variables


def _of_input(fuzzification: Fuzzification) -> Iterator[Use]:
    if not fuzzification.enabled:
        yield Use("ENABLED", YES, fuzzification.span)
    if fuzzification.clamped and fuzzification.span is None:
        yield Use("LOCK", YES, fuzzification.span)
    for term in fuzzification.terms:
        if isinstance(term.shape, Points):
            moved = any(isinstance(point.x, str) for point in term.shape.points)
            yield Use("input_terms", "variable" if moved else "constant", term.span)
            yield from _of_points(term, term.shape, "input points")
        else:
            yield from _of_shape(term)


def _of_output(output: Defuzzification, *, locked: bool) -> Iterator[Use]:
    yield Use("METHOD", str(output.method), output.span)
    yield Use("DEFAULT", _default(output, locked=locked), output.span)
    if output.range is not None:
        yield Use("RANGE", YES, output.span)
    if output.accumulation is not None:
        yield Use("ACCU_of_outputs", YES, output.span)
        yield Use("ACCU", str(output.accumulation), output.span)
    if output.clamped and output.span is None:
        yield Use("LOCK", YES, output.span)
    if not output.enabled:
        yield Use("ENABLED", YES, output.span)
    for term in output.terms:
        if isinstance(term.shape, Points):
            moved = any(isinstance(point.x, str) for point in term.shape.points)
            yield Use("output_terms", "variable points" if moved else "points", term.span)
            yield from _of_points(term, term.shape, "output points")
        elif isinstance(term.shape, Singleton):
            moved = isinstance(term.shape.value, str)
            yield Use("output_terms", "variable singletons" if moved else "singletons", term.span)
        else:
            yield from _of_shape(term)


def _default(output: Defuzzification, *, locked: bool) -> str:
    """Return which kind of default there is; an output may be held by `locked`, a LOCK, as well."""
    if output.default is None:
        return "NC"
    if output.held and not locked:
        return "value | NC"
    if isnan(output.default):
        return "NaN"
    return "0" if output.default == 0.0 else "value"


def _of_points(term: Term, shape: Points, row: str) -> Iterator[Use]:
    count = len(shape.points)
    if count > MOST_POINTS:
        yield Use(span=term.span, row="more points", words="more than four points in a term")
    elif count > BASIC_POINTS and row == "input points":
        yield Use(span=term.span, row=row, words="four points in a term of an input")
    if any(point.degree not in {0.0, 1.0} for point in shape.points):
        yield Use("degrees", YES, term.span)


def _of_shape(term: Term) -> Iterator[Use]:
    match term.shape:
        case Singletons():
            yield Use("singletons", YES, term.span)
        case Formula():
            yield Use("formulas", YES, term.span)
        case Curve() if term.span is None:
            yield Use("shapes", str(term.shape.kind), None)


# -- rules


def _of_rule_block(rule_block: RuleBlock, block: FunctionBlock) -> Iterator[Use]:
    if not rule_block.enabled:
        yield Use("ENABLED", YES, rule_block.span)
    areas = {each.variable for each in block.defuzzifications if not _is_singletons(each)}
    own = {each.variable for each in block.defuzzifications if each.accumulation is not None}
    with_terms = {each.variable for each in block.fuzzifications}
    concluded = {each.variable for rule in rule_block.rules for each in rule.conclusions}
    if concluded & areas:
        yield Use("ACT", str(rule_block.activation), rule_block.span)
    if concluded - own:
        yield Use("ACCU", str(rule_block.accumulation), rule_block.span)
    uses = [use for rule in rule_block.rules for use in used_in_rule(rule, rule_block, with_terms)]
    yield from uses
    yield from _declared(rule_block, {use.key for use in uses})


def _declared(rule_block: RuleBlock, used: Container[str]) -> Iterator[Use]:
    """Yield the operators that the text must name though no rule has them; one names its pair, too (S10)."""
    chosen_and, chosen_or = rule_block.and_operator, rule_block.or_operator
    is_pair = PAIRS.get(chosen_and) is chosen_or
    if "AND" not in used and chosen_and is not AndOperator.MIN and not (is_pair and "OR" in used):
        yield Use("AND", str(chosen_and), rule_block.span)
    if "OR" not in used and chosen_or is not OrOperator.MAX and not is_pair:
        yield Use("OR", str(chosen_or), rule_block.span)


def _is_singletons(output: Defuzzification) -> bool:
    return all(isinstance(each.shape, Singleton | Formula) for each in output.terms)


# -- notes


def _of_note(note: Note) -> Iterator[Use]:
    if note.code in TOLD_BY_MODEL:
        return
    match note.code:
        case "norm" | "method":
            if not _is_own_word(note.feature):
                row = "norm" if note.code == "norm" else "further method"
                yield Use(span=note.span, row=row, words=note.feature)
        case "options":
            yield Use("OPTIONS", YES, note.span)
        case "shape":
            yield Use("shapes", known(note.feature, SHAPES) or note.feature, note.span)
        case "range":
            yield Use("input_ranges", YES, note.span)
        case "lock":
            yield Use("LOCK", YES, note.span)
        case _:
            yield Use(span=note.span, row="form", words=FEATURES.get(note.code, note.feature))


def _is_own_word(feature: str) -> bool:
    """Return whether an algorithm is written as the model calls it, such as `AND : HPROD`."""
    key, _, word = (each.strip() for each in feature.partition(":"))
    element = ELEMENTS.get(key)
    return isinstance(element, Choice) and known(word, element.rows) is not None

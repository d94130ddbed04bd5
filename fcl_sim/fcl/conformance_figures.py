"""Model → its own figures in the form of Table 11, and where each of them grows (clause 6.2)."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from fcl_sim.diagnostics import Span
from fcl_sim.fcl.conformance_conditions import subconditions
from fcl_sim.model import (
    Curve,
    Defuzzification,
    FunctionBlock,
    Fuzzification,
    Points,
    Rule,
    Singletons,
    Term,
)


@dataclass(frozen=True, slots=True)
class Count:
    """How many there are of something: in `subject`, which is empty for the whole function block.

    `places` are those of what was counted, in the order of the text, or one for
    all of it.
    """

    number: int
    subject: str = ""
    places: tuple[Span | None, ...] = ()

    def beyond(self, limit: int) -> Span | None:
        """Return the place of the first one beyond a limit."""
        if not self.places:
            return None
        return self.places[min(limit, len(self.places) - 1)]


@dataclass(frozen=True, slots=True)
class Figure:
    """A row of Table 11 that is a count: what is counted, and how, in all that a function block has of it.

    `thing` is what a limit is about, such as `rules`.
    """

    title: str
    thing: str
    counts: Callable[[FunctionBlock], Iterable[Count]]

    def most(self, block: FunctionBlock) -> Count:
        """Return the largest count, the first of several."""
        return max(self.counts(block), key=lambda each: each.number, default=Count(0))


def data_types(block: FunctionBlock) -> dict[str, tuple[Span, ...]]:
    """Return the types of inputs and outputs, each with the places of its variables."""
    found: dict[str, list[Span]] = {}
    for each in (*block.inputs, *block.outputs):
        places = found.setdefault(str(each.type), [])
        if each.span is not None:
            places.append(each.span)
    return {name: tuple(places) for name, places in found.items()}


def line_comments(block: FunctionBlock) -> tuple[Span, ...]:
    """Return the places of the comments that go to the end of their line."""
    return tuple(each.span for each in block.notes if each.code == "line comment" and each.span is not None)


# -- counting


def _names(block: FunctionBlock) -> Iterator[Count]:
    yield _name(block.name, block.span)
    for variable in (*block.inputs, *block.outputs, *block.variables):
        for part in variable.name.split("."):
            yield _name(part, variable.span)
    for fuzzification in block.fuzzifications:
        yield from (_name(each.name, each.span) for each in fuzzification.terms)
    for defuzzification in block.defuzzifications:
        yield from (_name(each.name, each.span) for each in defuzzification.terms)
    for rule_block in block.rule_blocks:
        yield _name(rule_block.name, rule_block.span)


def _name(name: str, span: Span | None) -> Count:
    return Count(len(name), name, (span,))


Sections = Sequence[Fuzzification] | Sequence[Defuzzification]


def _variables(sections: Sections) -> Count:
    spans = tuple(each.span for each in sections)
    return Count(len(spans), places=spans)


def _terms(sections: Sections) -> Iterator[Count]:
    for each in sections:
        yield Count(len(each.terms), each.variable, tuple(term.span for term in each.terms))


def _all_terms(sections: Sections) -> Count:
    spans = tuple(term.span for each in sections for term in each.terms)
    return Count(len(spans), places=spans)


def _points(sections: Sections) -> Iterator[Count]:
    for each in sections:
        for term in each.terms:
            yield Count(_points_of(term), f"{each.variable}.{term.name}", (term.span,))


def _all_points(sections: Sections) -> Count:
    spans = [term.span for each in sections for term in each.terms for _ in range(_points_of(term))]
    return Count(len(spans), places=tuple(spans))


def _points_of(term: Term) -> int:
    """Return how many points describe a term: one for a singleton or a formula, none for a smooth shape."""
    if isinstance(term.shape, Points | Singletons):
        return len(term.shape.points)
    return 0 if isinstance(term.shape, Curve) else 1


def _rule_blocks(block: FunctionBlock) -> Iterator[Count]:
    spans = tuple(each.span for each in block.rule_blocks)
    yield Count(len(spans), places=spans)


def _rules_per_block(block: FunctionBlock) -> Iterator[Count]:
    for each in block.rule_blocks:
        yield Count(len(each.rules), each.name, tuple(rule.span for rule in each.rules))


def _rules(block: FunctionBlock) -> Iterator[Rule]:
    for each in block.rule_blocks:
        yield from each.rules


def _all_rules(block: FunctionBlock) -> Iterator[Count]:
    spans = tuple(each.span for each in _rules(block))
    yield Count(len(spans), places=spans)


def _subconditions(block: FunctionBlock) -> Iterator[Count]:
    for rule in _rules(block):
        spans = tuple(each.span for each in subconditions(rule.condition))
        yield Count(len(spans), f"rule {rule.label}", spans)


def _subconclusions(block: FunctionBlock) -> Iterator[Count]:
    for rule in _rules(block):
        spans = tuple(each.span for each in rule.conclusions)
        yield Count(len(spans), f"rule {rule.label}", spans)


def _nesting(block: FunctionBlock) -> Iterator[Count]:
    for rule in _rules(block):
        yield Count(rule.nesting, f"rule {rule.label}", (rule.span,))


FIGURES: Mapping[str, Figure] = MappingProxyType(
    {
        "identifier_length": Figure("length of identifiers", "characters", _names),
        "inputs": Figure(
            "input variables for fuzzification", "inputs", lambda block: [_variables(block.fuzzifications)]
        ),
        "terms_per_input": Figure(
            "terms per input variable", "terms", lambda block: _terms(block.fuzzifications)
        ),
        "terms_of_inputs": Figure(
            "terms of all input variables",
            "terms of inputs",
            lambda block: [_all_terms(block.fuzzifications)],
        ),
        "points_per_input_term": Figure(
            "points per term of an input variable", "points", lambda block: _points(block.fuzzifications)
        ),
        "points_of_inputs": Figure(
            "points of all terms of input variables",
            "points of inputs",
            lambda block: [_all_points(block.fuzzifications)],
        ),
        "outputs": Figure(
            "output variables for defuzzification",
            "outputs",
            lambda block: [_variables(block.defuzzifications)],
        ),
        "terms_per_output": Figure(
            "terms per output variable", "terms", lambda block: _terms(block.defuzzifications)
        ),
        "terms_of_outputs": Figure(
            "terms of all output variables",
            "terms of outputs",
            lambda block: [_all_terms(block.defuzzifications)],
        ),
        "points_per_output_term": Figure(
            "points per term of an output variable", "points", lambda block: _points(block.defuzzifications)
        ),
        "points_of_outputs": Figure(
            "points of all terms of output variables",
            "points of outputs",
            lambda block: [_all_points(block.defuzzifications)],
        ),
        "rule_blocks": Figure("rule blocks", "rule blocks", _rule_blocks),
        "rules_per_block": Figure("rules per block", "rules", _rules_per_block),
        "subconditions": Figure("subconditions per rule", "subconditions", _subconditions),
        "rules": Figure("all rules", "rules in all", _all_rules),
        "subconclusions": Figure("subconclusions per rule", "subconclusions", _subconclusions),
        "nesting": Figure("nesting depth of ( )", "parentheses within one another", _nesting),
    }
)
"""By the key of a statement, in the order of Table 11."""

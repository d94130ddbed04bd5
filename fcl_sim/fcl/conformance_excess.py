"""What a file uses beyond a target's statement: each excess is one finding (clause 6.2, Table 11)."""

from collections.abc import Iterator

from fcl_sim.diagnostics import Diagnostic, Place, Severity, Span
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.fcl.conformance_elements import ELEMENTS, Choice
from fcl_sim.fcl.conformance_features import Feature, features
from fcl_sim.fcl.conformance_figures import FIGURES, Count, data_types, line_comments
from fcl_sim.fcl.conformance_statement import Limit, Listed, Statement
from fcl_sim.model import FunctionBlock

BASIC = 8
"""The table of what every target has."""


FORMS = ("form", "norm", "further method")
"""Rows of features that are a matter of writing: an element tells what is meant."""


def excesses(block: FunctionBlock, statement: Statement) -> tuple[Diagnostic, ...]:
    """Return what a function block uses that the target does not have, has not enough of, or does otherwise.

    An error where the target lacks something, a warning where it computes
    something else, a note where its statement is silent. The first place is in
    the rule base, in whose order they stand; that in the statement has a label.
    """
    used = features(block)
    found = (
        *_lacking(used, statement),
        *_comments(block, statement),
        *_types(block, statement),
        *_limits(block, statement),
        *_otherwise(used, statement),
        *_forms(used, statement),
        *_unsaid(used, statement),
        *_remarks(block, statement),
    )
    return tuple(sorted(found, key=_offset))


def _offset(finding: Diagnostic) -> int:
    first = finding.places[0] if finding.places else Place()
    return first.span.start if first.span and not first.label else -1


def _lacking(used: tuple[Feature, ...], statement: Statement) -> Iterator[Diagnostic]:
    for each in used:
        listed_values = statement.elements.get(each.key)
        if listed_values is None or each.value in listed_values.values:
            continue
        yield Diagnostic(
            code="FCL510",
            message=f"{statement.name} does not have {each.words}",
            places=(*_places(each.places), _stated(listed_values.at)),
            hint=_there_is(each, listed_values),
        )


def _there_is(feature: Feature, values: Listed) -> str:
    element = ELEMENTS[feature.key]
    if not isinstance(element, Choice):
        return ""
    there = [each for each in element.rows if each in values.values]
    return f"the target has {listed(there)}" if there else "the target has none of the kind"


def _comments(block: FunctionBlock, statement: Statement) -> Iterator[Diagnostic]:
    stated = statement.line_comments
    places = line_comments(block)
    if stated is not None and not stated.values and places:
        yield Diagnostic(
            code="FCL510",
            message=f"{statement.name} does not have comments to the end of the line",
            places=(*_places(places), _stated(stated.at)),
            hint="write (* ... *)",
        )


def _types(block: FunctionBlock, statement: Statement) -> Iterator[Diagnostic]:
    if statement.data_types is None:
        return
    there = sorted(statement.data_types.values)
    for name, places in data_types(block).items():
        if name not in statement.data_types.values:
            yield Diagnostic(
                code="FCL512",
                message=f"{statement.name} does not have the data type {name}",
                places=(*_places(places), _stated(statement.data_types.at)),
                hint=f"the target has {listed(there)}",
            )


def _limits(block: FunctionBlock, statement: Statement) -> Iterator[Diagnostic]:
    for key, limit in statement.limits.items():
        for count in FIGURES[key].counts(block):
            if count.number > limit.number:
                yield _beyond(key, count, limit, statement)


def _beyond(key: str, count: Count, limit: Limit, statement: Statement) -> Diagnostic:
    subject = f"`{count.subject}`" if count.subject else "this function block"
    thing = FIGURES[key].thing
    place = count.beyond(limit.number)
    return Diagnostic(
        code="FCL511",
        message=f"{subject} has {count.number} {thing}; {statement.name} takes {limit.number} at most",
        places=(*((Place(place),) if place else ()), _stated(limit.at)),
    )


def _otherwise(used: tuple[Feature, ...], statement: Statement) -> Iterator[Diagnostic]:
    for each in used:
        told = statement.differs.get((each.key, each.value)) or statement.differs.get((each.key, ""))
        if told is not None:
            yield Diagnostic(
                code="FCL513",
                message=f"{statement.name} makes something else of {each.words}: {told.words}",
                severity=Severity.WARNING,
                places=(*_places(each.places), _stated(told.at)),
            )


def _unsaid(used: tuple[Feature, ...], statement: Statement) -> Iterator[Diagnostic]:
    for each in used:
        is_beyond = each.row.table > BASIC  # the Basic Level is mandatory (6.1 b)
        if each.key and is_beyond and each.key not in statement.elements:
            yield Diagnostic(
                code="FCL514",
                message=f"the statement of {statement.name} does not say whether there is {each.words}",
                severity=Severity.NOTE,
                places=_places(each.places),
                hint=f"look it up and add `{each.key}` to the statement",
            )


def _forms(used: tuple[Feature, ...], statement: Statement) -> Iterator[Diagnostic]:
    for each in used:
        if not each.key and each.row.name in FORMS:
            yield Diagnostic(
                code="FCL516",
                message=f"{statement.name} may not read this: {each.words}",
                severity=Severity.WARNING,
                places=_places(each.places),
                hint="fcl-sim fmt writes it as the standard does",
            )


def _remarks(block: FunctionBlock, statement: Statement) -> Iterator[Diagnostic]:
    count = len(statement.remarks)
    if count:
        what = "a remark that no table can say" if count == 1 else f"{count} remarks that no table can say"
        yield Diagnostic(
            code="FCL515",
            message=f"the statement of {statement.name} has {what}",
            severity=Severity.NOTE,
            places=_places((block.span,) if block.span else ()),
            hint="fcl-sim conformance --target prints them",
        )


def _places(spans: tuple[Span, ...]) -> tuple[Place, ...]:
    return tuple(Place(span) for span in spans)


def _stated(span: Span) -> Place:
    return Place(span, "the target's statement")

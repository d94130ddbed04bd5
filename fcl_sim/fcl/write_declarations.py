"""Variables and structure types → VAR_INPUT, VAR_OUTPUT, VAR and TYPE (5.2.1, Annex D)."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

from fcl_sim.diagnostics import Span
from fcl_sim.fcl.comments import Comments
from fcl_sim.fcl.outline import END, END_STRUCT, END_TYPE, HEAD, STRUCT, TYPE
from fcl_sim.fcl.write_lines import INDENT, Line
from fcl_sim.fcl.write_numbers import constant, number
from fcl_sim.model import FunctionBlock, Member, Structure, Variable


@dataclass(frozen=True, slots=True)
class _Declared:
    """A name and what stands behind its colon: several names with the same may be one declaration."""

    name: str
    specification: str
    span: Span | None


def declarations(block: FunctionBlock, comments: Comments) -> Iterator[Line]:
    """Yield the sections of variables; what stands together in the text stays so."""
    spans = {each.variable: each.span for each in block.fuzzifications}
    elsewhere = {name for name, span in spans.items() if comments.part(span, "RANGE") is not None}
    for keyword, variables in (
        ("VAR_INPUT", block.inputs),
        ("VAR_OUTPUT", block.outputs),
        ("VAR", block.variables),
    ):
        for _, section in groupby(variables, lambda each: comments.section(each.span)):
            yield from _section(keyword, tuple(section), elsewhere, comments)


def limits(found: tuple[float, float]) -> str:
    """Return a range as 5.2.3 writes it."""
    low, high = found
    return f"RANGE := ({number(low)} .. {number(high)})"


def _section(
    keyword: str, variables: Sequence[Variable], elsewhere: set[str], comments: Comments
) -> Iterator[Line]:
    span = variables[0].span
    yield Line(code=(keyword,), number=comments.part(span, HEAD), blank=True)
    declared = list(_declared(variables, elsewhere))
    for members in _together(declared, comments):
        names = ", ".join(each.name for each in members)
        code = f"{names}: {members[0].specification};"
        yield Line(code=(code,), indent=INDENT, number=comments.number(members[0].span))
    yield Line(code=("END_VAR",), inner=INDENT, number=comments.part(span, END), blank=False)


def _declared(variables: Sequence[Variable], elsewhere: set[str]) -> Iterator[_Declared]:
    """Yield what is to be declared; the members of a structure are one variable.

    A range stands here unless FUZZIFY has it: those `elsewhere`.
    """
    for (name, structure), group in groupby(variables, _owner):
        first, *_ = group
        if structure is not None:
            yield _Declared(name, structure, first.span)
            continue
        found = None if name in elsewhere else first.range
        later = "" if found is None else f"; {limits(found)}"
        yield _Declared(name, f"{_typed(first)}{later}", first.span)


def _owner(variable: Variable) -> tuple[str, str | None]:
    """Return the name in the declaration, and the structure type."""
    if variable.structure is None:
        return variable.name, None
    return variable.name.rpartition(".")[0], variable.structure


def _together(declared: Sequence[_Declared], comments: Comments) -> Iterator[list[_Declared]]:
    """Yield what one declaration of the text declares."""
    members = [declared[0]]
    for each in declared[1:]:
        at = comments.number(each.span)
        joins = at is not None and at == comments.number(members[0].span)
        if joins and each.specification == members[0].specification:
            members.append(each)
            continue
        yield members
        members = [each]
    yield members


def _typed(variable: Variable | Member) -> str:
    initial = "" if variable.initial is None else f" := {constant(variable.initial, variable.type)}"
    return f"{variable.type}{initial}"


# -- structure types


def structures(types: Sequence[Structure], comments: Comments) -> Iterator[Line]:
    """Yield TYPE … END_TYPE as Annex D writes it, nothing where there are no types."""
    if not types:
        return
    yield Line(code=("TYPE",), number=comments.part(types[0].span, TYPE), blank=True)
    for each in types:
        span = each.span
        yield Line(code=(f"STRUCT {each.name}",), indent=INDENT, number=comments.part(span, STRUCT))
        for member in each.members:
            code = f"{member.name}: {_typed(member)};"
            at = comments.part(span, member.name.upper())
            yield Line(code=(code,), indent=2 * INDENT, number=at)
        at = comments.part(span, END_STRUCT)
        yield Line(code=("END_STRUCT",), indent=INDENT, inner=INDENT, number=at, blank=False)
    at = comments.part(types[-1].span, END_TYPE)
    yield Line(code=("END_TYPE",), inner=INDENT, number=at, blank=False)

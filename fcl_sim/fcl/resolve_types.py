"""Data types and structure types (5.2.1, Annex D; IEC 61131-3 B.1.3; S7)."""

from collections.abc import Iterable

from fcl_sim.diagnostics import Place
from fcl_sim.fcl.scope import Scope
from fcl_sim.fcl.tokens import Token
from fcl_sim.fcl.tree import Number, Structure, Structures
from fcl_sim.model import DataType, Member
from fcl_sim.model import Structure as ModelStructure

_WIDTHS = {
    DataType.SINT: 8,
    DataType.INT: 16,
    DataType.DINT: 32,
    DataType.LINT: 64,
    DataType.USINT: 8,
    DataType.UINT: 16,
    DataType.UDINT: 32,
    DataType.ULINT: 64,
}
"""Bits of the integer types (IEC 61131-3, Table 10)."""

_OTHERS = {"FLOAT": "REAL", "DOUBLE": "LREAL", "INTEGER": "INT", "BOOLEAN": "BOOL"}
"""What other languages call them."""


def resolve_structures(scope: Scope, sections: Iterable[Structures]) -> None:
    """Enter the structure types of sections into the scope."""
    for section in sections:
        for each in section.structures:
            name = each.name
            if name is None:
                message = "this structure has no name"
                scope.findings.error("FCL309", message, each.keyword, hint="write `STRUCT name`")
                continue
            first = scope.structures.setdefault(name.key, structure_type(scope, each, name))
            if first.span is not None and first.span.start != name.start:
                message = f"two structure types have the name {name.shown}"
                related = (Place(first.span, "first here"),)
                scope.findings.error("FCL301", message, name, related=related)


def structure_type(scope: Scope, structure: Structure, name: Token) -> ModelStructure:
    """Return the type that a structure declares; a member given twice is reported."""
    members: dict[str, Member] = {}
    names: dict[str, Token] = {}
    for each in structure.members:
        kind = data_type(scope, each.type)
        initial = None if each.initial is None else initial_value(scope, kind, each.initial)
        if each.name.key in members:
            message = f"`{name.text}` has two members {each.name.shown}"
            scope.report_twice("FCL301", message, each.name, names[each.name.key])
        names.setdefault(each.name.key, each.name)
        members.setdefault(each.name.key, Member(each.name.text, kind, initial))
    if not members:
        scope.findings.error("FCL309", f"the structure `{name.text}` has no members", name)
    scope.findings.feature("structure", f"the structure type `{name.text}`", name)
    return ModelStructure(name.text, tuple(members.values()), scope.findings.span(name))


def data_type(scope: Scope, token: Token | Structure | None) -> DataType:
    """Return the data type of a number that is named; REAL, once reported, where there is no such one.

    What is no name here has been reported by the parser.
    """
    if not isinstance(token, Token):
        return DataType.REAL
    if token.key in {each.value for each in DataType}:
        return DataType(token.key)
    _report_type(scope, token)
    return DataType.REAL


def _report_type(scope: Scope, token: Token) -> None:
    known = [*(each.value for each in DataType), *(each.name for each in scope.structures.values())]

    def hint() -> str:
        near = _OTHERS.get(token.key) or scope.findings.near(token.key, known)
        return f"did you mean {near}?" if near else f"the types of numbers are {', '.join(DataType)}"

    scope.findings.error("FCL305", f"{token.shown} is not a data type of a number", token, hint)


def initial_value(scope: Scope, kind: DataType, number: Number) -> float | None:
    """Return the initial value that a literal gives; None, once reported, where it does not fit."""
    limits = _limits(kind)
    if limits is None:
        if number.type != DataType.BOOL:
            return number.value
        message = f"a truth value cannot be the initial value of a variable of type {kind}"
        scope.findings.error("FCL306", message, number, hint="write 1.0 or 0.0, or declare it as BOOL")
        return None
    # Compared as binary64: the largest LINT is no number of that kind, its neighbour stands for it.
    if number.value.is_integer() and float(limits[0]) <= number.value <= float(limits[1]):
        return number.value
    shown = scope.findings.span(number).text
    held = (
        "0, 1, FALSE or TRUE" if kind is DataType.BOOL else f"whole numbers from {limits[0]} to {limits[1]}"
    )
    message = f"`{shown}` cannot be the initial value of a variable of type {kind}"
    scope.findings.error("FCL306", message, number, hint=f"{kind} holds {held}")
    return None


def _limits(kind: DataType) -> tuple[int, int] | None:
    """Return the least and the largest value of a type, None for REAL and LREAL."""
    if kind is DataType.BOOL:
        return 0, 1
    width = _WIDTHS.get(kind)
    if width is None:
        return None
    if kind.startswith("U"):
        return 0, 2**width - 1
    return -(2 ** (width - 1)), 2 ** (width - 1) - 1

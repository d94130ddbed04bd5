"""Declarations → variables of the model (5.2.1)."""

from fcl_sim.fcl.scope import Declared, Role, Scope
from fcl_sim.fcl.tokens import Token
from fcl_sim.fcl.tree import Declaration, Declarations, Number
from fcl_sim.model import DataType, Variable

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


def resolve_declarations(scope: Scope, section: Declarations, *, types: bool) -> None:
    """Declare the variables of a section; `types` says that structure types were passed over."""
    scope.incomplete = scope.incomplete or section.damaged
    if section.opening.key not in {each.value for each in Role}:
        scope.incomplete = True
        return
    role = Role(section.opening.key)
    for declaration in section.variables:
        _declare(scope, role, declaration, types=types)


def _declare(scope: Scope, role: Role, declaration: Declaration, *, types: bool) -> None:
    name = declaration.name
    data_type = DataType.REAL
    if declaration.type is not None:
        known = declaration.type.key in {each.value for each in DataType}
        if not known and types:
            scope.declare_structure(name)
            return
        if known:
            data_type = DataType(declaration.type.key)
        else:
            _report_type(scope, declaration.type)
    initial = None
    if declaration.initial is not None:
        initial = _initial(scope, data_type, declaration.initial)
    variable = Variable(name=name.text, type=data_type, initial=initial, span=scope.findings.span(name))
    scope.declare(Declared(variable, role, name))


def _report_type(scope: Scope, token: Token) -> None:
    known = [each.value for each in DataType]

    def hint() -> str:
        near = _OTHERS.get(token.key) or scope.findings.near(token.key, known)
        return f"did you mean {near}?" if near else f"the types of numbers are {', '.join(known)}"

    scope.findings.error("FCL305", f"{token.shown} is not a data type of a number", token, hint)


def _initial(scope: Scope, data_type: DataType, number: Number) -> float | None:
    limits = _limits(data_type)
    if limits is None:
        if number.type != DataType.BOOL:
            return number.value
        message = f"a truth value cannot be the initial value of a variable of type {data_type}"
        scope.findings.error("FCL306", message, number)
        return None
    # Compared as binary64: the largest LINT is no number of that kind, its neighbour stands for it.
    if number.value.is_integer() and float(limits[0]) <= number.value <= float(limits[1]):
        return number.value
    shown = scope.findings.span(number).text
    held = (
        "0, 1, FALSE or TRUE"
        if data_type is DataType.BOOL
        else f"whole numbers from {limits[0]} to {limits[1]}"
    )
    message = f"`{shown}` cannot be the initial value of a variable of type {data_type}"
    scope.findings.error("FCL306", message, number, hint=f"{data_type} holds {held}")
    return None


def _limits(data_type: DataType) -> tuple[int, int] | None:
    """Return the least and the largest value of a type, None for REAL and LREAL."""
    if data_type is DataType.BOOL:
        return 0, 1
    width = _WIDTHS.get(data_type)
    if width is None:
        return None
    if data_type.startswith("U"):
        return 0, 2**width - 1
    return -(2 ** (width - 1)), 2 ** (width - 1) - 1

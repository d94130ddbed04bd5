"""Declarations → variables of the model (5.2.1)."""

from fcl_sim.fcl.resolve_settings import range_of
from fcl_sim.fcl.resolve_types import data_type, initial_value, structure_type
from fcl_sim.fcl.scope import Declared, Role, Scope
from fcl_sim.fcl.tokens import Kind, Token
from fcl_sim.fcl.tree import Declaration, Declarations, Structure
from fcl_sim.model import Structure as ModelStructure
from fcl_sim.model import Variable


def resolve_declarations(scope: Scope, section: Declarations) -> None:
    """Declare the variables of a section."""
    scope.incomplete = scope.incomplete or section.damaged
    if section.opening.key not in {each.value for each in Role}:
        scope.incomplete = True
        return
    role = Role(section.opening.key)
    for declaration in section.variables:
        _declare(scope, role, declaration)


def _declare(scope: Scope, role: Role, declaration: Declaration) -> None:
    name = declaration.name
    limits = None
    if declaration.range is not None:
        scope.findings.feature("range", f"a range for `{name.text}`", declaration.range)
        limits = range_of(scope, declaration.range)
    kind = declaration.type
    structure = scope.structures.get(kind.key) if isinstance(kind, Token) else None
    if structure is None and isinstance(kind, Structure):
        structure = _inline(scope, kind, name)
    if structure is not None:
        _declare_members(scope, role, declaration, structure)
        return
    type_of = data_type(scope, kind)
    initial = None
    if declaration.initial is not None:
        initial = initial_value(scope, type_of, declaration.initial)
    variable = Variable(name.text, type_of, initial, scope.findings.span(name), range=limits)
    scope.declare(Declared(variable, role, name))


def _inline(scope: Scope, structure: Structure, variable: Token) -> ModelStructure:
    """Return the type of a structure that stands in a declaration, and name it after the variable (S7)."""
    text = f"{variable.text}_type"
    name = Token(Kind.NAME, text, text.upper(), variable.start)
    made = structure_type(scope, structure, name)
    return scope.structures.setdefault(name.key, made)


def _declare_members(scope: Scope, role: Role, declaration: Declaration, structure: ModelStructure) -> None:
    """Declare a variable for each member of a structure (S7)."""
    name = declaration.name
    if declaration.initial is not None:
        message = f"`{name.text}` is a structure and cannot have one initial value"
        hint = f"give the members of `{structure.name}` theirs"
        scope.findings.error("FCL306", message, declaration.initial, hint)
    scope.instances[name.key] = structure
    if name.key in scope.variables:
        message = f"`{name.text}` is declared twice"
        scope.report_twice("FCL301", message, name, scope.variables[name.key].token)
    for member in structure.members:
        text = f"{name.text}.{member.name}"
        token = Token(Kind.NAME, text, text.upper(), name.start)
        span = scope.findings.span(name)
        variable = Variable(text, member.type, member.initial, span, structure=structure.name)
        scope.declare(Declared(variable, role, token))

"""Formulae of terms: the names in them get their meaning (FUNCTION, Function and Linear, S15)."""

import math

from fcl_sim.fcl.findings import Stretch
from fcl_sim.fcl.scope import Role, Scope
from fcl_sim.fcl.tokens import Kind, Token
from fcl_sim.fcl.tree import Formula, Named, Number
from fcl_sim.model import Call, Expression, Operation, Operator, Reference
from fcl_sim.model import Formula as ModelFormula
from fcl_sim.model import Number as Constant


def resolve_formula(scope: Scope, formula: Formula) -> ModelFormula | None:
    """Return a formula; None, once reported, where a name in it means nothing."""
    scope.findings.feature("formula", f"a formula ({formula.name.text})", formula)
    found = _resolved(scope, formula.expression)
    return None if found is None else ModelFormula(found)


def resolve_linear(scope: Scope, shape: Named) -> ModelFormula | None:
    """Return fuzzylite's `Linear c1 c2 … c0` as a formula: each input times its coefficient, plus the last.

    Inputs without a coefficient do not count; a coefficient more than there are
    inputs is the constant.
    """
    scope.findings.feature("formula", f"a formula ({shape.name.text})", shape)
    coefficients = []
    for each in shape.arguments:
        if not isinstance(each, Number) or not math.isfinite(each.value):
            message = f"the coefficients of {shape.name.text} are numbers"
            scope.findings.error("FCL322", message, each)
            return None
        coefficients.append(each.value)
    inputs = [each for each in scope.variables.values() if each.role is Role.INPUT]
    if len(coefficients) > len(inputs) + 1:
        count = f"{len(inputs)} input{'' if len(inputs) == 1 else 's'} and a constant"
        message = f"{shape.name.text} has {len(coefficients)} coefficients, for {count}"
        scope.findings.error("FCL322", message, shape)
        return None
    span = scope.findings.span(shape.name)
    parts: list[Expression] = [
        Operation(Operator.TIMES, (Constant(factor), Reference(each.name, span)))
        for factor, each in zip(coefficients, inputs, strict=False)
    ]
    parts += [Constant(each) for each in coefficients[len(inputs) :]]
    return ModelFormula(parts[0] if len(parts) == 1 else Operation(Operator.PLUS, tuple(parts)))


def _resolved(scope: Scope, expression: Expression) -> Expression | None:
    """Return an expression with the names as declared; it calls itself, and the parser bounds how deep."""
    match expression:
        case Reference():
            return _reference(scope, expression)
        case Operation() | Call():
            parts = [_resolved(scope, each) for each in expression.arguments]
            known = tuple(each for each in parts if each is not None)
            if len(known) < len(parts):
                return None
            if isinstance(expression, Call):
                return Call(expression.function, known)
            return Operation(expression.operator, known)
    return expression


def _reference(scope: Scope, reference: Reference) -> Expression | None:
    key = reference.variable.upper()
    if key == "PI" and key not in scope.variables:
        return Constant(math.pi)
    start = reference.span.start if reference.span else 0
    token = Token(Kind.NAME, reference.variable, key, start)
    declared = scope.find(token)
    if declared is None:
        return None
    if declared.role is Role.LOCAL:
        message = f"`{declared.name}` is a local variable: a formula is made of inputs and outputs"
        scope.findings.error("FCL303", message, Stretch(token.start, token.end))
        return None
    return Reference(declared.name, reference.span)

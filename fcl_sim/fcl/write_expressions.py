"""Expressions of terms → text: parentheses where the priorities of algebra need them (Open Level)."""

from fcl_sim.fcl.write_numbers import number
from fcl_sim.model import Call, Expression, Number, Operation, Operator, Reference

_SUM, _PRODUCT, _OPPOSITE, _POWER, _ATOM = range(1, 6)
_BINDING = {
    Operator.PLUS: _SUM,
    Operator.MINUS: _SUM,
    Operator.TIMES: _PRODUCT,
    Operator.OVER: _PRODUCT,
    Operator.MODULUS: _PRODUCT,
    Operator.POWER: _POWER,
}


def expression(tree: Expression) -> str:
    """Return an expression that reads back as the same tree.

    Calls itself as deep as the expression is nested, which its reader bounds.
    """
    match tree:
        case Number():
            return number(tree.value)
        case Reference():
            return tree.variable
        case Call():
            return f"{tree.function}({', '.join(expression(each) for each in tree.arguments)})"
        case Operation(arguments=(argument,)):
            return f"-{_operand(argument, _POWER)}"
        case Operation():
            return _operation(tree)


def _operation(tree: Operation) -> str:
    """Return operands with their operator: joined from the left, a power from the right.

    What begins with a minus stands in parentheses behind an operator.
    """
    binding = _BINDING[tree.operator]
    first, *others = tree.arguments
    is_power = binding == _POWER
    parts = [_operand(first, _ATOM if is_power else binding)]
    for each in others:
        part = _operand(each, _POWER if is_power else binding + 1)
        parts.append(f"({part})" if part.startswith("-") else part)
    return f" {tree.operator} ".join(parts)


def _operand(tree: Expression, least: int) -> str:
    """Return an expression, in parentheses if it binds less than `least`."""
    text = expression(tree)
    return text if _binding(tree) >= least else f"({text})"


def _binding(tree: Expression) -> int:
    match tree:
        case Number():
            return _OPPOSITE if number(tree.value).startswith("-") else _ATOM
        case Operation(arguments=(_,)):
            return _OPPOSITE
        case Operation():
            return _BINDING[tree.operator]
    return _ATOM

"""Formulae of terms (Open Level): postfix code, and the kernel that calculates their places."""

from collections.abc import Callable

from numpy import float64, int64
from numpy.typing import NDArray

from fcl_sim.arithmetic import formulas as f
from fcl_sim.arithmetic.formulas import BINARY, of_one, of_two
from fcl_sim.engine.moving import sourced
from fcl_sim.engine.program import FORMULA_CODE, FORMULA_LENGTH, FORMULA_PUSH, FORMULA_STACK, FORMULA_VALUE
from fcl_sim.jit import flat, u
from fcl_sim.model import Call, Expression, Function, Number, Operator, Reference

Ints = NDArray[int64]
Floats = NDArray[float64]

OPERATORS = {
    Operator.POWER: f.POWER,
    Operator.MODULUS: f.MODULUS,
    Operator.TIMES: f.TIMES,
    Operator.OVER: f.OVER,
    Operator.PLUS: f.PLUS,
    Operator.MINUS: f.MINUS,
}
FUNCTIONS = {
    Function.ABS: f.ABS,
    Function.ACOS: f.ACOS,
    Function.ACOSH: f.ACOSH,
    Function.ASIN: f.ASIN,
    Function.ASINH: f.ASINH,
    Function.ATAN: f.ATAN,
    Function.ATANH: f.ATANH,
    Function.ATAN2: f.ATAN2,
    Function.CEIL: f.CEIL,
    Function.COS: f.COS,
    Function.COSH: f.COSH,
    Function.EQ: f.EQ,
    Function.EXP: f.EXP,
    Function.FLOOR: f.FLOOR,
    Function.GE: f.GE,
    Function.GT: f.GT,
    Function.LE: f.LE,
    Function.LN: f.LN,
    Function.LOG1P: f.LOG1P,
    Function.LOG10: f.LOG10,
    Function.LT: f.LT,
    Function.MAX: f.MAX,
    Function.MIN: f.MIN,
    Function.NEQ: f.NEQ,
    Function.POW: f.POWER,
    Function.ROUND: f.ROUND,
    Function.SIN: f.SIN,
    Function.SINH: f.SINH,
    Function.SQRT: f.SQRT,
    Function.TAN: f.TAN,
    Function.TANH: f.TANH,
}


def postfix(expression: Expression, source: Callable[[float | str], int]) -> list[int]:
    """Return an expression as postfix code; `source` gives that of a number or of a variable."""
    if isinstance(expression, Number):
        return [FORMULA_PUSH, source(expression.value)]
    if isinstance(expression, Reference):
        return [FORMULA_PUSH, source(expression.variable)]
    parts = [postfix(each, source) for each in expression.arguments]
    if isinstance(expression, Call):
        code = FUNCTIONS[expression.function]
    elif expression.operator is Operator.MINUS and len(parts) == 1:
        code = f.OPPOSITE
    else:
        code = OPERATORS[expression.operator]
    words = parts[0]
    if code >= BINARY:
        return [*words, code]
    for part in parts[1:]:
        words = [*words, *part, code]
    return words


def depth(code: list[int]) -> int:
    """Return how many numbers the stack must hold for a postfix code."""
    deepest = level = place = 0
    while place < len(code):
        push = code[place] == FORMULA_PUSH
        level += 1 if push else -1 if code[place] < BINARY else 0
        place += 2 if push else 1
        deepest = max(deepest, level)
    return deepest


@flat
def place_formulas(ints: Ints, floats: Floats, origin: int, start: int, memory: Floats, base: int) -> None:
    """Calculate the formulae whose number stands at `start`, and whose records follow."""
    record = start + 1
    for _ in range(ints[u(start)]):
        first = base + ints[u(record + FORMULA_STACK)]
        top = first - 1
        place = record + FORMULA_CODE
        end = place + ints[u(record + FORMULA_LENGTH)]
        while place < end:
            code = ints[u(place)]
            place += 1
            if code == FORMULA_PUSH:
                top += 1
                memory[u(top)] = sourced(ints[u(place)], floats, origin, memory, base)
                place += 1
            elif code < BINARY:
                top -= 1
                memory[u(top)] = of_two(code, memory[u(top)], memory[u(top + 1)])
            else:
                memory[u(top)] = of_one(code, memory[u(top)])
        memory[u(base + ints[u(record + FORMULA_VALUE)])] = memory[u(first)]
        record = end

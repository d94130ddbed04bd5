"""`expression`, a family of its own: a formula of signals, held to its units, then postfix code."""

from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType
from typing import Any

from fcl_sim.arithmetic import formulas as f
from fcl_sim.arithmetic.formulas import BINARY, of_one, of_two
from fcl_sim.diagnostics import Diagnostic, InputFault
from fcl_sim.formula.parse import Parser
from fcl_sim.formula.resolve import Resolver
from fcl_sim.formula.text import Text
from fcl_sim.formula.tokens import scan
from fcl_sim.formula.tree import Arithmetic, Expression, Number, Scaled, Signal
from fcl_sim.jit import flat
from fcl_sim.loop.blocks.declaration import (
    BlockInputs,
    BlockOutput,
    BlockParameter,
    BlockType,
    Misfit,
    Prepared,
    ToldElsewhere,
)
from fcl_sim.loop.blocks.setting import Setting
from fcl_sim.loop.row import Row, keep, number, read, recall, word, write
from fcl_sim.units import Quantity, Unit

INPUT = 64
"""From this word on, a word of the code puts a number on the stack: an even one an input, an odd one a
constant."""
LENGTH, CODE = 0, 1

OPERATIONS: Mapping[str, int] = MappingProxyType(
    {
        "+": f.PLUS,
        "-": f.MINUS,
        "*": f.TIMES,
        "/": f.OVER,
        "negative": f.OPPOSITE,
        "abs": f.ABS,
        "min": f.MIN,
        "max": f.MAX,
        "sqrt": f.SQRT,
        "pow": f.POWER,
        "mod": f.MODULUS,
        "exp": f.EXP,
        "ln": f.LN,
        "log10": f.LOG10,
        "sin": f.SIN,
        "cos": f.COS,
        "tan": f.TAN,
        "asin": f.ASIN,
        "acos": f.ACOS,
        "atan": f.ATAN,
        "atan2": f.ATAN2,
        "sinh": f.SINH,
        "cosh": f.COSH,
        "tanh": f.TANH,
        "floor": f.FLOOR,
        "ceil": f.CEIL,
        "round": f.ROUND,
    }
)
"""The codes of operators and functions."""


@flat
def calculate(row: Row) -> None:
    """Kernel of `expression`; its states are the stack."""
    top = -1
    for place in range(CODE, CODE + word(row, LENGTH)):
        code = word(row, place)
        if code >= INPUT:
            top += 1
            source = (code - INPUT) >> 1
            keep(row, top, number(row, source) if code & 1 else read(row, source))
        elif code < BINARY:
            top -= 1
            keep(row, top, of_two(code, recall(row, top), recall(row, top + 1)))
        else:
            keep(row, top, of_one(code, recall(row, top)))
    write(row, 0, recall(row, 0))


def parsed(text: Text) -> Expression:
    """Return the tree of a formula; InputFault, at its place, where it is none."""
    parser = Parser(scan(text))
    found = parser.number(parser.inner(), "a formula")
    parser.ended("join two numbers by + - * /")
    return found


def _fitting(text: Text, units: Mapping[str, Unit]) -> tuple[Expression, Unit | None, list[Diagnostic]]:
    """Return a formula in the units of its inputs, the unit of its result, and all that does not fit."""
    resolver = Resolver(units)
    tree = parsed(text)
    sized = resolver.number(tree)
    return (tree, None, resolver.faults) if sized is None else (*sized, resolver.faults)


def _unit(inputs: Mapping[str, Unit], text: Text) -> Unit:
    unit = _fitting(text, inputs)[1]
    if unit is None:
        raise ToldElsewhere("the formula has no unit")
    return unit


def _outputs(parameters: Mapping[str, Any]) -> tuple[BlockOutput, ...]:
    def unit(inputs: Mapping[str, Unit], _: Mapping[str, Quantity]) -> Unit:
        return _unit(inputs, parameters["formula"])

    return (BlockOutput(unit=unit),)


def _legible(parameters: Mapping[str, Any]) -> Iterator[Misfit]:
    try:
        parsed(parameters["formula"])
    except InputFault as fault:
        yield from _misfits(fault.diagnostics)


def _check(setting: Setting) -> Iterator[Misfit]:
    yield from _misfits(_fitting(setting.values["formula"], setting.units)[2])


def _misfits(faults: list[Diagnostic] | tuple[Diagnostic, ...]) -> Iterator[Misfit]:
    for each in faults:
        yield Misfit(
            parameter="formula", message=each.message, hint=each.hint, span=each.places[0].span, code="WIR203"
        )


def _prepare(setting: Setting) -> Prepared:
    tree, *_ = _fitting(setting.values["formula"], setting.units)
    numbers: list[float] = []

    def constant(value: float) -> int:
        numbers.append(value)
        return INPUT + 2 * len(numbers) - 1

    ports = {port: INPUT + 2 * i for i, port in enumerate(setting.connected)}
    code = _postfix(tree, ports, constant)
    return Prepared(numbers=numbers, words=(len(code), *code), states=(0.0,) * _depth(code))


def _postfix(node: Expression, ports: Mapping[str, int], constant: Callable[[float], int]) -> list[int]:
    match node:
        case Number():
            return [constant(node.quantity.value)]
        case Signal():
            return [ports[node.name]]
        case Scaled():
            return [constant(node.factor), *_postfix(node.operand, ports, constant), f.TIMES]
        case Arithmetic():
            operation = OPERATIONS[node.operator]
            first, *others = (_postfix(each, ports, constant) for each in node.operands)
            if not others:
                return [*first, operation]
            for each in others:
                first = [*first, *each, operation]
            return first


def _depth(code: list[int]) -> int:
    """Return how many numbers the stack must hold."""
    level = deepest = 0
    for each in code:
        level += 1 if each >= INPUT else -1 if each < BINARY else 0
        deepest = max(deepest, level)
    return deepest


EXPRESSION = BlockType(
    name="expression",
    summary="a formula of signals, held to its units",
    equation=(
        "y = formula(u): numbers with units, inputs by name, + - * / and parentheses; abs min max sqrt pow "
        "mod exp ln log10 sin cos tan asin acos atan atan2 sinh cosh tanh floor ceil round. What is added or "
        "compared converts to one unit, that of the first signal; sin cos tan take angles, asin acos atan "
        "atan2 give them; sqrt halves a unit, pow with a whole number raises it; the others take plain "
        "numbers. No memory"
    ),
    source="IEC 61131-3 3.3, expressions of ST; IEC 61131-7 A.3, preparation of the inputs",
    kernel=calculate,
    group=BlockInputs(name="inputs", meaning="u, each under the name that the formula knows", form="named"),
    parameters=(
        BlockParameter(
            name="formula",
            kind="formula",
            meaning="what is calculated; a/0 and the like give NaN or infinity",
        ),
    ),
    outputs=_outputs,
    prepare=_prepare,
    check=_check,
    legible=_legible,
)

TABLE = (EXPRESSION,)


@flat
def execute(code: int, row: Row) -> None:
    """Execute a block of this family by its row in TABLE."""
    if code == 0:
        calculate(row)

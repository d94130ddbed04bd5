"""Expressions of FUNCTION terms: parsed with stacks of its own, never evaluated as code (S15)."""

from dataclasses import dataclass, field

from fcl_sim.fcl.cursor import Astray, Cursor
from fcl_sim.fcl.parse_values import number, variable
from fcl_sim.fcl.tokens import Kind, Token
from fcl_sim.model import Call, Expression, Function, Number, Operation, Operator, Reference

DEEPEST = 50
"""Levels of an expression: what is deeper is refused."""
LONGEST = 1000
"""Numbers and names in an expression."""

_AFTER_NAME = frozenset(("+", "-", "*", "/", "^", "%", ")", ",", ";"))
_ALSO = {"LOG": "log10", "FABS": "abs"}
_COMPARISONS = (Function.EQ, Function.NEQ, Function.LT, Function.LE, Function.GT, Function.GE)
_ARGUMENTS = {
    Function.MAX: (2, LONGEST),
    Function.MIN: (2, LONGEST),
    **dict.fromkeys((Function.ATAN2, Function.POW, *_COMPARISONS), (2, 2)),
}
"""How many arguments functions take; the others take one."""

_OPERANDS = 2
"""Of an operator; fuzzylite has fmod as well as its sign."""
_NEGATION = "~"
_BINDING = {"+": 1, "-": 1, "*": 2, "/": 2, "%": 2, _NEGATION: 3, "^": 4}
"""How tightly an operator binds; `~` is the minus before its one argument."""

_Part = tuple[Expression, int]
"""An expression and how many levels it has."""


@dataclass(slots=True)
class _Level:
    """What has been read within one pair of parentheses."""

    opening: Token | None = None
    function: Token | None = None
    arguments: list[_Part] = field(default_factory=list)
    values: list[_Part] = field(default_factory=list)
    operators: list[str] = field(default_factory=list)


def expression(cursor: Cursor, *, natural: bool = False) -> Expression:
    """Read `expression ::= operand {operator operand}` (S15).

    `operator ::= '+' | '-' | '*' | '/' | '%' | '^'`, with the priorities of
    algebra; `^` joins from the right. `natural` says that LOG is the natural
    logarithm, as fuzzylite has it, and not the decimal one.
    """
    levels = [_Level()]
    count = 0
    while True:
        _opening(cursor, levels)
        levels[-1].values.append((operand(cursor), 1))
        count += 1
        if count > LONGEST:
            message = f"this formula has more than {LONGEST} numbers and names"
            raise cursor.refuse("FCL208", message, cursor.last)
        while len(levels) > 1 and cursor.take(")"):
            _close(cursor, levels, natural=natural)
        if not _operator(cursor, levels[-1]):
            break
    if len(levels) > 1:
        opening = levels[-1].opening or cursor.last
        raise cursor.refuse(
            "FCL207", "this parenthesis is not closed", opening, "write `)` behind the formula"
        )
    _reduce(cursor, levels[0], 0)
    return levels[0].values[0][0]


def operand(cursor: Cursor) -> Expression:
    """Read an operand whose signs and opening parentheses have been taken.

    `operand ::= {'-' | '+'} (numeric_literal | variable | '(' expression ')'
    | function_name '(' expression {',' expression} ')')`
    """
    what = "a number, the name of a variable or a function"
    if cursor.token.kind is Kind.NAME:
        name = variable(cursor, what, _AFTER_NAME)
        return Reference(name.text, cursor.findings.span(name))
    return Number(number(cursor, what).value)


def _opening(cursor: Cursor, levels: list[_Level]) -> None:
    """Take signs, functions and opening parentheses."""
    while True:
        token = cursor.token
        if token.key == "-":
            levels[-1].operators.append(_NEGATION)
        elif token.key == "(":
            levels.append(_Level(opening=token))
        elif token.kind is Kind.NAME and cursor.ahead().key == "(":
            levels.append(_Level(opening=cursor.ahead(), function=token))
            cursor.advance()
        elif token.key != "+":
            return
        if len(levels) > DEEPEST or len(levels[-1].operators) > DEEPEST:
            raise _too_deep(cursor, token)
        cursor.advance()


def _operator(cursor: Cursor, level: _Level) -> bool:
    """Take an operator, or the comma before another argument; return whether there was one."""
    sign = cursor.token.key
    if sign == "," and level.function is not None:
        cursor.advance()
        _end_argument(cursor, level)
        return True
    if cursor.token.kind is not Kind.SYMBOL or sign not in _BINDING:
        return False
    cursor.advance()
    _reduce(cursor, level, _BINDING[sign] + (sign == "^"))
    level.operators.append(sign)
    return True


def _reduce(cursor: Cursor, level: _Level, binding: int) -> None:
    """Apply the operators that bind as tightly as `binding`, or more."""
    while level.operators and _BINDING[level.operators[-1]] >= binding:
        sign = level.operators.pop()
        right, depth = level.values.pop()
        if sign == _NEGATION:
            made: Expression = Operation(Operator.MINUS, (right,))
            depth += 1
            if isinstance(right, Number):
                made, depth = Number(-right.value), 1
        else:
            made, depth = _joined(Operator(sign), level.values.pop(), (right, depth))
        if depth >= DEEPEST:
            raise _too_deep(cursor, cursor.last)
        level.values.append((made, depth))


def _joined(operator: Operator, left: _Part, right: _Part) -> _Part:
    """Return an operation; what begins with a sum of its own kind is one sum, and so is a product."""
    first, depth = left
    longer = operator in {Operator.PLUS, Operator.TIMES} and isinstance(first, Operation)
    if longer and isinstance(first, Operation) and first.operator is operator:
        return Operation(operator, (*first.arguments, right[0])), max(depth, right[1] + 1)
    return Operation(operator, (first, right[0])), max(depth, right[1]) + 1


def _end_argument(cursor: Cursor, level: _Level) -> None:
    _reduce(cursor, level, 0)
    level.arguments.append(level.values.pop())


def _close(cursor: Cursor, levels: list[_Level], *, natural: bool) -> None:
    """Make one value of what stands in parentheses."""
    closed = levels.pop()
    _end_argument(cursor, closed)
    depth = max(each for _, each in closed.arguments)
    made = closed.arguments[0][0]
    if closed.function is not None:
        depth += 1
        made = _call(cursor, closed.function, tuple(each for each, _ in closed.arguments), natural=natural)
    if depth > DEEPEST:
        raise _too_deep(cursor, closed.opening or cursor.last)
    levels[-1].values.append((made, depth))


def _call(cursor: Cursor, name: Token, arguments: tuple[Expression, ...], *, natural: bool) -> Expression:
    if name.key == "FMOD" and len(arguments) == _OPERANDS:
        return Operation(Operator.MODULUS, arguments)
    functions = {each.upper(): each for each in Function}
    also = _ALSO | ({"LOG": "ln"} if natural else {})
    function = functions.get(also.get(name.key, name.key).upper())
    if function is None:
        near = cursor.findings.near(name.text, list(Function))
        hint = f"did you mean {near}?" if near else f"functions are {', '.join(Function)}"
        raise cursor.refuse("FCL360", f"{name.shown} is not a function", name, hint)
    least, most = _ARGUMENTS.get(function, (1, 1))
    if not least <= len(arguments) <= most:
        wanted = "one argument" if most == 1 else "two arguments" if most == 2 else "two arguments or more"
        raise cursor.refuse("FCL361", f"{name.text} takes {wanted}, not {len(arguments)}", name)
    return Call(function, arguments)


def _too_deep(cursor: Cursor, at: Token) -> Astray:
    return cursor.refuse("FCL208", f"this formula is nested more than {DEEPEST} levels deep", at)

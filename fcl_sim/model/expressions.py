"""Expressions of terms that are formulae (FUNCTION, Linear, Function: Open Level)."""

from dataclasses import dataclass, field
from enum import StrEnum

from fcl_sim.diagnostics import Span


class Operator(StrEnum):
    """Operators, those that bind most first; `-` with one argument is the opposite."""

    POWER = "^"
    MODULUS = "%"
    """The remainder, with the sign of the dividend."""
    TIMES = "*"
    """Two arguments or more."""
    OVER = "/"
    PLUS = "+"
    """Two arguments or more."""
    MINUS = "-"


class Function(StrEnum):
    """Functions of numbers; angles are in radian. No other can be called."""

    ABS = "abs"
    ACOS = "acos"
    ACOSH = "acosh"
    ASIN = "asin"
    ASINH = "asinh"
    ATAN = "atan"
    ATAN2 = "atan2"
    ATANH = "atanh"
    CEIL = "ceil"
    COS = "cos"
    COSH = "cosh"
    EQ = "eq"
    """1 where two numbers are equal, else 0; so are the other comparisons."""
    EXP = "exp"
    FLOOR = "floor"
    GE = "ge"
    GT = "gt"
    LE = "le"
    LN = "ln"
    LOG10 = "log10"
    LOG1P = "log1p"
    LT = "lt"
    MAX = "max"
    """Two arguments or more."""
    MIN = "min"
    """Two arguments or more."""
    NEQ = "neq"
    POW = "pow"
    ROUND = "round"
    SIN = "sin"
    SINH = "sinh"
    SQRT = "sqrt"
    TAN = "tan"
    TANH = "tanh"


@dataclass(frozen=True, slots=True)
class Number:
    """A constant."""

    value: float


@dataclass(frozen=True, slots=True)
class Reference:
    """The value of a variable, by its name as declared."""

    variable: str
    span: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Operation:
    """An operator and its arguments, in the order of the text."""

    operator: Operator
    arguments: tuple["Expression", ...]


@dataclass(frozen=True, slots=True)
class Call:
    """A function and its arguments."""

    function: Function
    arguments: tuple["Expression", ...]


Expression = Number | Reference | Operation | Call
"""A tree of bounded depth: whoever walks it may call themselves."""

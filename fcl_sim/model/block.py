"""The function block and its interface (5.2.1 to 5.2.3)."""

from dataclasses import dataclass, field
from enum import StrEnum

from fcl_sim.diagnostics import Span
from fcl_sim.model.operators import Method
from fcl_sim.model.rules import RuleBlock
from fcl_sim.model.terms import Term


class DataType(StrEnum):
    """Elementary data types of IEC 61131-3 that hold a number or a truth value."""

    BOOL = "BOOL"
    SINT = "SINT"
    INT = "INT"
    DINT = "DINT"
    LINT = "LINT"
    USINT = "USINT"
    UINT = "UINT"
    UDINT = "UDINT"
    ULINT = "ULINT"
    REAL = "REAL"
    LREAL = "LREAL"


@dataclass(frozen=True, slots=True)
class Variable:
    """A declared variable; `initial` is None where none is declared."""

    name: str
    type: DataType = DataType.REAL
    initial: float | None = None
    span: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Fuzzification:
    """FUZZIFY: the terms of an input variable."""

    variable: str
    terms: tuple[Term, ...]
    span: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class Defuzzification:
    """DEFUZZIFY: the terms of an output variable and how a number is made of them.

    `default` is None for NC, no change. `range` is (minimum, maximum) or None.
    """

    variable: str
    terms: tuple[Term, ...]
    method: Method
    default: float | None
    range: tuple[float, float] | None = None
    span: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class FunctionBlock:
    """A fuzzy function block: all names resolve, every choice is made.

    `options` are the contents of its OPTIONS sections, word for word (5.2.5).
    """

    name: str
    inputs: tuple[Variable, ...]
    outputs: tuple[Variable, ...]
    variables: tuple[Variable, ...] = ()
    fuzzifications: tuple[Fuzzification, ...]
    defuzzifications: tuple[Defuzzification, ...]
    rule_blocks: tuple[RuleBlock, ...]
    options: tuple[str, ...] = ()
    span: Span | None = field(default=None, compare=False, repr=False)

"""The function block and its interface (5.2.1 to 5.2.3)."""

from dataclasses import dataclass, field
from enum import StrEnum
from math import isnan

from fcl_sim.diagnostics import Span
from fcl_sim.model.notes import Note
from fcl_sim.model.operators import Accumulation, Method
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
    """A declared variable; `initial` is None where none is declared.

    A member of a structure is a variable of its own with a name such as
    `color.brown`; `structure` is then the name of the structure's type.
    `range` is what the text declares of an input or local variable (Open
    Level): it bounds nothing unless a Fuzzification is `clamped`.
    """

    name: str
    type: DataType = DataType.REAL
    initial: float | None = None
    span: Span | None = field(default=None, compare=False, repr=False)
    range: tuple[float, float] | None = field(default=None, kw_only=True)
    structure: str | None = field(default=None, kw_only=True)


@dataclass(frozen=True, slots=True)
class Member:
    """A member of a structure type, with its initial value if one is declared there."""

    name: str
    type: DataType = DataType.REAL
    initial: float | None = None


@dataclass(frozen=True, slots=True)
class Structure:
    """A structure type (Annex D): TYPE name: STRUCT … END_STRUCT."""

    name: str
    members: tuple[Member, ...]
    span: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Fuzzification:
    """FUZZIFY: the terms of an input variable.

    Open Level: unless `enabled`, all its degrees are 0; where `clamped`, the
    variable is taken no further than its range.
    """

    variable: str
    terms: tuple[Term, ...]
    span: Span | None = field(default=None, compare=False, repr=False)
    enabled: bool = field(default=True, kw_only=True)
    clamped: bool = field(default=False, kw_only=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class Defuzzification:
    """DEFUZZIFY: the terms of an output variable and how a number is made of them.

    `default` is None for NC, no change; NaN is a default value too (Open Level).
    `range` is (minimum, maximum) or None. `accumulation` is the output's own
    ACCU, which goes before that of the rule blocks, or None (S8).

    Open Level: where `held` (`nan | NC`, LOCK : PREVIOUS), the previous output
    stays while no rule is active, and `default` is given out only before the
    first one. Where `clamped` (LOCK : RANGE), the result is taken no further
    than the range. Unless `enabled`, conclusions on the variable do not count.
    """

    variable: str
    terms: tuple[Term, ...]
    method: Method
    default: float | None
    range: tuple[float, float] | None = None
    accumulation: Accumulation | None = None
    held: bool = False
    clamped: bool = False
    enabled: bool = True
    span: Span | None = field(default=None, compare=False, repr=False)

    def __eq__(self, other: object) -> bool:
        """Whether both say the same; a default of NaN is the same as one of NaN."""
        if not isinstance(other, Defuzzification):
            return NotImplemented
        return _compared(self) == _compared(other)

    def __hash__(self) -> int:
        """Agree with `__eq__`."""
        return hash(_compared(self))


def _compared(output: Defuzzification) -> tuple[object, ...]:
    default = "NaN" if output.default is not None and isnan(output.default) else output.default
    choices = (output.method, default, output.range, output.accumulation)
    return (output.variable, output.terms, *choices, output.held, output.clamped, output.enabled)


@dataclass(frozen=True, slots=True, kw_only=True)
class FunctionBlock:
    """A fuzzy function block: all names resolve, every choice is made.

    `options` are the contents of its OPTIONS sections, word for word (5.2.5).
    `structures` are the types that its variables may have. `notes` are the
    features of the text beyond the Basic Level, in the order of the text; the
    same model can be written without them.
    """

    name: str
    inputs: tuple[Variable, ...]
    outputs: tuple[Variable, ...]
    variables: tuple[Variable, ...] = ()
    fuzzifications: tuple[Fuzzification, ...]
    defuzzifications: tuple[Defuzzification, ...]
    rule_blocks: tuple[RuleBlock, ...]
    options: tuple[str, ...] = ()
    structures: tuple[Structure, ...] = ()
    notes: tuple[Note, ...] = field(default=(), compare=False, repr=False)
    span: Span | None = field(default=None, compare=False, repr=False)

"""The syntax tree: what the text says, in the order in which it says it, before any name has a meaning.

Names are tokens, so that each keeps its spelling and its place. A part that
could not be read is None, and what holds it is `damaged`: nobody may conclude
from something's absence there.
"""

from dataclasses import dataclass

from fcl_sim.diagnostics import Source, Span
from fcl_sim.fcl.tokens import Token
from fcl_sim.model import Expression


@dataclass(frozen=True, slots=True)
class Number:
    """A numeric literal with its sign; `type` is the keyword before `#`, or empty."""

    value: float
    start: int
    end: int
    type: str = ""


Value = Number | Token
"""A number, or the name of the variable that holds one."""


@dataclass(frozen=True, slots=True)
class Range:
    """The limits `(low .. high)`."""

    low: Number
    high: Number

    @property
    def start(self) -> int:
        """Offset of the lower limit."""
        return self.low.start

    @property
    def end(self) -> int:
        """Offset behind the upper limit."""
        return self.high.end


@dataclass(frozen=True, slots=True)
class Declaration:
    """One variable of a declaration `a, b: REAL := 0.5;`, with what RANGE says of it.

    `type` is the name of a type, or the structure that stands in its place.
    """

    name: Token
    type: "Token | Structure | None"
    initial: Number | None
    range: Range | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Declarations:
    """A section between VAR_INPUT, VAR_OUTPUT or VAR (`opening`) and END_VAR."""

    opening: Token
    variables: tuple[Declaration, ...]
    damaged: bool


@dataclass(frozen=True, slots=True)
class Structure:
    """`name: STRUCT … END_STRUCT`, `STRUCT name … END_STRUCT` or, with its variable, without a name (S7)."""

    keyword: Token
    name: Token | None
    members: tuple[Declaration, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Structures:
    """A section between TYPE and END_TYPE, or a STRUCT without them (`opening`)."""

    opening: Token
    structures: tuple[Structure, ...]
    damaged: bool


@dataclass(frozen=True, slots=True)
class Pair:
    """A point in parentheses: abscissa and degree."""

    x: Value
    degree: Value
    start: int
    end: int


@dataclass(frozen=True, slots=True)
class Named:
    """A membership function by its name: `GAUSS 2 1`, `Triangle (0, 1, 2)`, `SINGLETONS (0, 1) (1, 0.5)`.

    Parentheses and commas between the arguments mean nothing.
    """

    name: Token
    arguments: tuple[Value, ...]
    end: int

    @property
    def start(self) -> int:
        """Offset of the name."""
        return self.name.start


@dataclass(frozen=True, slots=True)
class Formula:
    """`FUNCTION expression`; the names in it mean nothing yet."""

    name: Token
    expression: Expression
    end: int

    @property
    def start(self) -> int:
        """Offset of the keyword."""
        return self.name.start


Shape = tuple[Pair, ...] | Value | Named | Formula


@dataclass(frozen=True, slots=True)
class Term:
    """`TERM name := …;` with points, a number, the name of a variable, or a shape of the Open Level."""

    name: Token
    shape: Shape | None


@dataclass(frozen=True, slots=True)
class Default:
    """`number | NC` (fuzzylite): the number is given out once, then the previous output."""

    value: Number

    @property
    def start(self) -> int:
        """Offset of the number."""
        return self.value.start

    @property
    def end(self) -> int:
        """Offset behind the number."""
        return self.value.end


@dataclass(frozen=True, slots=True)
class Flags:
    """`PREVIOUS | RANGE` (fuzzylite)."""

    words: tuple[Token, ...]

    @property
    def start(self) -> int:
        """Offset of the first word."""
        return self.words[0].start

    @property
    def end(self) -> int:
        """Offset behind the last word."""
        return self.words[-1].end


@dataclass(frozen=True, slots=True)
class Setting:
    """A choice by keyword: `METHOD: CoGS`, `DEFAULT := 0`, `RANGE := (0 .. 1)`, `AND: MIN`.

    `key` is the keyword that is meant, `value` is None where it could not be
    read.
    """

    key: str
    keyword: Token
    value: Token | Number | Range | Default | Flags | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Fuzzify:
    """FUZZIFY … END_FUZZIFY."""

    opening: Token
    variable: Token | None
    terms: tuple[Term, ...]
    settings: tuple[Setting, ...]
    damaged: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class Defuzzify:
    """DEFUZZIFY … END_DEFUZZIFY."""

    opening: Token
    variable: Token | None
    terms: tuple[Term, ...]
    settings: tuple[Setting, ...]
    damaged: bool


@dataclass(frozen=True, slots=True)
class Is:
    """`variable IS NOT hedges term`; NOT may be absent. The term may turn out to be the hedge ANY."""

    variable: Token
    negation: Token | None
    term: Token
    start: int
    end: int
    hedges: tuple[Token, ...] = ()


@dataclass(frozen=True, slots=True)
class Member:
    """`structure.member`, or `structure = member` as Annex D writes it (S7)."""

    structure: Token
    member: Token
    start: int
    end: int


@dataclass(frozen=True, slots=True)
class Not:
    """`NOT argument`."""

    keyword: Token
    argument: "Condition"


@dataclass(frozen=True, slots=True)
class Group:
    """A condition in parentheses."""

    opening: Token
    argument: "Condition"


@dataclass(frozen=True, slots=True)
class And:
    """Conditions joined by AND, two or more."""

    arguments: tuple["Condition", ...]


@dataclass(frozen=True, slots=True)
class Or:
    """Conditions joined by OR, two or more."""

    arguments: tuple["Condition", ...]


Condition = Is | Token | Member | Not | Group | And | Or
"""A token is a variable that stands for a degree."""


@dataclass(frozen=True, slots=True)
class Conclusion:
    """`variable IS hedges term WITH weight`; all but the first may be absent."""

    variable: Token
    term: Token | None
    weight: Value | None
    start: int
    end: int
    hedges: tuple[Token, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Rule:
    """`RULE label: IF condition THEN conclusions;`; its heading is what stands before the colon."""

    label: str
    condition: Condition
    conclusions: tuple[Conclusion, ...]
    start: int
    heading_end: int
    end: int


@dataclass(frozen=True, slots=True, kw_only=True)
class RuleBlock:
    """RULEBLOCK … END_RULEBLOCK; `name` is None where none is given."""

    opening: Token
    name: Token | None
    settings: tuple[Setting, ...]
    rules: tuple[Rule, ...]
    damaged: bool


@dataclass(frozen=True, slots=True)
class Options:
    """OPTIONS … END_OPTIONS: what stands between the keywords, as it is written (S4)."""

    text: str
    start: int
    end: int


Section = Declarations | Structures | Fuzzify | Defuzzify | RuleBlock | Options


@dataclass(frozen=True, slots=True)
class Heading:
    """The name of a function block, as it is written; it need not be an identifier (S17)."""

    text: str
    start: int
    end: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Block:
    """FUNCTION_BLOCK … END_FUNCTION_BLOCK, with its sections in the order of the text."""

    opening: Token
    heading: Heading | None
    sections: tuple[Section, ...]
    damaged: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class Tree:
    """A whole text.

    `verbatim` are the stretches that are not FCL: options, and text behind the
    last function block. `types` are the structure types that stand outside of
    function blocks: all blocks see them.
    """

    source: Source
    blocks: tuple[Block, ...]
    verbatim: tuple[Span, ...]
    types: tuple[Structures, ...]

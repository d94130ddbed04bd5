"""Rules, their conditions and conclusions (5.2.4)."""

from dataclasses import dataclass, field

from fcl_sim.diagnostics import Span
from fcl_sim.model.operators import Accumulation, Activation, AndOperator, Hedge, OrOperator


@dataclass(frozen=True, slots=True)
class Is:
    """The subcondition `variable IS hedges term`; NOT before all of that stands around it as `Not`.

    The last hedge is applied first. `term` is empty where ANY stands alone.
    """

    variable: str
    term: str
    hedges: tuple[Hedge, ...] = field(default=(), kw_only=True)
    span: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Degree:
    """A variable brought in from outside as a degree of membership."""

    variable: str
    span: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Not:
    """`NOT argument`: 1 minus its degree."""

    argument: "Condition"


@dataclass(frozen=True, slots=True)
class And:
    """Two or more conditions joined by AND."""

    arguments: tuple["Condition", ...]


@dataclass(frozen=True, slots=True)
class Or:
    """Two or more conditions joined by OR."""

    arguments: tuple["Condition", ...]


Condition = Is | Degree | Not | And | Or


@dataclass(frozen=True, slots=True)
class Conclusion:
    """The subconclusion `variable IS hedges term WITH weight`.

    `term` is None where a variable alone is concluded. A text for `weight` is
    the name of the input variable that holds it; a number lies in [0, 1].
    Hedges (Open Level) change the rule's degree before activation, the last
    one first; they are of those that leave 0 and 1 where they are.
    """

    variable: str
    term: str | None
    weight: float | str = 1.0
    hedges: tuple[Hedge, ...] = field(default=(), kw_only=True)
    span: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Rule:
    """`RULE label: IF condition THEN conclusions;`.

    `nesting` is how deep parentheses stand within one another in the text,
    those that the priority of operators does not need included (Table 11).
    """

    label: str
    condition: Condition
    conclusions: tuple[Conclusion, ...]
    span: Span | None = field(default=None, compare=False, repr=False)
    nesting: int = field(default=0, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class RuleBlock:
    """Rules under one choice of operators; none of them counts unless `enabled` (Open Level)."""

    name: str
    and_operator: AndOperator = AndOperator.MIN
    or_operator: OrOperator = OrOperator.MAX
    activation: Activation = Activation.MIN
    accumulation: Accumulation = Accumulation.MAX
    rules: tuple[Rule, ...]
    enabled: bool = True
    span: Span | None = field(default=None, compare=False, repr=False)

"""What a mutant is: a rule base with one change, and the catalogue of changes."""

from dataclasses import dataclass, field
from enum import StrEnum

from fcl_sim.diagnostics import Span
from fcl_sim.model import FunctionBlock


class Kind(StrEnum):
    """The catalogue: what can be changed in a rule base, one thing at a time."""

    CONSEQUENT_MOVED = "consequent moved"
    """A conclusion takes the next term of its output, each way."""
    CONDITION_MOVED = "condition moved"
    """A subcondition takes the next term of its variable, each way."""
    CONDITION_NEGATED = "condition negated"
    """A subcondition gets a NOT, or loses it."""
    AND_OR_EXCHANGED = "AND and OR exchanged"
    """AND becomes OR, or OR becomes AND, at one place of a condition."""
    WEIGHT_CHANGED = "weight changed"
    """A weight is halved; one that is not 1 becomes 1; one from a variable becomes 1, or a half."""
    RULE_DELETED = "rule deleted"
    """A rule is left out."""
    BREAKPOINT_SHIFTED = "breakpoint shifted"
    """A base point of a term moves by a share of the distance to its neighbour, each way."""
    CURVE_CHANGED = "curve changed"
    """A place of a smooth shape moves likewise; its width or slope grows, or shrinks, by the share."""
    SINGLETON_SHIFTED = "singleton shifted"
    """A singleton moves by a share of the distance to the next one, each way."""
    OPERATORS_CHANGED = "operators changed"
    """AND and OR of a rule block become another pair of Table 3."""
    ACTIVATION_CHANGED = "ACT changed"
    """ACT becomes the other one of Table 4, where an output has areas."""
    ACCUMULATION_CHANGED = "ACCU changed"
    """ACCU becomes another one of Table 5."""
    METHOD_CHANGED = "METHOD changed"
    """METHOD becomes another one of Table 1 that the terms allow."""
    DEFAULT_CHANGED = "DEFAULT changed"
    """DEFAULT becomes NC, and the lower and the upper end of the output."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Mutant:
    """A rule base in which one thing is changed.

    `where` says in words what has the change, `rule 7` or `far of distance`,
    and `what` the change, `pos_high → zero`. `rule` is the unique label of the
    changed rule, empty where it is no rule. `span` is the place in the text that
    the original was read from, None where there was none.
    """

    kind: Kind
    where: str
    what: str
    rule: str = ""
    function_block: FunctionBlock = field(repr=False)
    span: Span | None = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        return f"{self.where}: {self.what}"

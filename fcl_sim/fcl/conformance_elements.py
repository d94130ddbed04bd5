"""What a file can use and a statement can name: choices and switches, each with its row of Tables 8 to 10."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from types import MappingProxyType

from fcl_sim.fcl.conformance_tables import ROWS, SHAPES, Row
from fcl_sim.model import Accumulation, Activation, AndOperator, Hedge, Method, OrOperator

YES = "yes"
"""The one value of a switch."""


@dataclass(frozen=True, slots=True)
class Choice:
    """An element that a statement lists values of, such as AND: the row of each value, and how people say it.

    `words` has `{}` where the value stands; `others` are values that are said otherwise.
    """

    rows: Mapping[str, str]
    words: str
    others: Mapping[str, str] = field(default_factory=dict)

    def row(self, value: str) -> Row:
        """Return the row that a value belongs to."""
        return ROWS[self.rows[value]]

    def said(self, value: str) -> str:
        """Return a value as people say it: `AND by PROD`."""
        return self.others.get(value) or self.words.format(value)


@dataclass(frozen=True, slots=True)
class Switch:
    """An element that is there or not, such as RANGE."""

    name: str
    words: str

    def row(self, value: str = YES) -> Row:  # noqa: ARG002  as of a choice
        """Return the row that it belongs to."""
        return ROWS[self.name]

    def said(self, value: str = YES) -> str:  # noqa: ARG002  as of a choice
        """Return it as people say it."""
        return self.words


Element = Choice | Switch


def known(value: str, values: Iterable[str]) -> str | None:
    """Return which of `values` is meant: spelled alike, else the first that differs in letter case only."""
    listed = list(values)
    if value in listed:
        return value
    return next((each for each in listed if each.casefold() == value.casefold()), None)


def _rows(first: Mapping[str, str], others: type[StrEnum], row: str) -> dict[str, str]:
    """Return the row of each algorithm: as `first` says, else `row`."""
    return {str(each): first.get(str(each), row) for each in others}


ELEMENTS: Mapping[str, Element] = MappingProxyType(
    {
        "input_terms": Choice({"constant": "input term", "variable": "input points"}, "{} points of inputs"),
        "output_terms": Choice(
            {
                "singletons": "output term",
                "variable singletons": "output points",
                "points": "output points",
                "variable points": "output points",
            },
            "{} as terms of outputs",
        ),
        "AND": Choice(
            _rows({"MIN": "and", "PROD": "and pairs", "BDIF": "and pairs"}, AndOperator, "norm"), "AND by {}"
        ),
        "OR": Choice(_rows(dict.fromkeys(("MAX", "ASUM", "BSUM"), "or"), OrOperator, "norm"), "OR by {}"),
        "NOT": Choice(
            {"subcondition": "not", "parentheses": "not"},
            "NOT before {}",
            {"subcondition": "NOT of a subcondition"},
        ),
        "parentheses": Switch("parentheses", "parentheses in a condition"),
        "ACT": Choice(_rows(dict.fromkeys(("MIN", "PROD"), "act"), Activation, "norm"), "activation by {}"),
        "ACCU": Choice(
            _rows({"MAX": "accumulation", "BSUM": "accu", "NSUM": "accu"}, Accumulation, "norm"),
            "accumulation by {}",
        ),
        "METHOD": Choice(
            _rows(
                {"CoGS": "method"} | dict.fromkeys(("CoG", "CoA", "LM", "RM"), "areas"),
                Method,
                "further method",
            ),
            "defuzzification by {}",
        ),
        "DEFAULT": Choice(
            {
                "NC": "default",
                "0": "default",
                "value": "default",
                "NaN": "further default",
                "value | NC": "further default",
            },
            "DEFAULT := {}",
            {"value": "a DEFAULT other than 0"},
        ),
        "RANGE": Switch("range", "RANGE of an output"),
        "VAR": Switch("local", "local variables"),
        "conditions": Choice(
            {"IS": "condition", "variable": "variables", "concluded": "concluded"},
            "conditions with {}",
            {
                "variable": "a variable without IS in a condition",
                "concluded": "an output or local variable with a term in a condition",
            },
        ),
        "conclusions": Choice(
            {"IS": "conclusion", "variable": "subconclusions"},
            "conclusions with {}",
            {"variable": "a variable without IS in a conclusion"},
        ),
        "WITH": Choice({"constant": "weight", "variable": "weight"}, "a {} weighting factor"),
        "degrees": Switch("degrees", "degrees of points between 0 and 1"),
        "shapes": Choice(dict.fromkeys(SHAPES, "shape"), "the membership function {}"),
        "singletons": Switch("singletons", "a term of single values"),
        "formulas": Switch("formula", "a term that is a formula"),
        "hedges": Choice(dict.fromkeys((str(each) for each in Hedge), "hedge"), "the hedge {}"),
        "ACCU_of_outputs": Switch("own accumulation", "ACCU of a single output"),
        "input_ranges": Switch("input range", "a range of an input"),
        "LOCK": Switch("lock", "LOCK"),
        "ENABLED": Switch("enabled", "ENABLED"),
        "structures": Switch("structure", "structure types"),
        "OPTIONS": Switch("options", "OPTIONS"),
    }
)
"""By the key of a statement."""

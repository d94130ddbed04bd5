"""Choices by keyword: algorithms and methods (Tables 1, 3, 4 and 5)."""

from collections.abc import Iterable, Sequence
from enum import StrEnum
from typing import TypeVar

from fcl_sim.diagnostics.spelling import listed
from fcl_sim.fcl.keywords import OPEN_LEVEL_METHODS, OPEN_LEVEL_OPERATORS
from fcl_sim.fcl.scope import Scope
from fcl_sim.fcl.tokens import Token
from fcl_sim.fcl.tree import Setting
from fcl_sim.model import Accumulation, Activation, AndOperator, Method, OrOperator

Choice = TypeVar("Choice", bound=StrEnum)

METHODS = (Method.COG, Method.COGS, Method.COA, Method.LM, Method.RM)
"""Table 1."""
AND_OPERATORS = (AndOperator.MIN, AndOperator.PROD, AndOperator.BDIF)
OR_OPERATORS = (OrOperator.MAX, OrOperator.ASUM, OrOperator.BSUM)
"""Table 3: the pair of an operator stands at the same place."""
ACTIVATIONS = (Activation.PROD, Activation.MIN)
"""Table 4."""
ACCUMULATIONS = (Accumulation.MAX, Accumulation.BSUM, Accumulation.NSUM)
"""Table 5."""


def settings_by_key(scope: Scope, settings: Iterable[Setting]) -> dict[str, Setting]:
    """Return the settings of a section by their keyword; a second one is reported."""
    by_key: dict[str, Setting] = {}
    for setting in settings:
        first = by_key.setdefault(setting.key, setting)
        if first is not setting:
            message = f"{setting.key} is given twice"
            scope.report_twice("FCL333", message, setting.keyword, first.keyword)
    return by_key


def algorithm(scope: Scope, setting: Setting, choices: Sequence[Choice], what: str) -> Choice | None:
    """Return the algorithm that a setting names; None, once reported, where it is none of the `choices`."""
    token = setting.value
    if not isinstance(token, Token):
        return None
    for choice in choices:
        if choice.upper() == token.key:
            return choice
    if token.key in (OPEN_LEVEL_METHODS if setting.key == "METHOD" else OPEN_LEVEL_OPERATORS):
        message = f"{token.shown} is {what} of the Open Level, which this version does not read"
        scope.findings.error("FCL290", message, token, hint=f"valid here: {listed(choices)}")
        return None

    def hint() -> str:
        near = scope.findings.near(token.text, choices)
        return f"did you mean {near}?" if near else f"valid here: {listed(choices)}"

    scope.findings.error("FCL330", f"{token.shown} is not {what}", token, hint)
    return None

"""Choices by keyword: algorithms and methods (Tables 1, 3, 4 and 5)."""

from collections.abc import Iterable
from enum import StrEnum
from typing import TypeVar

from fcl_sim.diagnostics.spelling import listed
from fcl_sim.fcl.keywords import OPEN_LEVEL_METHODS
from fcl_sim.fcl.scope import Scope
from fcl_sim.fcl.tokens import Token
from fcl_sim.fcl.tree import Setting

Choice = TypeVar("Choice", bound=StrEnum)


def settings_by_key(scope: Scope, settings: Iterable[Setting]) -> dict[str, Setting]:
    """Return the settings of a section by their keyword; a second one is reported."""
    by_key: dict[str, Setting] = {}
    for setting in settings:
        first = by_key.setdefault(setting.key, setting)
        if first is not setting:
            message = f"{setting.key} is given twice"
            scope.report_twice("FCL333", message, setting.keyword, first.keyword)
    return by_key


def algorithm(scope: Scope, setting: Setting, choices: type[Choice], what: str) -> Choice | None:
    """Return the algorithm that a setting names; None, once reported, where there is no such one."""
    token = setting.value
    if not isinstance(token, Token):
        return None
    for choice in choices:
        if choice.upper() == token.key:
            return choice
    if token.key in OPEN_LEVEL_METHODS and setting.key == "METHOD":
        message = f"{token.shown} is a method of the Open Level, which this version does not read"
        scope.findings.error("FCL290", message, token)
        return None

    def hint() -> str:
        near = scope.findings.near(token.text, choices)
        return f"did you mean {near}?" if near else f"valid here: {listed(choices)}"

    scope.findings.error("FCL330", f"{token.shown} is not {what}", token, hint)
    return None

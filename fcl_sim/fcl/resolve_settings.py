"""Choices by keyword: algorithms, methods, ranges and defaults (Tables 1, 3, 4 and 5; S15)."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Generic, TypeVar

from fcl_sim.diagnostics.spelling import listed
from fcl_sim.fcl.scope import Scope
from fcl_sim.fcl.tokens import Token
from fcl_sim.fcl.tree import Default, Flags, Number, Range, Setting
from fcl_sim.model import Accumulation, Activation, AndOperator, Method, OrOperator

Choice = TypeVar("Choice", bound=StrEnum)


@dataclass(frozen=True, slots=True, kw_only=True)
class Algorithms(Generic[Choice]):
    """What a keyword can name: what the tables have, and what is Open Level, by its names in capitals.

    `what` is how a message calls one, `code` the row of `features.FEATURES`.
    """

    what: str
    code: str
    standard: tuple[Choice, ...]
    others: Mapping[str, Choice]


_T_NORMS = {
    "HAMACHER": "HPROD",
    "EINSTEIN": "EPROD",
    "DMIN": "DPROD",
    "NIPMIN": "NMIN",
    "MINIMUM": "MIN",
    "ALGEBRAICPRODUCT": "PROD",
    "BOUNDEDDIFFERENCE": "BDIF",
    "HAMACHERPRODUCT": "HPROD",
    "EINSTEINPRODUCT": "EPROD",
    "DRASTICPRODUCT": "DPROD",
    "NILPOTENTMINIMUM": "NMIN",
}
_S_NORMS = {
    "PROBOR": "ASUM",
    "EINSTEIN": "ESUM",
    "HAMACHER": "HSUM",
    "DMAX": "DSUM",
    "NIPMAX": "NMAX",
    "MAXIMUM": "MAX",
    "ALGEBRAICSUM": "ASUM",
    "BOUNDEDSUM": "BSUM",
    "NORMALIZEDSUM": "NSUM",
    "UNBOUNDEDSUM": "SUM",
    "HAMACHERSUM": "HSUM",
    "EINSTEINSUM": "ESUM",
    "DRASTICSUM": "DSUM",
    "NILPOTENTMAXIMUM": "NMAX",
}
"""jFuzzyLogic's names, and fuzzylite's; it writes the long one where FCL has none."""


def _others(
    choices: type[Choice], also: Mapping[str, str], standard: tuple[Choice, ...]
) -> dict[str, Choice]:
    own = {each.value.upper(): each for each in choices if each not in standard}
    by_value = {each.value.upper(): each for each in choices}
    return own | {name: by_value[value] for name, value in also.items() if value in by_value}


_METHODS = (Method.COG, Method.COGS, Method.COA, Method.LM, Method.RM)
METHODS = Algorithms(
    what="a method of defuzzification",
    code="method",
    standard=_METHODS,
    others={
        "MM": Method.MM,
        "MEANOFMAXIMUM": Method.MM,
        "COGSS": Method.SUM,
        "WEIGHTEDSUM": Method.SUM,
        "COGF": Method.COGS,
        "WEIGHTEDAVERAGE": Method.COGS,
        "CENTROID": Method.COG,
        "BISECTOR": Method.COA,
        "SMALLESTOFMAXIMUM": Method.LM,
        "LARGESTOFMAXIMUM": Method.RM,
    },
)
"""Table 1."""
_AND = (AndOperator.MIN, AndOperator.PROD, AndOperator.BDIF)
AND_OPERATORS = Algorithms(
    what="an algorithm for AND",
    code="norm",
    standard=_AND,
    others=_others(AndOperator, _T_NORMS, _AND),
)
_OR = (OrOperator.MAX, OrOperator.ASUM, OrOperator.BSUM)
OR_OPERATORS = Algorithms(
    what="an algorithm for OR",
    code="norm",
    standard=_OR,
    others=_others(OrOperator, _S_NORMS, _OR),
)
"""Table 3."""
_ACT = (Activation.PROD, Activation.MIN)
ACTIVATIONS = Algorithms(
    what="a method of activation",
    code="norm",
    standard=_ACT,
    others=_others(Activation, _T_NORMS, _ACT),
)
"""Table 4."""
_ACCU = (Accumulation.MAX, Accumulation.BSUM, Accumulation.NSUM)
ACCUMULATIONS = Algorithms(
    what="a method of accumulation",
    code="norm",
    standard=_ACCU,
    others=_others(Accumulation, _S_NORMS, _ACCU),
)
"""Table 5."""

PAIRS: dict[AndOperator, OrOperator] = {
    AndOperator.MIN: OrOperator.MAX,
    AndOperator.PROD: OrOperator.ASUM,
    AndOperator.BDIF: OrOperator.BSUM,
    AndOperator.HPROD: OrOperator.HSUM,
    AndOperator.EPROD: OrOperator.ESUM,
    AndOperator.DPROD: OrOperator.DSUM,
    AndOperator.NMIN: OrOperator.NMAX,
}
"""Table 3, and those of the Open Level."""


def settings_by_key(scope: Scope, settings: Iterable[Setting]) -> dict[str, Setting]:
    """Return the settings of a section by their keyword; a second one is reported.

    One that is NONE, as fuzzylite writes it, counts as missing.
    """
    by_key: dict[str, Setting] = {}
    for setting in settings:
        if isinstance(setting.value, Token) and setting.value.key == "NONE":
            scope.findings.feature("none", f"{setting.key} : NONE", setting.value)
            continue
        first = by_key.setdefault(setting.key, setting)
        if first is not setting:
            message = f"{setting.key} is given twice"
            scope.report_twice("FCL333", message, setting.keyword, first.keyword)
    return by_key


def algorithm(scope: Scope, setting: Setting | None, choices: Algorithms[Choice]) -> Choice | None:
    """Return the algorithm that a setting names; None, once reported, where it is none of the `choices`."""
    token = setting.value if setting is not None else None
    if setting is None or not isinstance(token, Token):
        return None
    for choice in choices.standard:
        if choice.upper() == token.key:
            return choice
    other = choices.others.get(token.key)
    if other is not None:
        scope.findings.feature(choices.code, f"{setting.key} : {token.text}", token)
        return other

    def hint() -> str:
        near = scope.findings.near(token.text, choices.standard)
        return f"did you mean {near}?" if near else f"valid here: {listed(choices.standard)}"

    scope.findings.error("FCL330", f"{token.shown} is not {choices.what}", token, hint)
    return None


def enabled(scope: Scope, setting: Setting | None) -> bool:
    """Return what ENABLED says, true where it is missing (S15)."""
    token = setting.value if setting is not None else None
    if not isinstance(token, Token):
        return True
    if token.key not in {"TRUE", "FALSE"}:
        message = f"TRUE or FALSE is expected after ENABLED, not {token.shown}"
        scope.findings.error("FCL201", message, token)
    scope.findings.feature("enabled", f"ENABLED : {token.text}", token)
    return token.key != "FALSE"


_LOCKS = {"PREVIOUS": "PREVIOUS", "VALID": "PREVIOUS", "RANGE": "RANGE"}
"""Flags of LOCK; VALID is what fuzzylite called PREVIOUS before its version 5."""


def locks(scope: Scope, setting: Setting | None) -> frozenset[str]:
    """Return what LOCK names: PREVIOUS, RANGE, both or nothing (S15)."""
    flags = setting.value if setting is not None else None
    if not isinstance(flags, Flags):
        return frozenset()
    for word in flags.words:
        if word.key not in _LOCKS:
            scope.findings.error(
                "FCL201", f"PREVIOUS or RANGE is expected after LOCK, not {word.shown}", word
            )
    scope.findings.feature("lock", f"LOCK : {' | '.join(each.text for each in flags.words)}", flags)
    return frozenset(_LOCKS.get(each.key, each.key) for each in flags.words)


def range_of(scope: Scope, limits: Range, *, bounds: bool = False) -> tuple[float, float] | None:
    """Return the limits of a range; None where it has none, or once an empty one has been reported.

    `bounds` says that the range bounds areas: then one of a single value is an
    error, and else a warning.
    """
    low, high = limits.low, limits.high
    if not (math.isfinite(low.value) and math.isfinite(high.value)):
        scope.findings.feature("range", "a range without limits", limits)
        return None
    if low.value < high.value:
        return low.value, high.value
    spans = scope.findings.span(low), scope.findings.span(high)
    message = f"the range is empty: {spans[0].text} is not below {spans[1].text}"
    if low.value == high.value and not bounds:
        scope.findings.warning("FCL337", message, limits, hint="it has no effect here")
    else:
        scope.findings.error("FCL337", message, limits)
    return None


def default_of(scope: Scope, setting: Setting | None) -> tuple[float | None, bool]:
    """Return the default value, None for NC, and whether the previous output goes before it (S15, S30)."""
    value = setting.value if setting is not None else None
    held = isinstance(value, Default)
    number = value.value if isinstance(value, Default) else value
    if not isinstance(number, Number):
        return None, False
    if math.isinf(number.value):
        message = f"a number or NC is expected after DEFAULT, not `{scope.findings.span(number).text}`"
        scope.findings.error("FCL201", message, number)
    if held or math.isnan(number.value):
        scope.findings.feature("default", f"DEFAULT := {scope.findings.span(number).text}", number)
    return (math.nan if math.isnan(number.value) else number.value), held

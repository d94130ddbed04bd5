"""The functions of formulae: how many numbers each takes, and what becomes of their units."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from types import MappingProxyType

ANY = 0
"""A number of arguments: two or more."""


class Kind(Enum):
    """What a function asks of units, and gives."""

    ALIKE = "all have one unit, which is also that of the result"
    KEEPS = "any unit, also that of the result"
    PLAIN = "plain numbers, as is the result"
    OF_ANGLE = "an angle, which gives a plain number"
    ANGLE = "plain numbers, which give an angle"
    DIRECTION = "two of one unit, which give an angle"
    ROOT = "the root of the unit"
    POWER = "the power of the unit, where the exponent is a whole number as written"


@dataclass(frozen=True, slots=True)
class Function:
    """A function: its number of arguments, `ANY` for two or more, and what it makes of units."""

    arguments: int
    kind: Kind


def _one(kind: Kind, *names: str) -> dict[str, Function]:
    return {name: Function(1, kind) for name in names}


OF_REQUIREMENTS: Mapping[str, Function] = MappingProxyType(
    {
        "abs": Function(1, Kind.KEEPS),
        "min": Function(ANY, Kind.ALIKE),
        "max": Function(ANY, Kind.ALIKE),
    }
)
"""Functions that formulae of requirements have."""

FUNCTIONS: Mapping[str, Function] = MappingProxyType(
    {
        **OF_REQUIREMENTS,
        **_one(Kind.ROOT, "sqrt"),
        "pow": Function(2, Kind.POWER),
        **_one(Kind.PLAIN, "exp", "ln", "log10", "sinh", "cosh", "tanh", "floor", "ceil", "round"),
        **_one(Kind.OF_ANGLE, "sin", "cos", "tan"),
        **_one(Kind.ANGLE, "asin", "acos", "atan"),
        "atan2": Function(2, Kind.DIRECTION),
        "mod": Function(2, Kind.ALIKE),
    }
)
"""All functions."""

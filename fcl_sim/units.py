"""Units and quantities as text: `"100 ms"` is 0.1 s; exact, small, without affine scales.

A unit is a product of powers of known symbols. A space or `*` multiplies, `/`
divides all that follows up to the next `/`: `W/m2 K` is watt per square metre
and kelvin. `m2`, `m^2` and `m**2` are the same. Angles have a dimension of
their own, so that degrees are not taken for a plain number; `degC` is a
temperature on the Celsius scale and meets no other unit, kelvin included. In a
product it is a difference, and that is in kelvin: `%/degC` is `%/K`.
"""

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from types import MappingProxyType

from fcl_sim.diagnostics.spelling import nearest
from fcl_sim.diagnostics.unit_notations import IN_WORDS, OTHER_UNITS

Dimension = tuple[int, ...]
"""Exponents of mass, length, time, current, angle, amount of substance, temperature, Celsius temperature."""


class UnitError(ValueError):
    """A text that is no unit or quantity, or two units that do not meet; `hint` says what would be right."""

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.hint = hint


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit: `scale` times pi to the power `pi`, in SI base units of `dimension`.

    `powers` are the symbols it was written with and their exponents.
    """

    scale: Fraction
    pi: int
    dimension: Dimension
    powers: tuple[tuple[str, int], ...] = ()

    @property
    def factor(self) -> float:
        """How many SI base units it is."""
        return float(self.scale) * math.pi**self.pi

    @property
    def symbol(self) -> str:
        """The unit as text that `parse_unit` reads back; empty when dimensionless and 1."""
        return _as_text(self.powers)

    def __str__(self) -> str:
        return self.symbol or "1"

    def __mul__(self, other: "Unit") -> "Unit":
        powers = dict(self.powers)
        for name, exponent in other.powers:
            powers[name] = powers.get(name, 0) + exponent
        return _counting_differences(
            Unit(
                self.scale * other.scale,
                self.pi + other.pi,
                tuple(mine + theirs for mine, theirs in zip(self.dimension, other.dimension, strict=True)),
                tuple((name, exponent) for name, exponent in powers.items() if exponent),
            )
        )

    def __truediv__(self, other: "Unit") -> "Unit":
        return self * other**-1

    def __pow__(self, exponent: int) -> "Unit":
        return _counting_differences(
            Unit(
                self.scale**exponent,
                self.pi * exponent,
                tuple(each * exponent for each in self.dimension),
                tuple((name, power * exponent) for name, power in self.powers if exponent),
            )
        )

    @property
    def difference(self) -> "Unit":
        """The unit of a difference of two such values: K for degC, itself for all others."""
        return _symbol("K") if self.powers == CELSIUS else self

    def same_as(self, other: "Unit") -> bool:
        """Return whether a number means the same in both units (`N s` and `kg m/s`)."""
        mine = (self.scale, self.pi, self.dimension)
        return mine == (other.scale, other.pi, other.dimension)

    def commensurate(self, other: "Unit") -> bool:
        """Return whether one converts into the other (`min` and `ms`)."""
        return self.dimension == other.dimension


def _counting_differences(unit: Unit) -> Unit:
    """Return a unit with K in place of degC where this stands beside others or to a power.

    A temperature on a scale with its own zero is not multiplied: what is multiplied is a difference.
    """
    celsius = unit.dimension[-1]
    if not celsius or unit.powers == CELSIUS:
        return unit
    powers = dict(unit.powers)
    powers["K"] = powers.get("K", 0) + powers.pop("degC")
    *others, kelvin, _ = unit.dimension
    kept = tuple((name, exponent) for name, exponent in powers.items() if exponent)
    return Unit(unit.scale, unit.pi, (*others, kelvin + celsius, 0), kept)


@lru_cache
def _as_text(powers: tuple[tuple[str, int], ...]) -> str:
    above = " ".join(_power(name, exponent) for name, exponent in powers if exponent > 0)
    below = " ".join(_power(name, -exponent) for name, exponent in powers if exponent < 0)
    return f"{above or '1'}/{below}" if below else above


def _power(name: str, exponent: int) -> str:
    return name if exponent == 1 else f"{name}{exponent}"


def _dimension(**exponents: int) -> Dimension:
    order = ("mass", "length", "time", "current", "angle", "amount", "temperature", "celsius")
    return tuple(exponents.get(each, 0) for each in order)


CELSIUS = (("degC", 1),)
"""The powers of degC alone."""

ONE = Unit(Fraction(1), 0, _dimension())
"""The dimensionless unit."""


def _table() -> Mapping[str, tuple[Fraction, int, Dimension]]:
    """Return symbol → scale, power of pi, dimension, for the symbols without an SI prefix."""
    force = _dimension(mass=1, length=1, time=-2)
    pressure = _dimension(mass=1, length=-1, time=-2)
    energy = _dimension(mass=1, length=2, time=-2)
    power = _dimension(mass=1, length=2, time=-3)
    time, angle = _dimension(time=1), _dimension(angle=1)
    one, milli = Fraction(1), Fraction(1, 1000)
    rows = {
        "%": (Fraction(1, 100), 0, _dimension()),
        "g": (milli, 0, _dimension(mass=1)),
        "t": (Fraction(1000), 0, _dimension(mass=1)),
        "m": (one, 0, _dimension(length=1)),
        "l": (milli, 0, _dimension(length=3)),
        "s": (one, 0, time),
        "min": (Fraction(60), 0, time),
        "h": (Fraction(3600), 0, time),
        "d": (Fraction(86400), 0, time),
        "Hz": (one, 0, _dimension(time=-1)),
        "N": (one, 0, force),
        "Pa": (one, 0, pressure),
        "bar": (Fraction(100_000), 0, pressure),
        "J": (one, 0, energy),
        "Wh": (Fraction(3600), 0, energy),
        "W": (one, 0, power),
        "A": (one, 0, _dimension(current=1)),
        "V": (one, 0, _dimension(mass=1, length=2, time=-3, current=-1)),
        "Ohm": (one, 0, _dimension(mass=1, length=2, time=-3, current=-2)),
        "K": (one, 0, _dimension(temperature=1)),
        "degC": (one, 0, _dimension(celsius=1)),
        "mol": (one, 0, _dimension(amount=1)),
        "rad": (one, 0, angle),
        "deg": (Fraction(1, 180), 1, angle),
        "rpm": (Fraction(1, 30), 1, _dimension(angle=1, time=-1)),
    }
    return MappingProxyType(rows)


SYMBOLS = _table()
PREFIXES: Mapping[str, Fraction] = MappingProxyType(
    {
        "G": Fraction(10**9),
        "M": Fraction(10**6),
        "k": Fraction(1000),
        "h": Fraction(100),
        "d": Fraction(1, 10),
        "c": Fraction(1, 100),
        "m": Fraction(1, 1000),
        "u": Fraction(1, 10**6),
        "n": Fraction(1, 10**9),
    }
)
PREFIXED = frozenset(
    {"g", "m", "l", "s", "Hz", "N", "Pa", "bar", "J", "Wh", "W", "A", "V", "Ohm", "K", "mol"}
)
OTHER_SPELLINGS: Mapping[str, str] = MappingProxyType(
    {
        "°C": "degC",
        "C": "degC",
        "°": "deg",
        "Ω": "Ohm",
        "Nm": "N m",
        "L": "l",
        "ltr": "l",
        "liter": "l",
        "litre": "l",
        "lpm": "l/min",
        "sec": "s",
        "hr": "h",
        "kph": "km/h",
    }
)
ACCEPTED_SPELLINGS = frozenset({"°C", "°", "L", "Ω"})

_FACTOR = re.compile(r"([^\W\d_]+|%|°C|°)(?:\^?([+-]?\d{1,2}))?")
_NUMBER = re.compile(r"\s*([+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?)(.*)", re.DOTALL)


@lru_cache(maxsize=256)
def parse_unit(text: str) -> Unit:
    """Return the unit that `text` names; the empty text and `1` are dimensionless.

    unit = product { "/" product } ; product = power { ( " " | "*" ) power } ;
    power = symbol [ [ "^" | "**" ] exponent ] | "1"
    """
    unit = ONE
    try:
        for index, product in enumerate(text.split("/")):
            factor = _product(product, text.strip())
            unit = unit / factor if index else unit * factor
    except UnitError as error:
        meant = IN_WORDS.get("".join(text.split()).casefold())
        if meant is None or "/" not in text:
            raise
        raise UnitError(f"there is no unit `{text.strip()}`", f"did you mean `{meant}`?") from error
    return unit


def _product(text: str, whole: str) -> Unit:
    words = text.replace("**", "^").replace("*", " ").replace("·", " ").split()
    if not words and whole.strip():
        raise UnitError(f"`{whole}` is not a unit: a symbol is missing", "write units as in m/s2 or kN s/m")
    unit = ONE
    for word in words:
        if word != "1":
            unit = unit * _factor(word, whole)
    return unit


def _factor(word: str, whole: str) -> Unit:
    match = _FACTOR.fullmatch(word)
    if match is None:
        raise UnitError(
            f"`{whole}` is not a unit: `{word}` cannot be read", "write units as in m/s2 or kN s/m"
        )
    name, exponent = match[1], int(match[2] or 1)
    return _symbol(name) ** exponent


def _symbol(text: str) -> Unit:
    name = text.replace("µ", "u").replace("μ", "u")
    if name in ACCEPTED_SPELLINGS:
        name = OTHER_SPELLINGS[name]
    if name in SYMBOLS:
        scale, pi, dimension = SYMBOLS[name]
        return Unit(scale, pi, dimension, ((name, 1),))
    prefix, base = name[:1], name[1:]
    if base in PREFIXED and prefix in PREFIXES:
        scale, pi, dimension = SYMBOLS[base]
        return Unit(scale * PREFIXES[prefix], pi, dimension, ((name, 1),))
    raise UnitError(f"there is no unit `{text}`", _hint(text))


def _hint(text: str) -> str:
    if text in OTHER_SPELLINGS:
        return f"did you mean `{OTHER_SPELLINGS[text]}`?"
    if text in OTHER_UNITS:
        return f"1 {text} is {OTHER_UNITS[text]}"
    if text.casefold() in IN_WORDS:
        return f"did you mean `{IN_WORDS[text.casefold()]}`?"
    known = [*SYMBOLS, *(prefix + base for base in sorted(PREFIXED) for prefix in PREFIXES)]
    by_case = [each for each in known if each.casefold() == text.casefold()]
    near = by_case[0] if len(by_case) == 1 else nearest(text, known if len(text) > 1 else ())
    if near is None:
        return "units are written as m, kg, s, min, N, kW, deg, K, degC, bar, %"
    return f"did you mean `{near}`?"


@dataclass(frozen=True, slots=True)
class Quantity:
    """A number with its unit."""

    value: float
    unit: Unit = ONE

    def to(self, unit: "Unit | str") -> float:
        """Return the number in `unit`; UnitError where the two do not meet."""
        target = parse_unit(unit) if isinstance(unit, str) else unit
        if not self.unit.commensurate(target):
            message = f"{self} does not convert to {target.symbol or 'a plain number'}"
            raise UnitError(message, conversion_hint(self.unit, target))
        if self.unit.same_as(target):
            return self.value
        ratio, pi = self.unit.scale / target.scale, self.unit.pi - target.pi
        try:
            return float(exact(self.value) * ratio) * math.pi**pi
        except OverflowError as error:
            raise UnitError(f"{self} is beyond what a number in {target} can hold") from error

    def __str__(self) -> str:
        return f"{short(self.value)} {self.unit.symbol}".rstrip()


def conversion_hint(unit: Unit, target: Unit) -> str:
    """Return how to write a quantity in `unit` that does not convert to `target`."""
    if unit.dimension == SYMBOLS["Hz"][2] and target.dimension == SYMBOLS["rpm"][2]:
        return f"{unit} counts no angle: revolutions per minute are written in rpm"
    if (unit.symbol, target.symbol) == ("K", "degC"):
        return "degC is a scale of its own and K is not: a temperature is written in degC, a difference in K"
    if (unit.symbol, target.symbol) == ("degC", "K"):
        return "degC is a scale of its own and K is not: write the number in K"
    if not target.symbol:
        return "write the number alone"
    return f"write it in {target.symbol}, or in a unit that converts to it"


def exact(value: float) -> Fraction:
    """Return the decimal number that `value` was written as: 1/10 for 0.1."""
    return Fraction(repr(value))


def short(value: float) -> str:
    """Return `value` with as many digits as tell it apart, without a trailing `.0`."""
    text = repr(float(value))
    return text.removesuffix(".0")


def parse_quantity(given: str | float) -> Quantity:
    """Return the quantity that a text (`"-6 s"`, `"5 %"`) or a plain number means.

    quantity = number [ unit ] ; finite; the decimal separator is a point.
    """
    if isinstance(given, int | float):
        text, value, rest = str(given), float(given), ""
    else:
        text = given
        match = _NUMBER.fullmatch(given)
        if match is None:
            shown = f"`{given}`" if given.strip() else "an empty text"
            raise UnitError(f"{shown} is not a quantity", 'write a number and a unit, as in "50 ms"')
        value, rest = float(match[1]), match[2]
    if not math.isfinite(value):
        raise UnitError(f"`{text}` is not a finite number")
    if re.match(r",\d", rest):
        mended = text.replace(",", ".")
        raise UnitError(f"`{text}` is not a quantity", f"the decimal separator is a point: `{mended}`")
    return Quantity(value, parse_unit(rest))


def nanoseconds(quantity: Quantity) -> int:
    """Return a time in whole nanoseconds; UnitError for other dimensions and for fractions of one."""
    unit = parse_unit("s")
    if not quantity.unit.commensurate(unit):
        raise UnitError(f"{quantity} is not a time", 'write a time with its unit, as in "50 ms" or "2 min"')
    ticks = exact(quantity.value) * quantity.unit.scale * 10**9
    if ticks.denominator != 1:
        raise UnitError(f"{quantity} is not a whole number of nanoseconds", "the clock counts nanoseconds")
    return int(ticks)

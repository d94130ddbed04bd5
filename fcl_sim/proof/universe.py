"""The universe: from where to where each input of a rule base goes, and what couples inputs."""

import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TypeVar

from fcl_sim.diagnostics import nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.model import FunctionBlock
from fcl_sim.units import exact

Stretch = tuple[Fraction, Fraction]
T = TypeVar("T")

RANGE = re.compile(
    r"\s*(?P<low>[^.\s](?:\.?[^.\s])*)\s*\.\.\s*(?P<high>[^.\s](?:\.?[^.\s])*)(?:\s+(?P<unit>.*\S))?\s*"
)
ITEM = re.compile(r"\s*(?P<sign>[+-])?\s*(?:(?P<factor>\d+(?:\.\d+)?)\s*\*\s*)?(?P<name>[A-Za-z_][\w.]*)")
RELATION = re.compile(r"<=|>=|=")


class UniverseError(ValueError):
    """A text that says no universe, or no coupling, of a rule base; its message is for the user."""


class UnknownInput(UniverseError):
    """A text is about an input that a rule base does not have."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Coupling:
    """What inputs have in common: the sum of `factors` times them is `relation` `value`, as in `text`."""

    factors: Mapping[str, Fraction]
    relation: str
    value: Fraction
    text: str = ""

    @property
    def is_equal(self) -> bool:
        """Whether it leaves no more than a plane of the space."""
        return self.relation == "="


@dataclass(frozen=True, slots=True, kw_only=True)
class Universe:
    """Where inputs go: `stretches` by name in lower case, closed; an input without one goes everywhere.

    `units` are by name, too, and only for messages.
    """

    stretches: Mapping[str, Stretch] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    couplings: tuple[Coupling, ...] = ()

    def of(self, variable: str) -> Stretch | None:
        """Return from where to where a variable goes, if that is known."""
        return self.stretches.get(variable.casefold())

    def unit(self, variable: str) -> str:
        """Return the unit of a variable; empty where none is known."""
        return self.units.get(variable.casefold(), "")


def declared(block: FunctionBlock) -> dict[str, Stretch]:
    """Return the ranges that a text declares of its inputs (Open Level)."""
    return {
        each.name.casefold(): (exact(each.range[0]), exact(each.range[1]))
        for each in block.inputs
        if each.range is not None and each.range[0] < each.range[1]
    }


def without_end(block: FunctionBlock, universe: Universe) -> tuple[str, ...]:
    """Return the inputs with terms that go anywhere."""
    fuzzified = {each.variable.casefold() for each in block.fuzzifications if each.terms}
    names = [each.name for each in block.inputs if each.name.casefold() in fuzzified]
    return tuple(each for each in names if universe.of(each) is None)


class Asked:
    """Texts that say the universe of one or several rule bases.

    `distance=-10..30 m` is a stretch, `brown + light + dark = 1` a coupling. A
    member of a structure may be named without the structure where that is clear.
    """

    def __init__(self, stretches: Sequence[str] = (), couplings: Sequence[str] = ()) -> None:
        self._stretches, self._couplings = tuple(stretches), tuple(couplings)
        self._used: set[str] = set()
        self._unknown: dict[str, UniverseError] = {}

    def universe_of(
        self,
        block: FunctionBlock,
        given: Mapping[str, Stretch] | None = None,
        units_given: Mapping[str, str] | None = None,
    ) -> Universe:
        """Return the universe of a rule base: its own RANGEs, what is `given`, and the texts over both.

        What is given, and its units, are by name in lower case. A text about an
        input that this block does not have is left out. Raises UniverseError for a text that says nothing.
        """
        known = declared(block) | dict(given or {})
        units = dict(units_given or {})
        for text in self._stretches:
            told = self._told(stretch_of, text, block)
            if told is not None:
                name, known[name], unit = told
                units |= {name: unit} if unit else {}
        couplings = [self._told(coupling_of, text, block) for text in self._couplings]
        return Universe(
            stretches=known, units=units, couplings=tuple(each for each in couplings if each is not None)
        )

    def all_used(self) -> None:
        """Raise UniverseError for a text that was about no input of any block."""
        for text, error in self._unknown.items():
            if text not in self._used:
                raise error

    def _told(self, read: Callable[[str, FunctionBlock], T], text: str, block: FunctionBlock) -> T | None:
        try:
            found = read(text, block)
        except UnknownInput as error:
            self._unknown.setdefault(text, error)
            return None
        self._used.add(text)
        return found


def universe_of(
    block: FunctionBlock, stretches: Sequence[str] = (), couplings: Sequence[str] = ()
) -> Universe:
    """Return the universe of one rule base, of texts as in `Asked`; UniverseError where one does not fit."""
    asked = Asked(stretches, couplings)
    found = asked.universe_of(block)
    asked.all_used()
    return found


def stretch_of(text: str, block: FunctionBlock) -> tuple[str, Stretch, str]:
    """Return name, ends and unit of `distance=-10..30 m`."""
    name, equals, rest = text.partition("=")
    found = RANGE.fullmatch(rest)
    if not equals or found is None:
        raise UniverseError(
            f"'{text}' is not NAME=LOW..HIGH, such as distance=-10..30 or 'distance=-10..30 m'"
        )
    low, high = (_number(found[each], text) for each in ("low", "high"))
    if low >= high:
        raise UniverseError(f"'{text}' goes from {low} to {high}: the first is to be the lower one")
    return input_named(name.strip(), block).casefold(), (low, high), found["unit"] or ""


def coupling_of(text: str, block: FunctionBlock) -> Coupling:
    """Return what `brown + 2*light <= 1` says; the right side is a number."""
    relation = RELATION.search(text)
    if relation is None:
        raise UniverseError(f"'{text}' has none of =, <= and >=, as in 'brown + light + dark = 1'")
    factors: dict[str, Fraction] = {}
    for sign, factor, name in _items(text[: relation.start()], text):
        variable = input_named(name, block).casefold()
        factors[variable] = factors.get(variable, Fraction(0)) + sign * factor
    value = _number(text[relation.end() :].strip(), text)
    return Coupling(factors=factors, relation=relation[0], value=value, text=" ".join(text.split()))


def _items(left: str, text: str) -> Iterator[tuple[int, Fraction, str]]:
    at = 0
    while left[at:].strip():
        found = ITEM.match(left, at)
        if found is None or (at > 0 and not found["sign"]):
            raise UniverseError(f"'{text}' is no sum of inputs, such as 'brown + 2*light + dark = 1'")
        yield -1 if found["sign"] == "-" else 1, Fraction(found["factor"] or 1), found["name"]
        at = found.end()
    if at == 0:
        raise UniverseError(f"'{text}' names no input on its left side")


def input_named(name: str, block: FunctionBlock) -> str:
    """Return the input that is called `name`, or whose member is, where there is one alone."""
    names = [each.name for each in block.inputs]
    folded = name.casefold()
    same = [each for each in names if each.casefold() == folded]
    ending = [each for each in names if each.casefold().endswith(f".{folded}")]
    found = same or ending
    if len(found) == 1:
        return found[0]
    if found:
        raise UniverseError(f"'{name}' may be {listed(found)}")
    near = nearest(name, names)
    hint = f"did you mean {near}?" if near else f"there is {listed(names)}" if names else "there is none"
    raise UnknownInput(f"{block.name} has no input '{name}': {hint}")


def _number(text: str, whole: str) -> Fraction:
    try:
        value = float(text)
    except ValueError:
        hint = ": the decimal separator is a point" if "," in text else ""
        raise UniverseError(f"'{text}' in '{whole}' is not a number{hint}") from None
    if not math.isfinite(value):
        raise UniverseError(f"'{text}' in '{whole}' is no end: leave the input out, and it goes everywhere")
    return exact(value)

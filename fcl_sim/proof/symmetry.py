"""Whether a rule base is its own mirror image: odd, or even, for all inputs at once, by its rules alone.

Each input is turned about 0, and for an odd law each output place, too. Where the rules
are the same afterwards, each term being known by its points, so is the law everywhere.
"""

from collections import Counter
from collections.abc import Iterator, Mapping
from fractions import Fraction

from fcl_sim.engine.grid import Base
from fcl_sim.engine.straighten import straightened
from fcl_sim.engine.switches import switched
from fcl_sim.model import (
    And,
    Conclusion,
    Condition,
    Defuzzification,
    FunctionBlock,
    Is,
    Method,
    Not,
    Or,
    Singleton,
)
from fcl_sim.proof.axes import base_of, is_straight
from fcl_sim.units import exact

BALANCED = frozenset((Method.COGS, Method.MM))
"""Methods that turn with their singletons; of LM the mirror image is RM."""

Bases = Mapping[tuple[str, str], Base]


def symmetry_of(block: FunctionBlock, output: str) -> str:
    """Return `odd` or `even` where the rules of an output are their own mirror image, else nothing.

    Nothing is said of smooth terms, degrees from outside, and what moves.
    """
    own = straightened(switched(block))
    found = next(each for each in own.defuzzifications if each.variable.casefold() == output.casefold())
    places = {each.name.casefold(): each.shape for each in found.terms}
    if found.method not in BALANCED or not all(isinstance(each, Singleton) for each in places.values()):
        return ""
    bases = {
        (each.variable.casefold(), term.name.casefold()): _plain(base_of(term))
        for each in own.fuzzifications
        for term in each.terms
        if is_straight(term)
    }
    for name, sign in (("odd", -1), ("even", 1)):
        if sign < 0 and not _keeps_zero(found):
            continue
        try:
            here = Counter(_rules(own, found, bases, 1, turned=False))
            there = Counter(_rules(own, found, bases, sign, turned=True))
        except _Unknown:
            return ""
        if here == there:
            return name
    return ""


class _Unknown(Exception):
    """A rule asks for something that is not turned."""


def _keeps_zero(output: Defuzzification) -> bool:
    """Return whether what is given out without a rule turns into itself."""
    return (output.default in {None, 0.0}) and not output.clamped


def _rules(
    block: FunctionBlock, output: Defuzzification, bases: Bases, sign: int, *, turned: bool
) -> Iterator[tuple[object, ...]]:
    """Yield for each conclusion on an output everything that it depends on, as it is, or turned about 0."""
    for number, rule_block in enumerate(block.rule_blocks):
        for rule in rule_block.rules:
            for each in rule.conclusions:
                if each.variable.casefold() == output.variable.casefold():
                    condition = _key(rule.condition, bases, turned=turned)
                    yield number, condition, sign * _place(each, output), each.weight, each.hedges


def _place(conclusion: Conclusion, output: Defuzzification) -> Fraction:
    name = (conclusion.term or "").casefold()
    shape = next(each.shape for each in output.terms if each.name.casefold() == name)
    if not isinstance(shape, Singleton) or isinstance(shape.value, str):
        raise _Unknown
    return exact(float(shape.value))


def _key(condition: Condition, bases: Bases, *, turned: bool) -> object:
    match condition:
        case Not(argument):
            return "not", _key(argument, bases, turned=turned)
        case And(arguments) | Or(arguments):
            parts = [_key(each, bases, turned=turned) for each in arguments]
            return type(condition).__name__, tuple(sorted(parts, key=repr))
        case Is(variable, term) if (variable.casefold(), term.casefold()) in bases:
            base = bases[variable.casefold(), term.casefold()]
            return variable.casefold(), condition.hedges, _turned(base) if turned else base
    raise _Unknown


def _turned(base: Base) -> Base:
    return tuple((-x, degree) for x, degree in reversed(base))


def _plain(base: Base) -> Base:
    """Return base points without those that lie on the straight line between others, or repeat an end."""
    found: list[tuple[Fraction, Fraction]] = []
    for point in base:
        while len(found) > 1 and _is_straight(found[-2], found[-1], point):
            found.pop()
        found.append(point)
    while len(found) > 1 and found[0][1] == found[1][1]:
        found.pop(0)
    while len(found) > 1 and found[-1][1] == found[-2][1]:
        found.pop()
    return tuple(found)


def _is_straight(
    one: tuple[Fraction, Fraction], middle: tuple[Fraction, Fraction], other: tuple[Fraction, Fraction]
) -> bool:
    (a, low), (b, degree), (c, high) = one, middle, other
    return a < b < c and (degree - low) * (c - b) == (high - degree) * (b - a)

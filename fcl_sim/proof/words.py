"""Intervals, boxes and points in words."""

from collections.abc import Mapping, Sequence
from fractions import Fraction
from shlex import quote

from fcl_sim.diagnostics import Span
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.proof.space import Side
from fcl_sim.proof.universe import Universe
from fcl_sim.units import short

DIGITS = 6
MANY = 4
"""Rules that are named; of more, some are counted."""


def number(value: Fraction) -> str:
    """Return a number: exactly where few digits tell it, else rounded."""
    return short(float(f"{float(value):.{DIGITS}g}") + 0.0)


def in_full(value: Fraction) -> str:
    """Return a number without rounding: as a decimal, else as a fraction with what it is about."""
    decimal = as_decimal(value)
    return decimal or f"{value} ({float(value):.{DIGITS}g})"


def as_decimal(value: Fraction) -> str:
    """Return a number as a decimal that is exact; empty where none of few digits is."""
    text = short(float(value) + 0.0)
    return text if Fraction(text) == value else ""


def interval(side: Side, unit: str = "") -> str:
    """Return an interval as it stands behind a variable: `from 5 to 10 m`, `below 0 m`."""
    told = _between(side) if side.low is not None and side.high is not None else _without_end(side)
    return told.format(unit=f" {unit}" if unit else "")


def over(side: Side, unit: str = "") -> str:
    """Return an interval as it stands behind a statement: `from 5 to 10 m`, `at 5 m`."""
    return interval(side, unit).replace("= ", "at ", 1) if side.is_point else interval(side, unit)


def _without_end(side: Side) -> str:
    if side.high is not None:
        return f"{'up to' if side.high_closed else 'below'} {number(side.high)}{{unit}}"
    if side.low is None:
        return "anywhere"
    return f"from {number(side.low)}{{unit}} on" if side.low_closed else f"above {number(side.low)}{{unit}}"


def _between(side: Side) -> str:
    low, high = (number(each or Fraction(0)) for each in (side.low, side.high))
    if side.is_point:
        return f"= {low}{{unit}}"
    if side.low_closed:
        return f"from {low} to {'' if side.high_closed else 'below '}{high}{{unit}}"
    return f"above {low}, up to {high}{{unit}}" if side.high_closed else f"between {low} and {high}{{unit}}"


def box(sides: Mapping[str, Side], universe: Universe) -> str:
    """Return a box: `distance from 5 to 10 m and angle below 0 deg`."""
    told = [f"{name} {interval(side, universe.unit(name))}" for name, side in sides.items()]
    return listed_and(told) if told else "everywhere"


def listed_and(items: Sequence[str]) -> str:
    """Return items joined by commas and a last `and`."""
    return items[0] if len(items) == 1 else f"{', '.join(items[:-1])} and {items[-1]}"


def percent(share: Fraction) -> str:
    """Return a share in percent, with four digits; one that is not 0 or all does not look so."""
    text = f"{float(100 * share):.4g}"
    if share not in {0, 1} and text in {"0", "100"}:
        return "less than 0.01 %" if share < Fraction(1, 2) else "more than 99.99 %"
    return f"{text} %"


def assignments(point: Mapping[str, Fraction]) -> str:
    """Return a point as `fcl-sim eval` takes it."""
    return " ".join(f"{name}={short(float(value))}" for name, value in point.items())


def in_fractions(point: Mapping[str, Fraction]) -> str:
    """Return a point as `fcl-sim eval --exact` takes it."""
    return " ".join(f"{name}={as_decimal(value) or value}" for name, value in point.items())


def command(
    span: Span | None, point: Mapping[str, Fraction], *, thin: bool = False, explain: bool = False
) -> str:
    """Return the command that shows a point; where that is of no width, `thin`, the exact one."""
    file = quote(span.source.name if span else "FILE")
    more = " --explain" if explain else ""
    if thin or not all(map(as_decimal, point.values())):
        return f"fcl-sim eval {file} --exact{more} {in_fractions(point)}"
    return f"fcl-sim eval {file}{more} {assignments(point)}"


def seen(span: Span | None, point: Mapping[str, Fraction] | None, *, thin: bool = False) -> str:
    """Return the end of a hint: the command that shows step by step what is so at a point, if any."""
    return "" if point is None else f"; see `{command(span, point, thin=thin, explain=True)}`"


def quoted(names: Sequence[str]) -> str:
    """Return names, each in backquotes."""
    return listed([f"`{each}`" for each in names]).replace(" or ", " and ")


def rules_named(labels: Sequence[str]) -> str:
    """Return rules by their labels, in the singular or plural: `rules 1, 2, 3 and 5 others`."""
    if len(labels) == 1:
        return f"rule {labels[0]}"
    few = [*labels] if len(labels) <= MANY else [*labels[: MANY - 1], f"{len(labels) - MANY + 1} others"]
    return f"rules {listed_and(few)}"

"""`over` and `at_least`: how a requirement is held to an envelope, and whether it can be."""

from collections.abc import Iterator, Mapping, Sequence
from math import prod

from pydantic_core import PydanticCustomError

from fcl_sim.diagnostics import Diagnostic
from fcl_sim.judge.verdict import AtLeast, Over
from fcl_sim.scenario.fields import at_least
from fcl_sim.scenario.model import Axis, RequirementText
from fcl_sim.toml.tree import Entry, finding

Grids = Mapping[str, tuple[Axis, ...]]
GIVE_ONE = "give the scenario a [vary], or leave this out"


def over_of(entry: Entry | None) -> Over:
    """Return what a requirement is held to; as without it where it is of no known choice."""
    return Over(entry.value) if entry is not None and entry.value in list(Over) else Over.BOTH


def points_asked(entry: Entry | None, variant: str) -> AtLeast:
    """Return at how many points of a variant's envelope a requirement must hold: at all unless it says so."""
    asked = _asked(entry, variant)
    try:
        return AtLeast() if asked is None else at_least(asked.value)
    except PydanticCustomError:  # which its shape tells
        return AtLeast()


def _asked(entry: Entry | None, variant: str) -> Entry | None:
    return entry.get(variant) if entry is not None and entry.is_table else entry


def envelope_faults(texts: Sequence[RequirementText], grids: Grids, *, lenient: bool) -> Iterator[Diagnostic]:
    """Yield what requirements ask of envelopes and cannot be had.

    `grids` are the axes by run. A `lenient` look lets pass what overrides have
    made smaller, or what is switched off.
    """
    for text in texts:
        asked_of = {name: grid for name, grid in grids.items() if name in text.runs}
        yield from _of_one(text, asked_of, lenient=lenient)
        for name, grid in asked_of.items() if not lenient else ():
            asked, points = _asked(text.at_least, name), prod(len(each.values) for each in grid)
            if grid and asked is not None and (points_asked(text.at_least, name).count or 0) > points:
                message = (
                    f"{text.id} must hold at {asked.value} points, and the envelope of `{name}` has {points}"
                )
                yield finding("SCN504", message, asked, 'a share of them is written "95 %"')


def _of_one(text: RequirementText, asked_of: Grids, *, lenient: bool) -> Iterator[Diagnostic]:
    spread = [name for name, grid in asked_of.items() if grid]
    if text.over is Over.MEAN and not text.metric:
        message = f"{text.id} has no metric, and only a metric has a mean over the points"
        yield finding("SCN504", message, text.span, 'write over = "points", each of them is judged then')
    if text.over in {Over.NOMINAL, Over.MEAN} and text.at_least is not None:
        message = f"{text.id} is not judged point by point, so that `at_least` counts nothing"
        yield finding("SCN504", message, text.at_least.key, "leave it out, or leave out `over`")
    if lenient:
        return
    if text.over in {Over.POINTS, Over.MEAN} and not spread:
        message = f"{text.id} asks for an envelope, and no run that it is asked of has one"
        yield finding("SCN504", message, text.span, GIVE_ONE)
    elif text.at_least is not None and text.over is not Over.NOMINAL:
        named = text.at_least.table or dict.fromkeys(spread or list(asked_of)[:1], text.at_least)
        for name, entry in named.items():
            if name not in spread:
                message = f"{text.id} counts points of the envelope of `{name}`, which has none"
                yield finding("SCN504", message, entry.key, GIVE_ONE)

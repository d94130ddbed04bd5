"""Where in the grid of its terms a rule base was: cells of each input, combinations of terms."""

from collections.abc import Iterator
from itertools import product

import numpy as np
from numpy.typing import NDArray

from fcl_sim.engine.program import Program
from fcl_sim.engine.switches import limits_of
from fcl_sim.engine.words import subconditions
from fcl_sim.loop.alone import Alone
from fcl_sim.loop.trace import Values
from fcl_sim.model import FunctionBlock, Fuzzification, Is, Not, Points, Singletons
from fcl_sim.verify.coverage import Cell, Combination, GridCoverage, InputCoverage


def cells(block: FunctionBlock, names: tuple[str, ...], inputs: Values) -> tuple[InputCoverage, ...]:
    """Return for each input with terms how many of the points (n, inputs) lay in each of its cells.

    `names` are those of the columns. Points that variables move, and smooth
    shapes, part nothing; where an input is kept in its range, so are its cells.
    """
    places = {name.casefold(): place for place, name in enumerate(names)}
    found = []
    for each in block.fuzzifications:
        place = places.get(each.variable.casefold())
        if place is not None:
            knots = _knots(block, each)
            values = np.clip(inputs[:, place], knots[0], knots[-1]) if each.clamped else inputs[:, place]
            found.append(InputCoverage(variable=names[place], cells=_counted(knots, values)))
    return tuple(found)


def _knots(block: FunctionBlock, fuzzification: Fuzzification) -> list[float]:
    """Return the ends of the cells, rising."""
    inner: set[float] = set()
    for term in fuzzification.terms:
        if isinstance(term.shape, Points | Singletons):
            inner |= {float(point.x) for point in term.shape.points if not isinstance(point.x, str)}
    low, high = limits_of(block, fuzzification) or (-np.inf, np.inf)
    return [low, *sorted(each for each in inner if low < each < high), high]


def _counted(knots: list[float], values: Values) -> tuple[Cell, ...]:
    at = np.clip(np.searchsorted(knots, values, side="right") - 1, 0, len(knots) - 2)
    counts = np.bincount(at, minlength=len(knots) - 1).tolist()
    return tuple(Cell(*each) for each in zip(knots[:-1], knots[1:], counts, strict=True))


def grid(block: FunctionBlock, program: Program, inputs: Values) -> GridCoverage:
    """Return which combinations of terms the points (n, inputs) visited; `program` is that of `block`."""
    asked = {each.variable.casefold() for each in _asked(block)}
    known = {name.casefold(): name for name in program.input_names}
    parts = [each for each in block.fuzzifications if each.variable.casefold() in asked & known.keys()]
    held = _held(program, inputs, parts) if parts else np.empty((0, 0), np.bool_)
    sizes = [len(each.terms) for each in parts]
    ends = np.cumsum([0, *sizes])
    visited: set[Combination] = set()
    for row in _each_once(held):
        own = [np.flatnonzero(row[ends[i] : ends[i + 1]]).tolist() for i in range(len(parts))]
        visited.update(product(*own))
    return GridCoverage(
        inputs=tuple(known[each.variable.casefold()] for each in parts),
        terms=tuple(tuple(term.name for term in each.terms) for each in parts),
        visited=frozenset(visited),
    )


def _each_once(held: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return the rows, each once. From scan to scan most stay as they are, and need no sorting."""
    changed = np.flatnonzero((held[1:] != held[:-1]).any(axis=1)) + 1
    return np.unique(held[[*range(min(1, len(held))), *changed]], axis=0)


def _asked(block: FunctionBlock) -> Iterator[Is]:
    for rule_block in block.rule_blocks:
        for rule in rule_block.rules:
            for each in subconditions(rule.condition):
                inner = each.argument if isinstance(each, Not) else each
                if isinstance(inner, Is):
                    yield inner


def _held(program: Program, inputs: Values, parts: list[Fuzzification]) -> NDArray[np.bool_]:
    """Return for each point and each term of `parts` whether its degree is above 0."""
    slots = [
        program.layout.terms[each.variable.casefold(), term.name.casefold()]
        for each in parts
        for term in each.terms
    ]
    return Alone(program).evaluate(inputs, words=slots)[:, program.recorded :] > 0.0

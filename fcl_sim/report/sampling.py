"""A block sampled for its pictures: an output over one or two inputs, and where no rule is active."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from fcl_sim.block import Block
from fcl_sim.loop.trace import Values
from fcl_sim.model import FunctionBlock
from fcl_sim.report.ranges import width
from fcl_sim.report.terms import REACH, abscissae, extent, initials

CELLS = 160
"""Cells of a map each way, beside those that begin at base points."""

ROOM = 0.06
"""What is shown beyond the outermost points, as a share of their span."""

NEAR = 0.55
"""A run that stays within this share of the terms' span is worth a closer look."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Domain:
    """An input: what is shown of it, `knots` the places where its terms have points."""

    name: str
    unit: str
    low: float
    high: float
    knots: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Surface:
    """An output over two inputs: cells (m, n) between the edges `x` (n + 1,) and `y` (m + 1,)."""

    across: Domain
    up: Domain
    name: str
    unit: str
    title: str
    x: Values
    y: Values
    values: Values
    undefined: NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True)
class Curve:
    """An output (n,) over one input `x` (n,)."""

    across: Domain
    name: str
    unit: str
    x: Values
    values: Values
    undefined: NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Track:
    """The way of a run through a picture, (n,) each; `active` where any rule was active for the output.

    `time` are the seconds of each point, none where they are not told.
    """

    x: Values
    y: Values
    active: NDArray[np.bool_]
    time: Values = field(default_factory=lambda: np.zeros(0))


def domains(block: FunctionBlock, units: Mapping[str, str]) -> tuple[Domain, ...]:
    """Return the inputs of a block with the range of their terms; 0 to 1 for a degree brought in."""
    terms = {each.variable.casefold(): each.terms for each in block.fuzzifications}
    unit_of = {name.casefold(): unit for name, unit in units.items()}
    start = initials(block)
    result = []
    for variable in block.inputs:
        own = terms.get(variable.name.casefold(), ())
        low, high = extent(own, start) if own else (0.0, 1.0)
        room = ROOM * (high - low) if own else 0.0
        knots = sorted({x for term in own for x in abscissae(term, start)})
        unit = unit_of.get(variable.name.casefold(), "")
        result.append(
            Domain(name=variable.name, unit=unit, low=low - room, high=high + room, knots=tuple(knots))
        )
    return tuple(result)


def following(domain: Domain, seen: Values) -> Domain:
    """Return a domain wide enough for the values (n,) that a run saw, within reason."""
    finite = seen[np.isfinite(seen)]
    if not len(finite):
        return domain
    reach = REACH * (domain.high - domain.low)
    low, high = float(finite.min()), float(finite.max())
    room = ROOM * (high - low)
    wider_low = min(domain.low, max(low - room, domain.low - reach))
    wider_high = max(domain.high, min(high + room, domain.high + reach))
    return replace(domain, low=wider_low, high=wider_high)


def closer(shown: Sequence[Domain], seen: Sequence[Values]) -> list[Domain] | None:
    """Return domains close to what a run saw, or None where that is most of them already, or outside."""
    result = []
    for domain, values in zip(shown, seen, strict=True):
        finite = values[np.isfinite(values)]
        if not len(finite):
            return None
        room = 2.0 * ROOM * width(finite) or 0.02 * (domain.high - domain.low)
        low, high = max(float(finite.min()) - room, domain.low), min(float(finite.max()) + room, domain.high)
        if not low < high:
            return None  # it went nowhere that is shown
        result.append(replace(domain, low=low, high=high))
    shares = [(near.high - near.low) / (far.high - far.low) for near, far in zip(result, shown, strict=True)]
    return result if min(shares) < NEAR else None


def surface(
    block: Block, output: str, plane: tuple[Domain, Domain], fixed: Mapping[str, float], unit: str, title: str
) -> Surface:
    """Return an output over two inputs, the others held at `fixed`.

    Cells begin at the terms' points, so that where no rule is active is told
    exactly when conditions are made of MIN, MAX, PROD and NOT.
    """
    across, up = plane
    x, y = _edges(across), _edges(up)
    point: dict[str, float | Values] = {
        **fixed,
        across.name: _middles(x)[None, :],
        up.name: _middles(y)[:, None],
    }
    values, active = _answer(block, output, point, (len(y) - 1, len(x) - 1))
    return Surface(
        across=across, up=up, name=output, unit=unit, title=title, x=x, y=y, values=values, undefined=~active
    )


def curve(block: Block, output: str, across: Domain, fixed: Mapping[str, float], unit: str) -> Curve:
    """Return an output over one input, the others held at `fixed`, a hair on either side of each knot too."""
    hair = 1e-9 * (across.high - across.low)
    edges = _edges(across, 4 * CELLS)
    x = np.unique(np.concatenate([edges, edges[:-1] + hair, edges[1:] - hair]))
    values, active = _answer(block, output, {**fixed, across.name: x}, x.shape)
    return Curve(across=across, name=output, unit=unit, x=x, values=values, undefined=~active)


def _edges(domain: Domain, cells: int = CELLS) -> Values:
    knots = [knot for knot in domain.knots if domain.low < knot < domain.high]
    return np.unique(np.concatenate([np.linspace(domain.low, domain.high, cells + 1), knots]))


def _middles(edges: Values) -> Values:
    return (edges[:-1] + edges[1:]) / 2.0


def _answer(
    block: Block, output: str, point: Mapping[str, float | Values], shape: tuple[int, ...]
) -> tuple[Values, NDArray[np.bool_]]:
    found = block.evaluation(point)
    return np.broadcast_to(found.outputs[output], shape), np.broadcast_to(found.active[output], shape)

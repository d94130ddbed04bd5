"""Test vectors: inputs that try every breakpoint, cell and gap of a rule base, with what it gives there.

They are a trace, a sample each second, so that `replay` reads a PLC's answers to them.
First each input walks over its breakpoints, a little before and behind each and the
middles between, while the others rest; then comes the grid of breakpoints and middles
of all inputs; last the ways into each gap and out of it, which tell DEFAULT from a
value that is kept.
"""

from collections.abc import Iterator, Sequence
from itertools import pairwise, product

import numpy as np

from fcl_sim.block import Block
from fcl_sim.loop.trace import Trace, Values
from fcl_sim.proof.axes import Axis, Cell
from fcl_sim.proof.coupled import whole
from fcl_sim.proof.finding import Finding
from fcl_sim.proof.points import span_of, within
from fcl_sim.proof.space import Side, axes_of
from fcl_sim.proof.universe import Universe
from fcl_sim.verify.cover import ranges
from fcl_sim.verify.replay import TOLERANCES, replay

MOST = 2000
"""Vectors at most, where nothing is said."""
BESIDE = 1e-3
"""How far beside a breakpoint, as part of the narrower cell there."""
SECOND = 1_000_000_000
TOLERANCE = "_tolerance"
"""What the name of an output's tolerance ends in."""


def vectors(
    block: Block,
    universe: Universe,
    findings: Sequence[Finding] = (),
    arithmetic: str = "",
    most: int = MOST,
) -> Trace:
    """Return test vectors: inputs, the outputs that are expected, and by how much an answer may differ.

    `findings` are those of `prove`: their gaps are visited. Outputs follow each
    other from the initial state, since NC keeps what was before. `arithmetic` is
    what the block declares, where nothing is said.
    """
    arithmetic = arithmetic or block.declared_arithmetic
    inputs = _rounded(_inputs(block, universe, findings, most), arithmetic)
    names, units = block.inputs, {each: universe.unit(each) for each in block.inputs}
    ticks = np.arange(len(inputs), dtype=np.int64) * SECOND
    asked = Trace(ticks=ticks, names=names, units=units, values=inputs)
    record = replay(block, asked, arithmetic, name="the vectors").record
    widths = ranges(block.function_block, record)
    tolerances = [TOLERANCES[arithmetic] * widths[each] for each in block.outputs]
    allowed = np.broadcast_to(tolerances, record.outputs.shape)
    columns = [f"{each}{TOLERANCE}" for each in block.outputs]
    return Trace(
        ticks=ticks,
        names=(*names, *block.outputs, *columns),
        units={**units, **dict.fromkeys((*block.outputs, *columns), "")},
        values=np.column_stack([inputs, record.outputs, allowed]),
    )


def _rounded(inputs: Values, arithmetic: str) -> Values:
    """Return numbers that the arithmetic has: those of binary32 for REAL, whole ones for INT."""
    if arithmetic == "INT":
        return np.round(inputs)
    return inputs.astype(np.float32).astype(np.float64) if arithmetic == "REAL" else inputs


def _inputs(block: Block, universe: Universe, findings: Sequence[Finding], most: int) -> Values:
    """Return the inputs (n, inputs) in their order, none twice in a row."""
    model = block.function_block
    axes = {each.variable: each for each in axes_of(model, universe)}
    rest = [_rest(axes.get(each.name), each.initial) for each in model.inputs]
    rows = [*_walks(block, axes, rest)]
    gaps = [[*_around(block, each, rows)] for each in findings if each.boxes and each.witness]
    room = most - len(rows) - sum(map(len, gaps))
    pairs = zip(block.inputs, rest, strict=True)
    grid = [_grid_of(axes[name]) if name in axes else [own] for name, own in pairs]
    rows += [*_thinned(grid, max(room, 0))]
    rows += [row for own in gaps for row in own]
    kept = [row for place, row in enumerate(rows) if place == 0 or row != rows[place - 1]]
    return np.array(kept[:most])


def _rest(axis: Axis | None, initial: float | None) -> float:
    """Return where an input rests: in the middle of its breakpoints."""
    if axis is None:
        return initial or 0.0
    ends = [each.low for each in axis.cells if each.low is not None]
    return float(ends[len(ends) // 2]) if ends else 0.0


def _walks(block: Block, axes: dict[str, Axis], rest: Sequence[float]) -> Iterator[list[float]]:
    for place, name in enumerate(block.inputs):
        for mark in _marks(axes[name]) if name in axes else ():
            yield [*rest[:place], mark, *rest[place + 1 :]]


def _marks(axis: Axis) -> list[float]:
    """Return breakpoints, what lies a little beside them, and the middles between, rising."""
    knots = [float(each.low) for each in axis.cells if each.is_point and each.low is not None]
    widths = [high - low for low, high in pairwise(knots)]
    found = {*knots, *_grid_of(axis)}
    for place, knot in enumerate(knots):
        step = BESIDE * min([*widths[max(place - 1, 0) : place + 1], *([1.0] if not widths else [])])
        found |= {knot - step, knot + step}
    ends = whole(axis)
    return sorted(
        each
        for each in found
        if (ends.low is None or each >= float(ends.low)) and (ends.high is None or each <= float(ends.high))
    )


def _grid_of(axis: Axis) -> list[float]:
    """Return breakpoints and a point of each cell between and beyond."""
    span = span_of(axis)
    found = []
    for each in axis.cells:
        if each.is_point and each.low is not None:
            found.append(float(each.low))
        else:
            found.append(float(within(_side(each), span)))
    return found


def _side(cell: Cell) -> Side:
    return Side(cell.low, cell.high, low_closed=False, high_closed=False)


def _thinned(grid: Sequence[Sequence[float]], most: int) -> Iterator[list[float]]:
    """Yield the points of a grid, or of one with too many evenly spread ones."""
    size = int(np.prod([len(each) for each in grid]))
    if size <= most:
        yield from ([*each] for each in product(*grid))
        return
    for number in np.unique(np.linspace(0, size - 1, most).astype(np.int64)).tolist() if most else ():
        row = []
        for each in reversed(grid):
            number, place = divmod(number, len(each))  # noqa: PLW2901  digit by digit
            row.append(each[place])
        yield row[::-1]


def _around(block: Block, finding: Finding, rows: Sequence[list[float]]) -> Iterator[list[float]]:
    """Yield the way into a gap and out of it: the nearest of `rows` where a rule is active, the witness."""
    witness = finding.witness or {}
    inside = [float(witness[name]) for name in block.inputs]
    points = np.array(rows)
    active = block.evaluation(dict(zip(block.inputs, points.T, strict=True))).active
    defined = next(flags for name, flags in active.items() if name.casefold() == finding.variable.casefold())
    spread = np.maximum(points.max(axis=0) - points.min(axis=0), 1e-300)
    far = np.where(defined, np.abs((points - inside) / spread).sum(axis=1), np.inf)
    outside = rows[int(np.argmin(far))]
    yield from (outside, inside, outside)

"""Where an output jumps along an input, and how high: at edges of gaps and terms, where LM or RM switch.

Lines along the input are looked at, the others being on breakpoints or between; a step
between two of their points that stays as they are halved together is a jump. Where the
law along such a line is straight (proof.section), place and height are exact.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise, product

import numpy as np
from numpy.typing import NDArray

from fcl_sim.block import Block
from fcl_sim.proof.degrees import Boxes
from fcl_sim.proof.section import Knot, NotStraight, section
from fcl_sim.units import exact

Values = NDArray[np.float64]

MOST_LINES = 400
"""Lines that are looked at along an input, evenly spread where there are more."""
BETWEEN = 8
"""Points within a cell."""
BESIDE = 1e-7
"""How far beside a breakpoint, as part of the input's reach."""
FOLLOWED = 64
"""Steps that are followed, the highest first."""
HALVINGS = 60
LEAST = 1e-6
"""The part of an output's reach from which on a step is one."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Jump:
    """An output goes from one value to another `at` a point, as `variable` rises through it.

    `without` says on which side no rule is active: `before`, `behind`, or neither.
    """

    variable: str
    at: Mapping[str, float]
    before: float
    behind: float
    without: str
    is_exact: bool

    @property
    def height(self) -> float:
        """By how much."""
        return abs(self.behind - self.before)


class Jumps:
    """The jumps of one output of a block, whose cells are `cells`; `held` keeps its value without a rule."""

    def __init__(self, block: Block, output: str, cells: Boxes, reach: float) -> None:
        self._block, self._cells, self._least = block, cells, LEAST * reach
        self._names = block.inputs
        self._output = next(each for each in block.outputs if each.casefold() == output.casefold())
        found = next(
            each
            for each in block.function_block.defuzzifications
            if each.variable.casefold() == output.casefold()
        )
        self._held = found.held or found.default is None

    def along(self, place: int) -> Jump | None:
        """Return the highest jump along an input that is found; None where none is."""
        lines, xs = self._lines(place), self._marks(place)
        points = np.repeat(lines, len(xs), axis=0)
        points[:, place] = np.tile(xs, len(lines))
        values, active = self._evaluated(points)
        shape = (len(lines), len(xs))
        steps = self._steps(values.reshape(shape), active.reshape(shape))
        order = np.argsort(-steps, axis=None, kind="stable")[:FOLLOWED]
        rows, columns = np.unravel_index(order, steps.shape)
        wanted = steps[rows, columns] > self._least
        if not wanted.any():
            return None
        low = points.reshape(*shape, -1)[rows[wanted], columns[wanted]]
        high = points.reshape(*shape, -1)[rows[wanted], columns[wanted] + 1]
        return self._highest(place, low, high)

    def _steps(self, values: Values, active: NDArray[np.bool_]) -> Values:
        """Return how far neighbours along the last axis are apart; where a value is kept they are not."""
        found = np.nan_to_num(np.abs(np.diff(values, axis=-1)))
        if self._held:
            found = np.where(active[..., :-1] & active[..., 1:], found, 0.0)
        return np.asarray(found)

    def _highest(self, place: int, low: Values, high: Values) -> Jump | None:
        """Return the highest of the steps that stay when their ends are halved together."""
        for _ in range(HALVINGS):
            middle = 0.5 * low + 0.5 * high
            values, active = self._evaluated(np.stack([low, middle, high], axis=1).reshape(-1, low.shape[1]))
            steps = self._steps(values.reshape(-1, 3), active.reshape(-1, 3))
            upper = (steps[:, 1] > steps[:, 0])[:, None]
            low, high = np.where(upper, middle, low), np.where(upper, high, middle)
        values, active = self._evaluated(np.stack([low, high], axis=1).reshape(-1, low.shape[1]))
        steps = self._steps(values.reshape(-1, 2), active.reshape(-1, 2))[:, 0]
        best = int(np.argmax(steps))
        if steps[best] <= self._least:
            return None
        before, behind = values.reshape(-1, 2)[best].tolist()
        flags = active.reshape(-1, 2)[best].tolist()
        found = Jump(
            variable=self._names[place],
            at=dict(zip(self._names, high[best].tolist(), strict=True)),
            before=before,
            behind=behind,
            without="" if all(flags) else "behind" if flags[0] else "before",
            is_exact=False,
        )
        return self._exactly(place, found) or found

    def _exactly(self, place: int, near: Jump) -> Jump | None:
        """Return the highest jump on the line of one, exactly; None where the law bends along it."""
        low, high = (exact(float(each)) for each in self._ends(place))
        at = {name: exact(value) for name, value in near.at.items()}
        try:
            own = section(self._block.function_block, self._output, near.variable, at, (low, high))
        except NotStraight:
            return None
        steps = [step for knot in own.knots for step in _steps_at(knot, low, high)]
        if not steps:
            return None
        knot, (before, fires), (behind, fires_behind) = max(
            steps, key=lambda each: abs(each[2][0] - each[1][0])
        )
        return replace(
            near,
            at={**near.at, near.variable: float(knot.x)},
            before=float(before),
            behind=float(behind),
            without="" if fires and fires_behind else "behind" if fires else "before",
            is_exact=True,
        )

    def _evaluated(self, points: Values) -> tuple[Values, NDArray[np.bool_]]:
        found = self._block.evaluation(dict(zip(self._names, points.T, strict=True)))
        return found.outputs[self._output], found.active[self._output]

    def _ends(self, place: int) -> tuple[float, float]:
        return float(self._cells.low[:, place].min()), float(self._cells.high[:, place].max())

    def _knots(self, place: int) -> Values:
        return np.unique(np.concatenate([self._cells.low[:, place], self._cells.high[:, place]]))

    def _marks(self, place: int) -> Values:
        """Return breakpoints of an input, what lies a little beside them, and points between."""
        knots = self._knots(place)
        low, high = self._ends(place)
        beside = BESIDE * (high - low)
        inner = [np.linspace(a, b, BETWEEN + 2)[1:-1] for a, b in pairwise(knots.tolist())]
        return np.unique(np.clip(np.concatenate([knots, knots - beside, knots + beside, *inner]), low, high))

    def _lines(self, place: int) -> Values:
        """Return lines along an input: the others on their breakpoints and in the middles between."""
        sides: list[Sequence[float]] = []
        for other in range(len(self._names)):
            knots = self._knots(other)
            both = np.unique(np.concatenate([knots, 0.5 * knots[1:] + 0.5 * knots[:-1]]))
            sides.append([0.0] if other == place else both.tolist())
        count = int(np.prod([len(each) for each in sides]))
        if count <= MOST_LINES:
            return np.array(list(product(*sides)))
        chosen = np.unique(np.linspace(0, count - 1, MOST_LINES).astype(np.int64))
        columns = np.unravel_index(chosen, [len(each) for each in sides])
        return np.column_stack([np.array(own)[column] for own, column in zip(sides, columns, strict=True)])


Side = tuple[Fraction, bool]


def _steps_at(knot: Knot, low: Fraction, high: Fraction) -> Iterator[tuple[Knot, Side, Side]]:
    """Yield the steps at a knot, each with value and whether a rule is active on both sides of it."""
    sides = list(zip(knot.values, knot.active, strict=True))
    if knot.x == low:
        sides = sides[1:]
    if knot.x == high:
        sides = sides[:-1]
    for (before, fires), (behind, fires_behind) in pairwise(sides):
        if before is not None and behind is not None and before != behind:
            yield knot, (before, fires), (behind, fires_behind)

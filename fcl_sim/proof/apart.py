"""How far the laws of two rule bases are apart: where most, and because of which rules.

Both are looked at over the universe, or where there is none over the breakpoints
of both. Where none of the rules that differ can fire, the laws are the same; so
two rule bases that differ in a corner are compared in that corner.
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from fcl_sim.block import Block
from fcl_sim.model import FunctionBlock, Rule
from fcl_sim.model.labels import unique_labels
from fcl_sim.proof.axes import Axis
from fcl_sim.proof.changed import changed_terms, concludes, frame_of, rule_keys, rule_text, surplus
from fcl_sim.proof.degrees import Boxes, NotEnclosed
from fcl_sim.proof.enclosure import Enclosure, Law, average
from fcl_sim.proof.few_digits import Shown, shown
from fcl_sim.proof.law import Extreme, cells_of, require_ranges
from fcl_sim.proof.search import AT_ONCE, STEPS, halved, largest
from fcl_sim.proof.space import axes_of
from fcl_sim.proof.universe import Universe

Values = NDArray[np.float64]

CLOSE = 1e-6
"""The part of an output's reach to which the largest difference is found to be exact."""
COARSE, COARSE_STEPS = 1e-2, 16
"""That part where only what matters is looked for, and the times that boxes are halved for it."""
SHARE_STEPS = 12
"""Times that boxes are halved to tell a share."""
PART = 0.01
"""The part of an output's reach by which two laws may differ, where nothing is said."""


@dataclass(frozen=True, slots=True)
class Effort:
    """To which part of the reach a difference is found, and how much is halved for it, and for a share."""

    close: float
    steps: int
    at_once: int
    boxes: int


EFFORT = Effort(CLOSE, STEPS, AT_ONCE, boxes=20_000)
OF_AREAS = Effort(1e-3, 30, 256, boxes=1_000)
"""The same where outputs have areas, whose bounds take longer and are wider."""


@dataclass(frozen=True, slots=True)
class ChangedRule:
    """A rule that is not the same in both, or concludes a term that is not.

    `side` is `old` or `new`; `degree` is that at the place.
    """

    side: str
    label: str
    text: str
    degree: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Apart:
    """How far two laws of an output are apart.

    They count as different from `threshold` on: surely in `share_at_least` of
    the universe, possibly in `share_at_most`. `unknown` says why nothing is known.
    """

    output: str
    threshold: float = 0.0
    largest: Extreme | None = None
    old: float = 0.0
    new: float = 0.0
    shown: Shown = field(default_factory=Shown)
    share_at_least: float = 0.0
    share_at_most: float = 0.0
    rules: tuple[ChangedRule, ...] = ()
    unknown: str = ""

    @property
    def differs(self) -> bool:
        """Whether they differ by more than the threshold, or may for all that is known."""
        return self.largest is None or self.largest.bound > self.threshold


def apart(
    old: Block, new: Block, universe: Universe, threshold: float | None = None, *, coarse: bool = False
) -> tuple[Apart, ...]:
    """Return how far the outputs of two blocks are apart that both have.

    The inputs of `old` and `new` must have the same names. `threshold` is in the
    unit of the outputs, else PART of each one's reach. With `coarse` the largest
    difference is found to COARSE of the reach, and shares are left open.
    """
    common = [
        each.variable
        for each in old.function_block.defuzzifications
        if each.variable.casefold()
        in {own.variable.casefold() for own in new.function_block.defuzzifications}
    ]
    found = []
    for output in common:
        try:
            found.append(_Comparer(old, new, output, universe).apart(threshold, coarse=coarse))
        except NotEnclosed as reason:
            found.append(Apart(output=output, unknown=str(reason)))
    return tuple(found)


class _Comparer:
    def __init__(self, old: Block, new: Block, output: str, universe: Universe) -> None:
        self._blocks = (old, new)
        self._output, self._universe = output, universe
        self._names = old.inputs
        self._enclosures = tuple(Enclosure(each.function_block, output) for each in self._blocks)
        self._orders = tuple(self._order(each) for each in self._blocks)
        self._has_areas = not all(each.follows_slopes for each in self._enclosures)
        self._surplus = surplus(old.function_block, new.function_block, output)
        self._changed = (
            self._surplus
            if frame_of(old.function_block, output) == frame_of(new.function_block, output)
            else None
        )
        self._terms = changed_terms([each.function_block for each in self._blocks], output)
        self._moved = self._moves(old.function_block, new.function_block, output)
        for each in self._blocks:
            require_ranges(each.function_block, universe)
        self._cells = cells_of(self._names, _joined(self._names, self._blocks, universe), universe)

    def _order(self, block: Block) -> list[int]:
        """Return for each input of a block its place among the names."""
        places = {name.casefold(): place for place, name in enumerate(self._names)}
        return [places[name.casefold()] for name in block.inputs]

    def _moves(self, old: FunctionBlock, new: FunctionBlock, output: str) -> Mapping[str, float] | None:
        """Return how far each singleton has moved, if nothing but that is different; else None."""
        frames = [frame_of(each, output, places=False) for each in (old, new)]
        keys = [Counter(key for _, key in rule_keys(each, output)) for each in (old, new)]
        places = [each.places for each in self._enclosures]
        if frames[0] != frames[1] or keys[0] != keys[1] or places[0].keys() != places[1].keys():
            return None
        if any(low != high for own in places for low, high in own.values()):
            return None
        return {term: places[1][term][0] - place for term, (place, _) in places[0].items()}

    def apart(self, threshold: float | None, *, coarse: bool) -> Apart:
        """Return how far they are apart."""
        spans = [self._law(side, _whole(self._cells)) for side in (0, 1)]
        reach = max(float(each.high[0] - each.low[0]) for each in spans) or 1.0
        limit = PART * reach if threshold is None else threshold
        effort = OF_AREAS if self._has_areas else EFFORT
        close, steps = (COARSE, COARSE_STEPS) if coarse else (effort.close, effort.steps)
        found = largest(
            self._cells,
            self._most,
            lambda points: self._value(points)[2],
            close * reach,
            steps,
            effort.at_once,
        )
        exact = not coarse and found.gap <= 1.5 * CLOSE * reach
        at = dict(zip(self._names, found.at.tolist(), strict=True))
        bound = found.reached if exact else found.bound
        before, after, _ = self._value(found.at[None, :])
        least, most = (0.0, 1.0) if coarse else self._share(limit)
        return Apart(
            output=self._output,
            threshold=limit,
            largest=Extreme(found.reached, bound, at, exact),
            old=float(before[0]),
            new=float(after[0]),
            shown=shown(self._blocks, self._output, at, self._cells.reach, self._universe),
            share_at_least=least,
            share_at_most=most,
            rules=tuple(self._responsible(found.at)) if found.reached > 0.0 else (),
        )

    def _boxes(self, side: int, boxes: Boxes) -> Boxes:
        order = self._orders[side]
        return Boxes(boxes.low[:, order], boxes.high[:, order])

    def _law(self, side: int, boxes: Boxes) -> Law:
        return self._enclosures[side].law(self._boxes(side, boxes))

    def _value(self, points: Values) -> tuple[Values, Values, Values]:
        """Return the old and the new output at points, and how far they are apart."""
        columns = dict(zip(self._names, points.T, strict=True))
        values = []
        for block in self._blocks:
            own = {name.casefold(): each for name, each in block.evaluate(columns).items()}
            found = own[self._output.casefold()]
            values.append(np.broadcast_to(found, len(points)))  # of no inputs it is one
        return values[0], values[1], np.abs(values[1] - values[0])

    def _most(self, boxes: Boxes) -> Values:
        old, new = self._law(0, boxes), self._law(1, boxes)
        bound = np.maximum(new.high - old.low, old.high - new.low)
        if self._moved is not None:
            bound = np.where(old.maybe_undefined, bound, np.minimum(bound, self._by_moves(boxes)))
        return np.where(self._may_differ(boxes), bound, 0.0)

    def _by_moves(self, boxes: Boxes) -> Values:
        """Return how far the means of moved singletons are apart at most: the mean of their moves."""
        moves = self._moved or {}
        spans = self._enclosures[0].shares(self._boxes(0, boxes))
        names = sorted(spans, key=lambda each: moves[each])
        lows, highs = (np.array([getattr(spans[each], end) for each in names]) for end in ("low", "high"))
        low, high = average(lows, highs, np.array([moves[each] for each in names]))
        return np.maximum(np.abs(low), np.abs(high))

    def _least(self, boxes: Boxes) -> Values:
        old, new = self._law(0, boxes), self._law(1, boxes)
        return np.maximum(0.0, np.maximum(new.low - old.high, old.low - new.high))

    def _may_differ(self, boxes: Boxes) -> NDArray[np.bool_]:
        """Return in which boxes a rule may fire that is not the same in both."""
        if self._changed is None:
            return np.ones(len(boxes), np.bool_)
        found = np.zeros(len(boxes), np.bool_)
        for side, places in enumerate(self._changed):
            spans = self._enclosures[side].rules(self._boxes(side, boxes)) if places else []
            for place in places:
                found |= spans[place][1].high > 0.0
        return found

    def _share(self, limit: float) -> tuple[float, float]:
        """Return the parts of the cells in which the laws surely and possibly differ by more than a limit."""
        sizes = np.maximum(self._cells.high.max(axis=0) - self._cells.low.min(axis=0), 1e-300)
        moving = [place for place, size in enumerate(sizes) if size > 1e-300]
        boxes, surely = self._cells, 0.0
        whole = float(_volumes(boxes, moving).sum()) or 1.0
        for _ in range(SHARE_STEPS):
            surely += float(_volumes(boxes, moving)[self._least(boxes) > limit].sum())
            open_ = (self._most(boxes) > limit) & (self._least(boxes) <= limit)
            boxes = Boxes(boxes.low[open_], boxes.high[open_])
            if not 0 < len(boxes) < (OF_AREAS if self._has_areas else EFFORT).boxes:
                break
            boxes = halved(boxes, sizes)
        rest = float(_volumes(boxes, moving)[self._most(boxes) > limit].sum()) if len(boxes) else 0.0
        return surely / whole, min(1.0, (surely + rest) / whole)

    def _responsible(self, at: Values) -> list[ChangedRule]:
        point = Boxes(at[None, :], at[None, :])
        found = []
        for side, word in enumerate(("old", "new")):
            block = self._blocks[side].function_block
            labels = unique_labels(block)
            rules = self._enclosures[side].rules(self._boxes(side, point))
            for place, (rule, span) in enumerate(rules):
                is_changed = place in self._surplus[side] or self._concludes_changed(rule)
                if is_changed and span.high[0] > 0.0 and concludes(rule, self._output):
                    found.append(ChangedRule(word, labels[place], rule_text(rule), float(span.high[0])))
        return found

    def _concludes_changed(self, rule: Rule) -> bool:
        return any(
            each.variable.casefold() == self._output.casefold()
            and (each.term or "").casefold() in self._terms
            for each in rule.conclusions
        )


def _volumes(boxes: Boxes, moving: Sequence[int]) -> Values:
    return np.asarray(np.prod((boxes.high - boxes.low)[:, moving], axis=1))


def _whole(cells: Boxes) -> Boxes:
    return Boxes(cells.low.min(axis=0)[None, :], cells.high.max(axis=0)[None, :])


def _joined(names: Sequence[str], blocks: Sequence[Block], universe: Universe) -> Mapping[str, Axis]:
    """Return axes with the breakpoints of both blocks."""
    each_axes = [
        {axis.variable.casefold(): axis for axis in axes_of(each.function_block, universe)} for each in blocks
    ]
    cuts = {
        name.casefold(): {
            cell.low
            for axes in each_axes
            if name.casefold() in axes
            for cell in axes[name.casefold()].cells
            if cell.low is not None
        }
        for name in names
    }
    found: dict[str, Axis] = {}
    for block in reversed(blocks):
        for axis in axes_of(block.function_block, universe, cuts):
            own = next(name for name in names if name.casefold() == axis.variable.casefold())
            found[own] = axis
    return found

"""The control law of an output: how far it goes, how steep it is, along which inputs it only rises or falls.

Looked at over the universe, or where there is none over all breakpoints: beyond
them straight terms change no more. Maxima and minima are found by branch and
bound over the cells (proof.search): what was reached is so at a point; the bound
is so everywhere.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from itertools import pairwise, product
from math import isfinite

import numpy as np
from numpy.typing import NDArray

from fcl_sim.block import Block
from fcl_sim.model import FunctionBlock
from fcl_sim.proof.axes import Axis
from fcl_sim.proof.cubes import leaves
from fcl_sim.proof.degrees import Boxes, NotEnclosed
from fcl_sim.proof.enclosure import Enclosure
from fcl_sim.proof.jumps import Jump, Jumps
from fcl_sim.proof.saturation import Saturation, saturations
from fcl_sim.proof.search import Search, largest
from fcl_sim.proof.section import NotStraight, section
from fcl_sim.proof.space import axes_of
from fcl_sim.proof.symmetry import symmetry_of
from fcl_sim.proof.terms import moving
from fcl_sim.proof.universe import Universe
from fcl_sim.units import exact

Values = NDArray[np.float64]

MOST_CELLS = 20_000
"""Cells with which a search begins; of a rule base with more it begins with the whole."""
CLOSE = 1e-6
"""The part of an output's reach to which its ends are found."""
CLOSE_GAIN = 1e-3
"""The part of the largest slope to which that is found."""
GAIN_STEPS = 18
"""Times that boxes are halved for a slope."""
BLIND_STEPS = 5
"""Times for a slope of which no bound is followed."""
CLOSE_AREA, AREA_STEPS, AREA_AT_ONCE = 2e-3, 30, 256
"""As CLOSE, where areas are defuzzified; times and boxes that are halved for it."""
STEP = 1e-6
"""The part of an input's reach over which a slope is measured."""
FLAT = 1e-9
"""The part of an output's reach up to which two values count as the same."""
SAMPLES = 2001
"""Points at which symmetry and dead zones are looked at."""


class Course(StrEnum):
    """How an output goes along an input while the others stay."""

    CONSTANT = "does not change"
    RISES = "never falls"
    FALLS = "never rises"
    BOTH = "rises and falls"
    OPEN = "may rise and fall"


@dataclass(frozen=True, slots=True)
class Extreme:
    """A largest or least value: `reached` at `at`, inputs by name, and nothing beyond `bound`."""

    reached: float
    bound: float
    at: dict[str, float]
    is_exact: bool


@dataclass(frozen=True, slots=True)
class Gain:
    """The slope of an output along one input: the steepest, up or down, and its course.

    Where `course` is BOTH, it rises at one of `shown` and falls at the other.
    """

    variable: str
    steepest: Extreme
    course: Course
    shown: tuple[dict[str, float], ...] = ()


@dataclass(frozen=True, slots=True)
class DeadZone:
    """From where to where along an input an output is what it is at 0, the other inputs being 0.

    Unless it `is_exact`, its ends are of samples.
    """

    variable: str
    low: float
    high: float
    is_exact: bool = False


@dataclass(frozen=True, slots=True)
class OutputLaw:
    """What is known of an output; `unknown` says why nothing is, or is empty.

    `jumps` are the highest that were found along the inputs along which no bound
    of the slope is known. `at_zero` is what it is where all inputs are 0, `symmetry`
    is `odd`, `even` or empty around there, of samples unless `is_symmetry_proved`.
    """

    output: str
    least: Extreme | None = None
    most: Extreme | None = None
    gains: tuple[Gain, ...] = ()
    at_zero: float | None = None
    symmetry: str = ""
    is_symmetry_proved: bool = False
    dead_zones: tuple[DeadZone, ...] = ()
    jumps: tuple[Jump, ...] = ()
    saturations: tuple[Saturation, ...] = ()
    unknown: str = ""


def law_of(block: Block, universe: Universe) -> tuple[OutputLaw, ...]:
    """Return the law of each output with terms on which a rule concludes."""
    model = block.function_block
    concluded = {
        each.variable.casefold()
        for rule_block in model.rule_blocks
        for rule in rule_block.rules
        for each in rule.conclusions
    }
    found = []
    for output in model.defuzzifications:
        if output.variable.casefold() in concluded and output.enabled:
            try:
                found.append(_Explorer(block, output.variable, universe).law())
            except NotEnclosed as reason:
                found.append(OutputLaw(output.variable, unknown=str(reason)))
    return tuple(found)


class _Explorer:
    def __init__(self, block: Block, output: str, universe: Universe) -> None:
        self._block, self._output = block, output
        self._names = block.inputs
        self._enclosure = Enclosure(block.function_block, output)
        self._coupled = bool(universe.couplings)
        self._axes = {each.variable: each for each in axes_of(block.function_block, universe)}
        require_ranges(block.function_block, universe)
        self._cells = cells_of(self._names, self._axes, universe)
        self._reach = self._cells.high.max(axis=0) - self._cells.low.min(axis=0)

    def law(self) -> OutputLaw:
        most = self._extreme(1.0)
        least = self._extreme(-1.0)
        span = max(most.bound - least.bound, 1e-300)
        gains = tuple(self._gain(place, span) for place in self._used())
        zero = self._at_zero()
        symmetry, is_proved = ("", False) if zero is None else self._symmetry(span)
        return OutputLaw(
            self._output,
            least,
            most,
            gains,
            at_zero=zero,
            symmetry=symmetry,
            is_symmetry_proved=is_proved,
            dead_zones=() if zero is None else tuple(self._dead_zones(zero, FLAT * span)),
            jumps=tuple(self._jumps(gains, span)),
            saturations=() if self._coupled else self._saturations(),
        )

    def _jumps(self, gains: Sequence[Gain], span: float) -> Iterator[Jump]:
        jumps = Jumps(self._block, self._output, self._cells, span)
        for gain in gains:
            if not isfinite(gain.steepest.bound):
                found = jumps.along(self._names.index(gain.variable))
                if found is not None:
                    yield found

    def _saturations(self) -> tuple[Saturation, ...]:
        return saturations(self._block.function_block, tuple(self._axes.values()), self._output)

    def _used(self) -> list[int]:
        """Return the places of the inputs that rules on the output ask for."""
        asked = {
            each.variable.casefold()
            for rule_block in self._block.function_block.rule_blocks
            for rule in rule_block.rules
            if any(each.variable.casefold() == self._output.casefold() for each in rule.conclusions)
            for each in leaves(rule.condition)
        }
        named = [place for place, name in enumerate(self._names) if name.casefold() in asked]
        return [place for place in named if self._reach[place] > 0.0]

    def value(self, points: Values) -> Values:
        """Return the output at points (n, inputs)."""
        columns = dict(zip(self._names, points.T, strict=True))
        found = self._block.evaluate(columns)[self._block.outputs[self._place()]]
        return np.broadcast_to(found, len(points))  # of no inputs it is one

    def _place(self) -> int:
        return [each.casefold() for each in self._block.outputs].index(self._output.casefold())

    def _extreme(self, sign: float) -> Extreme:
        def bound(boxes: Boxes) -> Values:
            law = self._enclosure.law(boxes)
            return law.high if sign > 0.0 else -law.low

        span = self._span()
        close, *effort = (CLOSE * span,)
        if not self._enclosure.follows_slopes:
            close, *effort = CLOSE_AREA * span, AREA_STEPS, AREA_AT_ONCE
        found = largest(self._cells, bound, lambda points: sign * self.value(points), close, *effort)
        return self._told(found, sign, CLOSE * span)

    def _span(self) -> float:
        law = self._enclosure.law(whole_of(self._cells))
        return max(float(law.high[0] - law.low[0]), 1e-300)

    def _told(self, found: Search, sign: float, tolerance: float) -> Extreme:
        exact = found.gap <= 1.5 * tolerance
        bound = found.reached if exact else found.bound
        at = dict(zip(self._names, found.at.tolist(), strict=True))
        return Extreme(sign * found.reached, sign * bound, at, exact)

    def _gain(self, place: int, span: float) -> Gain:
        step = STEP * self._reach[place]
        mean = span / float(self._reach[place])
        steps = GAIN_STEPS if self._enclosure.follows_slopes else BLIND_STEPS
        signs = []
        for sign in (1.0, -1.0):
            bound, slope = self._of_slope(place, sign), self._slope(place, sign, step)
            signs.append(largest(self._cells, bound, slope, CLOSE_GAIN * mean, steps=steps))
        rise, fall = signs
        steepest, sign = (rise, 1.0) if rise.reached >= fall.reached else (fall, -1.0)
        worst = max(rise.bound, fall.bound)
        exact = worst - steepest.reached <= 10 * CLOSE_GAIN * max(mean, steepest.reached)
        at = dict(zip(self._names, steepest.at.tolist(), strict=True))
        extreme = Extreme(sign * steepest.reached, worst, at, exact)
        return Gain(self._names[place], extreme, *self._course(rise, fall, mean))

    def _course(self, rise: Search, fall: Search, mean: float) -> tuple[Course, tuple[dict[str, float], ...]]:
        little = CLOSE_GAIN * mean
        rises, falls = rise.reached > little, fall.reached > little
        if rises and falls:
            shown = [dict(zip(self._names, each.at.tolist(), strict=True)) for each in (rise, fall)]
            return Course.BOTH, tuple(shown)
        if rise.bound <= 2.0 * little and fall.bound <= 2.0 * little:
            return Course.CONSTANT, ()
        if fall.bound <= 2.0 * little:
            return Course.RISES, ()
        return (Course.FALLS, ()) if rise.bound <= 2.0 * little else (Course.OPEN, ())

    def _of_slope(self, place: int, sign: float) -> Callable[[Boxes], Values]:
        def bound(boxes: Boxes) -> Values:
            law = self._enclosure.law(boxes)
            return law.rises[:, place] if sign > 0.0 else -law.falls[:, place]

        return bound

    def _slope(self, place: int, sign: float, step: float) -> Callable[[Values], Values]:
        low, high = self._cells.low.min(axis=0)[place], self._cells.high.max(axis=0)[place]

        def slope(points: Values) -> Values:
            before, after = points.copy(), points.copy()
            before[:, place] = np.maximum(points[:, place] - step, low)
            after[:, place] = np.minimum(points[:, place] + step, high)
            rise = self.value(after) - self.value(before)
            return np.asarray(sign * rise / (after[:, place] - before[:, place]))

        return slope

    def _at_zero(self) -> float | None:
        """Return the output where all inputs are 0, if they can be."""
        low, high = self._cells.low.min(axis=0), self._cells.high.max(axis=0)
        if ((low > 0.0) | (high < 0.0)).any():
            return None
        return float(self.value(np.zeros((1, len(self._names))))[0])

    def _symmetry(self, span: float) -> tuple[str, bool]:
        """Return what the rules tell, else how samples at opposite inputs compare; whether it is proved."""
        proved = symmetry_of(self._block.function_block, self._output)
        return (proved, True) if proved else (self._sampled_symmetry(span), False)

    def _sampled_symmetry(self, span: float) -> str:
        low, high = self._cells.low.min(axis=0), self._cells.high.max(axis=0)
        half = np.maximum(np.minimum(-low, high), 0.0)
        if not half.any():
            return ""
        points = np.random.default_rng(0).uniform(-half, half, (SAMPLES, len(half)))
        here, there = self.value(points), self.value(-points)
        if np.abs(here - there).max() <= FLAT * span:
            return "even"
        return "odd" if np.abs(here + there).max() <= FLAT * span else ""

    def _dead_zones(self, zero: float, tolerance: float) -> Iterator[DeadZone]:
        for place in self._used():
            own = float(self._cells.low[:, place].min()), float(self._cells.high[:, place].max())
            found = self._exact_zone(place, own) or self._sampled_zone(place, own, zero, tolerance)
            if found.low < found.high:
                yield found

    def _exact_zone(self, place: int, ends: tuple[float, float]) -> DeadZone | None:
        """Return the zone along an input; None where the law bends along it."""
        low, high = map(exact, ends)
        name, zero = self._names[place], dict.fromkeys(self._names, Fraction(0))
        try:
            own = section(self._block.function_block, self._output, name, zero, (low, high))
        except NotStraight:
            return None
        low, high = own.same_around(Fraction(0))
        return DeadZone(name, float(low), float(high), is_exact=True)

    def _sampled_zone(self, place: int, ends: tuple[float, float], zero: float, tolerance: float) -> DeadZone:
        sides = []
        for end in ends:
            points = np.zeros((SAMPLES, len(self._names)))
            points[:, place] = np.linspace(0.0, end, SAMPLES)
            apart = np.flatnonzero(np.abs(self.value(points) - zero) > tolerance)
            last = (int(apart[0]) if apart.size else SAMPLES) - 1
            sides.append(float(points[last, place]))
        return DeadZone(self._names[place], sides[0], sides[1])


def whole_of(cells: Boxes) -> Boxes:
    """Return the one box around all cells."""
    return Boxes(cells.low.min(axis=0)[None, :], cells.high.max(axis=0)[None, :])


def require_ranges(block: FunctionBlock, universe: Universe) -> None:
    """Raise NotEnclosed where a variable moves something and may go anywhere."""
    fuzzified = {each.variable.casefold() for each in block.fuzzifications}
    for name in dict.fromkeys(moving(block)):
        if universe.of(name) is None and name not in fuzzified:
            raise NotEnclosed(f"`{name}` moves terms and may go anywhere: give its range by --universe")


def cells_of(names: Sequence[str], axes: Mapping[str, Axis], universe: Universe) -> Boxes:
    """Return the closed cells between breakpoints, as boxes of all inputs.

    An input without terms has its range, or is 0.
    """
    ends = []
    for name in names:
        axis = axes.get(name)
        knots = (
            [float(each.low) for each in axis.cells if each.is_point and each.low is not None] if axis else []
        )
        stretch = None if axis else universe.of(name)
        alone = (float(stretch[0]), float(stretch[1])) if stretch else ((knots or [0.0])[0],) * 2
        ends.append(list(pairwise(knots)) or [alone])
    count = 1
    for each in ends:
        count *= len(each)
    if count > MOST_CELLS:
        ends = [[(each[0][0], each[-1][1])] for each in ends]
    boxes = list(product(*ends))
    corners = np.array(boxes).reshape(len(boxes), len(names), 2)  # of no inputs there is one box, too
    return Boxes(corners[:, :, 0], corners[:, :, 1])

"""A function block about an operating point: its gains, and the loop that it then closes."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal

import control
import numpy as np
from numpy.typing import ArrayLike, NDArray

from fcl_sim.block import Block
from fcl_sim.engine.evaluate import by_declared_name
from fcl_sim.engine.smooth import sight
from fcl_sim.interop.iosystem import labels, remembered, seconds, state_labels
from fcl_sim.interop.loop import Loop, close
from fcl_sim.interop.slopes import Slopes, slopes
from fcl_sim.model import Curve, Points, Singletons, Term

Values = NDArray[np.float64]
Side = Literal["mean", "below", "above"]


@dataclass(frozen=True, kw_only=True, eq=False)
class Linearisation:
    """A block near `point`: its outputs are about `values` + `gains` · (inputs − point).

    `gains`, `below` and `above` are ∂output/∂input, (outputs, inputs), each in
    units of the output per unit of the input: `below` with the input falling
    from the point, `above` with it rising, `gains` those that were asked for.
    `memory`, (outputs, states), is ∂output/∂previous output. `kinks` are the
    pairs (output, input) whose two sides differ. Where `couples`, two inputs
    that change at once, under one MIN for instance, change an output otherwise
    than the sum of the gains says; no linear system describes the block there.
    `loop` is there where a plant was given.
    """

    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    states: tuple[str, ...]
    point: Mapping[str, float]
    values: Mapping[str, float]
    active: Mapping[str, bool]
    gains: Values
    below: Values
    above: Values
    memory: Values
    kinks: tuple[tuple[str, str], ...]
    couples: bool
    loop: Loop | None = None

    def system(self, dt: float, name: str | None = None) -> control.StateSpace:
        """Return the gains as a system of python-control, to stand where `to_iosystem` stood.

        It has the same inputs, outputs and states, which are now deviations
        from the operating point. Raises ValueError as `to_iosystem` does.
        """
        kept = [self.outputs.index(each) for each in self.states]
        return control.StateSpace(
            self.memory[kept],
            self.gains[kept],
            self.memory,
            self.gains,
            seconds(dt),
            inputs=labels(self.inputs),
            outputs=labels(self.outputs),
            states=state_labels(self.states),
            name=name,
            remove_useless_states=False,
        )


def linearise(
    block: Block,
    point: Mapping[str, float],
    plant: control.lti.LTI | None = None,
    dt: float | None = None,
    *,
    previous: Mapping[str, float] | None = None,
    side: Side = "mean",
) -> Linearisation:
    """Return `block` about `point`, inputs by name, and with a `plant` the loop that both close.

    A fuzzy law has kinks, and set points like to lie on them. So each gain is
    taken from both sides; `side` says which ones the loop is judged with. The
    mean, as everywhere else, is what a small swing about a kink meets: the
    describing function of two slopes is their mean, for what is even in the law
    makes a bias and even harmonics. To be safe, look at `below` and `above` too.
    Gains are those of the law in LREAL, to about 1e-9 of its range over the span
    of the input's terms; in REAL and INT it is a staircase. NC goes on from
    `previous`, as in Block.evaluate; where no rule is active, gains are 0.

    `plant` is the rest of the loop: a linear system of python-control from the
    block's outputs to its inputs, signs included (-G for an input that is set
    point less G's output), differentiators, integrators and filters too. Signals
    that are named as the block's are found by name, others are taken in order.
    In continuous time it is sampled every `dt` seconds with its input held
    between (zero-order hold, exact); in discrete time `dt` may be left out.

    Raises TypeError for an unknown or missing input; ValueError for one that is
    not finite, for a plant that does not fit, and where an output has no finite
    gain: it jumps, as where the last rule stops firing and DEFAULT takes over.
    """
    linear = _about(block, point, previous or {}, side)
    if plant is None:
        return linear
    step = plant.dt if dt is None else dt
    return replace(linear, loop=close(linear.system(step), plant))


def _about(
    block: Block, point: Mapping[str, float], previous: Mapping[str, float], side: Side
) -> Linearisation:
    at = _operating_point(block, point, previous)
    before = block.evaluation(at.inputs, previous)
    found = slopes(at.law, np.array([*at.inputs.values(), *at.states.values()]), at.spans())
    _refuse_jumps(at, found)
    mean = (found.below + found.above) / 2
    chosen = {"mean": mean, "below": found.below, "above": found.above}[side]
    n = len(block.inputs)
    differ = np.abs(found.above - found.below) > found.alike
    return Linearisation(
        inputs=block.inputs,
        outputs=block.outputs,
        states=tuple(at.states),
        point=at.inputs,
        values={name: float(value) for name, value in before.outputs.items()},
        active={name: bool(flag) for name, flag in before.active.items()},
        gains=chosen[:, :n],
        below=found.below[:, :n],
        above=found.above[:, :n],
        memory=chosen[:, n:],
        kinks=tuple(
            (output, name)
            for i, output in enumerate(block.outputs)
            for j, name in enumerate(block.inputs)
            if differ[i, j]
        ),
        couples=found.couples,
    )


@dataclass(frozen=True)
class _OperatingPoint:
    """A block with its inputs and the previous outputs that it remembers, by declared name."""

    block: Block
    inputs: Mapping[str, float]
    states: Mapping[str, float]

    def law(self, points: Values) -> Values:
        """Return the outputs (outputs, points) at inputs and previous outputs (inputs + states, points)."""
        n = len(self.inputs)
        given = dict(zip(self.inputs, points[:n], strict=True))
        previous = dict(zip(self.states, points[n:], strict=True))
        found = self.block.evaluate(given, previous)
        return np.array([np.broadcast_to(found[name], points.shape[1]) for name in self.block.outputs])

    def spans(self) -> Values:
        """Return over how much each input and each state varies: the span of its terms, else its size."""
        folded = {name.casefold(): value for name, value in self.inputs.items()}
        terms = {each.variable.casefold(): each.terms for each in self.block.function_block.fuzzifications}
        places = {
            name: [x for term in terms.get(name.casefold(), ()) for x in _places(term, folded)]
            for name in self.inputs
        }
        widths = [np.ptp(places[name]) if places[name] else 0.0 for name in self.inputs]
        sizes = [*self.inputs.values(), *self.states.values()]
        widths += [0.0] * len(self.states)
        return np.array([width or max(1.0, abs(size)) for width, size in zip(widths, sizes, strict=True)])


def _operating_point(
    block: Block, point: Mapping[str, float], previous: Mapping[str, float]
) -> _OperatingPoint:
    outputs = block.evaluate(point, previous)
    given = by_declared_name(point, block.inputs, "input")
    former = by_declared_name(previous, block.outputs, "output")
    initial = {each.name: each.initial for each in block.function_block.inputs}
    return _OperatingPoint(
        block,
        {name: _number(given.get(name, initial[name])) for name in block.inputs},
        {name: _number(former.get(name, outputs[name])) for name in remembered(block.function_block)},
    )


def _number(value: ArrayLike | None) -> float:
    array = np.asarray(value, np.float64)
    if array.ndim > 0:
        raise ValueError("an operating point has one number for each variable")
    return float(array)


def _places(term: Term, values: Mapping[str, float]) -> list[float]:
    """Return the abscissae of an input's term, with what moves them at the operating point."""

    def at(x: float | str) -> float:
        return values.get(x.casefold(), 0.0) if isinstance(x, str) else x

    match term.shape:
        case Points() | Singletons():
            return [at(each.x) for each in term.shape.points]
        case Curve():
            return [*sight(replace(term.shape, parameters=tuple(map(at, term.shape.parameters))))]
    return []


def _refuse_jumps(at: _OperatingPoint, found: Slopes) -> None:
    """Raise ValueError for an output without a finite slope."""
    names = (*at.inputs, *(f"its previous value {name}" for name in at.states))
    for where, slope in (("below", found.below), ("above", found.above)):
        for i, j in np.argwhere(np.isnan(slope)):
            place = ", ".join(f"{name} = {value:g}" for name, value in at.inputs.items())
            raise ValueError(
                f"{at.block.outputs[i]} has no finite gain by {names[j]} {where} {place}: "
                "it jumps there, or rises without bound"
            )

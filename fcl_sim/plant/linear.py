"""Linear plants as matrices: transfer functions, zeros and poles, first order, state space.

x' = A x + B u,  y = C x + D u, where u is the input as it arrives, after the
dead time. What arrives is kept as further states behind x, so that a run moves
all of them at once, exactly, by the exponential of one matrix (`loop.exact`).
"""

import hashlib
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fcl_sim.plant.catalog import PlantModel
from fcl_sim.plant.declaration import Input, Output, Parameter, Plant, State
from fcl_sim.plant.functions import DEFAULTS, PARTS, Array, PlantFunctions, as_entry

Matrix = NDArray[np.float64]
Polynomial = Sequence[float] | Matrix
"""Coefficients, the highest power of s first."""

PAIRED = 1e-9
"""How far, relative to its size, the conjugate of a complex zero or pole may be off."""
STILL = 1e-12
"""What may be left of the derivatives of a plant at rest, relative to the values in them."""


class LinearError(ValueError):
    """Numbers that make no linear plant; `about` names the parameter."""

    def __init__(self, about: str, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.about = about
        self.hint = hint


@dataclass(frozen=True, slots=True, eq=False)
class StateSpace:
    """A (n, n), B (n, m), C (r, n) and D (r, m), time in seconds."""

    a: Matrix
    b: Matrix
    c: Matrix
    d: Matrix

    @property
    def gives_its_state(self) -> bool:
        """Whether the only output is the first state."""
        return self.c.tolist() == [[float(i == 0) for i in range(self.c.shape[1])]] and not self.d.any()


def state_space(a: ArrayLike, b: ArrayLike, c: ArrayLike, d: ArrayLike | None = None) -> StateSpace:
    """Return matrices that fit together, as given; without D it is 0. LinearError names one that does not."""
    given = {"A": a, "B": b, "C": c} | ({} if d is None else {"D": d})
    read = {name: _matrix(name, each) for name, each in given.items()}
    states, inputs, outputs = len(read["A"]), read["B"].shape[1], len(read["C"])
    read.setdefault("D", np.zeros((outputs, inputs)))
    wanted = {
        "A": (states, states),
        "B": (states, inputs),
        "C": (outputs, states),
        "D": (outputs, inputs),
    }
    for name, shape in wanted.items():
        if read[name].shape != shape:
            rows, columns = read[name].shape
            hint = (
                f"with {states} states, {inputs} inputs and {outputs} outputs it is {shape[0]} by {shape[1]}"
            )
            raise LinearError(name, f"`{name}` is {rows} by {columns}", hint)
    return StateSpace(read["A"], read["B"], read["C"], read["D"])


def _matrix(name: str, given: ArrayLike) -> Matrix:
    hint = f"write it by rows: {name} = [[0.0, 1.0], [-2.0, -3.0]]"
    try:
        matrix = np.array(given, dtype=np.float64)
    except (TypeError, ValueError):
        raise LinearError(name, f"`{name}` is not a matrix", hint) from None
    if matrix.ndim != 2 or not matrix.size:
        raise LinearError(name, f"`{name}` is not a matrix", hint)
    if not np.isfinite(matrix).all():
        raise LinearError(name, f"`{name}` has a number that is not finite")
    return matrix


def first_order(gain: float, time_constant: float) -> StateSpace:
    """Return gain / (time_constant s + 1); its state is its output."""
    if not time_constant > 0.0:
        raise LinearError("time_constant", "`time_constant` must be greater than 0")
    one = np.ones((1, 1))
    return StateSpace(one / -time_constant, one * (gain / time_constant), one, 0.0 * one)


def transfer_function(numerator: Polynomial, denominator: Polynomial) -> StateSpace:
    """Return numerator / denominator in observer form: the first state is the output less D u.

    The others are scaled by powers of a power of two, so that the matrix is no
    larger than twice the largest root or so.
    """
    num, den = (_without_leading_zeros(each) for each in (numerator, denominator))
    if not len(den):
        raise LinearError("denominator", "`denominator` is 0", "a gain of its own is a block: `gain`")
    if len(den) == 1:
        raise LinearError("denominator", "`denominator` has no power of s", "without one there is no plant")
    if len(num) > len(den):
        hint = "nothing real answers a step with a pulse: the denominator has at least the numerator's power"
        raise LinearError("numerator", "`numerator` has a higher power of s than the denominator", hint)
    order = len(den) - 1
    num = np.concatenate([np.zeros(order + 1 - len(num)), num]) / den[0]
    coefficients = den[1:] / den[0]
    through = num[0]
    sizes = [abs(each) ** (1.0 / power) for power, each in enumerate(coefficients, start=1)]
    unit = 2.0 ** math.frexp(max(sizes) or 1.0)[1]
    scales = unit ** -np.arange(order, dtype=np.float64)
    a = np.diag(np.full(order - 1, unit), 1)
    a[:, 0] = -coefficients * scales
    b = (num[1:] - coefficients * through) * scales
    c = np.zeros((1, order))
    c[0, 0] = 1.0
    return StateSpace(a, b[:, np.newaxis], c, np.array([[through]]))


def _without_leading_zeros(polynomial: Polynomial) -> Matrix:
    return np.trim_zeros(np.array(polynomial, dtype=np.float64), "f")


def zero_pole_gain(zeros: Sequence[complex], poles: Sequence[complex], gain: float) -> StateSpace:
    """Return gain * prod(s - zero) / prod(s - pole), as sections of second order one behind the other.

    Multiplied out, roots that lie close together would lose digits. The
    sections with fewest zeros come last, so that, if any can be, the first
    state is the output.
    """
    if not poles:
        raise LinearError("poles", "`poles` is empty", "without one there is no plant")
    if len(zeros) > len(poles):
        hint = "nothing real answers a step with a pulse: there are at least as many poles"
        raise LinearError("zeros", f"`zeros` has {len(zeros)} and `poles` {len(poles)} of them", hint)
    above, below = (_factors(name, each) for name, each in (("zeros", zeros), ("poles", poles)))
    above += [np.ones(1)] * (len(below) - len(above))
    system = transfer_function(gain * above[0], below[0])
    for num, den in zip(above[1:], below[1:], strict=True):
        system = _followed_by(system, transfer_function(num, den))
    return system


def _factors(name: str, roots: Sequence[complex]) -> list[Matrix]:
    """Return real polynomials with these roots, of second order but perhaps for the last."""
    pairs: list[Matrix] = []
    upper = sorted((each for each in roots if each.imag > 0.0), key=lambda each: (abs(each), each.real))
    lower = [each for each in roots if each.imag < 0.0]
    for each in upper:
        partner = min(lower, key=lambda other: abs(other - each.conjugate()), default=None)
        if partner is None or abs(partner - each.conjugate()) > PAIRED * abs(each):
            raise _lonely(name, each)
        lower.remove(partner)
        pairs.append(np.array([1.0, -2.0 * each.real, each.real**2 + each.imag**2]))
    if lower:
        raise _lonely(name, lower[0])
    real = sorted((each.real for each in roots if each.imag == 0.0), key=abs)
    pairs += [np.array([1.0, -(p + q), p * q]) for p, q in zip(real[::2], real[1::2], strict=False)]
    return pairs + ([np.array([1.0, -real[-1]])] if len(real) % 2 else [])


def _lonely(name: str, root: complex) -> LinearError:
    hint = f'complex ones come in pairs: "{root:g}" and "{root.conjugate():g}"'
    return LinearError(name, f"`{name}` has {root:g} without its conjugate", hint)


def _followed_by(first: StateSpace, second: StateSpace) -> StateSpace:
    """Return `second` behind `first`, the states of `second` in front."""
    n, m = len(second.a), len(first.a)
    a = np.block([[second.a, second.b @ first.c], [np.zeros((m, n)), first.a]])
    b = np.vstack([second.b @ first.d, first.b])
    return StateSpace(a, b, np.hstack([second.c, second.d @ first.c]), second.d @ first.d)


def at_rest(system: StateSpace, outputs: Sequence[float]) -> tuple[Matrix, Matrix]:
    """Return the states and inputs with which a plant rests at these outputs, the smallest such ones.

    LinearError where it cannot.
    """
    n = len(system.a)
    whole = np.block([[system.a, system.b], [system.c, system.d]])
    wanted = np.concatenate([np.zeros(n), np.asarray(outputs, dtype=np.float64)])
    found = np.linalg.lstsq(whole, wanted, rcond=None)[0]
    left = np.abs(whole @ found - wanted).max()
    if left > STILL * max(1.0, float((np.abs(whole) @ np.abs(found)).max())):
        raise LinearError("start", "the plant does not rest at this output", "begin at 0 and let it move")
    return found[:n], found[n:]


def linear_plant(
    system: StateSpace,
    *,
    name: str = "linear",
    title: str = "Linear plant",
    inputs: Sequence[Input],
    outputs: Sequence[Output],
    states: Sequence[State] = (),
    parameters: Sequence[Parameter] = (),
    delay: int = 0,
) -> PlantModel:
    """Return the plant model of matrices, its inputs late by `delay` nanoseconds.

    Without `states` they are called x1, x2, ... and start at 0. The inputs
    arrive as `start` of each says until the first write does.
    """
    own = tuple(states) or tuple(State(f"x{i + 1}", "", 0.0, "") for i in range(len(system.a)))
    arrived = tuple(
        State(f"{each.name}_arrived", each.unit, each.start, f"{each.name} after the dead time")
        for each in inputs
    )
    declaration = Plant(
        name=name,
        title=title,
        states=own + arrived,
        inputs=tuple(inputs),
        outputs=tuple(outputs),
        parameters=tuple(parameters),
    )
    size = len(own) + len(arrived)
    moving, seen = np.hstack([system.a, system.b]), np.hstack([system.c, system.d])
    constants = (float(size), float(len(own)), *moving.ravel().tolist(), *seen.ravel().tolist())
    return replace(_bare(), declaration=declaration, constants=constants, delay=delay)


@cache
def _bare() -> PlantModel:
    """Return what all linear plants have in common."""
    path = Path(__file__)
    given = {**DEFAULTS, "dynamics": dynamics, "outputs": outputs}
    entries: dict[str, Any] = {part: as_entry(part, given[part], "") for part in PARTS}
    return PlantModel(
        declaration=Plant(name="", title="", states=(), inputs=(), outputs=()),
        path=path,
        digest=hashlib.sha256(path.read_bytes()).hexdigest(),
        functions=PlantFunctions(**entries, path=path),
        samples=False,
        delay=0,
    )


def dynamics(t: float, x: Array, u: Array, p: Array, mode: int, dx: Array) -> None:  # noqa: ARG001
    """Give x' = A x + B u; what arrives stays as it is between writes.

    p begins with the number of states in all, the number of own ones, and by
    rows [A B], then [C D].
    """
    size, own = int(p[0]), int(p[1])
    at = 2
    for i in range(own):
        total = 0.0
        for j in range(size):
            total += p[at + j] * x[j]
        dx[i] = total
        at += size
    for i in range(own, size):
        dx[i] = 0.0


def outputs(t: float, x: Array, u: Array, p: Array, mode: int, y: Array) -> None:  # noqa: ARG001
    """Give y = C x + D u, u as it has arrived."""
    size, own = int(p[0]), int(p[1])
    at = 2 + own * size
    for i in range(y.size):
        total = 0.0
        for j in range(size):
            total += p[at + j] * x[j]
        y[i] = total
        at += size

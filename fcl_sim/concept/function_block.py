"""An instance of a function block in INT: the library's blocks wired as its text says."""

from collections.abc import Mapping
from math import isfinite
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fcl_sim.arithmetic.integer import INT_LEAST, INT_MOST, ROUND, TRUNCATE, fits_int
from fcl_sim.concept.declaration import Ints
from fcl_sim.concept.events import event_of
from fcl_sim.concept.instance import Rounding
from fcl_sim.concept.network import run_many, run_once
from fcl_sim.concept.scale import Scale
from fcl_sim.concept.translate import translated
from fcl_sim.diagnostics import nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.model import FunctionBlock

Scales = Mapping[str, float | tuple[float, float]]
"""By variable, the factor of its counts, or factor and offset: value = counts * factor + offset."""


class IntegerInstance:
    """A function block with its memory, in INT: degrees are 0 .. 10000, intermediates have 32 bits (S36).

    `scale` says what a count of each variable is; without it values are counts.
    `rounding` is of quotients. Call it with inputs by name; those not given
    keep their last value, at first the declared initial one, else 0. Read
    outputs as attributes. Raises InputFault for what the library cannot do,
    with every place (FCL414).
    """

    __slots__ = ("_block", "_memory", "_network", "_rounding", "_scales")

    def __init__(
        self, block: FunctionBlock, scale: Scales | None = None, rounding: Rounding | str = Rounding.TRUNCATE
    ) -> None:
        self._block = block
        self._scales = _scales(block, scale or {})
        self._rounding = ROUND if _chosen(rounding) is Rounding.ROUND else TRUNCATE
        self._network = translated(block, self._scales)
        self._memory = self._network.memory.copy()
        self.reset()

    def __call__(self, /, **inputs: float) -> None:
        """Evaluate once.

        Raises TypeError for an unknown input or what is no number, ValueError
        for one that INT cannot hold, OverflowError where a result leaves its
        width, naming the step; the instance is then as it was.
        """
        memory = self._memory.copy()
        for name, value in inputs.items():
            known = _declared(name, tuple(self._network.inputs), "input")
            memory[self._network.inputs[known]] = self._counts(known, value)
        self._told(run_once(self._network.steps, memory, self._rounding))
        self._memory = memory

    def __getattr__(self, name: str) -> float:
        """Return the value of the output `name`."""
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self._value(_declared(name, tuple(self._network.outputs), "output"))
        except TypeError as unknown:
            raise AttributeError(str(unknown), name=name, obj=self) from None

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._network.outputs]

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value:g}" for name, value in (self.inputs | self.outputs).items())
        return f"<instance of {self._block.name} in INT: {values}>"

    @property
    def inputs(self) -> dict[str, float]:
        """Current values of the inputs."""
        return {name: self._value(name) for name in self._network.inputs}

    @property
    def outputs(self) -> dict[str, float]:
        """Current values of the outputs."""
        return {name: self._value(name) for name in self._network.outputs}

    @property
    def degrees(self) -> dict[str, int]:
        """Degree of firing of each rule at the last call, 0 .. 10000."""
        return {label: int(self._memory[word]) for label, word in self._network.degrees.items()}

    @property
    def active(self) -> dict[str, bool]:
        """Whether any rule was active for each output at the last call."""
        return {name: bool(self._memory[words].any()) for name, words in self._network.shares.items()}

    def resume(self, /, **outputs: float) -> None:
        """Set outputs to values from which the next call goes on: what NC keeps, as after a warm restart.

        Raises TypeError for an unknown output or what is no number, ValueError
        for one that INT cannot hold.
        """
        memory = self._memory.copy()
        for name, value in outputs.items():
            known = _declared(name, tuple(self._network.outputs), "output")
            memory[self._network.outputs[known]] = self._counts(known, value)
        self._memory = memory

    def beyond(self, /, **inputs: float) -> str:
        """Return the first of these inputs that INT cannot hold, empty where it can hold all."""
        for name, value in inputs.items():
            try:
                self._counts(_declared(name, tuple(self._network.inputs), "input"), value)
            except ValueError:
                return name
        return ""

    def reset(self) -> None:
        """Set inputs and outputs to their initial values, as a cold restart does."""
        self._memory[:] = self._network.memory
        for each in self._block.inputs:
            if each.initial is not None:
                self._memory[self._network.inputs[each.name]] = self._counts(each.name, each.initial)

    def evaluate(self, values: Mapping[str, Any]) -> dict[str, NDArray[np.float64]]:
        """Return the outputs at every point of `values`, arrays that are broadcast, each from this state.

        An input may be missing: it keeps its value. Errors as in a call.
        """
        names = [_declared(name, tuple(self._network.inputs), "input") for name in values]
        columns = [self._all_counts(name, each) for name, each in zip(names, values.values(), strict=True)]
        shape = np.broadcast_shapes(*(each.shape for each in columns))
        points = np.array([np.broadcast_to(each, shape).ravel() for each in columns], np.int64).ravel()
        size = int(np.prod(shape))
        results = np.empty(len(self._network.outputs) * size, np.int64)
        network = self._network
        given = np.array([network.inputs[name] for name in names], np.int64)
        taken = np.array([*network.outputs.values()], np.int64)
        self._told(run_many(network.steps, self._memory, given, taken, points, results, self._rounding))
        rows = results.reshape(len(taken), *shape)
        return {name: self._values(name, rows[place, ...]) for place, name in enumerate(network.outputs)}

    def _values(self, name: str, counts: Ints) -> NDArray[np.float64]:
        scale = self._scales[name.casefold()]
        return np.asarray(counts * scale.factor + scale.offset, np.float64)

    def _value(self, name: str) -> float:
        words = self._network.inputs if name in self._network.inputs else self._network.outputs
        return self._scales[name.casefold()].value(int(self._memory[words[name]]))

    def _counts(self, name: str, value: Any) -> int:
        try:
            usable = isfinite(value)
        except TypeError:
            raise TypeError(f"{name} must be a number, not {type(value).__name__}") from None
        if not usable:
            raise ValueError(f"{name} is {value}")
        counts = self._scales[name.casefold()].counts(value)
        if not fits_int(counts):
            raise ValueError(f"{name} is {value}, {counts} counts; an INT lies in {INT_LEAST} .. {INT_MOST}")
        return counts

    def _all_counts(self, name: str, values: Any) -> Ints:
        array = np.asarray(values)
        if array.dtype.kind in "iu" and self._scales[name.casefold()] == Scale():
            beyond = array[(array < INT_LEAST) | (array > INT_MOST)]
            if beyond.size:
                self._counts(name, int(beyond.flat[0]))
            return array.astype(np.int64)
        flat = array.ravel()
        if array.dtype.kind != "f":
            given = [self._counts(name, each) for each in flat.tolist()]
            return np.array(given, np.int64).reshape(array.shape)
        counts, sure = self._scales[name.casefold()].sure_counts(flat.astype(np.float64))
        for place in np.flatnonzero(~(sure & (counts >= INT_LEAST) & (counts <= INT_MOST))).tolist():
            counts[place] = self._counts(name, flat[place].item())
        return counts.astype(np.int64).reshape(array.shape)

    def _told(self, result: int) -> None:
        if result:
            number, event = divmod(result, 8)
            raise OverflowError(f"{self._block.name}: {self._network.names[number]}: {event_of(event)}")


def _scales(block: FunctionBlock, given: Scales) -> dict[str, Scale]:
    names = tuple(each.name for each in (*block.inputs, *block.outputs))
    scales = {name.casefold(): Scale() for name in names}
    for name, value in given.items():
        factor, offset = value if isinstance(value, tuple) else (value, 0)
        if not (isfinite(factor) and isfinite(offset) and factor > 0):
            raise ValueError(f"the scale of {name} must be finite, its factor above 0: {value}")
        scales[_declared(name, names, "variable").casefold()] = Scale(factor, offset)
    return scales


def _chosen(rounding: Rounding | str) -> Rounding:
    try:
        return Rounding(rounding)
    except ValueError:
        raise ValueError(f"no rounding {rounding}; there is {listed(Rounding)}") from None


def _declared(name: str, names: tuple[str, ...], kind: str) -> str:
    for each in names:
        if each.casefold() == name.casefold():
            return each
    near = nearest(name, names)
    hint = f"did you mean {near}?" if near else f"there is {listed(names)}"
    raise TypeError(f"no {kind} {name}; {hint}")

"""An instance of a function block, called as IEC 61131-3 calls one."""

from collections.abc import Callable
from functools import partial
from math import isfinite
from operator import itemgetter
from typing import Any, cast

from fcl_sim.engine.entries import NOTHING, WITH_THE_CALL, one_for, placed
from fcl_sim.engine.evaluate import declared_name
from fcl_sim.engine.explain import Explanation, explain
from fcl_sim.engine.precision import PRECISIONS, REAL
from fcl_sim.engine.program import Program
from fcl_sim.jit import address, compiled
from fcl_sim.model import FunctionBlock


class Instance:
    """A function block with its memory.

    Call it with inputs by name; those not given keep their last value, at
    first the declared initial one, else 0. Read outputs as attributes. With NC
    an output keeps its previous value while no rule is active.
    """

    __slots__ = (
        "_block",
        "_fits",
        "_memory",
        "_placed",
        "_places",
        "_program",
        "_results",
        "_run",
        "_together",
        "_words",
    )

    def __init__(self, block: FunctionBlock, program: Program) -> None:
        self._block = block
        self._program = program
        self._memory = program.initial.copy()
        self._words = cast("memoryview[float]", self._memory.data)  # read and written faster than an array
        self._places = {name: place for place, name in enumerate(program.input_names)}
        self._results = {name: place for place, name in enumerate(program.output_names, program.outputs_at)}
        self._fits = isfinite if program.arithmetic == "LREAL" else _fits_real
        run = one_for(program).compile()
        count = len(self._places)
        # What numba takes for a number is one; uncompiled, all sorts of things would be.
        together = compiled() and count <= WITH_THE_CALL
        self._placed = (
            placed(program, self._memory, 0),
            placed(program, self._memory, count if together else 0),
        )
        self._run = partial(run, *NOTHING, address(self._placed[0]))
        # One attribute: with a __getattr__, each costs a call a twentieth of its time.
        rest = (*NOTHING[count:], address(self._placed[1]))
        self._together = _picked(program.input_names), count if together else -1, run, rest

    def __call__(self, /, **inputs: float) -> None:
        """Evaluate once.

        Raises TypeError for an unknown input or what is no number, ValueError
        for a number that is not finite (S37), or beyond REAL; the instance is then
        as it was.
        """
        picked, count, run, rest = self._together
        if len(inputs) == count:  # all of them go in with the call
            try:
                if run(*picked(inputs) + rest):
                    return
            except (KeyError, TypeError, ValueError, OverflowError):
                pass  # other names, numbers of other kinds, or none
        self._write(inputs)
        self._run()

    def _write(self, inputs: dict[str, float]) -> None:
        """Write inputs by name, or raise what `__call__` says and write none."""
        places = self._places
        try:
            usable = all(map(self._fits, inputs.values())) and inputs.keys() <= places.keys()
        except (TypeError, OverflowError):
            usable = False
        for name, value in (inputs if usable else self._checked(inputs)).items():
            self._words[places[name]] = value

    def __getattr__(self, name: str) -> float:
        """Return the value of the output `name`."""
        if name.startswith("__"):  # what Python asks of an object that it copies
            raise AttributeError(name)
        place = self._results.get(name)
        if place is None:
            try:
                place = self._results[declared_name(name, self._program.output_names, "output")]
            except TypeError as unknown:
                raise AttributeError(str(unknown), name=name, obj=self) from None
        return self._words[place]

    def __copy__(self) -> "Instance":
        """Return an instance that goes on from here by itself."""
        twin = Instance(self._block, self._program)
        twin._memory[:] = self._memory
        return twin

    def __deepcopy__(self, memo: dict[int, object]) -> "Instance":
        return self.__copy__()

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._program.output_names]

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value:g}" for name, value in (self.inputs | self.outputs).items())
        return f"<instance of {self._program.name}: {values}>"

    @property
    def inputs(self) -> dict[str, float]:
        """Current values of the inputs."""
        return self._stretch(0, self._program.input_names)

    @property
    def outputs(self) -> dict[str, float]:
        """Current values of the outputs."""
        return self._stretch(self._program.outputs_at, self._program.output_names)

    @property
    def active(self) -> dict[str, bool]:
        """Whether any rule was active for each output at the last call."""
        flags = self._stretch(self._program.active_at, self._program.output_names)
        return {name: flag != 0.0 for name, flag in flags.items()}

    @property
    def degrees(self) -> dict[str, float]:
        """Degree of firing of each rule at the last call."""
        return self._stretch(self._program.degrees_at, self._program.rule_labels)

    def explain(self, /, **inputs: float) -> Explanation:
        """Return what a call with `inputs` would do, step by step; the instance stays as it is."""
        memory = self._memory.copy()
        for name, value in self._checked(inputs).items():
            memory[self._places[name]] = value
        return explain(self._block, self._program, memory)

    def resume(self, /, **outputs: float) -> None:
        """Set outputs to values from which the next call goes on: what NC keeps, as after a warm restart.

        Raises TypeError for an unknown output or what is no number.
        """
        names = self._program.output_names
        values = {declared_name(name, names, "output"): float(value) for name, value in outputs.items()}
        for name, value in values.items():
            self._words[self._results[name]] = value

    def reset(self) -> None:
        """Set inputs and outputs to their initial values, as a cold restart does."""
        self._memory[:] = self._program.initial

    def _checked(self, inputs: dict[str, Any]) -> dict[str, float]:
        """Return inputs as finite floats by their declared names, or raise what `__call__` says."""
        names = self._program.input_names
        arithmetic = self._program.arithmetic
        return {
            declared_name(name, names, "input"): _number(name, value, arithmetic)
            for name, value in inputs.items()
        }

    def _stretch(self, start: int, names: tuple[str, ...]) -> dict[str, float]:
        return dict(zip(names, self._words[start : start + len(names)].tolist(), strict=True))


def _picked(names: tuple[str, ...]) -> Callable[[dict[str, Any]], tuple[Any, ...]]:
    """Return what takes the values of names, in their order, out of a dictionary."""
    if len(names) > 1:
        return itemgetter(*names)  # which is quicker, but of one name makes no tuple
    return lambda inputs: tuple([inputs[name] for name in names])


def _fits_real(value: float) -> bool:
    return abs(value) <= REAL.largest


def _number(name: str, value: Any, arithmetic: str) -> float:
    try:
        usable = isfinite(value)
    except TypeError:
        raise TypeError(f"{name} must be a number, not {type(value).__name__}") from None
    except OverflowError:  # a whole number of more than 308 digits
        raise ValueError(f"{name} is more than {arithmetic} can hold") from None
    if not usable:
        raise ValueError(f"{name} is {value}")
    largest = PRECISIONS[arithmetic].largest
    if abs(value) > largest:
        raise ValueError(f"{name} is {value}; {arithmetic} reaches to {largest:g}")
    return float(value)

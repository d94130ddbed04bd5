"""An instance of a Concept block, called as IEC 61131-3 calls one."""

from collections.abc import Iterable, Mapping
from enum import StrEnum
from typing import Any

import numpy as np

from fcl_sim.arithmetic.integer import ROUND, TRUNCATE
from fcl_sim.concept.declaration import CEILING, BlockType
from fcl_sim.concept.events import Event, event_of
from fcl_sim.concept.execute import TABLE, execute_int, execute_real
from fcl_sim.concept.values import FUZ_MD_INT, FUZ_MD_REAL, Value, data_type, members, number_of, value_of
from fcl_sim.diagnostics.spelling import listed, nearest


class Rounding(StrEnum):
    """What becomes of an INT quotient; the manual does not say which it is."""

    TRUNCATE = "truncate"
    ROUND = "round"


class Instance:
    """A block with its memory: inputs keep their last value, at first 0, outputs too.

    `inputs` is how many inputs the symbol is stretched to have, 32 at most
    (p. 37); without it, as many as `initial` names, which are initial values
    of inputs or outputs by name. `rounding` is for INT.

    `ENO` says whether the last call ran without an error, `event` what it
    reported, if anything. Raises TypeError for a name that is not there or a
    value of another type, ValueError for one outside its data type.
    """

    __slots__ = (
        "ENO",
        "_inputs",
        "_kind",
        "_opcode",
        "_outputs",
        "_places",
        "_rounding",
        "_stretched",
        "event",
    )

    def __init__(
        self,
        kind: BlockType,
        /,
        *,
        inputs: int | None = None,
        rounding: Rounding | str = Rounding.TRUNCATE,
        **initial: Value,
    ) -> None:
        self._kind = kind
        self._opcode = TABLE.index(kind)
        self._rounding = ROUND if _rounding(kind, rounding) is Rounding.ROUND else TRUNCATE
        self._stretched = _stretched(kind, inputs, initial)
        words = kind.inputs(self._stretched)
        self._inputs: np.ndarray[Any, Any] = np.zeros(len(words), _DTYPES[kind.number])
        self._outputs: np.ndarray[Any, Any] = np.zeros(len(kind.outputs), _DTYPES[kind.number])
        self._places = {word: (self._inputs, place) for place, word in enumerate(words)}
        self._places |= {word: (self._outputs, place) for place, word in enumerate(kind.outputs)}
        self.ENO = True
        self.event: Event | None = None
        self._assign(initial, (*words, *kind.outputs), "input or output")

    def __call__(self, /, *, EN: bool = True, **inputs: Value) -> None:  # noqa: N803  the name of the input
        """Run once; with EN false outputs stay and ENO is false (p. 86)."""
        self._assign(inputs, self._kind.inputs(self._stretched), "input")
        number = self._run() if EN else 0
        self.event = event_of(number)
        self.ENO = bool(EN) and number <= 0

    def __getattr__(self, name: str) -> Value:
        """Return the value of the output `name`."""
        if name.startswith("_"):  # of Python's own, when an instance is copied
            raise AttributeError(name)
        names = _names(self._kind.outputs)
        try:
            return self._values(names)[_declared(name, names, "output")]
        except TypeError as unknown:
            raise AttributeError(str(unknown), name=name, obj=self) from None

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *_names(self._kind.outputs)]

    def __repr__(self) -> str:
        shown = ", ".join(f"{name}={value}" for name, value in (self.inputs | self.outputs).items())
        return f"<instance of {self._kind.name}: {shown}>"

    @property
    def inputs(self) -> dict[str, Value]:
        """Current values of the inputs."""
        return self._values(_names(self._kind.inputs(self._stretched)))

    @property
    def outputs(self) -> dict[str, Value]:
        """Current values of the outputs."""
        return self._values(_names(self._kind.outputs))

    def _run(self) -> int:
        words = (self._opcode, self._inputs, self._stretched, self._outputs)
        integer = self._kind.number == "INT"
        number: int = execute_int(*words, self._rounding) if integer else execute_real(*words)
        return number

    def _assign(self, values: Mapping[str, Any], words: tuple[str, ...], kind: str) -> None:
        """Take values in, all or none."""
        number = self._kind.number
        names = _names(words)
        taken: list[tuple[str, float]] = []
        for name, value in values.items():
            known = _declared(name, names, kind)
            pairs = members(known, value, number) if f"{known}.n" in words else [(known, value)]
            taken += [(word, number_of(word, each, data_type(word, number))) for word, each in pairs]
        for word, each in taken:
            array, place = self._places[word]
            array[place] = each

    def _values(self, names: Iterable[str]) -> dict[str, Value]:
        structure: Any = FUZ_MD_INT if self._kind.number == "INT" else FUZ_MD_REAL
        values: dict[str, Value] = {}
        for name in names:
            if name in self._places:
                values[name] = self._value(name)
            else:
                values[name] = structure(*(self._value(f"{name}.{member}") for member in structure._fields))
        return values

    def _value(self, word: str) -> bool | int | float:
        array, place = self._places[word]
        return value_of(array[place], data_type(word, self._kind.number))


_DTYPES = {"INT": np.int64, "REAL": np.float32}


def _names(words: Iterable[str]) -> tuple[str, ...]:
    """Return the names that Python writes: a structure's is one."""
    return tuple(dict.fromkeys(word.partition(".")[0] for word in words))


def _declared(name: str, names: tuple[str, ...], kind: str) -> str:
    for each in names:
        if each.casefold() == name.casefold():
            return each
    near = nearest(name, names)
    raise TypeError(
        f"no {kind} {name}; " + (f"did you mean {near}?" if near else f"there is {listed(names)}")
    )


def _stretched(kind: BlockType, inputs: int | None, initial: Iterable[str]) -> int:
    """Return how many inputs carry the stem."""
    if inputs is None:
        known = [each.casefold() for each in kind.inputs(CEILING)[len(kind.leading) :]]
        given = [known.index(each.casefold()) + 1 for each in initial if each.casefold() in known]
        return max([kind.least, *given])
    if not kind.least <= inputs <= CEILING:
        raise ValueError(
            f"{kind.name} has {kind.least} to {CEILING} inputs {kind.stem}1, {kind.stem}2, .., not {inputs}"
        )
    return inputs


def _rounding(kind: BlockType, rounding: Rounding | str) -> Rounding:
    try:
        chosen = Rounding(rounding)
    except ValueError:
        raise ValueError(f"no rounding {rounding}; there is {listed(Rounding)}") from None
    if kind.number == "REAL" and chosen is not Rounding.TRUNCATE:
        raise ValueError(f"{kind.name} works in REAL: there is nothing to round")
    return chosen

"""Frozen dataclasses ↔ JSON and arrays: any noun of ours as data, without a class of its own for it.

What is equal is written once, and every number comes back bit for bit. A noun is
named by its module and class, and only what the program itself has loaded is
made again: a file cannot name anything else. What is compiled is left out: a
Block is made anew of its function block, and a plant comes back without its
functions, so that it can be shown but not run.
"""

import math
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields, is_dataclass
from datetime import datetime
from enum import Enum
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from fcl_sim.block import Block
from fcl_sim.engine.assemble import assemble
from fcl_sim.plant.functions import PARTS, PlantFunctions, as_entry

Json = dict[str, Any]
Array = NDArray[Any]
Pools = Mapping[str, Array]
"""All numbers of arrays in a row (n,), by the name of their type; equal columns stand there once."""

OURS = "fcl_sim."
"""What the modules of nouns begin with."""


class Unreadable(Exception):
    """What is not, or not of this version, what `encoded` gives."""


def encoded(noun: Any) -> tuple[Json, Pools]:
    """Return a noun as a JSON document, and the numbers of its arrays.

    `classes` has the fields of each class, `nouns` the values of these, those of
    a noun behind those it is made of; `top` is the noun itself.
    """
    writer = _Writer()
    top = writer.value(noun)
    return {"classes": writer.classes, "nouns": writer.nouns, "top": top}, writer.columns.pools()


def decoded(document: Json, pools: Pools) -> Any:
    """Return the noun of a document; Unreadable where it names what there is not, or has other fields."""
    try:
        reader = _Reader(pools, {name: _maker(name, names) for name, names in document["classes"].items()})
        for name, values in document["nouns"]:
            reader.nouns.append(reader.noun(name, values))
        return reader.value(document["top"])
    except (KeyError, IndexError, TypeError, ValueError, AttributeError) as error:
        raise Unreadable(f"{type(error).__name__}: {error}") from error


class _Columns:
    """Columns of arrays, each different one once."""

    def __init__(self) -> None:
        self._bytes: dict[str, list[bytes]] = {}
        self._offsets: dict[tuple[str, bytes], int] = {}
        self._sizes: dict[str, int] = {}

    def add(self, array: Array) -> Json:
        """Take an array (n, ...); return type, shape and where each of its columns begins."""
        kind = array.dtype.name
        columns = np.ascontiguousarray(array.reshape(array.shape[0], -1).T) if array.size else ()
        starts = [self._start(kind, column) for column in columns]
        return {"array": [kind, [*array.shape], starts]}

    def _start(self, kind: str, column: Array) -> int:
        content = column.tobytes()
        start = self._offsets.get((kind, content))
        if start is None:
            start = self._offsets[kind, content] = self._sizes.get(kind, 0)
            self._sizes[kind] = start + len(column)
            self._bytes.setdefault(kind, []).append(content)
        return start

    def pools(self) -> Pools:
        """Return everything that was taken."""
        return {kind: np.frombuffer(b"".join(each), dtype=kind) for kind, each in self._bytes.items()}


class _Writer:
    def __init__(self) -> None:
        self.classes: dict[str, list[str]] = {}
        self.nouns: list[tuple[str, list[Any]]] = []
        self.columns = _Columns()
        self._known: dict[int, Json] = {}
        self._numbers: dict[tuple[str, str], int] = {}
        self._kept: list[Any] = []
        """What is known by its identity must live as long as that is looked up."""

    def value(self, value: Any) -> Any:
        """Return any value as JSON has it; TypeError for one that is no data."""
        if value is None or type(value) in {str, int, bool}:
            return value
        if type(value) is tuple:
            return [self.value(each) for each in value]
        if isinstance(value, np.ndarray) or is_dataclass(value):
            return self._shared(value)
        if isinstance(value, Mapping):
            return {"map": [[self.value(key), self.value(each)] for key, each in value.items()]}
        return self._plain(value)

    def _plain(self, value: Any) -> Any:
        if isinstance(value, Enum):
            return {"enum": [_name(type(value)), value.name]}
        if isinstance(value, float | np.floating):
            number = float(value)
            return number if math.isfinite(number) else {"float": [repr(number)]}
        for kind, (name, plain, _) in PLAIN.items():
            if isinstance(value, kind):
                return {name: [self.value(each) for each in plain(value)]}
        raise TypeError(f"{type(value).__name__} is no data")

    def _shared(self, value: Any) -> Json:
        known = self._known.get(id(value))
        if known is None:
            known = self.columns.add(value) if isinstance(value, np.ndarray) else self._noun(value)
            self._known[id(value)] = known
            self._kept.append(value)
        return known

    def _noun(self, noun: Any) -> Json:
        name = _name(type(noun))
        parts = PARTS_OF.get(name, _values_by_field)(noun)
        self.classes[name] = [*parts]
        values = [self.value(each) for each in parts.values()]
        number = self._numbers.setdefault((name, repr(values)), len(self.nouns))
        if number == len(self.nouns):
            self.nouns.append((name, values))
        return {"noun": number}


class _Reader:
    def __init__(self, pools: Pools, classes: Mapping[str, Callable[..., Any]]) -> None:
        self.nouns: list[Any] = []
        self._pools = pools
        self._classes = classes

    def noun(self, name: str, values: Sequence[Any]) -> Any:
        """Return a noun of a class made of values of its fields, in their order."""
        return self._classes[name](*[self.value(each) for each in values])

    def value(self, value: Any) -> Any:
        """Return what `_Writer.value` was given."""
        if isinstance(value, list):
            return tuple([self.value(each) for each in value])
        if not isinstance(value, dict):
            return value
        ((kind, body),) = value.items()
        if kind == "map":
            return {self.value(key): self.value(each) for key, each in body}
        if kind == "noun":
            return self.nouns[body]
        if kind == "array":
            return self._array(*body)
        return MADE[kind](*[self.value(each) for each in body])

    def _array(self, kind: str, shape: Sequence[int], starts: Sequence[int]) -> Array:
        """Return an array; equal ones of one column share their numbers, which nobody writes to."""
        if not starts:
            return np.zeros(shape, dtype=kind)
        columns = [self._pools[kind][start : start + shape[0]] for start in starts]
        return columns[0].reshape(shape) if len(columns) == 1 else np.column_stack(columns).reshape(shape)


PLAIN: Mapping[type, tuple[str, Callable[[Any], Sequence[Any]], Callable[..., Any]]] = {
    list: ("list", lambda value: value, lambda *values: [*values]),
    frozenset: ("set", sorted, lambda *values: frozenset(values)),
    Path: ("path", lambda value: [str(value)], Path),
    datetime: ("date", lambda value: [value.isoformat()], datetime.fromisoformat),
    Fraction: ("fraction", lambda value: [value.numerator, value.denominator], Fraction),
    np.bool_: ("bool", lambda value: [bool(value)], bool),
    np.integer: ("int", lambda value: [int(value)], int),
}
"""Kinds of values that are neither JSON's nor nouns: name, parts, what makes one of its parts."""


def _member(name: str, member: str) -> Any:
    return _loaded(name)[member]


MADE: Mapping[str, Callable[..., Any]] = {
    **{name: make for name, _, make in PLAIN.values()},
    "enum": _member,
    "float": float,
}


def _block(function_block: Any, diagnostics: Any) -> Block:
    return Block(function_block, assemble(function_block), diagnostics)


def _without_functions(path: Path) -> PlantFunctions:
    return PlantFunctions(**{part: as_entry(part, _not_here, "") for part in PARTS}, path=path)


def _not_here(*_: Any) -> NoReturn:
    raise NotImplementedError("a plant that was stored has no functions")


def _name(kind: type) -> str:
    return f"{kind.__module__}.{kind.__qualname__}"


PARTS_OF: Mapping[str, Callable[[Any], Mapping[str, Any]]] = {
    _name(Block): lambda block: {
        "function_block": block.function_block,
        "diagnostics": block.diagnostics,
    },
    _name(PlantFunctions): lambda functions: {"path": functions.path},
}
"""What is kept of nouns that hold something compiled."""

MAKERS: Mapping[str, Callable[..., Any]] = {
    _name(Block): _block,
    _name(PlantFunctions): _without_functions,
}


def _values_by_field(noun: Any) -> Mapping[str, Any]:
    kind: Any = type(noun)
    return {name: getattr(noun, name) for name in _field_names(kind)}


@cache
def _field_names(kind: Any) -> tuple[str, ...]:
    return tuple(each.name for each in fields(kind) if each.init)


def _maker(name: str, names: Sequence[str]) -> Callable[..., Any]:
    """Return what makes a noun of a class of the values of its fields, in their order."""
    if name in MAKERS:
        return MAKERS[name]
    kind: Any = _loaded(name)
    if issubclass(kind, Enum) or _field_names(kind) != (*names,):
        raise Unreadable(f"{name} has other fields")
    return lambda *values: kind(**dict(zip(names, values, strict=True)))


@cache
def _loaded(name: str) -> Any:
    """Return a class of data of ours that is loaded; Unreadable where there is none of that name."""
    module, _, own = name.rpartition(".")
    found = getattr(sys.modules.get(module), own, None) if name.startswith(OURS) else None
    if not isinstance(found, type) or not (is_dataclass(found) or issubclass(found, Enum)):
        raise Unreadable(f"there is no {name}")
    return found

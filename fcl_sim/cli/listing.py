"""A noun as indented text: every field by its name, as far as its `repr` would show it."""

from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fcl_sim.diagnostics import Span
from fcl_sim.scenario.tree import Entry

STEP = "  "
WIDTH = 100
NUMBERS_A_LINE = 8

Parts = list[tuple[str, Any]]


def listing(value: Any, name: str = "") -> Iterator[str]:
    """Yield the lines that show a dataclass, mapping, sequence, array or scalar, headed by `name`."""
    head = f"{name}: " if name else ""
    if isinstance(value, Entry):
        value = value.plain()
    if isinstance(value, np.ndarray):
        yield f"{head}{value.size} of {value.dtype}"
        yield from _array(value)
        return
    parts = _parts(value)
    line = _line(value, parts)
    if line is not None:
        first, *more = line.splitlines()
        yield head + first
        yield from (f"{STEP}{each}".rstrip() for each in more)
        return
    title = type(value).__name__ if is_dataclass(value) else ""
    yield f"{head}{title}".rstrip()
    for part_name, part in parts or ():
        for each in listing(part, part_name):
            yield STEP + each


def _parts(value: Any) -> Parts | None:
    """Return the named parts of a value, or None where it has none."""
    if is_dataclass(value):
        shown = [field.name for field in fields(value) if field.repr]
        return [(name, part) for name in shown if not isinstance(part := getattr(value, name), Span)]
    if isinstance(value, Mapping):
        return [(" ".join(key) if isinstance(key, tuple) else str(key), part) for key, part in value.items()]
    if isinstance(value, list | tuple | frozenset):
        return [(f"{number}", part) for number, part in enumerate(value, start=1)]
    return None


def _line(value: Any, parts: Parts | None) -> str | None:
    """Return a value on one line, or None where it needs several."""
    if parts is None:
        return _scalar(value)
    if not parts:
        return "none"
    plain = not is_dataclass(value) and not isinstance(value, Mapping)
    if not plain or any(
        _parts(part) is not None or isinstance(part, np.ndarray | Entry) for _, part in parts
    ):
        return None
    line = ", ".join(_scalar(part) for _, part in parts)
    return line if len(line) <= WIDTH else None


def _scalar(value: Any) -> str:
    if value is None:
        return "none"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return str(value) or '""'


def _array(values: NDArray[Any]) -> Iterator[str]:
    flat = values.ravel().tolist()
    for start in range(0, len(flat), NUMBERS_A_LINE):
        numbers = " ".join(f"{each:>10.6g}" for each in flat[start : start + NUMBERS_A_LINE])
        yield f"{STEP}{start:>5} |{numbers}"

"""TOML as a tree whose every entry knows where it stands; trees are laid over one another.

A key with dots in quotes, `"plant.parameters.load_mass" = "10 t"`, means the
same as one without quotes: that is how variants and overrides name what they
change, and how a wire names the member of a structure.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

from fcl_sim.diagnostics import Diagnostic, Place, Span
from fcl_sim.toml.positions import KeyPath, Position

NOTHING: Mapping[str, "Entry"] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class Entry:
    """A value with its place: `key` where its key stands, `span` where the value does.

    `value` is a mapping of entries, a tuple of entries, or a TOML scalar.
    """

    value: Any
    key: Span = field(compare=False, repr=False)
    span: Span = field(compare=False, repr=False)

    @property
    def is_table(self) -> bool:
        """Whether it is a table."""
        return isinstance(self.value, Mapping)

    @property
    def table(self) -> Mapping[str, "Entry"]:
        """Its entries; none where it is no table."""
        return self.value if isinstance(self.value, Mapping) else NOTHING

    @property
    def items(self) -> tuple["Entry", ...]:
        """Its elements; none where it is no array."""
        return self.value if isinstance(self.value, tuple) else ()

    def get(self, *path: str) -> "Entry | None":
        """Return the entry at a path of keys, or None."""
        entry: Entry | None = self
        for key in path:
            entry = entry.table.get(key) if entry else None
        return entry

    def plain(self) -> Any:
        """Return the value as tomllib gives it."""
        if isinstance(self.value, Mapping):
            return {key: each.plain() for key, each in self.value.items()}
        if isinstance(self.value, tuple):
            return [each.plain() for each in self.value]
        return self.value

    def leaves(self, prefix: str = "") -> Iterator[tuple[str, "Entry"]]:
        """Yield dotted key and entry of what is in it and in tables within."""
        for key, each in self.table.items():
            name = f"{prefix}.{key}" if prefix else key
            if each.is_table:
                yield from each.leaves(name)
            else:
                yield name, each

    def keeping(self, keys: Mapping[str, "Entry"]) -> "Entry":
        """Return a table at the same place with other entries."""
        return Entry(keys, self.key, self.span)

    def without(self, *keys: str) -> "Entry":
        """Return it with some of its keys left out."""
        return self.keeping({key: each for key, each in self.table.items() if key not in keys})


def finding(code: str, message: str, place: Entry | Span | None = None, hint: str = "") -> Diagnostic:
    """Return a finding at an entry's value, or at a span."""
    span = place.span if isinstance(place, Entry) else place
    return Diagnostic(code=code, message=message, places=(Place(span=span),) if span else (), hint=hint)


Twice = tuple[Span, Span]
"""The keys of something that is given twice: the second and the first."""


def grow(data: Mapping[str, Any], places: Mapping[KeyPath, Position], top: Span) -> tuple[Entry, list[Twice]]:
    """Return what tomllib read as a tree, and what was given twice once dotted keys are taken apart."""
    twice: list[Twice] = []
    root = Position(top, top)
    entry = _entry(data, (), {**places, (): root}, twice)
    return entry, twice


def _entry(value: Any, path: KeyPath, places: Mapping[KeyPath, Position], twice: list[Twice]) -> Entry:
    position = places[path]
    if isinstance(value, list):
        items = tuple(_entry(each, (*path, index), places, twice) for index, each in enumerate(value))
        return Entry(items, position.key, position.value)
    if not isinstance(value, dict):
        return Entry(value, position.key, position.value)
    table: dict[str, Entry] = {}
    for key, each in value.items():
        child = _entry(each, (*path, key), places, twice)
        first, *rest = key.split(".") if all(key.split(".")) else [key]
        for name in reversed(rest):
            child = Entry({name: child}, child.key, child.span)
        table[first] = _united(table[first], child, twice) if first in table else child
    return Entry(table, position.key, position.value)


def _united(one: Entry, other: Entry, twice: list[Twice]) -> Entry:
    if not (one.is_table and other.is_table):
        twice.append((other.key, one.key))
        return one
    table = dict(one.table)
    for key, each in other.table.items():
        table[key] = _united(table[key], each, twice) if key in table else each
    return one.keeping(table)


def overlaid(base: Entry, over: Entry) -> Entry:
    """Return `base` with `over` laid on it.

    Tables are merged, entry by entry, unless `over` gives another `type`: then
    it stands alone. Everything else is replaced.
    """
    if not (base.is_table and over.is_table) or _changes_type(base, over):
        return over
    table = dict(base.table)
    for key, each in over.table.items():
        table[key] = overlaid(table[key], each) if key in table else each
    return base.keeping(table)


def _changes_type(base: Entry, over: Entry) -> bool:
    before, after = base.get("type"), over.get("type")
    return before is not None and after is not None and before.value != after.value

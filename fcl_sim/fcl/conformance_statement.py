"""TOML → a manufacturer's statement in the form of Tables 8 to 11, or every fault of it (clause 6)."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from fcl_sim.diagnostics import Diagnostic, InputFault, Source, Span, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.fcl.conformance_elements import ELEMENTS, YES, Choice, Element, known
from fcl_sim.fcl.conformance_figures import FIGURES
from fcl_sim.model import DataType
from fcl_sim.toml import Entry, finding, parse

TEXTS = {
    "execution_time": "execution time",
    "memory": "memory requirements",
    "integer_degrees": "mapping of weighting factors and degrees onto integers",
}
"""Rows of Table 11 that are told and cannot be held against a file."""

DATA_TYPES, LINE_COMMENTS = "data_types", "line_comments"
SECTIONS = ("name", "source", "elements", "data", "differs", "remarks")


@dataclass(frozen=True, slots=True)
class Listed:
    """Which values of an element there are; `at` is where the statement says so."""

    values: frozenset[str]
    at: Span


@dataclass(frozen=True, slots=True)
class Limit:
    """The largest number of something."""

    number: int
    at: Span


@dataclass(frozen=True, slots=True)
class Otherwise:
    """What a target makes of an element that it has, where that is not what the standard says."""

    words: str
    at: Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Statement:
    """What a target says of itself. What it does not say is absent, and nothing is held against it.

    `elements` are by keys of `ELEMENTS`, `limits` by keys of `FIGURES`,
    `differs` by key and value, the latter empty for all values. `texts` are the
    further rows of Table 11, `remarks` what no row can say.
    """

    name: str
    source: str
    elements: Mapping[str, Listed]
    limits: Mapping[str, Limit]
    data_types: Listed | None
    line_comments: Listed | None
    differs: Mapping[tuple[str, str], Otherwise]
    texts: Mapping[str, str]
    remarks: tuple[str, ...]


def read_statement(source: Source) -> Statement:
    """Return the statement of a text; InputFault with everything that is wrong with it."""
    top = parse(source, not_toml="FCL521", twice="FCL522")
    reader = _Reader()
    statement = reader.statement(top)
    if reader.faults:
        raise InputFault(sorted(reader.faults, key=_offset))
    return statement


def _offset(fault: Diagnostic) -> int:
    span = fault.places[0].span
    return span.start if span else 0


class _Reader:
    """Collects faults while each part of a statement is read."""

    def __init__(self) -> None:
        self.faults: list[Diagnostic] = []

    def statement(self, top: Entry) -> Statement:
        self._known(top, SECTIONS, "a statement")
        name = top.get("name")
        if name is None:
            hint = 'begin with name = "…", as the findings are to call it'
            self.faults.append(finding("FCL525", "this statement has no `name`", top, hint))
        data = self._table(top, "data")
        self._known(data, (DATA_TYPES, LINE_COMMENTS, *TEXTS, *FIGURES), "`data` (Table 11)")
        elements = self._table(top, "elements")
        self._known(elements, ELEMENTS, "`elements` (Tables 8 to 10)")
        types = data.get(DATA_TYPES) if data else None
        comments = data.get(LINE_COMMENTS) if data else None
        return Statement(
            name=self._text(name),
            source=self._text(top.get("source")),
            elements={key: self._element(key, each) for key, each in _entries(elements, ELEMENTS)},
            limits={key: self._limit(each) for key, each in _entries(data, FIGURES)},
            data_types=None if types is None else self._listed(types, [str(each) for each in DataType]),
            line_comments=None if comments is None else self._switch(comments),
            differs=self._differs(self._table(top, "differs")),
            texts={key: self._text(each) for key, each in _entries(data, TEXTS)},
            remarks=tuple(self._text(each) for each in self._items(top.get("remarks"))),
        )

    # -- parts

    def _differs(self, table: Entry | None) -> dict[tuple[str, str], Otherwise]:
        """Read `METHOD.CoG = "…"`, or `RANGE = "…"` for an element that has no values."""
        self._known(table, ELEMENTS, "`differs`")
        found = {}
        for key, each in _entries(table, ELEMENTS):
            element = ELEMENTS[key]
            if not each.is_table:
                found[key, ""] = Otherwise(self._text(each), each.key)
                continue
            for value, words in each.table.items():
                meant = self._value(element, value, words.key)
                found[key, meant] = Otherwise(self._text(words), words.key)
        return found

    def _element(self, key: str, entry: Entry) -> Listed:
        element = ELEMENTS[key]
        if not isinstance(element, Choice):
            return self._switch(entry)
        found = self._listed(entry, list(element.rows))
        if key == "DEFAULT" and "value" in found.values:
            return Listed(found.values | {"0"}, found.at)
        return found

    def _value(self, element: Element, value: str, at: Span) -> str:
        if isinstance(element, Choice):
            return self._one_of(value, list(element.rows), at)
        self.faults.append(finding("FCL523", f"`{value}` is not a value of this key, which has none", at))
        return value

    # -- kinds of values

    def _listed(self, entry: Entry, known_values: list[str]) -> Listed:
        values = set()
        for each in self._items(entry):
            if isinstance(each.value, str):
                values.add(self._one_of(each.value, known_values, each.span))
            else:
                self._refuse(each, "a text in quotes")
        return Listed(frozenset(values), entry.key)

    def _one_of(self, value: str, values: list[str], at: Span) -> str:
        """Return a known value in its own spelling."""
        found = known(value, values)
        if found is not None:
            return found
        near = nearest(value, values)
        hint = f"did you mean `{near}`?" if near else f"known: {listed(values)}"
        self.faults.append(finding("FCL523", f"`{value}` is not a value of this key", at, hint))
        return value

    def _items(self, entry: Entry | None) -> tuple[Entry, ...]:
        if entry is None:
            return ()
        if not isinstance(entry.value, tuple):
            self._refuse(entry, 'a list, such as ["MIN"]; [] says that there is nothing of it')
        return entry.items

    def _switch(self, entry: Entry) -> Listed:
        if not isinstance(entry.value, bool):
            self._refuse(entry, "true or false")
        return Listed(frozenset([YES] if entry.value is True else []), entry.key)

    def _limit(self, entry: Entry) -> Limit:
        number = entry.value
        if not isinstance(number, int) or isinstance(number, bool) or number < 0:
            self._refuse(entry, "a whole number; where there is no limit, leave the key out")
            return Limit(0, entry.key)
        return Limit(number, entry.key)

    def _text(self, entry: Entry | None) -> str:
        if entry is None:
            return ""
        if isinstance(entry.value, str):
            return entry.value
        self._refuse(entry, "a text in quotes")
        return ""

    def _table(self, top: Entry, key: str) -> Entry | None:
        entry = top.get(key)
        if entry is not None and not entry.is_table:
            self._refuse(entry, f"a table, begun by [{key}]")
            return None
        return entry

    # -- faults

    def _refuse(self, entry: Entry, wanted: str) -> None:
        shown = entry.span.text if "\n" not in entry.span.text else "this"
        self.faults.append(finding("FCL524", f"{shown} is not what is wanted here", entry, f"write {wanted}"))

    def _known(self, table: Entry | None, keys: Iterable[str], where: str) -> None:
        names = list(keys)
        for key, each in (table.table if table else {}).items():
            if key not in names:
                near = nearest(key, names)
                hint = f"did you mean `{near}`?" if near else f"known: {listed(names)}"
                self.faults.append(finding("FCL523", f"`{key}` is not a key of {where}", each.key, hint))


def _entries(table: Entry | None, keys: Iterable[str]) -> list[tuple[str, Entry]]:
    found = table.table if table else {}
    return [(key, found[key]) for key in keys if key in found]

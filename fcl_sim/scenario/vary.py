"""[vary] → the axes of an envelope: lists of values, or `{ from, to, count }`, by dotted key."""

from collections.abc import Iterator, Sequence
from itertools import accumulate
from math import prod

from fcl_sim.diagnostics import Diagnostic, Span, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.scenario.fields import kind
from fcl_sim.scenario.model import Axis
from fcl_sim.toml.tree import Entry, finding, overlaid
from fcl_sim.units import Quantity, UnitError, exact, parse_quantity, short

VARY = "vary"
RANGE = ("from", "to", "count")
LIMIT = 100_000
"""Points of an envelope; beyond, it is no envelope of a scenario any more."""

FIXED = {
    "require": "what is required is the same at every point; `at_least` says at how many it must hold",
    "variants": "a variant has its own grid under [variants.NAME.vary]",
    VARY: "one grid is enough: name the keys themselves",
    "title": "it is the same at every point",
    "description": "it is the same at every point",
}
"""What a grid cannot set, and what serves instead."""

Faults = list[Diagnostic]


def varied(vary: Entry | None, over: Entry) -> Entry | None:
    """Return the [vary] of what is laid over something that has `vary`.

    Its own [vary] is merged; what it sets itself is set at every point, and
    where nothing is left that takes several values, there is no envelope. Where
    envelopes are switched off, `vary = false`, they stay off.
    """
    own = over.get(VARY)
    if vary is None or not vary.is_table:
        return own if vary is None else vary
    free = _without(vary, {key for key, _ in over.without(VARY).leaves()})
    if own is not None:
        return overlaid(free, own)
    return free if _spreads(free) or not _spreads(vary) else None


def _spreads(vary: Entry) -> bool:
    """Return whether anything takes several values: what is held at one alone makes no envelope."""
    return any(_is_range(each) or len(each.items) > 1 or _spreads(each) for each in vary.table.values())


def _without(vary: Entry, keys: set[str], prefix: str = "") -> Entry:
    table = {}
    for key, each in vary.table.items():
        path = f"{prefix}{key}"
        if path in keys:
            continue
        inner = _without(each, keys, f"{path}.") if each.is_table and not _is_range(each) else each
        if inner.table or not inner.is_table:
            table[key] = inner
    return vary.keeping(table)


def axes_of(vary: Entry | None, faults: Faults, before: Sequence[Axis] = ()) -> tuple[Axis, ...]:
    """Return the axes that a [vary] spans, none where it is `false`.

    They stand in the order of the text, those first that are as well in the
    [vary] `before`, in its order.
    """
    if vary is None or vary.value is False:
        return ()
    if not vary.is_table:
        message = f"`{VARY}` is a table, or false, not {kind(vary.plain())}"
        faults.append(
            finding("SCN203", message, vary, 'as in [vary] "plant.start.position" = ["-10 m", "-20 m"]')
        )
        return ()
    already = len(faults)
    axes = [axis for key, entry in _leaves(vary, faults) if (axis := _axis(key, entry, faults)) is not None]
    if len(faults) == already:
        faults += _too_many(axes)
    known = [each.key for each in before]

    def order(axis: Axis) -> tuple[int, int]:
        return (known.index(axis.key), 0) if axis.key in known else (len(known), axis.span.start)

    return tuple(sorted(axes, key=order))


def labels(axes: Sequence[Axis]) -> tuple[str, ...]:
    """Return what the axes are called in tables: the ends of their keys, as long as tell them apart."""
    return tuple(_label(each.key, [other.key for other in axes if other is not each]) for each in axes)


def _label(key: str, others: Sequence[str]) -> str:
    tails = list(accumulate(reversed(key.split(".")), lambda tail, part: f"{part}.{tail}"))
    return next(
        (tail for tail in tails if not any(f".{other}".endswith(f".{tail}") for other in others)), key
    )


def _is_range(entry: Entry) -> bool:
    """Return whether a table is a range: a block, too, may have a parameter called `from`."""
    return any(name in entry.table and not _inner(entry.table[name]) for name in RANGE)


def _inner(entry: Entry) -> bool:
    return entry.is_table or isinstance(entry.value, tuple)


def _leaves(vary: Entry, faults: Faults, prefix: str = "") -> Iterator[tuple[str, Entry]]:
    for key, each in vary.table.items():
        path = f"{prefix}{key}"
        if not prefix and key in FIXED:
            faults.append(finding("SCN502", f"[vary] cannot change `{key}`", each.key, FIXED[key]))
        elif each.is_table and each.table and not _is_range(each):
            yield from _leaves(each, faults, f"{path}.")
        else:
            yield path, each


def _axis(key: str, entry: Entry, faults: Faults) -> Axis | None:
    if entry.is_table and entry.table:
        values = _range(key, entry, faults)
    else:
        values = tuple(Entry(each.value, entry.key, each.span) for each in entry.items)
        faults += () if values else [_no_list(key, entry)]
    return Axis(key=key, values=values, span=entry.key) if values else None


def _no_list(key: str, entry: Entry) -> Diagnostic:
    if isinstance(entry.value, tuple) or entry.is_table:
        return finding("SCN501", f"[vary] gives `{key}` no values", entry, "list them, or leave the key out")
    given = entry.span.text
    message = f"[vary] gives `{key}` {kind(entry.value)} instead of a list"
    hint = f"write [{given}] for this one value at every point, or {{ from = ..., to = ..., count = ... }}"
    return finding("SCN501", message, entry, hint)


def _range(key: str, entry: Entry, faults: Faults) -> tuple[Entry, ...]:
    """Return the values of a range, both ends included; nothing where a fault was found."""
    found = [*_strange(key, entry), *_uncounted(key, entry)]
    ends = [_end(key, entry.get(name), found) for name in ("from", "to")]
    faults += found
    first, last = ends
    if found or first is None or last is None:
        return ()
    if not first.unit.commensurate(last.unit):
        message = f"`from` of `{key}` is in {first.unit}, and `to` is in {last.unit}"
        faults.append(finding("SCN404", message, entry.table["to"], f"give both in {first.unit}"))
        return ()
    count, unit = int(entry.table["count"].value), first.unit.symbol
    start, end = exact(first.value), exact(last.to(first.unit))
    steps = [start + (end - start) * step / (count - 1) for step in range(count)]
    whole = not unit and all(each.denominator == 1 for each in steps)
    values = [int(each) if whole else float(each) for each in steps]
    written = [f"{short(each)} {unit}" if unit else each for each in values]
    return tuple(Entry(each, entry.key, entry.span) for each in written)


def _strange(key: str, entry: Entry) -> Iterator[Diagnostic]:
    meant = set()
    for name, each in entry.table.items():
        if name not in RANGE:
            near = nearest(name, [each for each in RANGE if each not in entry.table])
            meant.add(near)
            hint = f"did you mean `{near}`?" if near else f"a range has {listed(RANGE)}"
            yield finding("SCN501", f"the range of `{key}` has no `{name}`", each.key, hint)
    for name in RANGE:
        if name not in entry.table and name not in meant:
            hint = 'write it as in { from = "-40 m", to = "-10 m", count = 7 }'
            yield finding("SCN501", f"the range of `{key}` lacks `{name}`", entry, hint)


def _uncounted(key: str, entry: Entry) -> Iterator[Diagnostic]:
    count = entry.get("count")
    if count is None:
        return
    if isinstance(count.value, bool) or not isinstance(count.value, int):
        message = f"`count` of `{key}` is a whole number, not {kind(count.plain())}"
        yield finding("SCN501", message, count, "as in count = 7")
    elif count.value < 2:
        hint = "it counts both ends; for one value write a list"
        yield finding("SCN501", f"`count` of `{key}` must be 2 or more, not {count.value}", count, hint)
    elif count.value > LIMIT:
        yield _grid_of(count.value, count)


def _end(key: str, entry: Entry | None, faults: Faults) -> Quantity | None:
    if entry is None:
        return None
    if isinstance(entry.value, bool) or not isinstance(entry.value, str | int | float):
        message = f"a range of `{key}` runs between quantities, not {kind(entry.plain())}"
        faults.append(finding("SCN501", message, entry, 'write it as in "20 t"; other values are listed'))
        return None
    try:
        return parse_quantity(entry.value)
    except UnitError as error:
        faults.append(finding("SCN204", f"`{key}`: {error}", entry, error.hint))
    return None


def _too_many(axes: Sequence[Axis]) -> Iterator[Diagnostic]:
    points = prod(len(each.values) for each in axes)
    if points > LIMIT:
        product = " x ".join(str(len(each.values)) for each in axes)
        yield _grid_of(points, axes[0].span, f", {product}," if len(axes) > 1 else ",")


def _grid_of(points: int, place: Entry | Span, product: str = ",") -> Diagnostic:
    message = f"the grid of [vary] has {points} points{product} and {LIMIT} are the most"
    return finding("SCN503", message, place, "give fewer values, or fewer keys")

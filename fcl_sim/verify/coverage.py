"""How far runs have exercised a rule base: the noun, and how that of several runs is put together."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import reduce
from itertools import product
from math import prod

from fcl_sim.diagnostics import Diagnostic
from fcl_sim.verify.waivers import Waiver, unknown_rules, unused

Combination = tuple[int, ...]
"""A term of each input of the grid, by its place."""


class Item(StrEnum):
    """What can be asked of a rule, each by itself: a rule may decide without being dominant."""

    FIRED = "fired"
    """Its degree of firing was above 0."""
    DOMINANT = "dominant"
    """Of all conclusions on one variable, none had a larger degree, its weight included."""
    DECISIVE = "decisive"
    """Without it an output would have been another by more than a part of its range."""


@dataclass(frozen=True, slots=True)
class Scan:
    """One scan of one run: what the run is called, and its time in nanoseconds."""

    run: str
    tick: int


@dataclass(frozen=True, slots=True)
class Seen:
    """In how many scans something was so, and in which of them first; None where in none."""

    scans: int = 0
    first: Scan | None = None

    def __add__(self, other: "Seen") -> "Seen":
        """Return what is seen in these scans and then in the others."""
        return Seen(self.scans + other.scans, self.first or other.first)


@dataclass(frozen=True, slots=True, kw_only=True)
class RuleCoverage:
    """What was seen of a rule, by its label as of `model.labels`; `text` is its condition and conclusion.

    `change` is by how much an output would at most have been another without
    it, as part of that output's range.
    """

    label: str
    text: str
    fired: Seen
    dominant: Seen
    decisive: Seen
    change: float = 0.0

    def seen(self, item: Item) -> Seen:
        """Return what was seen of one item."""
        found: Seen = getattr(self, item)
        return found


@dataclass(frozen=True, slots=True)
class Cell:
    """What lies between two neighbouring breakpoints of an input's terms, the upper one excluded."""

    low: float
    high: float
    scans: int


@dataclass(frozen=True, slots=True, kw_only=True)
class InputCoverage:
    """The cells that the constant breakpoints of an input's terms part it into, from below to above."""

    variable: str
    cells: tuple[Cell, ...]

    @property
    def visited(self) -> int:
        """How many cells a scan was in."""
        return sum(each.scans > 0 for each in self.cells)


@dataclass(frozen=True, slots=True, kw_only=True)
class GridCoverage:
    """The combinations of the terms of all inputs that conditions ask with IS.

    One counts as visited where at a scan all its terms had degrees above 0.
    """

    inputs: tuple[str, ...]
    terms: tuple[tuple[str, ...], ...]
    visited: frozenset[Combination]

    @property
    def size(self) -> int:
        """Number of combinations; 0 where no condition asks for a term of an input."""
        return prod(map(len, self.terms)) if self.terms else 0

    def missing(self) -> Iterator[tuple[str, ...]]:
        """Yield the combinations that were not visited, each as its terms; as many as the grid is large."""
        for each in product(*(range(len(names)) for names in self.terms)):
            if each not in self.visited:
                yield tuple(names[place] for names, place in zip(self.terms, each, strict=True))


@dataclass(frozen=True, slots=True, kw_only=True)
class OutputCoverage:
    """In which scans no rule was active for an output."""

    variable: str
    undefined: Seen


@dataclass(frozen=True, slots=True, kw_only=True)
class Coverage:
    """How far `runs` have exercised a rule base in `scans` scans.

    `name` is that of the function block, `file` the one it was read from;
    `least` is the part of an output's range by which a decisive rule changes it;
    `waivers` are those of items of its rules.
    """

    name: str
    file: str = ""
    runs: tuple[str, ...]
    scans: int
    least: float
    rules: tuple[RuleCoverage, ...]
    inputs: tuple[InputCoverage, ...]
    grid: GridCoverage
    outputs: tuple[OutputCoverage, ...]
    waivers: tuple[Waiver, ...] = ()

    def waiver(self, rule: RuleCoverage, item: Item) -> Waiver | None:
        """Return what waives an item of a rule, or of one that never fires that it need not fire."""
        items = {str(item)} if rule.fired.scans else {str(item), str(Item.FIRED)}
        label = rule.label.casefold()
        found = (each for each in self.waivers if each.rule.casefold() == label and each.what in items)
        return next(found, None)

    def unmet(self, item: Item) -> tuple[RuleCoverage, ...]:
        """Return the rules of which an item was never seen, and is not waived."""
        return tuple(each for each in self.lacking(item) if self.waiver(each, item) is None)

    def having(self, item: Item) -> tuple[RuleCoverage, ...]:
        """Return the rules of which an item was seen."""
        return tuple(each for each in self.rules if each.seen(item).scans)

    def lacking(self, item: Item) -> tuple[RuleCoverage, ...]:
        """Return the rules of which an item was never seen."""
        return tuple(each for each in self.rules if not each.seen(item).scans)


def waived(coverage: Coverage, waivers: Sequence[Waiver]) -> Coverage:
    """Return the coverage with the waivers of its rule base that are about items of its rules."""
    return replace(coverage, waivers=tuple(each for each in waivers if each.what in set(Item)))


def waiver_findings(coverages: Sequence[Coverage]) -> tuple[Diagnostic, ...]:
    """Return what is wrong with the waivers of one rule base: rules it does not have, waivers without use.

    `coverages` are those of the function blocks that stand in its file.
    """
    waivers = tuple(dict.fromkeys(each for coverage in coverages for each in coverage.waivers))
    rules = [rule for coverage in coverages for rule in coverage.rules]
    faults = list(unknown_rules(waivers, [rule.label for rule in rules]))
    for each in waivers:
        own = [rule for rule in rules if rule.label.casefold() == each.rule.casefold()]
        if own and all(rule.seen(Item(each.what)).scans for rule in own):
            first = own[0].seen(Item(each.what)).first
            at = f" at {first.tick / 1e9:.9g} s in {first.run}" if first else ""
            faults.append(unused(each, f"rule {each.rule} is {each.what}{at}"))
    return tuple(faults)


def merged(parts: Sequence[Coverage]) -> Coverage:
    """Return the coverage of one rule base by all runs of `parts`, at least one, in their order."""
    return reduce(_both, parts)


def _both(one: Coverage, other: Coverage) -> Coverage:
    pairs = zip(one.inputs, other.inputs, strict=True)
    return replace(
        one,
        runs=(*one.runs, *other.runs),
        scans=one.scans + other.scans,
        rules=tuple(_rule(*each) for each in zip(one.rules, other.rules, strict=True)),
        inputs=tuple(replace(first, cells=_cells(first.cells, then.cells)) for first, then in pairs),
        grid=replace(one.grid, visited=one.grid.visited | other.grid.visited),
        outputs=tuple(
            replace(first, undefined=first.undefined + then.undefined)
            for first, then in zip(one.outputs, other.outputs, strict=True)
        ),
    )


def _rule(one: RuleCoverage, other: RuleCoverage) -> RuleCoverage:
    return replace(
        one,
        fired=one.fired + other.fired,
        dominant=one.dominant + other.dominant,
        decisive=one.decisive + other.decisive,
        change=max(one.change, other.change),
    )


def _cells(one: Sequence[Cell], other: Sequence[Cell]) -> tuple[Cell, ...]:
    pairs = zip(one, other, strict=True)
    return tuple(replace(first, scans=first.scans + then.scans) for first, then in pairs)

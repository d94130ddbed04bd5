"""Coverage in words: shares, first scans, what was left out."""

import math
from collections.abc import Iterator, Sequence
from itertools import islice

from fcl_sim.report.words import counted, joined, number, with_unit
from fcl_sim.verify.coverage import Cell, Coverage, Item, RuleCoverage, Seen

MOST_LISTED = 6
"""Combinations of terms that are listed; of more, their number is told."""


def share(seen: Seen, scans: int) -> str:
    """Return in how many of the scans something was so, in per cent; a dash where in none."""
    if not seen.scans:
        return "\N{EN DASH}"
    part = 100.0 * seen.scans / scans
    if part < 1.0:
        return "< 1 %"
    return "> 99 %" if part >= 99.5 and seen.scans < scans else f"{part:.0f} %"


def first(seen: Seen) -> str:
    """Return where something was first; nothing where it never was."""
    if seen.first is None:
        return ""
    return f"{with_unit(seen.first.tick / 1e9, 's', 9)} in {seen.first.run}"


def remark(coverage: Coverage, rule: RuleCoverage) -> str:
    """Return why a rule may lack what it lacks; nothing where nothing is waived."""
    waivers = [coverage.waiver(rule, item) for item in Item if not rule.seen(item).scans]
    own = dict.fromkeys(each for each in waivers if each is not None)
    return "; ".join(f"need not be {each.what}: {each.reason} ({each.date.isoformat()})" for each in own)


def sentence(coverages: Sequence[Coverage]) -> str:
    """Return how many rules of all rule bases fired, dominated, decided, and how many need not."""
    rules = [(coverage, rule) for coverage in coverages for rule in coverage.rules]
    if not rules:
        return ""
    counts = {item: sum(bool(rule.seen(item).scans) for _, rule in rules) for item in Item}
    bases = f" in {counted(len(coverages), 'rule base')}" if len(coverages) > 1 else ""
    subject = f"Of {counted(len(rules), 'rule')}{bases} {counts[Item.FIRED]} fired"
    waivers = sum(bool(remark(*each)) for each in rules)
    more = f"; {waivers} need not, as waived" if waivers else ""
    return f"{subject}, {counts[Item.DOMINANT]} dominated, {counts[Item.DECISIVE]} decided{more}."


def notes(coverage: Coverage) -> Iterator[str]:
    """Yield what there is to say besides the rules: cells, combinations of terms, undefined outputs."""
    for each in coverage.inputs:
        missed = _stretches([cell for cell in each.cells if not cell.scans])
        told = f"; never {joined(missed)}" if missed else ""
        yield f"{each.variable}: {each.visited} of {counted(len(each.cells), 'cell')} visited{told}."
    grid = coverage.grid
    if len(grid.inputs) > 1:
        yield f"{len(grid.visited)} of {grid.size} combinations of terms visited{_missing(coverage)}."
    for output in coverage.outputs:
        seen = output.undefined
        if seen.scans:
            yield (
                f"{output.variable}: no rule was active in {share(seen, coverage.scans)} of the scans, "
                f"first at {first(seen)}."
            )
        else:
            yield f"{output.variable}: a rule was active in every scan."


def explained(coverage: Coverage) -> str:
    """Return what the words over the columns mean."""
    return (
        "Fired: its degree was above 0. "
        "Dominant: no other conclusion on the same variable had a larger degree. "
        f"Decisive: without it an output would differ by more than {number(100 * coverage.least)} % of its "
        "range."
    )


def _missing(coverage: Coverage) -> str:
    grid = coverage.grid
    left = grid.size - len(grid.visited)
    if not left:
        return ""
    if left > MOST_LISTED:
        return f"; {left} were not"
    told = [" and ".join(each) for each in islice(grid.missing(), MOST_LISTED)]
    return f"; never {'; '.join(told)}"


def _stretches(cells: Sequence[Cell]) -> list[str]:
    """Return cells as intervals, neighbours as one."""
    found: list[tuple[float, float]] = []
    for each in cells:
        if found and found[-1][1] == each.low:
            found[-1] = (found[-1][0], each.high)
        else:
            found.append((each.low, each.high))
    return [_stretch(*each) for each in found]


def _stretch(low: float, high: float) -> str:
    if math.isinf(low):
        return "anywhere" if math.isinf(high) else f"below {number(high)}"
    return f"from {number(low)} up" if math.isinf(high) else f"from {number(low)} to {number(high)}"

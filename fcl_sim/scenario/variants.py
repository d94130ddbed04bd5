"""A scenario with variants → one tree for each run, what differs laid over the base."""

from collections.abc import Iterator, Mapping

from fcl_sim.diagnostics import Diagnostic, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.scenario.model import BASE
from fcl_sim.scenario.vary import VARY, varied
from fcl_sim.toml.tree import Entry, finding, overlaid

SHARED: Mapping[str, str] = {
    "require": 'a requirement names the runs it is asked of, runs = ["NAME"], and those that miss it, '
    'expect = { NAME = "fail" }',
    "variants": "variants stand side by side, under [variants]",
}
"""What a variant cannot change, and why."""


def variant_trees(tree: Entry) -> tuple[dict[str, Entry], list[Diagnostic]]:
    """Return the tree of every run by variant, the base run's first, and what is wrong with the variants.

    The [vary] in it is that of the run.
    """
    faults: list[Diagnostic] = []
    base = tree.without("variants")
    trees = {BASE: tree}
    variants = tree.get("variants")
    for name, over in (variants.table if variants else {}).items():
        if name == BASE:
            hint = "give it another name, or change the scenario itself"
            faults.append(finding("SCN301", f"`{BASE}` is the run without a variant", over.key, hint))
        elif over.is_table:
            faults += _shared(name, over)
            fitting, unknown = without_unknown_blocks(base.get("blocks"), over, "the scenario")
            faults += unknown
            whole = overlaid(base.without(VARY), fitting.without(*SHARED, VARY))
            vary = varied(base.get(VARY), over)
            trees[name] = whole if vary is None else whole.keeping({**whole.table, VARY: vary})
    return trees, faults


def _shared(name: str, over: Entry) -> Iterator[Diagnostic]:
    for key, why in SHARED.items():
        entry = over.get(key)
        if entry is not None:
            yield finding("SCN301", f"the variant `{name}` cannot change `{key}`", entry.key, why)


def without_unknown_blocks(known: Entry | None, over: Entry, owner: str) -> tuple[Entry, list[Diagnostic]]:
    """Return what is laid over blocks without blocks that do not exist, and findings about those.

    A block that is not there and has no `type` is a misspelled one; with a
    `type` it is a new one.
    """
    faults: list[Diagnostic] = []
    blocks = over.get("blocks")
    if blocks is None or not blocks.is_table:
        return over, faults
    names = known.table if known else {}
    lost = [name for name, each in blocks.table.items() if name not in names and each.get("type") is None]
    for name in lost:
        near = nearest(name, names)
        hint = f"did you mean `{near}`?" if near else f"there are {listed(names) or 'none'}"
        place = blocks.table[name].key
        faults.append(finding("SCN301", f"{owner} has no block `{name}` to change", place, hint))
    return over.keeping({**over.table, "blocks": blocks.without(*lost)}), faults

"""Of which runs a requirement is asked, and which of them are meant to miss it."""

from collections.abc import Container, Iterator, Sequence
from collections.abc import Set as AbstractSet

from fcl_sim.diagnostics import Diagnostic, Span, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.judge.verdict import Over
from fcl_sim.scenario.model import RequirementText
from fcl_sim.toml.tree import Entry, finding

RUNS = "runs"
"""The runs that a requirement is asked of."""
BY_RUN = ("expect", "at_least")
"""What may be said by run."""
NOMINAL_RUN = (Over.BOTH, Over.NOMINAL)
"""What requirements on a run itself are over; the others are on the points of its envelope."""


def asked_of(
    texts: Sequence[RequirementText], variant: str, asked_over: Container[Over] = NOMINAL_RUN
) -> list[RequirementText]:
    """Return what is asked of the run of a variant: one that is relative to that run itself is not."""
    asked = [each for each in texts if variant in each.runs]
    others = [each for each in asked if each.relative_to is None or each.relative_to.variant != variant]
    return [each for each in others if each.over in asked_over]


def asked_runs(runs: Entry | None, variants: Sequence[str]) -> frozenset[str]:
    """Return the runs that a requirement is asked of: all unless it names some."""
    named = frozenset(each.value for each in runs.items if isinstance(each.value, str)) if runs else None
    return frozenset(variants) if named is None else named & frozenset(variants)


def expected(expect: Entry | None, variants: Sequence[str]) -> frozenset[str]:
    """Return the runs that are meant to miss a requirement, whether or not it is asked of them."""
    if expect is None:
        return frozenset()
    return frozenset(expect.table if expect.is_table else variants)


def run_faults(entry: Entry, variants: Sequence[str], asked: AbstractSet[str]) -> Iterator[Diagnostic]:
    """Yield what is wrong with the runs that a requirement names.

    They are named and do not exist, or are named though nothing is asked of
    them; or none is left of those that are `asked`, as no run is held against itself.
    """
    runs, relative = entry.get(RUNS), entry.get("relative_to", "variant")
    for each in runs.items if runs else ():
        if isinstance(each.value, str) and each.value not in variants:
            yield _unknown_run(each.value, each, variants)
    for key in BY_RUN:
        by_run = entry.get(key)
        for name, each in by_run.table.items() if by_run else ():
            if name not in variants:
                yield _unknown_run(name, each.key, variants)
            elif name not in asked:
                message = f"`{key}` names the run `{name}`, of which this is not asked"
                yield finding("SCN406", message, each.key, f"leave it out, or name it in `{RUNS}`, too")
            elif relative is not None and name == relative.value:
                message = f"`{key}` names the run `{name}`, to which this is relative"
                yield finding("SCN406", message, each.key, "leave it out: no run is held against itself")
    yield from _relative_faults(entry, variants, asked)


def _unknown_run(name: str, where: Entry | Span, variants: Sequence[str]) -> Diagnostic:
    near = nearest(name, variants)
    hint = f"did you mean `{near}`?" if near else f"the runs are {listed(variants)}"
    return finding("SCN405", f"there is no variant called `{name}`", where, hint)


def _relative_faults(entry: Entry, variants: Sequence[str], asked: AbstractSet[str]) -> Iterator[Diagnostic]:
    variant = entry.get("relative_to", "variant")
    if variant is None or not isinstance(variant.value, str):
        return
    if variant.value not in variants:
        yield _unknown_run(variant.value, variant, variants)
    elif asked == {variant.value}:
        yield _of_no_run(entry, variant, variants)


def _of_no_run(entry: Entry, variant: Entry, variants: Sequence[str]) -> Diagnostic:
    """Return the finding about a requirement on a run that is relative to that run itself."""
    runs, identity = entry.get(RUNS), entry.get("id")
    what = str(identity.value) if identity else "the requirement"
    none = "so that it would be asked of no run: no run is held against itself"
    others = [name for name in variants if name != variant.value]
    if not others:
        message = f"{what} is relative to `{variant.value}`, the only run there is, {none}"
        return finding(
            "SCN406", message, variant, "bound the metric itself, or add a variant to hold against it"
        )
    message = f"{what} is asked of the run `{variant.value}` alone and relative to it, {none}"
    hint = f"name in `{RUNS}` what is held against it: {listed(others)}"
    return finding("SCN406", message, runs or variant, hint)

"""How far runs have exercised their rule bases."""

from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path

from fcl_sim.diagnostics import Diagnostic, InputFault
from fcl_sim.forked import results
from fcl_sim.loop.diagram import FuzzyNode
from fcl_sim.scenario.document import shown
from fcl_sim.testbench.outcome import Outcome
from fcl_sim.verify.cover import LEAST, Visit, cover
from fcl_sim.verify.coverage import Coverage, Item, merged, waived
from fcl_sim.verify.subject import of_node
from fcl_sim.verify.waivers import Waiver, waivers_of


def coverage(outcomes: Iterable[Outcome], least: float = LEAST) -> tuple[Coverage, ...]:
    """Return how far runs have exercised each rule base, with its waivers, in the order of their first use.

    `least` is the part of an output's range by which a decisive rule changes
    it. InputFault with every fault of the files of waivers.
    """
    visits: list[tuple[Path, Callable[[], Coverage]]] = []
    benches: dict[Path, Path] = {}
    for outcome in outcomes:
        for run in outcome.variants.values():
            for node in [each for each in run.diagram.nodes if isinstance(each, FuzzyNode)]:
                file = outcome.scenario.variants[run.variant].rule_bases[node.name]
                benches.setdefault(file, outcome.scenario.bench)
                label = f"{outcome.scenario.name}/{run.variant}"
                visit = Visit(run=label, ticks=run.trace.ticks, record=run.trace.fuzzy[node.name])
                visits.append((file, partial(cover, of_node(node), visit, least, shown(file))))
    parts: dict[tuple[Path, str], list[Coverage]] = {}
    for (file, _), found in zip(visits, results([each for _, each in visits]), strict=True):
        parts.setdefault((file, found.name), []).append(found)
    faults: dict[Diagnostic, None] = {}
    waivers: dict[Path, tuple[Waiver, ...]] = {}
    for file, bench in benches.items():
        try:
            waivers[file] = waivers_of(file, bench, [*Item])
        except InputFault as fault:
            faults.update(dict.fromkeys(fault.diagnostics))
    if faults:
        raise InputFault(faults)
    return tuple(waived(merged(own), waivers[file]) for (file, _), own in parts.items())

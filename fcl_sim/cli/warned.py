"""Of the rule bases that were run, how many warnings there are."""

import shlex
from collections.abc import Iterator, Sequence
from pathlib import Path

from fcl_sim.diagnostics import Diagnostic, Severity
from fcl_sim.loop.diagram import FuzzyNode
from fcl_sim.report.words import counted
from fcl_sim.scenario.document import shown
from fcl_sim.testbench import Outcome


def warnings(outcomes: Sequence[Outcome]) -> Iterator[str]:
    """Yield a line for each rule base that was read with warnings: how many, and what tells them."""
    found: dict[Diagnostic, None] = {}
    for outcome in outcomes:
        for run in outcome.variants.values():
            for node in run.diagram.nodes:
                if isinstance(node, FuzzyNode):
                    found |= dict.fromkeys(node.block.diagnostics)
    files = [shown(Path(each.places[0].name)) for each in found if each.severity is Severity.WARNING]
    for file in dict.fromkeys(files):
        them = "them" if files.count(file) > 1 else "it"
        told = f"fcl-sim check {shlex.quote(file)} tells {them}"
        yield f"{file}: {counted(files.count(file), 'warning')} ({told})"

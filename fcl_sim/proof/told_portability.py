"""What other engines make of a text → findings."""

from collections.abc import Iterator

from fcl_sim.diagnostics import Severity
from fcl_sim.model import FunctionBlock
from fcl_sim.proof.completeness import Certainty
from fcl_sim.proof.finding import Finding, found
from fcl_sim.proof.portability import otherwise
from fcl_sim.proof.universe import Universe
from fcl_sim.proof.words import assignments
from fcl_sim.units import exact


def told_portability(block: FunctionBlock, universe: Universe) -> Iterator[Finding]:
    """Yield a note for each habit of another engine that changes an output by more than 1 % of its reach."""
    for each in otherwise(block, universe):
        habit, apart = each.habit, each.apart
        point = {name: exact(value) for name, value in apart.shown.at.items()}
        values = f"`{apart.output}` is {apart.shown.old:.5g} here and {apart.shown.new:.5g} there"
        yield found(
            "FCL631",
            f"{habit.who} {habit.what}: {values}, at {assignments(point)}",
            [habit.span],
            habit.hint,
            Severity.NOTE,
            certainty=Certainty.BOUNDED,
            variable=apart.output,
            witness=point,
        )

"""Outcomes → all that their report is made of, as it is now; nothing is read later."""

from collections.abc import Sequence

from fcl_sim.report.archive import Stored
from fcl_sim.report.proved import proved
from fcl_sim.report.provenance import origin_of
from fcl_sim.report.rule_bases import rule_bases
from fcl_sim.report.story import stories_of
from fcl_sim.testbench import Outcome, coverage
from fcl_sim.verify.coverage import Coverage


def gathered(outcomes: Sequence[Outcome], covered: Sequence[Coverage] | None = None) -> Stored:
    """Return what a report of outcomes is made of; `covered` is their coverage, where it is known.

    InputFault with every fault of the files of waivers, or of SOURCE_DATE_EPOCH.
    """
    return Stored(
        outcomes=tuple(outcomes),
        covered=tuple(coverage(outcomes) if covered is None else covered),
        proofs=tuple(proved(each.node.block, each.file) for each in rule_bases(outcomes)),
        stories=stories_of(outcomes),
        origin=origin_of(outcomes),
    )

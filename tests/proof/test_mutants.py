"""Mutants of rule bases: what makes a rule base unsound is found by its proof, every other law by `diff`."""

from fcl_sim import fcl
from fcl_sim.verify.mutants import Kind
from tests.house.places import ROOT
from tests.proof.mutants import seen

UNSOUND = {Kind.CONDITION_MOVED, Kind.CONDITION_NEGATED, Kind.RULE_DELETED, Kind.AND_OR_EXCHANGED}
"""Kinds that leave a gap, a contradiction, or a general rule, in a rule base with a rule for every cell."""


def test_a_mutant_of_another_law_is_told_by_diff_and_an_unsound_one_by_check():
    (block,) = fcl.read_file(ROOT / "scenarios" / "exchanger" / "bilinear.fcl").blocks
    found = list(seen(block, slice(3, None, 7)))
    assert {each.mutant.kind for each in found} & UNSOUND
    for each in found:
        assert bool(each.sampled) == bool(each.shown), each.mutant
        assert each.codes or each.mutant.kind not in UNSOUND, each.mutant
        assert each.shown or not each.codes, each.mutant

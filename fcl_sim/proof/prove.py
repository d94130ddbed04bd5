"""The proof of one function block: every finding, in the order in which a reader wants them."""

from fcl_sim.model import FunctionBlock
from fcl_sim.proof.completeness import EPSILON, completeness
from fcl_sim.proof.finding import Finding
from fcl_sim.proof.slabs import Budget
from fcl_sim.proof.space import axes_of
from fcl_sim.proof.terms import stretches_without_terms
from fcl_sim.proof.told_gaps import told_gaps
from fcl_sim.proof.told_portability import told_portability
from fcl_sim.proof.told_rules import told_rules
from fcl_sim.proof.told_terms import told_terms
from fcl_sim.proof.universe import Universe, declared


def prove(
    block: FunctionBlock,
    universe: Universe | None = None,
    epsilon: float = EPSILON,
    budget: Budget | None = None,
) -> tuple[Finding, ...]:
    """Return what is to be said of a rule base as a whole: gaps, terms, rules, other engines.

    The universe is that of the text's RANGEs where none is given. The block
    must be one that the engine can evaluate.
    """
    own = universe or Universe(stretches=declared(block))
    axes = axes_of(block, own)
    findings: list[Finding] = []
    proved = completeness(block, own, epsilon, budget)
    bare = stretches_without_terms(block, axes)
    for each in proved:
        findings += told_gaps(block, each, own, epsilon, bare)
    told = [each.gap for each in proved if each.gap is not None]
    findings += told_terms(block, axes, own, told)
    findings += told_rules(block, axes, own)
    findings += told_portability(block, own)
    return tuple(findings)

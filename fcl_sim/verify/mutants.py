"""FunctionBlock → its mutants: each with one change of the catalogue, each a legal rule base."""

from collections.abc import Iterator
from itertools import chain

from fcl_sim.model import FunctionBlock
from fcl_sim.verify.mutant import Kind, Mutant
from fcl_sim.verify.mutate_rules import mutants_of_rules
from fcl_sim.verify.mutate_settings import mutants_of_settings
from fcl_sim.verify.mutate_terms import mutants_of_terms

__all__ = ["SHARE", "Kind", "Mutant", "mutants"]

SHARE = 0.25
"""By which share of the distance to its neighbour a breakpoint moves: the order of breakpoints stays."""


def mutants(block: FunctionBlock, share: float = SHARE) -> Iterator[Mutant]:
    """Yield the mutants of a rule base: rules in the order of the text, then terms, then settings.

    Each differs from `block` and from all others as a model, and reads back as
    it is written. `share`, above 0 and below a half, is that by which
    breakpoints move. What could change nothing is left out, such as ACT where
    all outputs have singletons; so are singletons calculated by a formula.
    """
    if not 0.0 < share < 0.5:
        raise ValueError(f"share is {share}: a breakpoint moves by more than 0 and less than half the way")
    seen = {block}
    for each in chain(mutants_of_rules(block), mutants_of_terms(block, share), mutants_of_settings(block)):
        if each.function_block not in seen:
            seen.add(each.function_block)
            yield each

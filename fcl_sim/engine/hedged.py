"""Conclusions with hedges (Open Level): these change the rule's degree before activation and weight."""

from collections.abc import Sequence

from numpy import float64, int64
from numpy.typing import NDArray

from fcl_sim.arithmetic.hedges import hedged
from fcl_sim.arithmetic.operators import maximum
from fcl_sim.arithmetic.pairs import disjunction
from fcl_sim.engine.conditions import HEDGE_CODE
from fcl_sim.engine.program import HEDGED_COUNT, HEDGED_FIRST, HEDGED_SUM
from fcl_sim.jit import entry, f8, flat, i8, signature, u
from fcl_sim.model import Hedge

Ints = NDArray[int64]
Floats = NDArray[float64]


@flat
def conclude_hedged(
    ints: Ints, record: int, weight: float, degree: float, memory: Floats, target: int
) -> None:
    """Accumulate the degree of a rule, hedged and then weighted, in `memory[target]`."""
    changed, complement = degree, 1.0 - degree
    first = record + HEDGED_FIRST
    for word in range(first, first + ints[u(record + HEDGED_COUNT)]):
        changed, complement = hedged(ints[u(word)], changed, complement)
    weighted = weight * changed
    how = ints[u(record + HEDGED_SUM)]
    if how == 0:
        memory[u(target)] = maximum(memory[u(target)], weighted)
    elif how > 0:
        memory[u(target)] += weighted
    else:
        memory[u(target)] = disjunction(how, memory[u(target)], weighted)


@entry(signature(f8, i8, f8))
def hedged_once(hedge: int, degree: float) -> float:
    """Return what a hedge makes of a degree."""
    return hedged(hedge, degree, 1.0 - degree)[0]


def hedged_degree(hedges: Sequence[Hedge], degree: float) -> float:
    """Return what hedges make of a degree, the last one first."""
    for hedge in reversed(hedges):
        degree = hedged_once(HEDGE_CODE[hedge], degree)
    return degree

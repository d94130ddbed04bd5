"""Areas under norms of the Open Level become records, and room is made for their polylines."""

from collections.abc import Sequence
from itertools import pairwise
from math import ceil, sqrt

from fcl_sim.engine import program as p
from fcl_sim.engine.activated import HELD_SIZE, TRACK_SIZE
from fcl_sim.engine.buffers import Buffers, word_source
from fcl_sim.engine.conditions import AND_CODE, NORM_CODE
from fcl_sim.engine.curved import DEPTH, TAKEN
from fcl_sim.engine.plan import Plan
from fcl_sim.engine.plan_areas import AreaPlan, Pair, Part, points_of
from fcl_sim.model import Accumulation, Activation, AndOperator, Defuzzification, Term

RUN = 4.0 * sqrt(1.0 / (4.0 * TAKEN))
"""Vertices that halving adds along a rise or fall of a slope that changes by 1.

What leaves its line by TAKEN over a part h of the way changes its slope there by
4 TAKEN / h at least; of the 2**k parts that halving makes at depth k, no more
than 2**-k / (4 TAKEN) do so, and the sum over all k is less than this.
"""
STRAIGHT = frozenset((Activation.MIN, Activation.PROD, Activation.BDIF, Activation.DPROD, Activation.NMIN))
"""What leaves an activated term piecewise linear."""
KINDS = {
    Accumulation.MAX: p.GROUP_MAX,
    Accumulation.BSUM: p.GROUP_BSUM,
    Accumulation.NSUM: p.GROUP_NSUM,
    Accumulation.SUM: p.GROUP_SUM,
    **{kind: code + p.AND_MIN - p.OR_MAX for kind, code in NORM_CODE.items()},
}


def vertices_of(output: Defuzzification, area: AreaPlan, group: int) -> list[int]:
    """Return how many vertices each polyline has at most that a group is made from."""
    kind, parts = area.groups[group]
    if not area.curved[group]:
        return [area.counts[part.term] * (1 + len(part.pairs)) for part in parts]
    return [_places(area, each) + _halvings(output, kind, each) for each in _swept(kind, parts)]


def scratch_of(area: AreaPlan) -> int:
    """Return how many words of memory the curved groups of an output share."""
    if not any(area.curved):
        return 0
    terms = max(len(parts) for _, parts in area.groups)
    pairs = max(sum(len(part.pairs) for part in parts) for _, parts in area.groups)
    return TRACK_SIZE * terms + HELD_SIZE * pairs + 2 * (DEPTH + 1)


def put_curved(
    buffers: Buffers,
    own: Plan,
    area: AreaPlan,
    group: int,
    sources: Sequence[int],
    ends: Sequence[int],
    scratch: int,
) -> tuple[int, int]:
    """Append the record of a curved group; return the words that lead to it."""
    kind, parts = area.groups[group]
    there = [part for part in parts if ends[part.term] != -1]
    pairs = [(number, pair) for number, part in enumerate(there) for pair in part.pairs]
    held = scratch + TRACK_SIZE * len(there)
    head = [
        KINDS[kind],
        len(there),
        len(pairs),
        scratch,
        held,
        held + HELD_SIZE * len(pairs),
    ]
    terms = [word for part in there for word in (sources[part.term], ends[part.term])]
    words = [word for number, pair in pairs for word in _pair(buffers, own, number, pair)]
    return p.GROUP_CURVED, buffers.put([*head, *terms, *words])


def _pair(buffers: Buffers, own: Plan, term: int, pair: Pair) -> tuple[int, int, int, int]:
    operator = AND_CODE[AndOperator(pair.activation)]
    return term, operator, word_source(pair.word), buffers.weight(own, pair.weight)


def _swept(kind: Accumulation, parts: Sequence[Part]) -> list[Sequence[Part]]:
    """Return what is swept together: under MAX every pair alone, since `join` is exact."""
    if kind is not Accumulation.MAX:
        return [parts]
    return [(Part(part.term, (pair,)),) for part in parts for pair in part.pairs]


def _places(area: AreaPlan, parts: Sequence[Part]) -> int:
    """Return how many vertices there are where terms have points, and activations kinks: three at each."""
    return 3 * sum(area.counts[part.term] * (1 + 2 * len(part.pairs)) for part in parts) + 8


def _halvings(output: Defuzzification, kind: Accumulation, parts: Sequence[Part]) -> int:
    """Return how many vertices halving adds at most.

    A T-norm or S-norm that is bent changes the slope of what rises by 1 by no more
    than that; n conclusions on one term, by n, of which the root counts.
    """
    straight = kind not in NORM_CODE or kind is Accumulation.DSUM
    if straight and all(pair.activation in STRAIGHT for part in parts for pair in part.pairs):
        return 0
    return ceil(sum(RUN * _runs(output.terms[part.term]) * sqrt(len(part.pairs)) for part in parts))


def _runs(term: Term) -> int:
    """Return how often a term rises or falls, one after the other, and 1 at least."""
    degrees = [point.degree for point in points_of(term)]
    rises = [right > left for left, right in pairwise(degrees) if right != left]
    return 1 + sum(left != right for left, right in pairwise(rises))

"""Terms, activated by any T-norm and weighted, as they are met from left to right (Table 4, Open Level).

A track follows a term: where its next point lies, and its degrees at both ends
of the current stretch. A held pair is a conclusion that counts: how far before
it the track of its term lies, the operator, the degree that activates, the
weight, and which piece of the activation the stretch lies in.
"""

from math import inf

from numpy import float64, int64
from numpy.typing import NDArray

from fcl_sim.arithmetic.operators import maximum, minimum
from fcl_sim.arithmetic.pairs import (
    AND_BDIF,
    AND_DPROD,
    AND_MIN,
    AND_NMIN,
    AND_PROD,
    conjunction,
    disjunction,
)
from fcl_sim.arithmetic.polyline import POINT_SIZE
from fcl_sim.engine.moving import sourced
from fcl_sim.engine.program import (
    CURVED_FIRST,
    CURVED_HELD,
    CURVED_PAIR,
    CURVED_PAIRS,
    CURVED_TERM,
    CURVED_TERMS,
    CURVED_TRACKS,
    FLOATS,
)
from fcl_sim.jit import flat, inlined, u

Ints = NDArray[int64]
Floats = NDArray[float64]

TRACK_POINT, TRACK_LEFT, TRACK_BEGIN, TRACK_END, TRACK_PEAK, TRACK_SIZE = range(6)
"""Next point; how many are left; the degrees where the stretch begins and ends, and the largest there."""
HELD_TRACK, HELD_OPERATOR, HELD_DEGREE, HELD_WEIGHT, HELD_PIECE, HELD_SIZE = range(6)
NOTHING, LEVEL, TERM, LOWERED, PRODUCT, BENT = range(6)
"""Pieces of an activation: 0; the degree; the term; both less 1; their product; another function."""


@flat
def hold(ints: Ints, floats: Floats, at: int, record: int, memory: Floats, base: int) -> int:
    """Note the pairs that count; return how many."""
    origin = ints[u(at + FLOATS)]
    held = base + ints[u(record + CURVED_HELD)]
    tracks = base + ints[u(record + CURVED_TRACKS)]
    pair = record + CURVED_FIRST + CURVED_TERM * ints[u(record + CURVED_TERMS)]
    count = 0
    for _ in range(ints[u(record + CURVED_PAIRS)]):
        degree = sourced(ints[u(pair + 2)], floats, origin, memory, base)
        weight = sourced(ints[u(pair + 3)], floats, origin, memory, base)
        if degree > 0.0 and weight > 0.0:
            at_held = held + HELD_SIZE * count
            memory[u(at_held + HELD_TRACK)] = at_held - (tracks + TRACK_SIZE * ints[u(pair)])
            memory[u(at_held + HELD_OPERATOR)] = ints[u(pair + 1)]
            memory[u(at_held + HELD_DEGREE)] = degree
            memory[u(at_held + HELD_WEIGHT)] = weight
            count += 1
        pair += CURVED_PAIR
    return count


@inlined
def track_of(held: int, memory: Floats) -> int:
    """Return where the track of a held pair lies."""
    return held - int(memory[u(held + HELD_TRACK)])


@inlined
def number_of(source: int, offset: int, floats: Floats, origin: int, memory: Floats, base: int) -> float:
    """Return a number of a term's points, which `source` says where they begin."""
    number: float = (
        floats[u(origin + source + offset)] if source > 0 else memory[u(base - 1 - source + offset)]
    )
    return number


@flat
def begin_tracks(ints: Ints, record: int, first: int, last: int, memory: Floats, base: int) -> None:
    """Put the tracks of the terms that held pairs take before their first point; the others have none."""
    tracks = base + ints[u(record + CURVED_TRACKS)]
    for track in range(tracks, tracks + TRACK_SIZE * ints[u(record + CURVED_TERMS)], TRACK_SIZE):
        for word in range(track, track + TRACK_SIZE):
            memory[u(word)] = 0.0
    for held in range(first, last, HELD_SIZE):
        track = track_of(held, memory)
        end = ints[u(record + CURVED_FIRST + (track - tracks) // TRACK_SIZE * CURVED_TERM + 1)]
        if end < 0:
            memory[u(track + TRACK_LEFT)] = -1 - end
        else:
            memory[u(track + TRACK_LEFT)] = memory[u(base + end)]


@flat
def next_place(ints: Ints, floats: Floats, at: int, record: int, memory: Floats, base: int) -> float:
    """Return where the next point lies, infinity behind the last one."""
    origin = ints[u(at + FLOATS)]
    track = base + ints[u(record + CURVED_TRACKS)]
    term = record + CURVED_FIRST
    x = inf
    for _ in range(ints[u(record + CURVED_TERMS)]):
        if memory[u(track + TRACK_LEFT)] > 0.0:
            point = int(memory[u(track + TRACK_POINT)])
            x = minimum(x, number_of(ints[u(term)], point, floats, origin, memory, base))
        track += TRACK_SIZE
        term += CURVED_TERM
    return x


@flat
def pass_place(ints: Ints, floats: Floats, at: int, record: int, x: float, memory: Floats, base: int) -> None:
    """Go on behind the points at `x`: the degrees to the right of it, and the largest there (S21)."""
    origin = ints[u(at + FLOATS)]
    track = base + ints[u(record + CURVED_TRACKS)]
    term = record + CURVED_FIRST
    for _ in range(ints[u(record + CURVED_TERMS)]):
        source = ints[u(term)]
        degree = peak = memory[u(track + TRACK_END)]
        point = int(memory[u(track + TRACK_POINT)])
        left = memory[u(track + TRACK_LEFT)]
        while left > 0.0 and number_of(source, point, floats, origin, memory, base) == x:
            degree = number_of(source, point + 1, floats, origin, memory, base)
            peak = maximum(peak, degree)
            point += POINT_SIZE
            left -= 1.0
        memory[u(track + TRACK_POINT)] = point
        memory[u(track + TRACK_LEFT)] = left
        memory[u(track + TRACK_BEGIN)] = degree if left > 0.0 else 0.0
        memory[u(track + TRACK_END)] = 0.0
        memory[u(track + TRACK_PEAK)] = peak
        track += TRACK_SIZE
        term += CURVED_TERM


@flat
def reach(ints: Ints, floats: Floats, at: int, record: int, x: float, memory: Floats, base: int) -> None:
    """Write the degrees to the left of `x`, up to where the stretch goes."""
    origin = ints[u(at + FLOATS)]
    track = base + ints[u(record + CURVED_TRACKS)]
    term = record + CURVED_FIRST
    for _ in range(ints[u(record + CURVED_TERMS)]):
        point = int(memory[u(track + TRACK_POINT)])
        if memory[u(track + TRACK_LEFT)] > 0.0 and point > 0:
            source = ints[u(term)]
            right = number_of(source, point, floats, origin, memory, base)
            degree = number_of(source, point + 1, floats, origin, memory, base)
            if right != x:
                left = number_of(source, point - POINT_SIZE, floats, origin, memory, base)
                before = number_of(source, point - POINT_SIZE + 1, floats, origin, memory, base)
                if before <= degree:
                    degree = before + (degree - before) * ((x - left) / (right - left))
                else:
                    degree += (before - degree) * ((right - x) / (right - left))
            memory[u(track + TRACK_END)] = degree
        track += TRACK_SIZE
        term += CURVED_TERM


@inlined
def membership(held: int, part: float, memory: Floats) -> float:
    """Return the degree of a held pair's term at a part of the stretch."""
    track = track_of(held, memory)
    begin: float = memory[u(track + TRACK_BEGIN)]
    end: float = memory[u(track + TRACK_END)]
    return begin + (end - begin) * part


@flat
def next_kink(first: int, last: int, begin: float, memory: Floats) -> float:
    """Return the next part of the stretch where an activation has a kink or a jump, else its end."""
    stop = 1.0
    for held in range(first, last, HELD_SIZE):
        track = track_of(held, memory)
        start = memory[u(track + TRACK_BEGIN)]
        rise = memory[u(track + TRACK_END)] - start
        operator = int(memory[u(held + HELD_OPERATOR)])
        degree = memory[u(held + HELD_DEGREE)]
        if rise != 0.0:
            if operator in (AND_MIN, AND_NMIN):
                part = (degree - start) / rise
                if begin < part < stop:
                    stop = part
            if operator in (AND_BDIF, AND_NMIN):
                part = ((1.0 - degree) - start) / rise
                if begin < part < stop:
                    stop = part
    return stop


@inlined
def piece_of(held: int, part: float, memory: Floats) -> int:
    """Return in which piece of its activation a held pair is at a part of the stretch."""
    mu = membership(held, part, memory)
    operator = int(memory[u(held + HELD_OPERATOR)])
    degree = memory[u(held + HELD_DEGREE)]
    piece = BENT
    if mu == 0.0:
        piece = NOTHING
    elif operator == AND_PROD:
        piece = PRODUCT
    elif operator == AND_BDIF:
        piece = LOWERED if mu > 1.0 - degree else NOTHING
    elif operator == AND_DPROD:
        piece = TERM if degree >= 1.0 else LEVEL if mu >= 1.0 else NOTHING
    elif operator in (AND_MIN, AND_NMIN):
        piece = TERM if mu < degree else LEVEL
        if operator == AND_NMIN and not mu > 1.0 - degree:
            piece = NOTHING
    return piece


@flat
def choose_pieces(first: int, last: int, middle: float, memory: Floats) -> tuple[int, int]:
    """Note the piece of every held pair around `middle`; return how many are not 0, and how many bent."""
    live = bent = 0
    for held in range(first, last, HELD_SIZE):
        piece = piece_of(held, middle, memory)
        memory[u(held + HELD_PIECE)] = piece
        live += int(piece != NOTHING)
        bent += int(piece == BENT)
    return live, bent


@inlined
def activated(held: int, part: float, memory: Floats) -> float:
    """Return the activated and weighted degree of a held pair at a part of the stretch."""
    piece = int(memory[u(held + HELD_PIECE)])
    degree: float = memory[u(held + HELD_DEGREE)]
    weight: float = memory[u(held + HELD_WEIGHT)]
    mu = membership(held, part, memory)
    result = degree
    if piece == TERM:
        result = mu
    elif piece == LOWERED:
        result = maximum(0.0, degree - (1.0 - mu))
    elif piece == PRODUCT:
        result = degree * mu
    elif piece == BENT:
        operator = int(memory[u(held + HELD_OPERATOR)])
        result = conjunction(operator, degree, 1.0 - degree, mu, 1.0 - mu)[0]
    return weight * result


@flat
def next_jump(first: int, last: int, begin: float, stop: float, tie: float, memory: Floats) -> float:
    """Return where two pairs begin or cease to make 1 together (NMAX), if before `stop`; none is bent."""
    for held in range(first, last, HELD_SIZE):
        for other in range(first, held, HELD_SIZE):
            before = both_above_one(held, other, begin, memory)
            after = both_above_one(held, other, stop, memory)
            if minimum(before, after) < tie - 1.0 and maximum(before, after) > 1.0 - tie:
                part = begin + (stop - begin) * (before / (before - after))
                if begin < part < stop:
                    stop = part
    return stop


@flat
def both_above_one(held: int, other: int, part: float, memory: Floats) -> float:
    """Return how far above 1 two held pairs are together; 0 where one of them is 0."""
    if int(memory[u(held + HELD_PIECE)]) == NOTHING or int(memory[u(other + HELD_PIECE)]) == NOTHING:
        return 0.0
    return activated(held, part, memory) + activated(other, part, memory) - 1.0


@flat
def between_jumps(first: int, last: int, middle: float, tie: float, memory: Floats) -> int:
    """Return what NMAX is around `middle`: MAX, or where two pairs make 1 together, DSUM.

    Terms that make 1 together may do so all along a stretch: how their degrees
    were rounded must not tell one place from the next.
    """
    largest = second = 0.0
    for held in range(first, last, HELD_SIZE):
        if int(memory[u(held + HELD_PIECE)]) != NOTHING:
            degree = activated(held, middle, memory)
            second = maximum(second, minimum(degree, largest))
            largest = maximum(largest, degree)
    return AND_DPROD if second > 0.0 and largest + second >= tie else AND_MIN


@flat
def degree_within(kind: int, first: int, last: int, part: float, memory: Floats) -> float:
    """Return the accumulated degree at a part of the stretch, at its ends as the limit from within."""
    total = 0.0
    live = 0
    for held in range(first, last, HELD_SIZE):
        if int(memory[u(held + HELD_PIECE)]) != NOTHING:
            total = joined(kind, live, total, activated(held, part, memory))
            live += 1
    return total


@flat
def joined(kind: int, live: int, total: float, degree: float) -> float:
    """Return the degree accumulated from `live` pairs before and that of one more; none of them is 0."""
    if kind >= 0:
        return total + degree
    if live == 0:
        return degree
    if kind == AND_DPROD:
        return 1.0
    return disjunction(kind, total, degree)


@flat
def degree_at_place(kind: int, first: int, last: int, memory: Floats) -> float:
    """Return the accumulated degree where the stretch begins, the larger degree of each term there (S21)."""
    total = 0.0
    live = 0
    for held in range(first, last, HELD_SIZE):
        mu = memory[u(track_of(held, memory) + TRACK_PEAK)]
        degree = memory[u(held + HELD_DEGREE)]
        operator = int(memory[u(held + HELD_OPERATOR)])
        peak = conjunction(operator, degree, 1.0 - degree, mu, 1.0 - mu)[0] if mu > 0.0 else 0.0
        if peak > 0.0:
            total = joined(kind, live, total, memory[u(held + HELD_WEIGHT)] * peak)
            live += 1
    return total

"""Many points together, a step of A.2.3 at a time.

A step over some hundred points is a loop that becomes vector instructions. A
row is `width` numbers, one for each point, in place of a word of the instance
memory: word m of a point is `rows[m * width + point]`. Each point sees the
arithmetic of `infer` in its order, so that results are the same to the last
bit: a rule that cannot fire has the degree 0, and accumulates nothing.

Inputs, outputs and flags stay where the caller has them, in columns of which
the addresses are known: taken and given a step at a time, in the nearest cache.
"""

from numpy import float64, int64
from numpy.typing import NDArray

from fcl_sim.arithmetic.membership import cell_of_many, degree_on
from fcl_sim.arithmetic.operators import clamped, maximum, minimum
from fcl_sim.engine.program import (
    ALL_MIN,
    BRING,
    BRING_INPUT,
    BRING_NOT,
    BRING_SIZE,
    BRING_SLOT,
    BROUGHT,
    CLAMPS,
    DE_BRUIJN,
    EDGES_SIZE,
    FLOATS,
    GRID,
    GRID_CELLS,
    GRID_COUNT,
    GRID_INPUT,
    GRID_KNOTS,
    GRID_PIECES,
    GRID_ROW_SIZE,
    GRID_ROWS,
    GRID_SIZE,
    GRID_WIDTH,
    GRIDS,
    MASK_BITS,
    OUT_ACTIVE,
    OUT_DEGREES,
    OUT_KEEP,
    OUT_PLACES,
    OUT_TERMS,
    OUT_VALUE,
    OUTPUT,
    OUTPUT_SIZE,
    OUTPUTS,
    RULE,
    RULE_BODY,
    RULE_KIND,
    RULE_LENGTH,
    RULE_THEN,
    RULES,
    THEN_DEGREE,
    THEN_SIZE,
    THEN_SUM,
    THEN_WEIGHT,
    TOGETHER,
    UP_TO_RULES,
)
from fcl_sim.jit import bytes_at, doubles_at, flat, rounded, u

Ints = NDArray[int64]
Floats = NDArray[float64]

TOGETHER_AT_MOST = 256
"""Points: a row is worth its loop, and the rows in use stay in the nearest cache."""
GAP = 8
"""Numbers between rows, so that they do not all begin in the same few lines of the cache."""


EACH, ONE_OF_ALL, UNDOUBTED = range(3)
"""Kinds of columns: a number for each point; one for all of them; one that may as well be no number."""
PATTERN_BITS = 6
"""Of more rules, some share a bit."""
PATTERNS = 1 << PATTERN_BITS


@flat
def take_rows(
    columns: Ints, given: int, row: int, rows: Floats, width: int, count: int, largest: float
) -> bool:
    """Take the numbers of `count` points from `row` on, if none is beyond `largest`; `columns` of `given`."""
    unfit = 0
    for word in range(given):
        numbers, kind, own = doubles_at(columns[u(2 * word)]), columns[u(2 * word + 1)], word * width
        if kind == EACH:
            for point in range(count):
                x = numbers[u(row + point)]
                unfit += int(not abs(x) <= largest)
                rows[u(own + point)] = x
        else:
            unfit += int(kind == ONE_OF_ALL and not abs(numbers[u(0)]) <= largest)
            for point in range(count):
                rows[u(own + point)] = numbers[u(0)]
    return unfit == 0


@rounded
def give_rows(
    columns: Ints, given: int, outputs: int, row: int, rows: Floats, width: int, count: int
) -> None:
    """Give the outputs of `count` points from `row` on, and their flags."""
    for output in range(outputs):
        place = 2 * (given + output)
        numbers, flags = doubles_at(columns[u(place)]), bytes_at(columns[u(place + 1)])
        value, active = (given - outputs + output) * width, (given + output) * width
        for point in range(count):
            numbers[u(row + point)] = rows[u(value + point)]
            flags[u(row + point)] = int(rows[u(active + point)] != 0.0)


@flat
def by_pattern(patterns: Ints, order: Ints, count: int) -> None:
    """Write the points to `order`, those together for which the same rules fire.

    Their areas take the same way then, which a processor foresees. Behind the
    points, `order` has room for a number for each pattern.
    """
    room = order.size - PATTERNS
    for pattern in range(PATTERNS):
        order[u(room + pattern)] = 0
    for point in range(count):
        order[u(room + patterns[u(point)])] += 1
    begin = 0
    for pattern in range(PATTERNS):
        begin += order[u(room + pattern)]
        order[u(room + pattern)] = begin - order[u(room + pattern)]
    for point in range(count):
        pattern = patterns[u(point)]
        order[u(order[u(room + pattern)])] = point
        order[u(room + pattern)] += 1


@flat
def fuzzify_rows(
    ints: Ints,
    floats: Floats,
    rows: Floats,
    width: int,
    cells: Ints,
    count: int,
) -> None:
    """Write the degrees of all input terms into cleared rows; `cells` is a row of integers to work in."""
    origin = ints[u(FLOATS)]
    grid = ints[u(GRID)]
    for _ in range(ints[u(GRIDS)]):
        given = ints[u(grid + GRID_INPUT)] * width
        knots, knot_count = origin + ints[u(grid + GRID_KNOTS)], ints[u(grid + GRID_COUNT)]
        for point in range(count):
            cells[u(point)] = cell_of_many(rows[u(given + point)], floats, knots, knot_count)
        most = ints[u(grid + GRID_WIDTH)]
        slots, segments = ints[u(grid + GRID_ROWS)] + 1, origin + ints[u(grid + GRID_CELLS)] + EDGES_SIZE
        row_size, pieces = ints[u(grid + GRID_ROW_SIZE)], ints[u(grid + GRID_PIECES)]
        for point in range(count):
            x = rows[u(given + point)]
            slot = slots + cells[u(point)] * row_size
            segment = segments + cells[u(point)] * pieces
            for place in range(most):
                degree = degree_on(x, floats, segment, place)
                rows[u(ints[u(slot + place)] * width + point)] = degree
        grid += GRID_SIZE


@flat
def bring_rows(ints: Ints, rows: Floats, width: int, count: int) -> None:
    """Take the variables brought in as degrees or weights into [0, 1] (S27)."""
    record = ints[u(BRING)]
    for _ in range(ints[u(BROUGHT)]):
        given = ints[u(record + BRING_INPUT)] * width
        slot, complement = ints[u(record + BRING_SLOT)] * width, ints[u(record + BRING_NOT)] * width
        for point in range(count):
            degree = clamped(rows[u(given + point)])
            rows[u(slot + point)] = degree
            rows[u(complement + point)] = 1.0 - degree
        record += BRING_SIZE


@flat
def aggregate_rows(ints: Ints, rule: int, rows: Floats, width: int, count: int) -> int:
    """Return where the row of the degrees of a rule's condition begins."""
    body, length = rule + RULE_BODY, ints[u(rule + RULE_LENGTH)]
    degree = int(ints[u(body)] * width)
    result = ints[u(CLAMPS)] * width
    for place in range(body + 1, body + length):
        other = ints[u(place)] * width
        if ints[u(rule + RULE_KIND)] == ALL_MIN:
            for point in range(count):
                rows[u(result + point)] = minimum(rows[u(degree + point)], rows[u(other + point)])
        else:
            for point in range(count):
                rows[u(result + point)] = rows[u(degree + point)] * rows[u(other + point)]
        degree = result
    return degree


@flat
def conclude_rows(
    ints: Ints, floats: Floats, then: int, degree: int, rows: Floats, width: int, count: int
) -> None:
    """Weight and accumulate the conclusion at `then` of a rule whose degrees are the row at `degree`."""
    source = ints[u(then + THEN_WEIGHT)]
    weighted = degree
    if source != 0:
        weighted = (ints[u(CLAMPS)] + 1) * width
        constant = floats[u(ints[u(FLOATS)] + max(0, source))]
        weights = (-1 - source) * width
        for point in range(count):
            weight = constant if source > 0 else rows[u(weights + point)]
            rows[u(weighted + point)] = weight * rows[u(degree + point)]
    target = ints[u(then + THEN_DEGREE)] * width
    if ints[u(then + THEN_SUM)] == 0:
        for point in range(count):
            rows[u(target + point)] = maximum(rows[u(target + point)], rows[u(weighted + point)])
    else:
        for point in range(count):
            rows[u(target + point)] += rows[u(weighted + point)]


@flat
def visit_rows(ints: Ints, floats: Floats, rows: Floats, width: int, patterns: Ints, count: int) -> None:
    """Evaluate all rules; where an output has areas, write which of them fire, as a pattern."""
    patterned = ints[u(TOGETHER)] == UP_TO_RULES
    for point in range(count):
        patterns[u(point)] = 0
    for number in range(ints[u(RULES)]):
        bit = number % MASK_BITS
        rule = ints[u(ints[u(RULE)] + number - bit + (((DE_BRUIJN << bit) >> 27) & 31))]
        degree = aggregate_rows(ints, rule, rows, width, count)
        if patterned:
            fires = 1 << number % PATTERN_BITS
            for point in range(count):
                patterns[u(point)] ^= fires if rows[u(degree + point)] > 0.0 else 0
        then = rule + RULE_BODY + ints[u(rule + RULE_LENGTH)]
        for _ in range(ints[u(rule + RULE_THEN)]):
            conclude_rows(ints, floats, then, degree, rows, width, count)
            then += THEN_SIZE


@flat
def defuzzify_rows(ints: Ints, floats: Floats, rows: Floats, width: int, count: int) -> None:
    """Write each output and its flag by CoGS; without an active rule, the DEFAULT or nothing (S30, S31)."""
    moments = ints[u(CLAMPS)] * width
    weights = moments + width
    output = ints[u(OUTPUT)]
    for _ in range(ints[u(OUTPUTS)]):
        places = ints[u(FLOATS)] + ints[u(output + OUT_PLACES)]
        terms, degrees = ints[u(output + OUT_TERMS)], ints[u(output + OUT_DEGREES)] * width
        for point in range(count):
            rows[u(moments + point)] = 0.0
            rows[u(weights + point)] = 0.0
        for term in range(terms):
            place, own = floats[u(places + term)], degrees + term * width
            for point in range(count):
                degree = rows[u(own + point)]
                rows[u(moments + point)] += place * degree
                rows[u(weights + point)] += degree
        default, keep = floats[u(places + terms)], ints[u(output + OUT_KEEP)] != 0
        value, active = ints[u(output + OUT_VALUE)] * width, ints[u(output + OUT_ACTIVE)] * width
        for point in range(count):
            weight = rows[u(weights + point)]
            other = rows[u(value + point)] if keep else default
            rows[u(value + point)] = rows[u(moments + point)] / weight if weight != 0.0 else other
            rows[u(active + point)] = 1.0 if weight != 0.0 else 0.0
        output += OUTPUT_SIZE

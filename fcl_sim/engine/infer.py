"""`infer`: one evaluation of a function block, as A.2.3 lists the steps.

Fuzzify, aggregate, activate, weight, accumulate, defuzzify (S23). Activation
does nothing to singletons (Table 4), so a rule's weighted result is its degree
times its weight. Only rules that can fire in the cell of every input are
visited: a mask of rules per cell, joined over the inputs.
"""

from numpy import float64, int64
from numpy.typing import NDArray

from fcl_sim.arithmetic.defuzzify import moments_of_singletons
from fcl_sim.arithmetic.membership import cell_of, degree_on
from fcl_sim.arithmetic.operators import (
    algebraic_sum,
    bounded_difference,
    bounded_sum,
    clamped,
    maximum,
    minimum,
)
from fcl_sim.engine.program import (
    ALL,
    ALL_MIN,
    ALL_PROD,
    AND_BDIF,
    AND_MIN,
    AND_PROD,
    BRING,
    BRING_INPUT,
    BRING_NOT,
    BRING_SIZE,
    BRING_SLOT,
    BROUGHT,
    CLAMPS,
    CLEARED,
    DE_BRUIJN,
    DEGREES,
    FLOATS,
    GRID,
    GRID_COUNT,
    GRID_INPUT,
    GRID_KNOTS,
    GRID_ROWS,
    GRID_SEGMENTS,
    GRID_SIZE,
    GRID_WIDTH,
    GRIDS,
    GROUP_BSUM,
    GROUP_NSUM,
    MASK_BITS,
    NOT,
    OR_ASUM,
    OR_MAX,
    OUT_ACTIVE,
    OUT_DEGREES,
    OUT_GROUPS,
    OUT_KEEP,
    OUT_KINDS,
    OUT_PLACES,
    OUT_TERMS,
    OUT_VALUE,
    OUTPUT,
    OUTPUT_SIZE,
    OUTPUTS,
    ROWS,
    RULE,
    RULE_BODY,
    RULE_DEGREE,
    RULE_KIND,
    RULE_LENGTH,
    RULE_THEN,
    SEGMENT_SIZE,
    STACK,
    THEN_DEGREE,
    THEN_SIZE,
    THEN_SUM,
    THEN_WEIGHT,
    WORDS,
)
from fcl_sim.jit import flat, inlined, u

Ints = NDArray[int64]
Floats = NDArray[float64]


@inlined
def clear(ints: Ints, at: int, memory: Floats, base: int) -> None:
    """Set all degrees to 0."""
    start = base + ints[u(at + DEGREES)]
    for word in range(start, start + ints[u(at + CLEARED)], 4):
        memory[u(word)] = 0.0
        memory[u(word + 1)] = 0.0
        memory[u(word + 2)] = 0.0
        memory[u(word + 3)] = 0.0


@inlined
def fuzzify(ints: Ints, floats: Floats, at: int, memory: Floats, base: int) -> int:
    """Write the degrees of all input terms; return the first word of the mask of rules that can fire."""
    origin = ints[u(at + FLOATS)]
    words = ints[u(at + WORDS)]
    rows = base + ints[u(at + ROWS)]
    first = int(ints[u(at + ints[u(at + ALL)])])
    grid = at + ints[u(at + GRID)]
    for index in range(ints[u(at + GRIDS)]):
        x = memory[u(base + ints[u(grid + GRID_INPUT)])]
        cell = cell_of(x, floats, origin + ints[u(grid + GRID_KNOTS)], ints[u(grid + GRID_COUNT)])
        width = ints[u(grid + GRID_WIDTH)]
        row = at + ints[u(grid + GRID_ROWS)] + cell * (width + words)
        segment = origin + ints[u(grid + GRID_SEGMENTS)] + cell * (width * SEGMENT_SIZE)
        memory[u(base + ints[u(row)])] = degree_on(x, floats, segment)
        memory[u(base + ints[u(row + 1)])] = degree_on(x, floats, segment + SEGMENT_SIZE)
        for k in range(2, width):
            memory[u(base + ints[u(row + k)])] = degree_on(x, floats, segment + k * SEGMENT_SIZE)
        row += width
        first &= int(ints[u(row)])
        if words > 1:
            memory[u(rows + index)] = row
        grid += GRID_SIZE
    return first


@flat
def mask_of(ints: Ints, at: int, memory: Floats, base: int, word: int) -> int:
    """Return word `word` of the mask of rules that can fire."""
    mask = int(ints[u(at + ints[u(at + ALL)] + word)])
    rows = base + ints[u(at + ROWS)]
    for index in range(ints[u(at + GRIDS)]):
        mask &= int(ints[u(int(memory[u(rows + index)]) + word)])
    return mask


@flat
def bring(ints: Ints, at: int, memory: Floats, base: int) -> None:
    """Take the variables brought in as degrees or weights into [0, 1] (S27)."""
    clamps = 0.0
    record = at + ints[u(at + BRING)]
    for _ in range(ints[u(at + BROUGHT)]):
        x = memory[u(base + ints[u(record + BRING_INPUT)])]
        degree = clamped(x)
        if degree != x:
            clamps += 1.0
        memory[u(base + ints[u(record + BRING_SLOT)])] = degree
        memory[u(base + ints[u(record + BRING_NOT)])] = 1.0 - degree
        record += BRING_SIZE
    memory[u(base + ints[u(at + CLAMPS)])] = clamps


@flat
def calculate(ints: Ints, at: int, code: int, length: int, memory: Floats, base: int) -> float:
    """Return the degree of a condition in postfix code of `length` words at `code`."""
    first = base + ints[u(at + STACK)]
    top = first - 1
    for place in range(code, code + length):
        word = ints[u(place)]
        if word >= 0:
            top += 1
            memory[u(top)] = memory[u(base + word)]
        elif word == NOT:
            memory[u(top)] = 1.0 - memory[u(top)]
        else:
            top -= 1
            memory[u(top)] = joined(word, memory[u(top)], memory[u(top + 1)])
    return float(memory[u(first)])


@inlined
def joined(operator: int, a: float, b: float) -> float:
    """Return two degrees joined by an operator of Table 3."""
    if operator == AND_MIN:
        return minimum(a, b)
    if operator == AND_PROD:
        return a * b
    if operator == AND_BDIF:
        return bounded_difference(a, b)
    if operator == OR_MAX:
        return maximum(a, b)
    if operator == OR_ASUM:
        return algebraic_sum(a, b)
    return bounded_sum(a, b)


@inlined
def aggregate(ints: Ints, at: int, rule: int, memory: Floats, base: int) -> float:
    """Return the degree of firing of the rule whose record is at `rule`."""
    kind = ints[u(rule + RULE_KIND)]
    body = rule + RULE_BODY
    length = ints[u(rule + RULE_LENGTH)]
    if kind == ALL_MIN:
        degree = float(memory[u(base + ints[u(body)])])
        for place in range(body + 1, body + length):
            degree = minimum(degree, memory[u(base + ints[u(place)])])
        return degree
    if kind == ALL_PROD:
        degree = float(memory[u(base + ints[u(body)])])
        for place in range(body + 1, body + length):
            degree *= memory[u(base + ints[u(place)])]
        return degree
    return calculate(ints, at, body, length, memory, base)


@inlined
def conclude(
    ints: Ints, floats: Floats, origin: int, rule: int, degree: float, memory: Floats, base: int
) -> None:
    """Weight and accumulate the conclusions of a rule that fires with `degree`."""
    then = rule + RULE_BODY + ints[u(rule + RULE_LENGTH)]
    for _ in range(ints[u(rule + RULE_THEN)]):
        weight = ints[u(then + THEN_WEIGHT)]
        weighted = degree
        if weight > 0:
            weighted = floats[u(origin + weight)] * degree
        elif weight < 0:
            weighted = memory[u(base - 1 - weight)] * degree
        target = base + ints[u(then + THEN_DEGREE)]
        if ints[u(then + THEN_SUM)] == 0:
            memory[u(target)] = maximum(memory[u(target)], weighted)
        else:
            memory[u(target)] += weighted
        then += THEN_SIZE


@inlined
def visit(ints: Ints, floats: Floats, at: int, mask: int, word: int, memory: Floats, base: int) -> None:
    """Evaluate the rules of one word of the mask."""
    origin = ints[u(at + FLOATS)]
    table = at + ints[u(at + RULE)] + word * MASK_BITS
    while mask != 0:
        lowest = mask & -mask
        mask ^= lowest
        rule = at + ints[u(table + ((lowest * DE_BRUIJN >> 27) & 31))]
        degree = aggregate(ints, at, rule, memory, base)
        memory[u(base + ints[u(rule + RULE_DEGREE)])] = degree
        conclude(ints, floats, origin, rule, degree, memory, base)


@flat
def finish_groups(ints: Ints, at: int, output: int, memory: Floats, base: int) -> None:
    """Finish BSUM and NSUM (Table 5, S25), and join by MAX where rule blocks disagree (S26)."""
    terms = ints[u(output + OUT_TERMS)]
    result = base + ints[u(output + OUT_DEGREES)]
    kinds = at + ints[u(output + OUT_KINDS)]
    for group in range(ints[u(output + OUT_GROUPS)]):
        own = result + group * terms
        kind = ints[u(kinds + group)]
        if kind == GROUP_BSUM:
            for term in range(terms):
                memory[u(own + term)] = minimum(1.0, memory[u(own + term)])
        elif kind == GROUP_NSUM:
            largest = 1.0
            for term in range(terms):
                largest = maximum(largest, memory[u(own + term)])
            for term in range(terms):
                memory[u(own + term)] /= largest
        for term in range(terms if group > 0 else 0):
            memory[u(result + term)] = maximum(memory[u(result + term)], memory[u(own + term)])


@inlined
def defuzzify(ints: Ints, floats: Floats, at: int, memory: Floats, base: int) -> None:
    """Write each output and its flag; without an active rule, the DEFAULT or nothing (S30)."""
    origin = ints[u(at + FLOATS)]
    output = at + ints[u(at + OUTPUT)]
    for _ in range(ints[u(at + OUTPUTS)]):
        if ints[u(output + OUT_GROUPS)] > 0:
            finish_groups(ints, at, output, memory, base)
        degrees = base + ints[u(output + OUT_DEGREES)]
        places = origin + ints[u(output + OUT_PLACES)]
        terms = ints[u(output + OUT_TERMS)]
        moment, weight = moments_of_singletons(floats, places, memory, degrees, terms)
        if weight == 0.0:
            memory[u(base + ints[u(output + OUT_ACTIVE)])] = 0.0
            if ints[u(output + OUT_KEEP)] == 0:
                memory[u(base + ints[u(output + OUT_VALUE)])] = floats[u(places + terms)]
        else:
            memory[u(base + ints[u(output + OUT_ACTIVE)])] = 1.0
            memory[u(base + ints[u(output + OUT_VALUE)])] = moment / weight
        output += OUTPUT_SIZE


@inlined
def infer(ints: Ints, floats: Floats, at: int, memory: Floats, base: int) -> None:
    """Evaluate the program at `ints[at]` once, on the instance memory at `memory[base]`.

    Reads the inputs and, for NC, the outputs; writes the outputs, their flags,
    the degrees of the rules and of all terms. Inputs are finite: callers see
    to that (S37).
    """
    clear(ints, at, memory, base)
    mask = fuzzify(ints, floats, at, memory, base)
    if ints[u(at + BROUGHT)] > 0:
        bring(ints, at, memory, base)
    visit(ints, floats, at, mask, 0, memory, base)
    for word in range(1, ints[u(at + WORDS)]):
        visit(ints, floats, at, mask_of(ints, at, memory, base, word), word, memory, base)
    defuzzify(ints, floats, at, memory, base)

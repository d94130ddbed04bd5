"""`infer`: one evaluation of a function block, as A.2.3 lists the steps.

Fuzzify, aggregate, activate, weight, accumulate, defuzzify (S23). Activation
does nothing to singletons (Table 4), so a rule's weighted result is its degree
times its weight; of an area, rules leave the degrees from which `areas` makes
it. Only rules that can fire in the cell of every input are visited: a mask of
rules per cell, joined over the inputs, and of long masks only words whose bit
in the summary is set.
"""

from numpy import float64, int64
from numpy.typing import NDArray

from fcl_sim.arithmetic.defuzzify import moments_of_singletons
from fcl_sim.arithmetic.operators import clamped, maximum, minimum
from fcl_sim.arithmetic.pairs import disjunction
from fcl_sim.engine.aggregate import aggregate
from fcl_sim.engine.clear import clear
from fcl_sim.engine.curved import CURVED, Curved
from fcl_sim.engine.fuzzify import fuzzify
from fcl_sim.engine.hedged import conclude_hedged
from fcl_sim.engine.moving import fuzzify_moved, sourced
from fcl_sim.engine.program import (
    ALL,
    BRING,
    BRING_INPUT,
    BRING_NOT,
    BRING_SIZE,
    BRING_SLOT,
    BROUGHT,
    BY_COGS,
    CLAMPS,
    DE_BRUIJN,
    DEGREES,
    FLOATS,
    GRIDS,
    GROUP_BSUM,
    GROUP_NSUM,
    MASK_BITS,
    MORE,
    OUT_ACTIVE,
    OUT_DEGREES,
    OUT_GROUPS,
    OUT_KEEP,
    OUT_KIND,
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
    RULE_LENGTH,
    RULE_THEN,
    RULES,
    SUMMARY,
    THEN_DEGREE,
    THEN_SIZE,
    THEN_SUM,
    THEN_WEIGHT,
    VISITED,
    WORDS,
)
from fcl_sim.engine.settle import settle
from fcl_sim.jit import flat, inlined, u

Ints = NDArray[int64]
Floats = NDArray[float64]


@flat
def clear_visited(ints: Ints, at: int, memory: Floats, base: int) -> None:
    """Set the degrees of those rules to 0 whose words of the mask the last evaluation visited."""
    visited = base + ints[u(at + VISITED)]
    degrees = base + ints[u(at + DEGREES)]
    for entry in range(visited + 1, visited + 1 + int(memory[u(visited)])):
        start = degrees + MASK_BITS * int(memory[u(entry)])
        for word in range(start, min(start + MASK_BITS, degrees + ints[u(at + RULES)])):
            memory[u(word)] = 0.0
    memory[u(visited)] = 0.0


@flat
def joined_word(ints: Ints, at: int, memory: Floats, base: int, word: int) -> int:
    """Return a word of the summary and mask of rules that can fire."""
    mask = int(ints[u(at + ints[u(at + ALL)] + word)])
    rows = base + ints[u(at + ROWS)]
    for index in range(ints[u(at + GRIDS)]):
        mask &= int(ints[u(at + int(memory[u(rows + index)]) + word)])
    return mask


@flat
def next_word(ints: Ints, at: int, memory: Floats, base: int, word: int) -> int:
    """Return the next word of the mask, from `word` on, with its bit in the summary; WORDS after the last."""
    part = word // MASK_BITS
    passed = word % MASK_BITS
    while part < ints[u(at + SUMMARY)]:
        bits = joined_word(ints, at, memory, base, part) >> passed << passed
        if bits != 0:
            found = part * MASK_BITS + place_of(bits & -bits)
            visited = base + ints[u(at + VISITED)]
            memory[u(visited)] += 1.0
            memory[u(visited + int(memory[u(visited)]))] = found
            return found
        part += 1
        passed = 0
    return int(ints[u(at + WORDS)])


@inlined
def place_of(bit: int) -> int:
    """Return the number of a bit."""
    place = 0
    while bit > 1:
        bit >>= 1
        place += 1
    return place


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


@inlined
def conclude(
    ints: Ints, floats: Floats, at: int, origin: int, rule: int, degree: float, memory: Floats, base: int
) -> None:
    """Weight and accumulate the conclusions of a rule that fires with `degree`."""
    then = rule + RULE_BODY + ints[u(rule + RULE_LENGTH)]
    for _ in range(ints[u(rule + RULE_THEN)]):
        source = ints[u(then + THEN_WEIGHT)]
        weighted = degree
        if source != 0:
            weighted = sourced(source, floats, origin, memory, base) * degree
        target = base + ints[u(then + THEN_DEGREE)]
        how = ints[u(then + THEN_SUM)]
        if how == 0:
            memory[u(target)] = maximum(memory[u(target)], weighted)
        elif how == 1:
            memory[u(target)] += weighted
        elif how < 0:
            memory[u(target)] = disjunction(how, memory[u(target)], weighted)
        else:
            weight = sourced(source, floats, origin, memory, base)
            conclude_hedged(ints, at + how, weight, degree, memory, target)
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
        conclude(ints, floats, at, origin, rule, degree, memory, base)


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
def defuzzify(ints: Ints, floats: Floats, at: int, memory: Floats, base: int, curved: Curved) -> None:
    """Write each output and its flag; without an active rule, the DEFAULT or nothing (S30, S31)."""
    origin = ints[u(at + FLOATS)]
    output = at + ints[u(at + OUTPUT)]
    for _ in range(ints[u(at + OUTPUTS)]):
        if ints[u(output + OUT_GROUPS)] > 0:
            finish_groups(ints, at, output, memory, base)
        places = origin + ints[u(output + OUT_PLACES)]
        terms = ints[u(output + OUT_TERMS)]
        if ints[u(output + OUT_KIND)] == BY_COGS:
            degrees = base + ints[u(output + OUT_DEGREES)]
            moment, weight = moments_of_singletons(floats, places, memory, degrees, terms)
            value = moment / weight if weight != 0.0 else 0.0
        else:
            value, weight = settle(ints, floats, at, output, memory, base, curved)
        if weight == 0.0:
            memory[u(base + ints[u(output + OUT_ACTIVE)])] = 0.0
            if ints[u(output + OUT_KEEP)] == 0:
                memory[u(base + ints[u(output + OUT_VALUE)])] = floats[u(places + terms)]
        else:
            memory[u(base + ints[u(output + OUT_ACTIVE)])] = 1.0
            memory[u(base + ints[u(output + OUT_VALUE)])] = value
        output += OUTPUT_SIZE


@inlined
def accumulate(ints: Ints, floats: Floats, at: int, memory: Floats, base: int) -> None:
    """Take all steps but defuzzification; arguments as of `infer`."""
    words = 1
    summary = 0
    if ints[u(at + MORE)] != 0:
        words = ints[u(at + WORDS)]
        summary = ints[u(at + SUMMARY)]
        if summary > 0:
            clear_visited(ints, at, memory, base)
    clear(ints, at, memory, base)
    mask = fuzzify(ints, floats, at, memory, base)
    word = 0
    if ints[u(at + MORE)] != 0:
        bring(ints, at, memory, base)
        fuzzify_moved(ints, floats, at, memory, base)
        if summary > 0:
            word = next_word(ints, at, memory, base, 0)
            mask = joined_word(ints, at, memory, base, summary + word) if word < words else 0
    while word < words:
        visit(ints, floats, at, mask, word, memory, base)
        word += 1
        if summary > 0:
            word = next_word(ints, at, memory, base, word)
        if word >= words:
            break
        mask = joined_word(ints, at, memory, base, summary + word)


@inlined
def infer(ints: Ints, floats: Floats, at: int, memory: Floats, base: int) -> None:
    """Evaluate the program at `ints[at]` once, on the instance memory at `memory[base]`.

    Reads the inputs and, for NC, the outputs; writes the outputs, their flags,
    the degrees of the rules and of all terms. Inputs are finite: callers see
    to that (S37). The program has no area under a norm of the Open Level.
    """
    accumulate(ints, floats, at, memory, base)
    defuzzify(ints, floats, at, memory, base, None)


@inlined
def infer_curved(ints: Ints, floats: Floats, at: int, memory: Floats, base: int) -> None:
    """Evaluate a program with areas under norms of the Open Level once; else as `infer`."""
    accumulate(ints, floats, at, memory, base)
    defuzzify(ints, floats, at, memory, base, CURVED)

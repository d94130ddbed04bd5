"""Program: a function block as two flat buffers, and the table of their offsets.

A program is one integer buffer, one float buffer, and the instance memory that
they describe. Offsets marked (i) count from the program's first word in the
integer buffer, (f) from its first word in the float buffer, (m) from the first
word of the instance memory. Several programs may share buffers: `infer` is told
where the integers begin, and the header's FLOATS says where the floats begin.

Header (i):
    FLOATS        where the program's floats begin in the float buffer
    RULES         number of rules
    WORDS         words of a rule mask: bit r % 32 of word r // 32 stands for rule r
    ALL           (i) mask of all rules, WORDS words
    GRIDS         number of fuzzified variables
    GRID          (i) their records, GRID_SIZE words each
    BROUGHT       number of variables brought in as degrees or weights (S27)
    BRING         (i) their records, BRING_SIZE words each
    RULE          (i) table: where each rule's record begins (i); 32 entries to a mask word, and within
                  them, in place of bit b, the entry (DE_BRUIJN << b >> 27) & 31
    OUTPUTS       number of outputs
    OUTPUT        (i) their records, OUTPUT_SIZE words each
    DEGREES       (m) degree of each rule; where clearing begins
    CLEARED       number of words to clear before each evaluation, a multiple of 4
    CLAMPS        (m) how many variables brought in lay outside [0, 1]
    ROWS          (m) where each grid's current words of its mask begin (i, from the buffer's first word);
                  used with WORDS > 1
    STACK         (m) stack of the postfix code

Grid record (i), one for each fuzzified variable:
    GRID_INPUT    (m) the variable
    GRID_COUNT    number of knots, filled up with NaN to 4, to 8, or to a power of 4 above it
    GRID_KNOTS    (f) the knots, strictly rising
    GRID_WIDTH    segments per cell, at least 2; cell 2 k is the interval before knot k, cell 2 k + 1 the
                  knot itself
    GRID_ROWS     (i) a row of GRID_WIDTH + WORDS words per cell: the slots (m) whose degrees the segments
                  give, and the mask of the rules that can fire there
    GRID_SEGMENTS (f) by cell and segment: origin, value, run; slots without a segment have degree 0

Record of a variable brought in (i):
    BRING_INPUT   (m) the variable
    BRING_SLOT    (m) its degree, clamped
    BRING_NOT     (m) 1 minus its degree

Rule record (i), of varying length:
    RULE_KIND     ALL_MIN or ALL_PROD: AND over slots; CODE: postfix code
    RULE_LENGTH   number of slots, or of words of code
    RULE_THEN     number of conclusions
    RULE_DEGREE   (m) its degree of firing
    RULE_BODY …   slots (m); in code a slot is a push, a negative word an operator
    … conclusions, THEN_SIZE words each:
    THEN_DEGREE   (m) the accumulated degree
    THEN_SUM      0: accumulate by MAX; 1: sum (BSUM and NSUM are finished with the output)
    THEN_WEIGHT   0: weight 1; above: (f) of a constant; below: -1 - (m) of a variable's slot

Output record (i):
    OUT_VALUE     (m) the output
    OUT_ACTIVE    (m) its flag
    OUT_TERMS     number of terms, made even by one that nothing concludes on
    OUT_PLACES    (f) places of the singletons, then the DEFAULT
    OUT_DEGREES   (m) accumulated degrees: OUT_GROUPS times OUT_TERMS; the first group takes the result
    OUT_GROUPS    accumulations: more than one only where rule blocks disagree on ACCU (S26);
                  0: one, by MAX, with nothing to finish
    OUT_KINDS     (i) the algorithm of each: GROUP_MAX, GROUP_BSUM or GROUP_NSUM
    OUT_KEEP      1: NC, the previous value stays when no rule is active; 0: the DEFAULT is taken

Floats begin with an unused word, so that no offset of a weight is 0.

Instance memory (m), a head that traces record and the work behind it:
    inputs | outputs | active flags | degrees of the rules |
    slots | accumulated degrees | spill | clamps | rows | stack
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

(
    FLOATS,
    RULES,
    WORDS,
    ALL,
    GRIDS,
    GRID,
    BROUGHT,
    BRING,
    RULE,
    OUTPUTS,
    OUTPUT,
    DEGREES,
    CLEARED,
    CLAMPS,
    ROWS,
    STACK,
    HEADER_SIZE,
) = range(17)

GRID_INPUT, GRID_COUNT, GRID_KNOTS, GRID_WIDTH, GRID_ROWS, GRID_SEGMENTS, GRID_SIZE = range(7)
BRING_INPUT, BRING_SLOT, BRING_NOT, BRING_SIZE = range(4)
RULE_KIND, RULE_LENGTH, RULE_THEN, RULE_DEGREE, RULE_BODY = range(5)
THEN_DEGREE, THEN_SUM, THEN_WEIGHT, THEN_SIZE = range(4)
(
    OUT_VALUE,
    OUT_ACTIVE,
    OUT_TERMS,
    OUT_PLACES,
    OUT_DEGREES,
    OUT_GROUPS,
    OUT_KINDS,
    OUT_KEEP,
    OUTPUT_SIZE,
) = range(9)

ALL_MIN, ALL_PROD, CODE = range(3)
NOT, AND_MIN, AND_PROD, AND_BDIF, OR_MAX, OR_ASUM, OR_BSUM = range(-1, -8, -1)
GROUP_MAX, GROUP_BSUM, GROUP_NSUM = range(3)

MASK_BITS = 32
DE_BRUIJN = 0x077CB531
"""Times a power of two below 2**32, bits 27 to 31 of the product tell which one."""
SEGMENT_SIZE = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class Layout:
    """Where named things lie in the instance memory (m); names are case-folded (S1).

    `terms` holds the degrees of input terms by (variable, term), `complements`
    those of NOT term where a condition takes it, `brought` the variables
    brought in, `accumulated` the final degrees of output terms; `clamps` counts
    how many of `brought` lay outside [0, 1] in the last evaluation.
    """

    terms: Mapping[tuple[str, str], int]
    complements: Mapping[tuple[str, str], int]
    brought: Mapping[str, int]
    accumulated: Mapping[tuple[str, str], int]
    clamps: int


@dataclass(frozen=True, kw_only=True, eq=False)
class Program:
    """A function block ready to be evaluated; the table of offsets heads this file.

    `initial` is an instance's memory before its first call: inputs and outputs
    at their initial values, declared or 0. `rule_labels` are unique: led by the
    rule block's name where there are several, numbered where one repeats.
    """

    name: str
    ints: NDArray[np.int64]
    floats: NDArray[np.float64]
    initial: NDArray[np.float64]
    input_names: tuple[str, ...]
    output_names: tuple[str, ...]
    rule_labels: tuple[str, ...]
    layout: Layout

    @property
    def size(self) -> int:
        """Words of an instance's memory."""
        return self.initial.size

    @property
    def outputs_at(self) -> int:
        """Offset of the outputs in the memory."""
        return len(self.input_names)

    @property
    def active_at(self) -> int:
        """Offset of the flags: 1.0 when a rule was active for the output, else 0.0."""
        return len(self.input_names) + len(self.output_names)

    @property
    def degrees_at(self) -> int:
        """Offset of the rules' degrees of firing, after aggregation."""
        return len(self.input_names) + 2 * len(self.output_names)

    @property
    def recorded(self) -> int:
        """Words at the head of the memory that a trace records: inputs, outputs, flags, rule degrees."""
        return self.degrees_at + len(self.rule_labels)

    def placed(self, floats_at: int) -> NDArray[np.int64]:
        """Return the integers for a shared float buffer in which `floats` begins at `floats_at`."""
        ints = self.ints.copy()
        ints[FLOATS] = floats_at
        return ints

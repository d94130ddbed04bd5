"""Program: a function block as two flat buffers, and the table of their offsets.

A program is one integer buffer, one float buffer, and the instance memory that
they describe. Offsets marked (i) count from the program's first word in the
integer buffer, (f) from its first word in the float buffer, (m) from the first
word of the instance memory. Several programs may share buffers: `infer` is told
where the integers begin, and the header's FLOATS says where the floats begin.

A source is one word that says where a number comes from: 0 is 1.0; above 0, a
constant (f); below 0, the word (m) -1 - source of the instance memory.

Header (i):
    FLOATS        where the program's floats begin in the float buffer
    RULES         number of rules
    WORDS         words of a rule mask: bit r % 32 of word r // 32 stands for rule r
    SUMMARY       words of its summary, in which bit w stands for word w of the mask; none for few words
    ALL           (i) mask of all rules: SUMMARY words, WORDS words
    GRIDS         number of inputs with a grid
    GRID          (i) their records, GRID_SIZE words each
    BROUGHT       number of variables brought in as degrees or weights (S27)
    BRING         (i) their records, BRING_SIZE words each
    MOVED         number of terms of inputs with points moved by variables, or with smooth curves
    MOVE          (i) their records
    RULE          (i) table: where each rule's record begins (i); 32 entries to a mask word, and within
                  them, in place of bit b, the entry (DE_BRUIJN << b >> 27) & 31
    OUTPUTS       number of outputs
    OUTPUT        (i) their records, OUTPUT_SIZE words each
    DEGREES       (m) degree of each rule
    CLEAR         (m) where clearing begins before each evaluation
    CLEARED       (m) where it ends, a multiple of CLEARED_TOGETHER words later
    CLAMPS        (m) how many variables brought in lay outside [0, 1]
    VISITED       (m) with SUMMARY > 0: how many words of the mask were visited, and which
    ROWS          (m) with WORDS > 1: the GRID_MASK of the grids, one after the other
    STACK         (m) stack of the postfix code
    MORE          1 where WORDS is above 1, or BROUGHT or MOVED above 0; else 0
    JOINT         (i) table by joint cell, the sum of each input's cell times its GRID_STRIDE: where its
                  record begins (i); 0 in a program that has none
    JOINT_HELD    (m) where the record of the joint cell of the last evaluation begins (i)
    JOINT_PAIRS   pairs of segments per cell
    TOGETHER      which steps are taken for many points together: ONE_BY_ONE none, UP_TO_RULES all but
                  defuzzification, ALL_TOGETHER all

Grid record (i), one for each input that has terms with constant points:
    GRID_INPUT    (m) the variable
    GRID_COUNT    number of knots, filled up with NaN to 8 or a power of 4, and to more than there are
    GRID_KNOTS    (f) the knots, strictly rising
    GRID_WIDTH    segments per cell, an even number; cell 2 k is the interval before knot k, cell 2 k + 1 the
                  knot itself
    GRID_ROWS     (i) a row per cell: the first word of the mask of the rules that can fire there, the slots
                  (m) whose degrees the segments give, and where WORDS is above 1 the whole mask
    GRID_CELLS    (f) by cell: the least and the greatest number in it, then its segments in pairs
                  (arithmetic.membership); slots without a segment have degree 0
    GRID_ROW_SIZE words of a row
    GRID_PIECES   numbers of a cell
    GRID_MASK     (m) with WORDS > 1: where the mask of its cell now begins (i); else 0
    GRID_STRIDE   what the number of its cell counts in that of the joint cell
    GRID_CELL     (m) the cell at the last evaluation
    GRID_MORE     1 where GRID_WIDTH is above 2 or GRID_MASK is not 0; else 0

Record of a variable brought in (i):
    BRING_INPUT   (m) the variable
    BRING_SLOT    (m) its degree, clamped
    BRING_NOT     (m) 1 minus its degree

Record of a moved term of an input (i), of varying length:
    MOVE_INPUT    (m) the variable
    MOVE_SLOT     (m) its degree
    MOVE_NOT      (m) 1 minus its degree
    MOVE_LOW      (f) the ends of where the variable is taken
    MOVE_COUNT    number of points
    … points, SPOT_SIZE words each: SPOT_X, a source; SPOT_DEGREE (f)
or of a curve (i), CURVE_SIZE words, where MOVE_COUNT is -1 - its kind (arithmetic.curves):
    CURVE_HEIGHT  a source
    … its parameters, as many sources as any kind has

Rule record (i), of varying length:
    RULE_KIND     ALL_MIN or ALL_PROD: AND over slots; CODE: postfix code
    RULE_LENGTH   number of slots, two at least (one alone stands there twice), or of words of code
    RULE_THEN     number of conclusions
    RULE_DEGREE   (m) its degree of firing
    RULE_BODY …   slots (m); in code, two words are a push: the slots of a degree and of 1 minus it; a
                  negative word is an operator, a hedge, ONE (push the degree 1), or LOOK - word the look
                  record (i) of what to push
    … conclusions, THEN_SIZE words each:
    THEN_DEGREE   (m) the accumulated degree
    THEN_SUM      0: accumulate by MAX; 1: sum (BSUM and NSUM are finished with the output); below 0: by the
                  S-norm of which this is the T-norm, AND_PROD and so on; above 1: (i) a hedged conclusion
    THEN_WEIGHT   a source

Record of a hedged conclusion (i), of varying length:
    HEDGED_SUM    how it accumulates, as THEN_SUM
    HEDGED_COUNT  number of hedges
    HEDGED_FIRST … the hedges, in the order in which they are applied to the rule's degree

Look record (i), a degree that the rules before have accumulated (S27a, S29):
    LOOK_TERM     which term of the variable
    LOOK_TERMS, LOOK_DEGREES, LOOK_GROUPS, LOOK_KINDS   as OUT_TERMS and so on

Output record (i):
    OUT_VALUE     (m) the output
    OUT_ACTIVE    (m) its flag
    OUT_KIND      BY_COGS: CoGS of constant singletons; BY_DEGREE: a degree given out (S28);
                  BY_SINGLETONS: other singletons; BY_AREA: terms with areas
    OUT_TERMS     number of terms, made even by one that nothing concludes on; 0 BY_AREA
    OUT_PLACES    (f) places of the singletons, then the DEFAULT
    OUT_DEGREES   (m) accumulated degrees: OUT_GROUPS times OUT_TERMS; the first group takes the result
    OUT_GROUPS    accumulations: more than one only where rule blocks disagree on ACCU (S26);
                  0: one, by MAX, with nothing to finish
    OUT_KINDS     (i) the algorithm of each: GROUP_MAX, GROUP_BSUM, GROUP_NSUM, GROUP_SUM or GROUP_NORM
    OUT_KEEP      1: NC, the previous value stays when no rule is active; 0: the DEFAULT is taken
    OUT_METHOD    METHOD_COG, METHOD_COA, METHOD_LM, METHOD_RM, METHOD_MM or METHOD_SUM
    OUT_MORE      (i) BY_SINGLETONS: a source for each place, the number of formulas, their records; BY_AREA:
                  the area record
    OUT_LIMITS    (f) where the result is taken no further than a range: its two ends; else 0

Record of a joint cell (i), for each grid:
    MET_INPUT     (m) the variable
    MET_CELL      (f) its cell, as in GRID_CELLS
    MET_SLOTS …   2 JOINT_PAIRS slots (m) whose degrees the segments give
    and its list, for each output the number of terms that can be concluded, and for each of these:
    FIRED_TERM    which term
    FIRED_RULES   number of rules
    … rules: slots (m) of the degrees of which each takes the least, two at least; FIRED_DEGREE - RULE_DEGREE

Formula record (i), a place calculated at each evaluation:
    FORMULA_VALUE  (m) the place
    FORMULA_STACK  (m) stack of the postfix code
    FORMULA_LENGTH number of words of code
    FORMULA_CODE … two words push a number: FORMULA_PUSH, a source; others are operators (arithmetic.formulas)

Area record (i):
    AREA_LOW      (f) the lower and the upper limit of the range
    AREA_HULL     1: there is no RANGE and points move, so that the hull of the points is taken instead
    AREA_MOVED    number of terms to place at each evaluation: all of them or, where no point moves, none
    AREA_MOVE     (i) their records: TERM_AT (m) where its points go, TERM_END (m) where that of the last of
                  them is kept, TERM_COUNT the number of points, then the points as in a moved term
    AREA_GROUPS   accumulations, as OUT_GROUPS, but at least 1
    AREA_GROUP    (i) for each: its algorithm, the number of its parts; and the parts, of varying length:
                  PART_TERM, the source of its term's points; PART_END (m) as TERM_END, or -1 - their number;
                  PART_PAIRS; then as many pairs of sources: the degree where activation cuts off the
                  term, and what the rest is multiplied by;
                  or GROUP_CURVED, and where its record begins (i)
    AREA_LEVELS   (m) levels of activation
    AREA_PART     (m) the activated part
    AREA_LINE     (m) three accumulated polylines, one after the other
    AREA_ROOM     words of each
    AREA_RESULT   (m) where the accumulated area begins and ends (m)

Curved accumulation (i), by norms that do not leave areas as they cut polylines (engine.curved):
    CURVED_KIND   GROUP_MAX, GROUP_BSUM, GROUP_NSUM or GROUP_SUM; below 0, by the S-norm of which this is the
                  T-norm
    CURVED_TERMS, CURVED_PAIRS   numbers of terms and of pairs
    CURVED_TRACKS (m) where the terms are followed
    CURVED_HELD   (m) the pairs that count
    CURVED_STACK  (m) stack of what is still to be halved
    CURVED_FIRST … CURVED_TERM words for each term: as PART_TERM, PART_END; then CURVED_PAIR words for each
                  pair: the number of its term, the T-norm that activates, and two sources: the degree that
                  activates, and the weight

Points are three words each (arithmetic.polyline).

Floats (f) begin with what their precision sets, so that no offset of a constant is 0:
    LIMIT         variables on an axis are taken no further than this, up or down
    TIE           degrees, or areas, whose ratio lies between this and 1 are equal: they were rounded

Instance memory (m), a head that traces record and the work behind it:
    inputs | outputs | active flags | degrees of the rules |
    slots | accumulated degrees | spill | clamps | cells | joint cell | visited | rows | stack | areas
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

(
    FLOATS,
    RULES,
    WORDS,
    SUMMARY,
    ALL,
    GRIDS,
    GRID,
    BROUGHT,
    BRING,
    MOVED,
    MOVE,
    RULE,
    OUTPUTS,
    OUTPUT,
    DEGREES,
    CLEAR,
    CLEARED,
    CLAMPS,
    VISITED,
    ROWS,
    STACK,
    MORE,
    JOINT,
    JOINT_HELD,
    JOINT_PAIRS,
    TOGETHER,
    HEADER_SIZE,
) = range(27)

(
    GRID_INPUT,
    GRID_COUNT,
    GRID_KNOTS,
    GRID_WIDTH,
    GRID_ROWS,
    GRID_CELLS,
    GRID_ROW_SIZE,
    GRID_PIECES,
    GRID_MASK,
    GRID_STRIDE,
    GRID_CELL,
    GRID_MORE,
    GRID_SIZE,
) = range(13)
BRING_INPUT, BRING_SLOT, BRING_NOT, BRING_SIZE = range(4)
MOVE_INPUT, MOVE_SLOT, MOVE_NOT, MOVE_LOW, MOVE_COUNT, MOVE_SPOTS = range(6)
CURVE_HEIGHT, CURVE_PARAMETER, CURVE_SIZE = 5, 6, 10
SPOT_X, SPOT_DEGREE, SPOT_SIZE = range(3)
RULE_KIND, RULE_LENGTH, RULE_THEN, RULE_DEGREE, RULE_BODY = range(5)
THEN_DEGREE, THEN_SUM, THEN_WEIGHT, THEN_SIZE = range(4)
MET_INPUT, MET_CELL, MET_SLOTS = range(3)
FIRED_TERM, FIRED_RULES, FIRED_SIZE = range(3)
FIRED_DEGREE = -1
HEDGED_SUM, HEDGED_COUNT, HEDGED_FIRST = range(3)
LOOK_TERM, LOOK_TERMS, LOOK_DEGREES, LOOK_GROUPS, LOOK_KINDS, LOOK_SIZE = range(6)
(
    OUT_VALUE,
    OUT_ACTIVE,
    OUT_KIND,
    OUT_TERMS,
    OUT_PLACES,
    OUT_DEGREES,
    OUT_GROUPS,
    OUT_KINDS,
    OUT_KEEP,
    OUT_METHOD,
    OUT_MORE,
    OUT_LIMITS,
    OUTPUT_SIZE,
) = range(13)
(
    AREA_LOW,
    AREA_HULL,
    AREA_MOVED,
    AREA_MOVE,
    AREA_GROUPS,
    AREA_GROUP,
    AREA_LEVELS,
    AREA_PART,
    AREA_LINE,
    AREA_ROOM,
    AREA_RESULT,
    AREA_SIZE,
) = range(12)
FORMULA_VALUE, FORMULA_STACK, FORMULA_LENGTH, FORMULA_CODE = range(4)
TERM_AT, TERM_END, TERM_COUNT, TERM_SPOTS = range(4)
PART_TERM, PART_END, PART_PAIRS, PART_PAIR = range(4)
(
    CURVED_KIND,
    CURVED_TERMS,
    CURVED_PAIRS,
    CURVED_TRACKS,
    CURVED_HELD,
    CURVED_STACK,
    CURVED_FIRST,
) = range(7)
CURVED_TERM, CURVED_PAIR = 2, 4

ALL_MIN, ALL_PROD, CODE = range(3)
NOT = -1
AND_MIN, AND_PROD, AND_BDIF, AND_HPROD, AND_EPROD, AND_DPROD, AND_NMIN = range(-2, -9, -1)
OR_MAX, OR_ASUM, OR_BSUM, OR_HSUM, OR_ESUM, OR_DSUM, OR_NMAX = range(-9, -16, -1)
ONE, VERY, EXTREMELY, SOMEWHAT, SELDOM, LOOK = range(-16, -22, -1)
GROUP_MAX, GROUP_BSUM, GROUP_NSUM, GROUP_SUM, GROUP_NORM, GROUP_CURVED = range(6)
BY_COGS, BY_DEGREE, BY_SINGLETONS, BY_AREA = range(4)
METHOD_COG, METHOD_COA, METHOD_LM, METHOD_RM, METHOD_MM, METHOD_SUM = range(6)
ONE_BY_ONE, UP_TO_RULES, ALL_TOGETHER = range(3)

LIMIT, TIE, BOUNDS = range(3)

LARGEST = 1e300
"""Bound of the magnitudes in a rule base: sums and products of degrees with them stay finite."""

MASK_BITS = 32
CLEARED_TOGETHER = 8
DE_BRUIJN = 0x077CB531
"""Times a power of two below 2**32, bits 27 to 31 of the product tell which one."""
EDGES_SIZE = 2
FORMULA_PUSH = -1


Floats = NDArray[np.float64] | NDArray[np.float32]


def rule_entry(rule: int) -> int:
    """Return which entry of the table RULE is that of a rule, by its number from 0."""
    return rule - rule % MASK_BITS + ((DE_BRUIJN << rule % MASK_BITS >> 27) & 31)


@dataclass(frozen=True, slots=True, kw_only=True)
class Layout:
    """Where named things lie in the instance memory (m); names are case-folded (S1).

    `terms` holds the degrees of input terms by (variable, term), `complements`
    those of NOT term where a condition takes it, `brought` the variables
    brought in, `accumulated` the final degrees of singletons, and by (variable,
    None) that of an output without terms; `asked` those of other variables that
    conditions ask for, as they are before BSUM and NSUM are finished; `areas`
    by output the two words that hold where its accumulated area begins and
    ends, `places` by (variable, term) what its formula gave. `clamps` counts how many
    of `brought` lay outside [0, 1] in the last evaluation.
    """

    terms: Mapping[tuple[str, str], int]
    complements: Mapping[tuple[str, str], int]
    brought: Mapping[str, int]
    accumulated: Mapping[tuple[str, str | None], int]
    asked: Mapping[tuple[str, str | None], int]
    areas: Mapping[str, int]
    places: Mapping[tuple[str, str], int]
    clamps: int


@dataclass(frozen=True, kw_only=True, eq=False)
class Program:
    """A function block ready to be evaluated; the table of offsets heads this file.

    `initial` is an instance's memory before its first call: inputs and outputs
    at their initial values, declared or 0. `floats` and `initial` are of the
    program's precision. `rule_labels` are unique: led by the
    rule block's name where there are several, numbered where one repeats.
    `curved` tells whether an area is accumulated under a norm of the Open Level:
    that is compiled for such programs only.
    """

    name: str
    ints: NDArray[np.int64]
    floats: Floats
    initial: Floats
    input_names: tuple[str, ...]
    output_names: tuple[str, ...]
    rule_labels: tuple[str, ...]
    layout: Layout
    curved: bool

    @property
    def arithmetic(self) -> str:
        """Name of its arithmetic: LREAL or REAL."""
        return "REAL" if self.floats.dtype == np.float32 else "LREAL"

    @property
    def form(self) -> str:
        """What evaluates it: `joint` its table of joint cells, `curved` what follows curves, or `plain`."""
        return "joint" if self.ints[JOINT] > 0 else "curved" if self.curved else "plain"

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

    def without(self, rule: int) -> "Program":
        """Return the program in which a rule, by its place in `rule_labels`, concludes nothing."""
        ints = self.ints.copy()
        ints[ints[ints[RULE] + rule_entry(rule)] + RULE_THEN] = 0
        ints[JOINT] = 0
        return replace(self, ints=ints)

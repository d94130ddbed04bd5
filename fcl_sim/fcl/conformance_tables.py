"""Tables 8, 9 and 10 of the standard as we fill them in: each row, and what we do (clause 6.1)."""

from dataclasses import dataclass

from fcl_sim.model import Level

LEVELS = {8: Level.BASIC, 9: Level.EXTENSION, 10: Level.OPEN}

# fmt: off
SHAPES = (
    "TRIAN", "TRAPE", "GAUSS", "GAUSS2", "GBELL", "SIGM", "DSIGM", "COSINE",
    "Triangle", "Trapezoid", "Rectangle", "Ramp", "Binary", "Discrete", "Constant",
    "Gaussian", "GaussianProduct", "Bell", "Sigmoid", "SigmoidDifference", "SigmoidProduct", "ZShape",
    "SShape", "PiShape", "Spike", "Concave", "Cosine",
)
# fmt: on
"""Words for membership functions, jFuzzyLogic's first, then fuzzylite's, as they write them."""

AS_STATED = "yes"
"""What we do where we do what the standard says."""

IN_PART = "read and written back (S15); fcl-sim check names what of it this version does not evaluate"
"""What we do where the engine is behind the reader."""


@dataclass(frozen=True, slots=True)
class Row:
    """A row: its table, the element, its keyword, the details, and what we do.

    `name` is what other tables call the row.
    """

    name: str
    table: int
    element: str
    keyword: str
    details: str
    ours: str = AS_STATED

    @property
    def level(self) -> Level:
        """The conformance level that its table describes."""
        return LEVELS[self.table]


TABLE_8 = (
    Row(
        "declaration",
        8,
        "function block declaration",
        "VAR_INPUT, VAR_OUTPUT",
        "input and output variables",
        "yes; letter case does not count (S1), keywords may be names where nothing else can stand (S1a)",
    ),
    Row(
        "input term",
        8,
        "membership function, input variable",
        "TERM",
        "up to three constant points, degrees 0 or 1",
        "yes; at a vertical edge the larger degree holds (S21)",
    ),
    Row("output term", 8, "membership function, output variable", "TERM", "constant singletons"),
    Row("and", 8, "conditional aggregation", "AND", "MIN"),
    Row("activation", 8, "activation", "–", "of no effect on singletons"),
    Row(
        "accumulation",
        8,
        "accumulation",
        "ACCU",
        "MAX",
        "yes; singletons accumulate per term, not per position (S24); MAX, with a warning, where ACCU is "
        "missing (S11)",
    ),
    Row(
        "method",
        8,
        "defuzzification",
        "METHOD",
        "CoGS",
        "yes; where METHOD is missing, CoGS of singletons and CoG of areas, with a warning (S11)",
    ),
    Row(
        "default",
        8,
        "default value",
        "DEFAULT",
        "NC, value",
        "yes; it stands in while every accumulated degree is 0, a rule WITH 0 does not count (S30); NC, "
        "with a warning, where DEFAULT is missing (S11)",
    ),
    Row("rule block", 8, "rule block", "RULEBLOCK", "one"),
    Row("condition", 8, "condition", "IF … IS …", "n subconditions"),
    Row("conclusion", 8, "conclusion", "THEN", "one subconclusion"),
)

TABLE_9 = (
    Row(
        "local",
        9,
        "function block declaration",
        "VAR",
        "local variables",
        "yes; concluded in a rule before they stand in a condition (S29)",
    ),
    Row(
        "input points",
        9,
        "membership function, input variable",
        "TERM",
        "up to four constant or variable points, degrees 0 or 1",
        "yes; a point moved past its neighbour counts at the largest x so far (S22)",
    ),
    Row(
        "output points",
        9,
        "membership function, output variable",
        "TERM",
        "up to four constant or variable points, degrees 0 or 1",
        "yes, and variable singletons; areas and singletons in one variable are refused (S35)",
    ),
    Row("and pairs", 9, "conditional aggregation", "AND", "PROD, BDIF"),
    Row(
        "or",
        9,
        "conditional aggregation",
        "OR",
        "ASUM, BSUM",
        "yes, and MAX, which Table 3 pairs with MIN and Table 9 leaves out; a choice that is not the pair "
        "of AND is a warning (S10)",
    ),
    Row(
        "not",
        9,
        "conditional aggregation",
        "NOT",
        "1 - argument",
        "yes; before subconditions and parentheses",
    ),
    Row("parentheses", 9, "conditional aggregation", "( )", "", "yes; AND binds before OR (Table 6)"),
    Row("act", 9, "activation", "ACT", "MIN, PROD", "yes; MIN where ACT is missing (S11)"),
    Row(
        "accu",
        9,
        "accumulation",
        "ACCU",
        "BSUM, NSUM",
        "yes; NSUM divides by the largest sum over the whole range where that is above 1 (S25)",
    ),
    Row(
        "range",
        9,
        "range",
        "RANGE",
        "limits the output's membership functions",
        "yes, with one deviation (S32): where RANGE is missing and there are areas, the hull of the "
        "output's points is taken, with a warning, and not the range of its data type",
    ),
    Row(
        "areas",
        9,
        "defuzzification method",
        "METHOD",
        "CoG, CoA, LM, RM",
        "yes; exact, without samples (S33); LM and RM where the degree reaches its supremum (S34: Table 2 "
        "prints inf); CoA in the middle of a gap (S33a)",
    ),
    Row(
        "rule blocks",
        9,
        "rule block",
        "RULEBLOCK",
        "n rule blocks",
        "yes; on one output their results accumulate together; where they name different ACCU, each by "
        "its own and then by MAX, with a warning (S26)",
    ),
    Row(
        "variables",
        9,
        "condition",
        "IF",
        "n subconditions, n input variables",
        "yes; a variable without IS is a degree from outside, clamped to 0 … 1 (S27)",
    ),
    Row(
        "subconclusions",
        9,
        "conclusion",
        "THEN",
        "n subconclusions, n output variables",
        "yes; a variable without IS gives out the rule's degree (S28)",
    ),
    Row(
        "weight",
        9,
        "weighting factor",
        "WITH",
        "constant, or a variable of VAR_INPUT",
        "yes; of the subconclusion it follows (S12), times the activated result (S23)",
    ),
)

TABLE_10 = (
    Row("more points", 10, "more than four points", "TERM", "", "yes"),
    Row("degrees", 10, "degrees of points from 0 to 1", "TERM", "", "yes"),
    Row(
        "shape",
        10,
        "free membership functions",
        "TERM",
        ", ".join(SHAPES),
        "yes; of inputs by their formulae, of outputs, which then need a RANGE and constant parameters, as "
        "polylines within 1e-6 (S33)",
    ),
    Row(
        "singletons",
        10,
        "several single values in a term, or a single value in an input",
        "SINGLETONS",
        "",
        IN_PART,
    ),
    Row(
        "formula",
        10,
        "terms that are formulae",
        "FUNCTION, Function, Linear",
        "",
        "yes; a place calculated at each evaluation (S15)",
    ),
    Row(
        "norm",
        10,
        "further algorithms",
        "AND, OR, ACT, ACCU",
        "Hamacher, Einstein, drastic, nilpotent; ACT BDIF; ACCU ASUM, SUM",
        "yes; areas that are not piecewise linear under them as polylines within 1e-6, in REAL 1e-5 (S33); "
        "ACCU NMAX of areas not under HPROD or EPROD",
    ),
    Row("further method", 10, "further methods of defuzzification", "METHOD", "MM, COGSS", "yes (S15)"),
    Row(
        "further default",
        10,
        "default values that are NaN, or that hold the previous output",
        "DEFAULT",
        "nan; number | NC",
        "yes; with NC the number is given out before the first active rule (S15)",
    ),
    Row(
        "hedge",
        10,
        "hedges",
        "IS",
        "very, extremely, somewhat, seldom; in conditions also any, not",
        "yes; the last one is applied first (S15), in a conclusion to the rule's degree before activation",
    ),
    Row(
        "concluded",
        10,
        "outputs and local variables with terms in conditions",
        "IF",
        "y IS term",
        "yes; the degree that the rules before have accumulated (S27a)",
    ),
    Row("own accumulation", 10, "ACCU of a single output", "ACCU", "inside of DEFUZZIFY", "yes (S8)"),
    Row("input range", 10, "ranges of inputs", "RANGE", "in FUZZIFY, behind a declaration", "yes (S15)"),
    Row("lock", 10, "outputs held, or kept in their range", "LOCK", "PREVIOUS, RANGE", "yes (S15)"),
    Row("enabled", 10, "parts that can be switched off", "ENABLED", "TRUE, FALSE", "yes (S15)"),
    Row(
        "structure",
        10,
        "structure types and their members",
        "TYPE, STRUCT",
        "color.brown, color = brown (Annex D)",
        "yes (S7)",
    ),
    Row(
        "options",
        10,
        "additional information",
        "OPTIONS",
        "word for word",
        "kept and written back; nothing of it changes a result (S4)",
    ),
    Row(
        "form",
        10,
        "other forms of writing",
        "",
        "names that are no identifiers; missing semicolons, labels, names and choices; comments that begin "
        "with # or %",
        "yes, with a warning or a note (S5, S6, S9, S11, S15, S17)",
    ),
)

TABLES = {8: TABLE_8, 9: TABLE_9, 10: TABLE_10}

TITLES = {
    8: "Table 8: language elements of the Basic Level",
    9: "Table 9: language elements of the Extension Level",
    10: "Table 10: language elements of the Open Level",
}

ROWS = {row.name: row for table in TABLES.values() for row in table}

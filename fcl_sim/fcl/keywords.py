"""The words that the parser knows (5.4.2, Table 7, and what other readers add)."""

# fmt: off
ENDS = frozenset((
    "END_FUNCTION_BLOCK", "END_VAR", "END_FUZZIFY", "END_DEFUZZIFY", "END_RULEBLOCK",
    "END_OPTION", "END_OPTIONS", "END_TYPE", "END_STRUCT",
))
SECTIONS = frozenset((
    "VAR_INPUT", "VAR_OUTPUT", "VAR", "VAR_IN_OUT", "VAR_EXTERNAL", "VAR_GLOBAL", "VAR_TEMP",
    "FUZZIFY", "DEFUZZIFY", "RULEBLOCK", "OPTION", "OPTIONS",
))
STRUCTURAL = ENDS | SECTIONS | {
    "FUNCTION_BLOCK", "TERM", "RULE", "IF", "THEN", "IS", "AND", "OR", "NOT", "WITH",
}
"""Keywords that hold the text together: names only where nothing but a name can stand (S1a)."""

SETTINGS = {
    "METHOD": (":", ":="), "ACCU": (":", ":="), "ACT": (":", ":="), "AND": (":", ":="), "OR": (":", ":="),
    "DEFAULT": (":=", ":"), "RANGE": (":=", ":", "("),
}
"""Keywords that begin a statement only before one of these signs."""

HEDGES = frozenset(("VERY", "EXTREMELY", "SOMEWHAT", "SELDOM", "ANY"))
"""Hedges of other readers (S15); this version knows that it does not know them."""

OPEN_LEVEL_SHAPES = frozenset((
    "TRIAN", "TRAPE", "GAUSS", "GAUSS2", "GBELL", "SIGM", "DSIGM", "COSINE", "SINGLETONS", "FUNCTION",
    "TRIANGLE", "TRAPEZOID", "RECTANGLE", "GAUSSIAN", "GAUSSIANPRODUCT", "BELL", "SIGMOID",
    "SIGMOIDDIFFERENCE", "SIGMOIDPRODUCT",
    "RAMP", "ZSHAPE", "SSHAPE", "PISHAPE", "SPIKE", "CONCAVE", "CONSTANT", "LINEAR",
))
"""Membership functions of other readers (S15), likewise."""

OPEN_LEVEL_METHODS = frozenset(("COGF", "COGSS", "MM"))
"""Methods of defuzzification of other readers (S15), likewise."""

OPEN_LEVEL_OPERATORS = frozenset((
    "HPROD", "EPROD", "DPROD", "NMIN", "HSUM", "ESUM", "DSUM", "NMAX", "SUM",
))
"""Operators of other readers (S15), likewise."""
# fmt: on

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
    "DEFAULT": (":=", ":"), "RANGE": (":=", ":", "("), "LOCK": (":", ":="), "ENABLED": (":", ":="),
}
"""Keywords that begin a statement only before one of these signs."""

HEDGES = frozenset(("VERY", "EXTREMELY", "SOMEWHAT", "SELDOM", "ANY"))
"""Hedges of fuzzylite (S15): names where nothing follows that they could hedge."""

CONCLUDED_HEDGES = frozenset(("VERY", "EXTREMELY", "SOMEWHAT", "SELDOM"))
"""Those of them that may stand in a conclusion: they leave the degree 0 of a rule that does not fire at 0."""
# fmt: on

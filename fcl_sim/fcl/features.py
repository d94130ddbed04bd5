"""What a text can use beyond Tables 8 and 9: the vocabulary of the notes on a model (clause 6, S15)."""

FEATURES: dict[str, str] = {
    "accumulation": "ACCU of a single output",
    "comment": "comments that begin with # or %",
    "conclusion": "conclusions in parentheses",
    "default": "default values that are NaN, or that hold the previous output",
    "degree": "degrees of points other than 0 and 1",
    "enabled": "ENABLED: parts that can be switched off",
    "equals": "= in place of IS in conclusions",
    "formula": "terms that are formulae",
    "hedge": "hedges",
    "line comment": "comments to the end of the line (Table 11)",
    "lock": "LOCK: outputs held or kept in their range",
    "method": "methods of defuzzification other than those of Table 1",
    "none": "NONE in place of an algorithm",
    "norm": "algorithms other than those of Tables 3, 4 and 5",
    "options": "additional information for a target",
    "points": "more than four points",
    "range": "ranges of inputs and of declarations",
    "rule block name": "rule blocks whose name is not an identifier",
    "shape": "membership functions that are not written as points",
    "singletons": "terms of several single values, or of one in an input",
    "structure": "structure types and their members (Annex D)",
}
"""Codes of notes and what they stand for; the notes on slips have the codes of their findings."""

SLIPS = frozenset(
    (
        *("FCL206", "FCL214", "FCL216", "FCL217", "FCL218", "FCL220", "FCL221"),
        *("FCL334", "FCL335", "FCL336", "FCL341", "FCL342"),
    )
)
"""Findings that tell of a text that is read though the standard would have it otherwise."""

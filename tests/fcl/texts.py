"""Small rule bases for the tests of the reader, and what is done with them."""

from fcl_sim import fcl
from fcl_sim.diagnostics import Source

BATH = """\
FUNCTION_BLOCK bath
VAR_INPUT
    temp: REAL;
    level: REAL;
END_VAR
VAR_OUTPUT
    valve: REAL;
END_VAR
FUZZIFY temp
    TERM cold := (3, 1) (27, 0);
    TERM hot := (3, 0) (27, 1);
END_FUZZIFY
FUZZIFY level
    TERM low := (0, 1) (1, 0);
    TERM high := (0, 0) (1, 1);
END_FUZZIFY
DEFUZZIFY valve
    TERM closed := 0;
    TERM inlet := 100;
    METHOD: CoGS;
    DEFAULT := 0;
END_DEFUZZIFY
RULEBLOCK No1
    AND: MIN;
    ACCU: MAX;
    RULE 1: IF temp IS cold AND level IS low THEN valve IS inlet;
    RULE 2: IF temp IS hot OR level IS high THEN valve IS closed;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""


def changed(*edits):
    """Return BATH with each old text replaced once by its new one."""
    text = BATH
    for old, new in edits:
        assert old in text
        text = text.replace(old, new, 1)
    return text


def with_rule(rule):
    """Return BATH with `rule` in place of its first."""
    return changed(("RULE 1: IF temp IS cold AND level IS low THEN valve IS inlet;", rule))


def block(text):
    """Return the one function block of a text without errors."""
    reading = fcl.read(text)
    assert reading.errors == ()
    (found,) = reading.blocks
    return found


def codes(text):
    return [each.code for each in fcl.read(text).diagnostics]


def tree(text):
    return fcl.parse(fcl.scan(Source("t", text))).tree

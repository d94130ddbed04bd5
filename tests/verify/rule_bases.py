"""Small rule bases, and what was recorded of them without a loop around."""

from itertools import pairwise

import numpy as np

import fcl_sim
from fcl_sim.loop.trace import FuzzyRecord

HEATING = """
FUNCTION_BLOCK heating
VAR_INPUT {inputs} END_VAR
VAR_OUTPUT valve: {type}; END_VAR
FUZZIFY room
    TERM cold := (0, 1) (20, 0);
    TERM warm := (0, 0) (20, 1) (40, 0);
END_FUZZIFY
FUZZIFY wind
    TERM calm := (0, 1) (10, 0);
    TERM gale := (10, 0) (20, 1);
END_FUZZIFY
DEFUZZIFY valve
    TERM closed := 0;
    TERM half := 50;
    TERM open := 100;
    METHOD: CoGS;
    DEFAULT := {default};
END_DEFUZZIFY
RULEBLOCK one
    AND: MIN; ACCU: MAX;
    {rules}
END_RULEBLOCK
END_FUNCTION_BLOCK
"""
RULES = """
    RULE 1: IF room IS cold AND wind IS calm THEN valve IS half;
    RULE 2: IF room IS cold AND wind IS gale THEN valve IS open;
    RULE 3: IF room IS warm AND wind IS calm THEN valve IS closed;
    RULE 4: IF room IS warm AND wind IS gale THEN valve IS half;
"""


def heating(rules=RULES, default="NC", kind="LREAL"):
    inputs = f"room: {kind}; wind: {kind};"
    return fcl_sim.loads(
        HEATING.format(inputs=inputs, type=kind, default=default, rules=rules), "heating.fcl"
    )


def recorded(block, arithmetic, points, cold=()):
    """Return what an instance gives that is called point by point, and begins anew before `cold`."""
    parts = []
    for start, end in pairwise((0, *cold, len(points))):
        instance = block.instance(arithmetic)
        parts += [called(instance, block.inputs, point) for point in points[start:end]]
    inputs, outputs, degrees, active = (np.array(each, np.float64) for each in zip(*parts, strict=True))
    return FuzzyRecord(
        input_names=block.inputs,
        output_names=block.outputs,
        rule_labels=block.program.rule_labels,
        inputs=inputs,
        outputs=outputs,
        degrees=degrees / (10_000 if arithmetic == "INT" else 1),
        flags=active,
        cold=tuple(cold),
    )


def called(instance, names, point):
    instance(**dict(zip(names, map(float, point), strict=True)))
    values = (instance.inputs, instance.outputs, instance.degrees, instance.active)
    return [list(each.values()) for each in values]

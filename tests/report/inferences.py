"""Rule bases whose inference is drawn: few rules and many, areas, nested conditions, long names."""

from fcl_sim.block import Block, loads
from tests.report.synthetic import LONG

THREE = """FUNCTION_BLOCK three
VAR_INPUT distance: REAL; angle: REAL; END_VAR
VAR_OUTPUT power: REAL; END_VAR
FUZZIFY distance TERM medium := (5, 0) (10, 1) (22, 0); TERM far := (10, 0) (22, 1); END_FUZZIFY
FUZZIFY angle TERM zero := (-5, 0) (0, 1) (5, 0); TERM pos_small := (0, 0) (5, 1) (50, 0); END_FUZZIFY
DEFUZZIFY power TERM zero := 0; TERM pos_medium := 9; METHOD: CoGS; DEFAULT := 0; END_DEFUZZIFY
RULEBLOCK No1
    AND: MIN; ACCU: MAX;
    RULE 1: IF distance IS medium AND angle IS pos_small THEN power IS pos_medium;
    RULE 2: IF distance IS medium AND angle IS zero THEN power IS zero;
    RULE 3: IF distance IS far AND angle IS zero THEN power IS pos_medium;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""
"""The three rules of figure C.8."""

TIP = """FUNCTION_BLOCK tip
VAR_INPUT service: REAL; food: REAL; END_VAR
VAR_OUTPUT tip: REAL; END_VAR
FUZZIFY service
    TERM poor := (0, 1) (4, 0); TERM good := (1, 0) (4, 1) (6, 1) (9, 0); TERM excellent := (6, 0) (9, 1);
END_FUZZIFY
FUZZIFY food TERM rancid := (0, 1) (1, 1) (3, 0); TERM delicious := (7, 0) (9, 1); END_FUZZIFY
DEFUZZIFY tip
    TERM cheap := (0, 0) (5, 1) (10, 0); TERM average := (8, 0) (15, 1) (22, 0);
    TERM generous := (20, 0) (25, 1) (30, 0);
    METHOD: CoG; DEFAULT := NC; RANGE := (0 .. 28);
END_DEFUZZIFY
RULEBLOCK No1
    AND: MIN; OR: MAX; ACT: MIN; ACCU: MAX;
    RULE 1: IF service IS poor OR food IS rancid THEN tip IS cheap;
    RULE 2: IF service IS good THEN tip IS average WITH 0.8;
    RULE 3: IF service IS excellent AND food IS delicious THEN tip IS generous;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""

NESTED = """FUNCTION_BLOCK nested
VAR_INPUT temperature: REAL; x: REAL (0 .. 12); ready: REAL; limit: REAL := 5; END_VAR
VAR_OUTPUT speed: REAL; alarm: REAL; mode: REAL; END_VAR
VAR edge: REAL; END_VAR
FUZZIFY temperature TERM cool := (0, 1) (40, 0); TERM hot := SIGM 0.2 55; END_FUZZIFY
FUZZIFY x TERM near := (0, 1) (limit, 0); TERM far := (limit, 0) (10, 1); END_FUZZIFY
DEFUZZIFY speed
    TERM slow := FUNCTION 2 * x + 1; TERM fast := FUNCTION 100 - temperature / 2;
    METHOD: CoGS; DEFAULT := 0;
END_DEFUZZIFY
DEFUZZIFY alarm
    TERM off := (0, 1) (50, 0); TERM on := GBELL 20 3 90;
    METHOD: CoG; DEFAULT := NC; RANGE := (10 .. 90);
END_DEFUZZIFY
RULEBLOCK first
    AND: PROD; OR: ASUM; ACT: PROD; ACCU: BSUM;
    RULE 1: IF (x IS very near OR NOT (x IS far AND ready)) AND temperature IS NOT cool
            THEN speed IS slow WITH 0.7, alarm IS on, edge;
    RULE 2: IF x IS near AND temperature IS hot THEN speed IS fast WITH ready;
END_RULEBLOCK
RULEBLOCK second
    AND: MIN; OR: MAX; ACT: MIN; ACCU: MAX;
    RULE 1: IF edge AND x IS NOT far AND x IS near THEN alarm IS off WITH 0.5, mode;
    RULE 2: IF x IS far OR x IS near OR ready OR NOT ready OR x IS NOT near THEN mode;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""
"""Hedges, NOT, parentheses, degrees in and out, a local variable, formulae, smooth terms, two rule blocks."""


def three() -> Block:
    return loads(THREE, "three.fcl")


def tip(activation: str = "MIN", accumulation: str = "MAX") -> Block:
    return loads(TIP.replace("ACT: MIN; ACCU: MAX", f"ACT: {activation}; ACCU: {accumulation}"), "tip.fcl")


def nested() -> Block:
    return loads(NESTED, "nested.fcl")


def grid(count: int, *, smooth: bool = False) -> Block:
    """Return a base of `count` x `count` rules; with smooth terms all of them fire."""
    names = [f"t{index}" for index in range(count)]
    shapes = [
        f"TERM {name} := GAUSS {at} 0.6;"
        if smooth
        else f"TERM {name} := ({at - 1}, 0) ({at}, 1) ({at + 1}, 0);"
        for at, name in enumerate(names)
    ]
    places = [f"TERM {name} := {10 * at - 30};" for at, name in enumerate(names)]
    rules = [
        f"RULE {count * i + j + 1}: IF error IS {a} AND change IS {b} "
        f"THEN u IS {names[min(i + j, count - 1)]};"
        for i, a in enumerate(names)
        for j, b in enumerate(names)
    ]
    return loads(
        "FUNCTION_BLOCK grid VAR_INPUT error: REAL; change: REAL; END_VAR VAR_OUTPUT u: REAL; END_VAR\n"
        f"FUZZIFY error {' '.join(shapes)} END_FUZZIFY\nFUZZIFY change {' '.join(shapes)} END_FUZZIFY\n"
        f"DEFUZZIFY u {' '.join(places)} METHOD: CoGS; DEFAULT := 0; END_DEFUZZIFY\n"
        f"RULEBLOCK No1 AND: PROD; ACCU: BSUM;\n{chr(10).join(rules)}\nEND_RULEBLOCK\nEND_FUNCTION_BLOCK\n"
    )


def long_names() -> Block:
    """Return a base with names that no column is wide enough for."""
    name = LONG.replace(".", "_").replace("/", "_")
    return loads(f"""FUNCTION_BLOCK {name}_block
VAR_INPUT {name}_a: REAL; {name}_b: REAL; c: REAL; d: REAL; e: REAL; END_VAR
VAR_OUTPUT {name}_u: REAL; v: REAL; END_VAR
FUZZIFY {name}_a TERM {name}_low := (0, 1) (1, 0); TERM {name}_high := (0, 0) (1, 1); END_FUZZIFY
FUZZIFY {name}_b TERM {name}_low := (0, 1) (1, 0); TERM {name}_high := (0, 0) (1, 1); END_FUZZIFY
FUZZIFY c TERM one := 1; TERM two := SIGM 5 2; END_FUZZIFY
FUZZIFY d TERM one := (0, 0) (0, 1) (1, 1) (1, 0); TERM two := (2, 0) (3, 1); END_FUZZIFY
FUZZIFY e TERM one := (0, 1) (10, 0); END_FUZZIFY
DEFUZZIFY {name}_u
    TERM {name}_small := 0; TERM {name}_large := 1; METHOD: CoGS; DEFAULT := 0;
END_DEFUZZIFY
DEFUZZIFY v
    TERM {name}_small := GBELL 2 2 3; TERM large := (0, 0) (10, 1) (10, 0);
    METHOD: RM; DEFAULT := 0; RANGE := (0 .. 12);
END_DEFUZZIFY
RULEBLOCK {name}
    AND: MIN; OR: MAX; ACT: MIN; ACCU: NSUM;
    RULE {name}_1: IF {name}_a IS {name}_low AND {name}_b IS {name}_low AND c IS one AND d IS one AND e IS one
        THEN {name}_u IS {name}_small, v IS {name}_small;
    RULE 2: IF {name}_a IS {name}_high OR {name}_b IS {name}_high OR c IS two
        THEN {name}_u IS {name}_large, v IS large WITH 0.25;
END_RULEBLOCK
END_FUNCTION_BLOCK
""")


def long_inputs() -> dict[str, float]:
    name = LONG.replace(".", "_").replace("/", "_")
    return {f"{name}_a": 0.25, f"{name}_b": 0.125, "c": 1.0, "d": 0.0, "e": 3.3}

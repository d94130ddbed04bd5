"""A bench with a tank and three rules, of which it is known what becomes of each change."""

from pathlib import Path

TANK = """\
FUNCTION_BLOCK tank
VAR_INPUT level: LREAL; END_VAR
VAR_OUTPUT inlet: LREAL; END_VAR
FUZZIFY level
    TERM low  := (0, 1) (1, 0);
    TERM high := (0, 0) (1, 1);
    TERM over := (5, 0) (6, 1);
END_FUZZIFY
DEFUZZIFY inlet
    TERM shut := 0; TERM part := 1; TERM open := 2;
    METHOD: CoGS;
    DEFAULT := 0;
END_DEFUZZIFY
RULEBLOCK rules
    AND: MIN; ACCU: MAX;
    RULE 1: IF level IS low THEN inlet IS open;
    RULE 2: IF level IS high THEN inlet IS shut;
    RULE 3: IF level IS over THEN inlet IS shut;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""
"""The inlet is 2 (1 - level): with level' = inlet - level the level rises from 0 to 2/3 and never to 5."""

SETTLES = """
[[require]]
id = "T-1"
text = "The level settles at two thirds"
formula = "always[6 s, 8 s] (abs(tank.level - 0.6667) < 0.05)"
"""

SCENARIO = """\
title    = "A tank is filled"
duration = "8 s"
scan     = "50 ms"

[plant]
model      = "first_order"
name       = "tank"
outputs    = ["level"]
parameters = { gain = 1, time_constant = "1 s" }
inputs     = { input = "rules.inlet" }

[blocks.rules]
type   = "fuzzy"
file   = "tank.fcl"
inputs = { level = "tank.level" }
"""


def write_bench(folder: Path, more: str = SETTLES, fcl: str = TANK) -> Path:
    """Write the bench into `folder`, `more` behind its scenario; return the scenario's file."""
    path = folder / "scenarios" / "fill.toml"
    path.parent.mkdir(parents=True)
    path.with_name("tank.fcl").write_text(fcl, "utf-8")
    path.write_text(SCENARIO + more, "utf-8")
    return path

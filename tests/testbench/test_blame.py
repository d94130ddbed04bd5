"""A run that ends early names what is to blame, not what comes of it."""

import pytest

from fcl_sim.testbench import run

RULES = """FUNCTION_BLOCK rules
VAR_INPUT error: REAL; rate: REAL; END_VAR
VAR_OUTPUT dv: REAL; END_VAR
FUZZIFY error TERM neg := (-100, 1) (100, 0); TERM pos := (-100, 0) (100, 1); END_FUZZIFY
FUZZIFY rate TERM neg := (-100, 1) (100, 0); TERM pos := (-100, 0) (100, 1); END_FUZZIFY
DEFUZZIFY dv TERM down := -100; TERM up := 100; METHOD: CoGS; DEFAULT := 0; END_DEFUZZIFY
RULEBLOCK all AND: MIN; ACCU: MAX;
RULE 1: IF error IS pos AND rate IS pos THEN dv IS up;
RULE 2: IF error IS neg OR rate IS neg THEN dv IS down;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""

SCENARIO = """
title    = "A plant that runs away from a controller that is too slow for it"
duration = "20 s"
scan     = "10 ms"

[plant]
model      = "transfer_function"
name       = "drive"
parameters = { numerator = [100.0], denominator = [1.0, -60.0, 1.0] }
inputs     = { voltage = "integral" }
outputs    = ["speed"]

[blocks]
setpoint = { type = "step", after = 1000.0, at = "0.5 s" }
error    = { type = "sum", terms = { setpoint = 1.0, "drive.speed" = -1.0 } }
rate     = { type = "differentiator", input = "error", filter = "0.05 s" }
integral = { type = "integrator", input = "rules.dv", low = 0.0, high = 120.0 }

[blocks.rules]
type   = "fuzzy"
file   = "rules.fcl"
units  = { rate = "1/s", dv = "1/s" }
inputs = { error = "error", rate = "rate" }
arithmetic = "REAL"
"""


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_a_number_that_a_rule_base_in_real_cannot_hold_is_named_and_not_the_plant_that_it_drives(tmp_path):
    (tmp_path / "rules.fcl").write_text(RULES)
    (tmp_path / "runaway.toml").write_text(SCENARIO)
    fault = run(tmp_path / "runaway.toml").base.trace.fault
    assert fault.signal == "rate"
    assert fault.reason == "`rate` exceeds what `rules.rate` can hold: it is REAL"

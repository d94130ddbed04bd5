"""Where a term counts: from a part of the strongest degree on, and what that finds."""

import numpy as np
import pytest

from fcl_sim.block import loads
from fcl_sim.diagnostics.page import page
from fcl_sim.proof.completeness import completeness
from fcl_sim.proof.prove import prove
from fcl_sim.proof.universe import universe_of
from tests.proof.bases import block_of, inside, random_text
from tests.proof.test_completeness import universe

BELLS = """
FUNCTION_BLOCK duty
VAR_INPUT
    error: REAL;
END_VAR
VAR_OUTPUT
    duty: REAL;
END_VAR
FUZZIFY error
    TERM low  := {shape};
    TERM none := {middle};
    TERM high := {other};
END_FUZZIFY
DEFUZZIFY duty
    TERM less := -1;
    TERM more := 1;
    METHOD: CoGS;
    DEFAULT := 0;
END_DEFUZZIFY
RULEBLOCK No1
    AND: {both};
    RULE 1: IF error IS low THEN duty IS more;
    RULE 2: IF error IS high THEN duty IS less;
    {rule}
END_RULEBLOCK
END_FUNCTION_BLOCK
"""
GAUSS = {"shape": "GAUSS -10 3", "middle": "GAUSS 0 3", "other": "GAUSS 10 3"}
BELL = {"shape": "GBELL 3 3 -10", "middle": "GBELL 3 3 0", "other": "GBELL 3 3 10"}
SET_POINT = "RULE 3: IF error IS none THEN duty IS more, duty IS less;"


def codes(text, epsilon):
    block = block_of(text)
    return [
        each.diagnostic.code
        for each in prove(block, universe_of(block), epsilon)
        if each.diagnostic.code < "FCL603"
    ]


@pytest.mark.parametrize("shapes", [GAUSS, BELL], ids=["gauss", "bell"])
def test_a_set_point_without_a_rule_is_found_by_epsilon_alone(shapes):
    text = BELLS.format(**shapes, both="MIN", rule="")
    assert codes(text, 0.05) == ["FCL602"]
    assert codes(text, 0.0) == []


@pytest.mark.parametrize("shapes", [GAUSS, BELL], ids=["gauss", "bell"])
@pytest.mark.parametrize("both", ["MIN", "PROD"])
def test_a_full_set_of_rules_is_not_hardly_defined(shapes, both):
    assert codes(BELLS.format(**shapes, both=both, rule=SET_POINT), 0.05) == []


def test_a_full_grid_under_prod_is_no_gap_however_many_inputs():
    assert codes(page("FCL602").mended.replace("MIN", "PROD"), 0.3) == []


def test_the_witness_shows_that_every_rule_has_a_weak_term():
    text = BELLS.format(**GAUSS, both="MIN", rule="")
    block = block_of(text)
    (proved,) = completeness(block, universe_of(block))
    at = {name: float(value) for name, value in proved.weak.witness.items()}
    degrees = [each.degree for each in loads(text).explain(**at).aggregated]
    assert 0.0 < max(degrees) < 0.05


@pytest.mark.parametrize("seed", range(12))
def test_what_hangs_together_with_a_gap_is_not_told_again(seed):
    block = block_of(random_text(seed))
    (proved,) = completeness(block, universe(block), 0.2)
    if proved.gap and proved.weak:
        gap_ends = [each for box in proved.gap.boxes for each in box.sides.values()]
        assert gap_ends
        assert not any(inside(box, proved.weak.witness) for box in proved.gap.boxes)


def test_the_seam_along_a_gap_is_no_finding_of_its_own():
    text = BELLS.format(
        shape="(0, 1) (4, 0)", middle="(1, 0) (4, 1) (9, 0)", other="(20, 0) (30, 1)", both="MIN", rule=""
    )
    assert codes(text, 0.05) == ["FCL601"]


def test_pieces_of_smooth_terms_leave_little_unknown():
    block = block_of(BELLS.format(**GAUSS, both="MIN", rule=""))
    (proved,) = completeness(block, universe_of(block))
    (box,) = proved.weak.boxes
    (side,) = box.sides.values()
    ends = np.array([float(side.low), float(side.high)])
    below = np.exp(-0.5 * ((ends - [-10, 10]) / 3) ** 2) / np.exp(-0.5 * (ends / 3) ** 2)
    assert below == pytest.approx([0.05, 0.05], rel=1e-4)

"""What another engine makes of a text is computed, and told where it matters."""

import numpy as np
import pytest

from fcl_sim.block import loads
from fcl_sim.diagnostics.page import frame
from fcl_sim.proof.prove import prove

SOUND = frame(complete=True)
RULE = "RULE 3: IF temp IS hot AND level IS low THEN valve IS drain;"


def notes(text):
    block = loads(text)
    return block, [each for each in prove(block.function_block) if each.diagnostic.code == "FCL631"]


def mixed(condition):
    return SOUND.replace(RULE, f"{RULE}\n    RULE 4: IF {condition} THEN valve IS inlet;")


@pytest.mark.parametrize(
    ("condition", "other"),
    [
        ("temp IS cold OR temp IS hot AND level IS high", "(temp IS cold OR temp IS hot) AND level IS high"),
        (
            "temp IS cold OR level IS low AND level IS high OR temp IS hot",
            "((temp IS cold OR level IS low) AND level IS high) OR temp IS hot",
        ),
    ],
)
def test_a_condition_without_parentheses_is_compared_with_its_reading_from_left_to_right(condition, other):
    block, (note,) = notes(mixed(condition))
    theirs = loads(mixed(other))
    at = {name: float(value) for name, value in note.witness.items()}
    ours, others = (float(each.evaluate(at)["valve"]) for each in (block, theirs))
    assert f"`valve` is {ours:.5g} here and {others:.5g} there" in note.diagnostic.message
    assert abs(ours - others) > 2.0


@pytest.mark.parametrize(
    "condition",
    [
        "temp IS cold OR (temp IS hot AND level IS high)",
        "temp IS hot AND level IS high OR temp IS cold",
        "temp IS cold OR temp IS hot",
    ],
)
def test_what_every_engine_reads_alike_is_not_told(condition):
    assert notes(mixed(condition))[1] == []


def test_operators_that_are_no_pair_are_compared_with_the_pair():
    block, (note,) = notes(SOUND.replace("AND: MIN;", "AND: PROD;\n    OR: MAX;"))
    assert note.diagnostic.message.startswith(
        "jFuzzyLogic takes AND: MIN with OR: MAX, whatever AND says: `valve` is "
    )
    at = {name: float(value) for name, value in note.witness.items()}
    ours, theirs = (float(each.evaluate(at)["valve"]) for each in (block, loads(SOUND)))
    assert abs(ours - theirs) > 2.0


def test_nsum_is_compared_with_bsum():
    text = SOUND.replace(RULE, "RULE 3: IF temp IS hot THEN valve IS drain;")
    block, (note,) = notes(text.replace("ACCU: MAX;", "ACCU: NSUM;"))
    theirs = loads(text.replace("ACCU: MAX;", "ACCU: BSUM;"))
    at = {name: float(value) for name, value in note.witness.items()}
    assert abs(float(block.evaluate(at)["valve"] - theirs.evaluate(at)["valve"])) > 2.0


def only(text):
    block, (note,) = notes(text)
    at = {name: float(value) for name, value in note.witness.items()}
    return note, at, float(block.evaluate(at)[note.variable])


def told(note):
    """Return what the message says that the other engine gives."""
    return float(note.diagnostic.message.split(" there")[0].split()[-1])


def test_weights_of_areas_are_compared_with_weights_before_activation():
    text = areas("WITH 0.5")
    note, at, ours = only(text)
    assert "weight a rule before activation, where A.15 multiplies the activated" in note.diagnostic.message
    u = np.linspace(0.0, 12.0, 100_001)
    one, other = 1.0 - at["a"] / 4.0, at["a"] / 4.0
    less_, more = np.interp(u, [0, 2, 4], [0, 1, 0]), np.interp(u, [4, 8, 12], [0, 1, 0])
    area = np.maximum(np.minimum(0.5 * one, less_), np.minimum(other, more))
    theirs = (u * area).sum() / area.sum()
    assert told(note) == pytest.approx(theirs, abs=1e-3)
    assert abs(ours - theirs) > 0.1
    assert notes(areas("WITH 0.5").replace("ACCU: MAX;", "ACT: PROD; ACCU: MAX;"))[1] == []


def areas(weight):
    return f"""
FUNCTION_BLOCK tank
VAR_INPUT a: REAL; END_VAR
VAR_OUTPUT y: REAL; END_VAR
FUZZIFY a TERM low := (0, 1) (4, 0); TERM high := (0, 0) (4, 1); END_FUZZIFY
DEFUZZIFY y
    TERM less := (0, 0) (2, 1) (4, 0);
    TERM more := (4, 0) (8, 1) (12, 0);
    RANGE := (0 .. 12); METHOD: CoG; DEFAULT := 0;
END_DEFUZZIFY
RULEBLOCK r
    ACCU: MAX;
    RULE 1: IF a IS low THEN y IS less {weight};
    RULE 2: IF a IS high THEN y IS more;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""


def test_two_rule_blocks_on_one_output_are_compared_with_either_alone():
    text = areas("").replace("    RULE 2:", "END_RULEBLOCK\nRULEBLOCK s\n    ACCU: MAX;\n    RULE 2:")
    note, at, ours = only(text)
    assert "lets one of the rule blocks on `y` replace what the others gave" in note.diagnostic.message
    alone = [float(loads(less(text, label)).evaluate(at)["y"]) for label in "12"]
    theirs = told(note)
    assert theirs in [float(f"{each:.5g}") for each in alone]
    assert abs(ours - theirs) > 1.0


def less(text, label):
    return "\n".join(each for each in text.splitlines() if not each.strip().startswith(f"RULE {label}:"))


def test_a_missing_accu_is_compared_with_a_sum():
    text = (
        areas("")
        .replace("    ACCU: MAX;\n", "")
        .replace("RULE 2:", "RULE 3: IF a IS high THEN y IS less;\n    RULE 2:")
    )
    note, at, _ = only(text)
    assert note.diagnostic.message.startswith("jFuzzyLogic adds without a bound where ACCU is missing: ")
    assert 0.0 < at["a"] < 4.0


def test_an_edge_of_an_input_in_whole_numbers_is_compared_with_its_other_side():
    text = areas("").replace("a: REAL", "a: INT").replace("(0, 1) (4, 0); TERM", "(0, 1) (3, 1) (3, 0); TERM")
    note, at, _ = only(text)
    assert at == {"a": 3.0}
    assert "take another degree at a vertical edge, such as that of `low`" in note.diagnostic.message
    assert notes(text.replace("a: INT", "a: REAL"))[1] == []

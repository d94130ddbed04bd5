"""What another engine makes of a text is computed, and told where it matters."""

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

"""Rule bases as they are met in practice: each has the findings that its comments name, and no other.

Some are sound; the others have the mistakes of practice. They are written in every
style that is read: the standard's, the draft's, jFuzzyLogic's, fuzzylite's.
"""

from functools import cache
from pathlib import Path
from statistics import median

import pytest

from fcl_sim import fcl
from fcl_sim.proof.completeness import EPSILON
from fcl_sim.proof.prove import prove
from tests.fcl.annotations import expected, found
from tests.house.places import ROOT

FOLDER = Path(__file__).parent / "practice"
FILES = sorted(FOLDER.glob("*.fcl"))
SOUND = {"irrigation", "robot_turn", "tank_level"}


@cache
def told(file, epsilon=EPSILON):
    """Return what `fcl-sim check` says of a file: what is read, and what is proved."""
    reading = fcl.read_file(file)
    proved = (each for block in reading.blocks for each in prove(block, None, epsilon))
    return [*reading.diagnostics, *(each.diagnostic for each in proved)]


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_a_rule_base_of_practice_has_the_findings_on_the_lines_that_name_them(file):
    reading = fcl.read_file(file)
    assert reading.errors == ()
    assert found(told(file)) == expected(file.read_text("utf-8"))


def test_the_twenty_are_of_all_sizes():
    blocks = [block for file in FILES for block in fcl.read_file(file).blocks]
    assert len(FILES) == len(blocks) == 21
    assert {len(block.inputs) for block in blocks} == {1, 2, 3, 4}
    rules = [sum(len(each.rules) for each in block.rule_blocks) for block in blocks]
    assert (min(rules), max(rules)) == (3, 54)


def test_findings_are_few():
    shipped = sorted((ROOT / "scenarios").rglob("*.fcl"))
    counts = [len(told(file)) for file in (*FILES, *shipped)]
    assert median(counts) <= 5
    assert {file.stem for file, count in zip(FILES, counts, strict=False) if count == 0} == SOUND


def test_a_duty_without_a_rule_at_the_set_point_is_found_by_epsilon_and_missed_without():
    duty = FOLDER / "heater_duty.fcl"
    assert "FCL602" in [each.code for each in told(duty)]
    assert [each.code for each in told(duty, 0.0)] == ["FCL608"]

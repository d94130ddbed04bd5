"""Rule bases that are read: those of COUNTS without a finding, the others with those they name.

Their first line names the notes that the model takes; a finding is named in a
comment on its line.
"""

import re
from pathlib import Path

import pytest

from fcl_sim import fcl
from fcl_sim.fcl.features import FEATURES
from fcl_sim.model import And, Degree, Is, Method, Not, Or, Point, Points
from tests.fcl.annotations import expected, found

FOLDER = Path(__file__).parent / "good"

COUNTS = {  # function blocks; inputs, outputs, terms of inputs, terms of outputs, rules of the first
    "cone_sched": (1, 1, 3, 5, 10, 5),
    "crane_completed": (1, 2, 1, 10, 5, 25),
    "crane_precise": (1, 2, 1, 10, 5, 25),
    "crane_printed": (1, 2, 1, 10, 5, 6),
    "draft_pid_linear8": (1, 3, 1, 6, 8, 8),
    "extension": (1, 7, 3, 5, 4, 3),
    "figure7": (1, 2, 1, 4, 3, 4),
    "fuzzy_pi25": (1, 2, 1, 10, 5, 25),
    "oven_completed": (1, 4, 2, 6, 6, 8),
    "oven_printed": (1, 4, 2, 6, 6, 5),
    "pi_linear4": (1, 2, 1, 4, 4, 4),
    "pi_linear9_shared": (1, 2, 1, 6, 5, 9),
    "pid_linear8": (1, 3, 1, 6, 8, 8),
    "precontrol": (1, 2, 1, 6, 7, 9),
    "precontrol_exact": (1, 2, 1, 4, 4, 4),
    "two_blocks": (2, 3, 1, 2, 2, 2),
    "zhao": (1, 2, 3, 14, 8, 49),
}


ANNOTATED = sorted(file for file in FOLDER.glob("*.fcl") if file.stem not in COUNTS)
NOTES = re.compile(r"\(\* notes: (.*) \*\)\n")


@pytest.mark.parametrize("file", ANNOTATED, ids=lambda file: file.stem)
def test_a_legitimate_file_is_read_with_the_findings_and_notes_that_it_names(file):
    text = file.read_text("utf-8")
    reading = fcl.read_file(file)
    assert reading.errors == ()
    assert found(reading) == expected(NOTES.sub("\n", text))
    named = NOTES.match(text)[1].split(", ")
    noted = {note.code for block in reading.blocks for note in block.notes}
    assert sorted(noted - {"line comment"}) == ([] if named == ["none"] else named)


def test_every_feature_of_the_open_level_has_its_good_file():
    named = {each for file in ANNOTATED for each in NOTES.match(file.read_text("utf-8"))[1].split(", ")}
    assert set(FEATURES) - named <= {"line comment"}  # most files have one


@pytest.mark.parametrize("name", COUNTS)
def test_a_good_file_has_no_findings_and_all_its_parts(name):
    reading = fcl.read_file(FOLDER / f"{name}.fcl")
    assert reading.diagnostics == ()
    block = reading.blocks[0]
    assert COUNTS[name] == (
        len(reading.blocks),
        len(block.inputs),
        len(block.outputs),
        sum(len(each.terms) for each in block.fuzzifications),
        sum(len(each.terms) for each in block.defuzzifications),
        sum(len(each.rules) for each in block.rule_blocks),
    )


def test_figure_7_says_what_it_says():
    (block,) = fcl.read_file(FOLDER / "figure7.fcl").blocks
    assert block.name == "Fuzzy_FB"
    cold, hot = block.fuzzifications[0].terms
    assert (cold.name, cold.shape) == ("cold", Points((Point(3.0, 1.0), Point(27.0, 0.0))))
    assert (hot.name, hot.shape) == ("hot", Points((Point(3.0, 0.0), Point(27.0, 1.0))))
    (valve,) = block.defuzzifications
    assert (valve.method, valve.default, valve.range) == (Method.COGS, 0.0, None)
    assert [(each.name, each.shape.value) for each in valve.terms] == [
        ("drainage", -100),
        ("closed", 0),
        ("inlet", 100),
    ]
    rules = block.rule_blocks[0].rules
    assert [each.label for each in rules] == ["1", "2", "3", "4"]
    assert [each.conclusions[0].weight for each in rules] == [1.0, 0.8, 1.0, 1.0]
    assert rules[1].condition == And((Is("temp", "cold"), Is("pressure", "high")))


def test_the_extension_level_says_what_it_says():
    (block,) = fcl.read_file(FOLDER / "extension.fcl").blocks
    assert [each.initial for each in block.inputs] == [None, None, 15.0, 15.0, 0.8, None, 1.0]
    assert [each.name for each in block.variables] == ["wish"]
    warm = block.fuzzifications[0].terms[1]
    assert warm.shape == Points((Point("bp_warm1", 0.0), Point(21.0, 1.0), Point("bp_warm2", 0.0)))
    first, second = block.rule_blocks
    assert [first.and_operator, first.or_operator, first.activation] == ["PROD", "ASUM", "PROD"]
    assert [second.and_operator, second.or_operator, second.activation] == ["BDIF", "BSUM", "MIN"]
    assert first.rules[0].condition == Or(
        (
            And((Is("temp", "cold"), Is("pressure", "low"))),
            Not(Or((Is("temp", "hot"), Degree("brown")))),
        )
    )
    assert [each.weight for each in first.rules[0].conclusions] == [0.5, "w_rule"]
    assert [each.label for each in (*first.rules, *second.rules)] == ["1", "3a", "3b"]
    assert block.options == ("\n    cycle = 50 ms; author = 'somebody' @ §7\n",)

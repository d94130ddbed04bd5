from dataclasses import replace

import pytest
from hypothesis import assume, given, settings

from fcl_sim.block import loads
from fcl_sim.fcl import read, write
from fcl_sim.model.labels import unique_labels
from fcl_sim.verify.edits import edits
from tests.laws.models import function_blocks
from tests.report.synthetic import CRANE


def between(*replacements):
    text = CRANE
    for old, new in replacements:
        assert old in text
        text = text.replace(old, new, 1)
    found = edits(loads(CRANE).function_block, loads(text).function_block)
    return [(each.kind, each.owner, each.name, each.old, each.new) for each in found]


@pytest.mark.parametrize(
    ("old", "new", "found"),
    [
        (
            "TERM close := (0, 0) (5, 1) (10, 0)",
            "TERM close := (0, 0) (6, 1) (10, 0)",
            (
                "term",
                "distance",
                "close",
                "TERM close := (0, 0) (5, 1) (10, 0)",
                "TERM close := (0, 0) (6, 1) (10, 0)",
            ),
        ),
        (
            "angle IS zero THEN power IS pos_medium",
            "angle IS zero THEN power IS pos_high",
            (
                "rule",
                "No1",
                "1",
                "RULE 1: IF distance IS far AND angle IS zero THEN power IS pos_medium",
                "RULE 1: IF distance IS far AND angle IS zero THEN power IS pos_high",
            ),
        ),
        (
            "    RULE 6: IF distance IS zero AND angle IS zero THEN power IS zero;\n",
            "",
            ("rule", "No1", "6", "RULE 6: IF distance IS zero AND angle IS zero THEN power IS zero", ""),
        ),
        ("DEFAULT := 0", "DEFAULT := NC", ("setting", "power", "DEFAULT", "DEFAULT := 0", "DEFAULT := NC")),
        ("AND: MIN", "AND: PROD", ("setting", "No1", "AND", "AND: MIN", "AND: PROD")),
        (
            "distance: REAL; angle",
            "distance: LREAL; angle",
            ("variable", "VAR_INPUT", "distance", "distance: REAL", "distance: LREAL"),
        ),
    ],
)
def test_an_edit_is_told_with_what_it_was_and_what_it_is(old, new, found):
    assert between((old, new)) == [found]


def test_comments_and_blanks_are_no_edits():
    assert (
        between(("(* figure C.16, rule 2 corrected *)", "(* another *)"), ("    TERM far :=", "TERM far:="))
        == []
    )


@settings(deadline=None, max_examples=30)
@given(function_blocks())
def test_a_block_has_no_edits_beside_itself_nor_beside_what_is_read_back_of_it(block):
    assert edits(block, block) == ()
    assert edits(block, read(write(block, terse=True)).blocks[0]) == ()


@settings(deadline=None, max_examples=30)
@given(function_blocks())
def test_edits_the_other_way_round_are_the_same_ones_undone(block):
    assume(block.rule_blocks and block.rule_blocks[-1].rules)
    *others, last = block.rule_blocks
    fewer = replace(block, rule_blocks=(*others, replace(last, rules=last.rules[:-1])))
    there, back = edits(block, fewer), edits(fewer, block)
    assert set(there) == {replace(each, old=each.new, new=each.old) for each in back}
    assert [each.name for each in there if each.kind == "rule"] == [unique_labels(block)[-1]]

"""Faults that are planted into complete rule bases are found, each by its code, and nothing else is told."""

import re

import pytest

from fcl_sim.proof.prove import prove
from tests.house.places import ROOT
from tests.proof.bases import block_of

COMPLETE = ("crane/crane_completed.fcl", "crane/crane_precise.fcl", "exchanger/precontrol.fcl")
RULE = re.compile(r"^ *RULE (\w+): IF (.*) THEN (\w+) IS (\w+);", re.MULTILINE)


def text_of(name):
    return (ROOT / "scenarios" / name).read_text("utf-8")


def rules_of(name):
    return [each.group(1) for each in RULE.finditer(text_of(name))]


def codes(text):
    return [each.diagnostic.code for each in prove(block_of(text))]


def found(text, code):
    return [each for each in prove(block_of(text)) if each.diagnostic.code == code]


EVERY_RULE = [(name, label) for name in COMPLETE for label in rules_of(name)]


def rule(name, label):
    return next(each for each in RULE.finditer(text_of(name)) if each.group(1) == label)


def planted(name, label, more):
    """Return a text with more rules behind one of its rules."""
    text, at = text_of(name), rule(name, label)
    return f"{text[: at.end()]}\n    {more}\n{text[at.end() :]}"


def other_term(name, label):
    text, own = text_of(name), rule(name, label)
    terms = re.findall(r"^ *TERM (\w+)", text.split(f"DEFUZZIFY {own.group(3)}")[1], re.MULTILINE)
    return next(each for each in terms if each != own.group(4))


@pytest.mark.parametrize(("name", "label"), EVERY_RULE[::2])
def test_a_rule_that_is_left_out_leaves_a_gap(name, label):
    own = rule(name, label)
    text = text_of(name).replace(own.group(0), "")
    gap, *others = found(text, "FCL601")
    assert others == []
    asked = dict(re.findall(r"(\w+) IS (\w+)", own.group(2)))
    assert set(gap.boxes[0].sides) <= set(asked)
    hint = (
        f"a rule for `{' AND '.join(f'{variable} IS {term}' for variable, term in asked.items())}` would help"
    )
    assert hint in gap.diagnostic.hint
    assert set(codes(text)) <= {"FCL601", "FCL609"}


@pytest.mark.parametrize(("name", "label"), EVERY_RULE[::4])
def test_a_rule_that_is_written_twice_is_found_in_any_order_of_its_condition(name, label):
    own = rule(name, label)
    turned = " AND ".join(reversed(own.group(2).split(" AND ")))
    text = planted(name, label, f"RULE again: IF {turned} THEN {own.group(3)} IS {own.group(4)};")
    assert codes(text) == ["FCL604"]


@pytest.mark.parametrize(("name", "label"), EVERY_RULE[::4])
def test_a_contradiction_is_found(name, label):
    own = rule(name, label)
    other = other_term(name, label)
    text = planted(name, label, f"RULE no: IF {own.group(2)} THEN {own.group(3)} IS {other};")
    assert codes(text) == ["FCL605"]


@pytest.mark.parametrize(("name", "label"), EVERY_RULE[::4])
def test_a_rule_that_asks_for_more_and_concludes_the_same_is_found(name, label):
    own = rule(name, label)
    first = own.group(2).split(" AND ")[0]
    more = f"RULE more: IF {own.group(2)} AND NOT {first} THEN {own.group(3)} IS {own.group(4)};"
    text = planted(name, label, more)
    assert codes(text) == ["FCL606"]


APART = {"too_far": "far", "passed_far": "far", "low": "high"}
"""Terms that no value has together."""


@pytest.mark.parametrize(
    ("name", "label"), [each for each in EVERY_RULE if rule(*each).group(2).split()[2] in APART]
)
def test_a_rule_that_cannot_fire_is_found(name, label):
    own = rule(name, label)
    variable, _, term = own.group(2).split()[:3]
    more = (
        f"RULE dead: IF {own.group(2)} AND {variable} IS {APART[term]} THEN {own.group(3)} IS {own.group(4)};"
    )
    (only,) = prove(block_of(planted(name, label, more)))
    terms = " and ".join(sorted((term, APART[term])))
    assert only.diagnostic.message == f"rule dead never fires: no value of `{variable}` is {terms}"


@pytest.mark.parametrize(("name", "label"), EVERY_RULE[::4])
def test_an_exception_beside_a_general_rule_is_a_note(name, label):
    own = rule(name, label)
    first = own.group(2).split(" AND ")[0]
    text = planted(name, label, f"RULE all: IF {first} THEN {own.group(3)} IS {other_term(name, label)};")
    assert "FCL607" in codes(text)


@pytest.mark.parametrize(("name", "label"), EVERY_RULE[::4])
def test_a_weight_of_0_is_found_and_what_it_leaves_open(name, label):
    own = rule(name, label)
    text = text_of(name).replace(own.group(0), own.group(0).replace(";", " WITH 0;"))
    assert set(codes(text)) == {"FCL601", "FCL613"}


@pytest.mark.parametrize(
    ("name", "old", "new", "code"),
    [
        ("crane/crane_completed.fcl", "METHOD: CoGS;", "TERM more := 30;\n    METHOD: CoGS;", "FCL609"),
        ("crane/crane_completed.fcl", "    angle: REAL;", "    angle: REAL;\n    wind: REAL;", "FCL610"),
    ],
)
def test_a_slip_in_the_terms_is_found(name, old, new, code):
    assert old in text_of(name)
    assert codes(text_of(name).replace(old, new, 1)) == [code]


def test_neighbouring_terms_that_do_not_meet_are_found():
    text = text_of("cone/schedule.fcl")
    moved = text.replace("(0.1, 1) (0.2, 0)", "(0.1, 1) (0.21, 0)")
    assert moved != text
    (off,) = found(moved, "FCL614")
    assert off.diagnostic.message == "the degrees of `level` add up to 1, but at 0.2 to 1.09091"

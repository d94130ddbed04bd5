"""A rule base is held against a statement: each excess is one finding, with its line and the statement's."""

import pytest

from fcl_sim.diagnostics import InputFault, Severity, Source
from fcl_sim.diagnostics.page import framed, page
from fcl_sim.diagnostics.render import render
from fcl_sim.fcl.conformance_elements import ELEMENTS, SHAPES
from fcl_sim.fcl.conformance_excess import excesses
from fcl_sim.fcl.conformance_figures import FIGURES
from fcl_sim.fcl.conformance_statement import read_statement
from fcl_sim.fcl.conformance_targets import target
from fcl_sim.fcl.targets import NAMES, shipped
from tests.fcl.texts import BATH, block, changed


def statement(text):
    return read_statement(Source("plc.toml", f'name = "PLC 7"\n{text}'))


def found(text, *edits):
    return excesses(block(changed(*edits)), statement(text))


def codes(text, *edits):
    return [each.code for each in found(text, *edits)]


def faults(text):
    with pytest.raises(InputFault) as caught:
        read_statement(Source("plc.toml", text))
    return [(each.code, each.places[0].span.line) for each in caught.value.diagnostics]


NEGATED = ("temp IS cold", "temp IS NOT cold")


# -- excesses


def test_what_is_not_there_is_told_with_both_lines_and_what_is_there():
    (finding,) = found('[elements]\nAND = ["PROD"]  # page 30\nOR = ["MAX"]\n')
    assert (
        render(finding)
        == """\
<text>:26:5: error[FCL510]: PLC 7 does not have AND by MIN
  26 |     RULE 1: IF temp IS cold AND level IS low THEN valve IS inlet;
     |     ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
  plc.toml:3:1: the target's statement
  3 | AND = ["PROD"]  # page 30
    | ^^^
  hint: the target has PROD"""
    )


def test_a_limit_that_is_passed_is_told_where_with_count_and_limit():
    (finding,) = found('[elements]\nOR = ["MAX"]\n[data]\nrules = 1\n')
    assert (
        render(finding)
        == """\
<text>:27:5: error[FCL511]: this function block has 2 rules in all; PLC 7 takes 1 at most
  27 |     RULE 2: IF temp IS hot OR level IS high THEN valve IS closed;
     |     ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
  plc.toml:5:1: the target's statement
  5 | rules = 1
    | ^^^^^"""
    )


def test_each_name_that_is_too_long_is_one_finding():
    told = found('[elements]\nOR = ["MAX"]\n[data]\nidentifier_length = 4\n')
    assert [each.message for each in told] == [
        f"`{name}` has {len(name)} characters; PLC 7 takes 4 at most"
        for name in ("level", "valve", "closed", "inlet")
    ]


@pytest.mark.parametrize("key", FIGURES)
def test_every_limit_is_held_at_its_number_and_passed_one_below(key):
    edits = [("IF temp IS cold AND level", "IF (temp IS cold AND level"), ("low THEN", "low) THEN")]
    most = FIGURES[key].most(block(changed(*edits))).number
    either = '[elements]\nOR = ["MAX"]\nparentheses = true\n[data]\n'
    assert codes(f"{either}{key} = {most}", *edits) == []
    assert set(codes(f"{either}{key} = {most - 1}", *edits)) == {"FCL511"}


def test_a_data_type_that_is_not_there_is_told_with_each_variable():
    (finding,) = found('[elements]\nOR = ["MAX"]\n[data]\ndata_types = ["INT", "LREAL"]\n')
    assert (finding.code, finding.message) == ("FCL512", "PLC 7 does not have the data type REAL")
    assert [each.span.line for each in finding.places] == [3, 4, 7, 5]
    assert finding.hint == "the target has INT or LREAL"


def test_line_comments_are_held_against_a_statement():
    edit = ("RULE 1:", "// the first\n    RULE 1:")
    silent = '[elements]\nOR = ["MAX"]\n'
    assert codes(f"{silent}[data]\nline_comments = false\n") == []
    assert codes(f"{silent}[data]\nline_comments = true\n", edit) == []
    (finding,) = found(f"{silent}[data]\nline_comments = false\n", edit)
    assert finding.message == "PLC 7 does not have comments to the end of the line"
    assert [each.span.line for each in finding.places] == [26, 5]


def test_what_is_computed_otherwise_is_a_warning():
    (finding,) = found('[elements]\nOR = ["MAX"]\n[differs]\nMETHOD.CoGS = "it rounds"\n')
    assert (finding.code, finding.severity) == ("FCL513", Severity.WARNING)
    assert finding.message == "PLC 7 makes something else of defuzzification by CoGS: it rounds"
    assert codes('[elements]\nOR = ["MAX"]\n[differs]\nMETHOD = "it rounds"\n') == ["FCL513"]
    assert codes('[elements]\nOR = ["MAX"]\n[differs]\nMETHOD.CoG = "it rounds"\n') == []


def test_what_the_statement_leaves_out_is_a_note_beyond_the_basic_level_only():
    told = found("")
    assert [(each.code, each.severity) for each in told] == [("FCL514", Severity.NOTE)]
    assert told[0].message == "the statement of PLC 7 does not say whether there is OR by MAX"
    assert codes('[elements]\nOR = ["MAX"]\nNOT = []\n', NEGATED) == ["FCL510"]
    assert codes('[elements]\nOR = ["MAX"]\n', NEGATED) == ["FCL514"]


def test_findings_stand_in_the_order_of_the_rule_base():
    text = "[elements]\nOR = []\nNOT = []\n[data]\nidentifier_length = 4\nrules = 1\n"
    lines = [each.places[0].span.line for each in found(text, NEGATED)]
    assert lines == sorted(lines)
    assert len(lines) == 7


def test_remarks_are_announced_once():
    text = 'remarks = ["no umlauts", "no blanks"]\n[elements]\nOR = ["MAX"]\n'
    (finding,) = [each for each in found(text, NEGATED) if each.code != "FCL514"]
    assert finding.message == "the statement of PLC 7 has 2 remarks that no table can say"


@pytest.mark.parametrize("default", ["NC", "0", "7"])
def test_a_target_that_can_give_any_default_can_give_zero(default):
    edit = ("DEFAULT := 0", f"DEFAULT := {default}")
    text = '[elements]\nOR = ["MAX"]\nDEFAULT = [{}]\n'
    assert codes(text.format('"value"'), edit) == (["FCL510"] if default == "NC" else [])
    assert codes(text.format('"NC", "0"'), edit) == (["FCL510"] if default == "7" else [])


# -- statements


def test_every_fault_of_a_statement_is_told_at_once():
    text = """\
nmae = "PLC 7"
[elements]
AND = ["MIN", "PROT"]
OR = "MAX"
VAR = "no"
NOT = [1]
RANGES = true
[data]
inputs = "8"
rules = -1
line_comments = 1
data_types = ["REEL"]
memory = 3
[differs]
METHOD.CoX = "it rounds"
RANGE.low = "it rounds"
WITH = 1
"""
    assert faults(text) == [
        ("FCL523", 1),
        ("FCL525", 1),
        ("FCL523", 3),
        ("FCL524", 4),
        ("FCL524", 5),
        ("FCL524", 6),
        ("FCL523", 7),
        ("FCL524", 9),
        ("FCL524", 10),
        ("FCL524", 11),
        ("FCL523", 12),
        ("FCL524", 13),
        ("FCL523", 15),
        ("FCL523", 16),
        ("FCL524", 17),
    ]


def test_a_slip_gets_the_nearest_name():
    with pytest.raises(InputFault) as caught:
        statement('[elements]\nAND = ["PROT"]\n')
    assert (
        str(caught.value)
        == """\
plc.toml:3:8: error[FCL523]: `PROT` is not a value of this key
  3 | AND = ["PROT"]
    |        ^^^^^^
  hint: did you mean `PROD`?"""
    )


@pytest.mark.parametrize("code", ["FCL521", "FCL522", "FCL523", "FCL524", "FCL525"])
def test_the_page_of_a_fault_shows_it_and_its_mend(code):
    told = page(code)
    assert [each for each, _ in faults(told.bad)] == [code]
    read_statement(Source("plc.toml", told.mended))


PLC = """\
name = "PLC 7"
[elements]
AND = ["MIN", "PROD"]
OR = ["MAX"]
ACCU = ["MAX", "NSUM", "BSUM"]
NOT = ["subcondition"]
[data]
data_types = ["INT", "REAL"]
points_per_input_term = 3
[differs]
ACCU.NSUM = "it divides pairwise"
"""


@pytest.mark.parametrize("code", ["FCL510", "FCL511", "FCL512", "FCL513", "FCL516"])
def test_the_page_of_an_excess_shows_it_and_its_mend(code):
    told, plc = page(code), read_statement(Source("plc.toml", PLC))
    assert [each.code for each in excesses(block(framed(told.bad, told.within)), plc)] == [code]
    assert excesses(block(framed(told.mended, told.within)), plc) == ()


# -- targets by name


@pytest.mark.parametrize("name", NAMES)
def test_a_shipped_statement_is_sound_and_names_a_source_in_every_line(name):
    source = shipped(name)
    told = read_statement(source)
    assert told.name
    assert told.source
    body = source.text[source.text.index("[elements]") :].replace(",\n", ",")
    assert [
        line for line in body.splitlines() if " = " in line and "#" not in line and "shapes" not in line
    ] == []


def test_the_concept_library_takes_singletons_and_nine_of_them():
    concept = target("concept")
    terms = "".join(f"TERM t{n} := {n};\n" for n in range(8))
    many = block(changed(("TERM closed", f"{terms}TERM closed")))
    assert [
        (each.code, each.places[0].span.line) for each in excesses(many, concept) if each.severity == "error"
    ] == [("FCL511", 27)]
    area = block(
        changed(
            ("TERM closed := 0;", "TERM closed := (0, 1) (50, 0);"),
            ("TERM inlet := 100;", "TERM inlet := (50, 0) (100, 1);"),
            ("METHOD: CoGS;", "METHOD: CoG; RANGE(0 .. 100);"),
        )
    )
    lacking = {each.message for each in excesses(area, concept) if each.code == "FCL510"}
    assert lacking == {
        f"the Concept FUZZY library does not have {words}"
        for words in (
            "points as terms of outputs",
            "defuzzification by CoG",
            "RANGE of an output",
            "activation by MIN",
        )
    }


@pytest.mark.parametrize("name", NAMES)
def test_the_bath_can_be_transferred_to_every_shipped_target(name):
    assert [each for each in excesses(block(BATH), target(name)) if each.is_error] == []


def test_a_target_is_a_file_too(tmp_path):
    file = tmp_path / "plc.toml"
    file.write_text('name = "PLC 7"\n')
    assert target(str(file)).name == "PLC 7"


def test_a_target_that_is_none_gets_the_nearest_name():
    with pytest.raises(InputFault) as caught:
        target("consept")
    assert str(caught.value) == "error[FCL520]: there is no target `consept`\n  hint: did you mean `concept`?"
    with pytest.raises(InputFault) as caught:
        target("plc.toml")
    assert [each.code for each in caught.value.diagnostics] == ["FCL101"]


def test_every_element_has_its_row_and_words():
    for key, element in ELEMENTS.items():
        for value in getattr(element, "rows", ("yes",)):
            assert element.row(value)
            assert element.said(value)
            assert "{}" not in element.said(value), key
    assert len(set(SHAPES)) == len(SHAPES)

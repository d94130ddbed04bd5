"""Every code has a page, every page its examples, and the documentation says the same."""

import re

import pytest

from docs.__main__ import FOLDER
from docs.__main__ import pages as generated
from fcl_sim import fcl
from fcl_sim.diagnostics import InputFault
from fcl_sim.diagnostics.codes import CODES
from fcl_sim.diagnostics.page import FAMILIES, family, frame, framed, page, pages
from fcl_sim.diagnostics.page_text import families, list_text, page_markdown, page_text
from fcl_sim.engine.assemble import assemble
from fcl_sim.proof.prove import prove

READ = [each for each in pages().values() if re.match("FCL[123]", each.code) and each.language == "fcl"]
EVALUATED = [each for each in pages().values() if each.code.startswith("FCL4") and each.language == "fcl"]
PROVED = [each for each in pages().values() if each.code.startswith("FCL6") and each.language == "fcl"]

BAD_FILES = {
    "FCL102": ("recording.fcl", b" " * (8 * 2**20 + 1)),
    "FCL103": ("bath.zip", bytes(range(32)) * 4),
    "FCL104": ("bath.fcl", f"(* Füllstand *) {frame()}".encode("cp1252")),
    "FCL199": ("table.txt", b"\n".join(b"VAR_INPUT x%d: T%d; END_VAR" % (n, n) for n in range(200))),
}
"""Of whole files, whose pages have no text as an example; FCL101 is a file that is not there."""


def found(text):
    return {(each.code, each.severity) for each in fcl.read(text, "bath.fcl").diagnostics}


def proved(text):
    """Return the findings of a text that can be read without any."""
    reading = fcl.read(text, "bath.fcl")
    assert reading.diagnostics == ()
    diagnostics = [each.diagnostic for each in prove(reading.blocks[0])]
    return {(each.code, each.severity) for each in diagnostics}


def codes_of(fault):
    return {each.code for each in fault.value.diagnostics}


def test_every_code_has_a_page_and_every_page_a_code():
    assert list(pages()) == list(CODES)


def test_every_code_belongs_to_a_family():
    assert {family(code) for code in CODES} <= set(FAMILIES)
    assert [code for _, codes in families() for code in codes] == list(CODES)


@pytest.mark.parametrize("told", pages().values(), ids=lambda told: told.code)
def test_a_page_is_complete(told):
    for prose in (told.means, told.why):
        assert prose[0].isupper() or prose[0] == "`"
        assert prose.endswith(".")
        assert "\n" not in prose
    assert told.bad != told.mended
    assert told.bad
    assert told.mended


def test_the_frame_of_the_examples_is_sound():
    assert found(frame()) == set()
    assert proved(frame(complete=True)) == set()


@pytest.mark.parametrize("told", READ, ids=lambda told: told.code)
def test_a_bad_text_has_its_finding_and_no_other_and_the_mended_one_has_none(told):
    assert found(framed(told.bad, told.within)) == {(told.code, told.severity)}
    assert found(framed(told.mended, told.within)) == set()


@pytest.mark.parametrize("told", EVALUATED, ids=lambda told: told.code)
def test_a_bad_text_is_not_evaluated_and_the_mended_one_is(told):
    (block,) = fcl.read(framed(told.bad, told.within)).blocks
    with pytest.raises(InputFault) as caught:
        assemble(block)
    assert codes_of(caught) == {told.code}
    (block,) = fcl.read(framed(told.mended, told.within)).blocks
    assemble(block)


@pytest.mark.parametrize("told", PROVED, ids=lambda told: told.code)
def test_a_bad_rule_base_has_its_finding_and_no_other_and_the_mended_one_has_none(told):
    assert proved(framed(told.bad, told.within, complete=True)) == {(told.code, told.severity)}
    assert proved(framed(told.mended, told.within, complete=True)) == set()


@pytest.mark.parametrize("code", BAD_FILES)
def test_a_bad_file_has_its_finding(code, tmp_path):
    name, content = BAD_FILES[code]
    file = tmp_path / name
    file.write_bytes(content)
    try:
        findings = fcl.read_file(file).diagnostics
    except InputFault as fault:
        findings = fault.diagnostics
    assert (code, page(code).severity) in {(each.code, each.severity) for each in findings}


def test_the_remaining_pages_about_texts_are_of_files():
    of_texts = {code for code in CODES if re.match("FCL[123]", code)}
    assert of_texts - {each.code for each in READ} == {"FCL101", *BAD_FILES}


def test_an_example_takes_the_place_of_what_stands_in_its_section():
    text = framed("TERM cold := (0, 1) (9, 0);", "FUZZIFY temp")
    assert "FUZZIFY temp\n    TERM cold := (0, 1) (9, 0);\nEND_FUZZIFY\n" in text
    assert len(text.splitlines()) == len(frame().splitlines()) - 1
    with pytest.raises(ValueError, match="no section `FUZZIFY tmep`"):
        framed("", "FUZZIFY tmep")


def test_a_page_reads_on_a_terminal():
    assert (
        page_text(page("FCL353"))
        == """\
FCL353: variable and term have changed places
error · IEC 61131-7, 5.4.1

A condition reads `term IS variable` instead of `variable IS term`.

The grammar wants the variable first. The two names are known, so that the finding says how it is
written.

Wrong, among the rules:

    RULE 1: IF cold IS temp THEN valve IS inlet;

Mended:

    RULE 1: IF temp IS cold THEN valve IS inlet;"""
    )


def test_a_page_in_markdown_has_its_examples_in_fences():
    text = page_markdown(page("SCN204"))
    assert "Wrong, in a scenario:\n\n```toml\nduration = 1\n```\n\nMended:\n\n```toml\n" in text


def test_a_page_says_by_which_clause_and_by_which_reading_of_ours():
    assert page_text(page("FCL304")).splitlines()[1] == "note · IEC 61131-3, B.1.1; our reading S1"
    assert page_text(page("FCL348")).splitlines()[1] == "error · IEC 61131-7, 5.2.4; our reading S27a, S29"
    assert page_text(page("RUN107")).splitlines()[1] == "error"


def test_all_codes_are_listed_by_family():
    lines = list_text().splitlines()
    assert [line.split()[0] for line in lines if line.startswith("  ")] == list(CODES)
    assert lines[0] == FAMILIES["FCL1"]


def test_the_documentation_is_current():
    wanted = generated()
    assert {name: (FOLDER / name).read_text("utf-8") for name in wanted} == wanted, "run `make docs`"
    families = {f"diagnostics/{file.name}" for file in (FOLDER / "diagnostics").iterdir()}
    assert families <= set(wanted), "run `make docs`"

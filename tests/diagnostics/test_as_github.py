"""Findings as a workflow of GitHub reads them."""

import re

from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.diagnostics import Diagnostic, Place, Source, Span
from fcl_sim.diagnostics.as_github import as_github
from tests.diagnostics.findings import BEHIND_WIDE, NOWHERE, OF_FILE, ONE, TWICE


def read_back(line):
    """Return command, properties and message as the runner takes them from a line."""
    command, listed, message = re.fullmatch(r"::(\w+) (.*?)::(.*)", line).groups()
    properties = dict(each.split("=", 1) for each in listed.split(","))
    for code, sign in (("%3A", ":"), ("%2C", ","), ("%0D", "\r"), ("%0A", "\n"), ("%25", "%")):
        properties = {name: value.replace(code, sign) for name, value in properties.items()}
        if sign not in ":,":
            message = message.replace(code, sign)
    return command, properties, message


def test_a_finding_is_one_line_at_its_first_place():
    assert as_github(ONE) == (
        "::error file=rules/bath.fcl,line=1,endLine=1,col=5,endColumn=9,"
        "title=FCL302 a name is not declared::`wrong` is not declared"
    )


def test_further_places_and_the_hint_stand_in_the_message():
    assert as_github(TWICE) == (
        "::warning file=rules/bath.fcl,line=2,endLine=2,col=5,endColumn=9,"
        "title=FCL301 a name is declared twice::`wrong` is declared twice"
        "%0Arules/bath.fcl:1: first here%0Aalso at rules/bath.fcl:4%0Ahint: give it another name"
    )


def test_a_note_is_a_notice_and_its_column_counts_characters():
    assert as_github(BEHIND_WIDE).startswith("::notice file=rules/bath.fcl,line=3,endLine=3,col=10,")


def test_a_file_without_a_text_and_no_file_at_all():
    assert as_github(OF_FILE) == (
        "::error file=rules/bath 2.fcl,title=FCL101 a file cannot be read::there is no such file"
    )
    assert as_github(NOWHERE) == (
        "::error title=RUN101 the system refused to read or write::the system refused: disk full"
    )


def test_files_are_named_relative_to_the_checkout_where_it_is_known(tmp_path, monkeypatch):
    folder = tmp_path / "checkout" / "bench"
    folder.mkdir(parents=True)
    monkeypatch.chdir(folder)
    assert read_back(as_github(OF_FILE, tmp_path / "checkout"))[1]["file"] == "bench/rules/bath 2.fcl"
    assert read_back(as_github(OF_FILE, tmp_path / "elsewhere"))[1]["file"] == "rules/bath 2.fcl"


def test_a_span_of_several_lines_has_no_last_column():
    text = Source("a.fcl", "RULE 1: IF\n  a;\n")
    line = as_github(Diagnostic(code="FCL201", message="x", places=(Place(Span(text, 5, 14)),)))
    assert read_back(line)[1].keys() == {"file", "line", "endLine", "col", "title"}


texts = st.text(alphabet="a%:,\n\r=;A2053é ", max_size=20)


@given(texts.filter(lambda name: name.strip()), texts)
def test_no_text_breaks_the_command(name, message):
    line = as_github(Diagnostic(code="FCL201", message=message, places=(Place(file=name),)))
    assert "\n" not in line
    assert "\r" not in line
    command, properties, told = read_back(line)
    assert command == "error"
    assert properties == {"file": name, "title": "FCL201 something else is expected"}
    assert "".join(each if each.isprintable() else "�" for each in message) == told


def test_signs_that_mean_something_to_the_runner_are_encoded():
    place = Place(file="a,b:50%.fcl")
    told = as_github(Diagnostic(code="FCL201", message="100 %0A, or 50 %:", hint="a\nb", places=(place,)))
    assert told == (
        "::error file=a%2Cb%3A50%25.fcl,title=FCL201 something else is expected"
        "::100 %250A, or 50 %25:%0Ahint: a�b"
    )

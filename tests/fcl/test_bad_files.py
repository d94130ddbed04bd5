"""Bad rule bases as data: each guilty line names the codes that it must be given, in a comment."""

import re
from pathlib import Path

import pytest

from fcl_sim import fcl
from fcl_sim.diagnostics.codes import CODES
from tests.fcl.annotations import CODE, expected, found

FOLDER = Path(__file__).parent / "bad"
FILES = sorted(FOLDER.glob("*.fcl"))


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_a_bad_file_has_the_expected_findings_on_the_expected_lines_and_no_others(file):
    reading = fcl.read_file(file)
    assert found(reading) == expected(file.read_text("utf-8"))
    assert bool(reading.blocks) != bool(reading.errors)


def test_every_kind_of_finding_about_a_text_has_its_bad_file():
    shown = {code for file in FILES for code in CODE.findall(file.read_text("utf-8"))}
    of_texts = {code for code in CODES if re.fullmatch(r"FCL[123]\d\d", code)}
    assert of_texts - shown == {"FCL101", "FCL102", "FCL103", "FCL104", "FCL199"}  # of whole files

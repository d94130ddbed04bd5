"""The rule bases that are shipped are written as `fcl-sim fmt` writes them."""

import pytest

from fcl_sim import fcl
from fcl_sim.diagnostics import Source
from tests.house.places import ROOT, own_files

FILES = [each for each in own_files("*.fcl") if ROOT / "tests" not in each.parents]


def test_there_are_shipped_rule_bases():
    assert {each.name for each in FILES} >= {"crane_printed.fcl", "crane_completed.fcl", "bath.fcl"}


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_a_shipped_rule_base_is_in_the_canonical_form(file):
    text = file.read_text("utf-8")
    assert fcl.rewrite(Source(file.name, text)) == text

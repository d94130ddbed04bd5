"""A catalogue of planted faults: each is found where it is, and nothing that does not follow from it."""

import tomllib
from collections import Counter
from functools import cache
from pathlib import Path

import pytest

from fcl_sim import fcl
from fcl_sim.proof.prove import prove
from tests.house.places import ROOT

HERE = Path(__file__).parent
FAULTS = tomllib.loads((HERE / "faults.toml").read_text("utf-8"))["fault"]
NAMES = [f"{each['base']}: {each['what']}" for each in FAULTS]


@cache
def text_of(base):
    folder = HERE if base.startswith("practice/") else ROOT / "scenarios"
    return (folder / f"{base}.fcl").read_text("utf-8")


@cache
def told(text):
    """Return what is proved of a text: each message with its code, and the words and line it points at."""
    (block,) = fcl.read(text).blocks
    found = {}
    for each in (finding.diagnostic for finding in prove(block)):
        span = each.places[0].span
        place = text[span.start : span.end], text[: span.start].count("\n")
        found[each.message] = (each.code, *place)
    return found


def wanted(text, found):
    """Return a finding as `told` gives it, of its code and the line that has its words in brackets."""
    code, _, line = found.partition(" ")
    before, _, rest = line.partition("[")
    words, _, after = rest.partition("]")
    assert text.count(before + words + after) == 1, found
    at = text.index(before + words + after) + len(before)
    return code, words, text[:at].count("\n")


@pytest.mark.parametrize("fault", FAULTS, ids=NAMES)
def test_a_planted_fault_is_found_where_it_is_and_nothing_else(fault):
    base = text_of(fault["base"])
    assert base.count(fault["old"]) == 1
    text = base.replace(fault["old"], fault["new"])
    new = [each for message, each in told(text).items() if message not in told(base)]
    assert Counter(new) == Counter(wanted(text, each) for each in fault["found"])


def test_the_catalogue_has_sixty_faults_each_of_its_own():
    assert len(FAULTS) >= 60
    assert len(set(NAMES)) == len(FAULTS)
    assert all(each["found"] for each in FAULTS)

import re
import subprocess
import sys

from fcl_sim import concept
from tests.house.places import ROOT

PAGE = (ROOT / "docs" / "concept.md").read_text("utf-8")


def test_the_example_prints_what_the_page_says():
    example, printed = re.findall(r"^```(?:python|)\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
    done = subprocess.run(
        [sys.executable, "-c", example], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert (done.stdout, done.stderr) == (printed, "")


def test_the_page_lists_every_block_with_its_pages():
    told = {}
    for name, variants, first, last in re.findall(
        r"^\| (\w+) \|.*\| ([A-Z, ]+) \| (\d+)–(\d+) \|$", PAGE, re.MULTILINE
    ):
        told |= {f"{name}_{variant}": (int(first), int(last)) for variant in variants.split(", ")}
    assert set(told) == set(concept.BLOCKS)
    for name, kind in concept.BLOCKS.items():
        first, last = map(int, re.findall(r"\d+", kind.source)[-2:])
        assert told[name][0] <= first <= last <= told[name][1]


def test_the_page_names_every_event_and_no_other():
    assert set(re.findall(r"^\| (E_EFB_\w+|OVERFLOW) \|", PAGE, re.MULTILINE)) == set(concept.Event)

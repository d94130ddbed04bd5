import re
import subprocess
import sys

import pytest

from tests.house.places import ROOT

PAGE = (ROOT / "docs" / "interop.md").read_text("utf-8")
BLOCKS = re.findall(r"^```(python|)\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
EXAMPLES = [text for language, text in BLOCKS if language]
PRINTED = [text for language, text in BLOCKS if not language]


def test_every_example_is_followed_by_what_it_prints():
    assert [language for language, _ in BLOCKS] == ["python", ""] * 4


@pytest.mark.parametrize("number", range(len(EXAMPLES)))
def test_an_example_prints_what_the_page_says(number):
    command = [sys.executable, "-W", "error", "-c", EXAMPLES[number]]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr) == (PRINTED[number], "")

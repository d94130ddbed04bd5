"""The pictures of the README and of the page on reports are those that the shipped crane gives."""

import re

import numpy as np
import pytest

from docs.figures import images
from tests.house.places import ROOT

NUMBER = re.compile(r"(?<![\w#])-?\d+(?:\.\d+)?")
PNG = re.compile(r"data:image/png;base64,[^\"]*")
CLOSE = 0.03
"""Millimetres by which a line may stand elsewhere where a processor rounds otherwise."""


@pytest.fixture(scope="module")
def drawn():
    return images()


def parts(text: str) -> tuple[str, np.ndarray]:
    """Return a picture without its numbers and maps of colours, and the numbers."""
    lines = PNG.sub("png", text)
    return NUMBER.sub("n", lines), np.array(NUMBER.findall(lines), dtype=float)


def test_they_are_current_and_no_other_is_there(drawn):
    folder = ROOT / "docs" / "images" / "report"
    assert {f"images/report/{each.name}" for each in folder.iterdir()} == set(drawn)
    for name, text in drawn.items():
        kept, is_now = parts((ROOT / "docs" / name).read_text("utf-8")), parts(text)
        assert kept[0] == is_now[0], f"{name} is not current: make docs"
        assert np.abs(kept[1] - is_now[1]).max() < CLOSE, f"{name} is not current: make docs"


def test_each_is_shown_on_the_page_on_reports(drawn):
    page = (ROOT / "docs" / "report.md").read_text("utf-8")
    assert set(re.findall(r"images/report/[\w-]+\.svg", page)) == set(drawn)

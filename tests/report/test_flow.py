"""How pages are filled: pictures give way no more than needed, paragraphs of a listing keep together."""

import json
from importlib.resources import files

import pikepdf
import pytest
import typst

from fcl_sim.report.writer import write_alone
from tests.report.reading import page_words
from tests.report.synthetic import CRANE

LEAST, WHOLE = 0.84, 249.0
"""What `flow.typ` says of both, in mm."""

SHARES = """
#let case = json("case.json")
#metadata(shares(case.units.map(unit => unit.map(each => each * 1mm)), case.free * 1mm)) <shares>
"""


def shares(units, free, folder):
    """Return the share that each picture is set at, as the layout computes it."""
    (folder / "case.json").write_text(json.dumps({"units": units, "free": free}), encoding="utf-8")
    flow = files("fcl_sim.report").joinpath("flow.typ").read_text(encoding="utf-8")
    (folder / "case.typ").write_text(flow + SHARES, encoding="utf-8")
    found = typst.query(str(folder / "case.typ"), "<shares>", field="value", one=True, root=str(folder))
    return json.loads(found)


@pytest.mark.parametrize(
    ("units", "free", "expected"),
    [
        ([(20, 80), (20, 80)], WHOLE, [1, 1]),
        ([(24.5, 125), (24.5, 125)], WHOLE, [0.8, 0.8]),
        ([(24.5, 110), (24.5, 110)], WHOLE, [200 / 220, 200 / 220]),
        ([(20, 100), (20, 150), (20, 60)], 118, [0.98, 209 / 210, 209 / 210]),
        ([(20, 150)], 100, [1]),
        ([(300, 0), (20, 100)], WHOLE, [1, 1]),
        ([(100, 180), (20, 60)], WHOLE, [1, 1]),
        ([(30, 0), (30, 0)], 0, [1, 1]),
        ([], WHOLE, []),
    ],
    ids=["fits", "too-much", "gives", "first-page", "next-page", "breaks", "too-high", "words", "nothing"],
)
def test_pictures_of_a_page_give_way_alike_and_no_more_than_needed(units, free, expected, tmp_path):
    spared = [each if each >= LEAST else 1 for each in expected]
    assert shares(units, free, tmp_path) == pytest.approx(spared)


def test_paragraphs_of_a_listing_are_not_parted_and_a_short_one_stays_with_the_next(tmp_path):
    paragraphs = [
        "\n".join([f"(* {each:02}begin", *["line"] * (each % 9), f"{each:02}end *)"]) for each in range(40)
    ]
    file = tmp_path / "long.fcl"
    file.write_text("\n\n".join([CRANE, *paragraphs]), encoding="utf-8")
    written = write_alone(file, tmp_path / "reports")
    with pikepdf.open(written[0]) as pdf:
        pages = [words for words in page_words(pdf) if "begin" in words]
    assert len(pages) > 2
    for words in pages:
        for each in range(40):
            assert (f"{each:02}begin" in words) == (f"{each:02}end" in words)
    for each in (9, 18, 27, 36):
        assert any(f"{each:02}begin" in words and f"{each + 1:02}begin" in words for words in pages)

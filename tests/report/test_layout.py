"""The pages: nothing runs out of the text column, whatever names are like."""

import io
import json
from contextlib import closing

import numpy as np
import pikepdf
import pytest
from matplotlib.image import imread

from fcl_sim.judge.verdict import Status
from fcl_sim.report import results, style, typeset
from fcl_sim.report.canvas import Text
from fcl_sim.report.content import report_data
from fcl_sim.report.gather import gathered
from fcl_sim.report.placed import placed
from fcl_sim.report.writer import Shelf, write_alone
from fcl_sim.scenario.kinds import RESULTS
from tests.report.legible import clashes, cut
from tests.report.reading import page_words
from tests.report.synthetic import CRANE, EVIL, LONG, outcome, run, trace, verdict

PPI = 36
MARGIN, SLACK = 22.0, 1.5
"""Side margin in mm, and how far a stroke may reach into it."""


def pages(outcomes, work) -> list[np.ndarray]:
    """Return the pages of a report as pictures (rows, columns) of grey from 0 to 1."""
    with closing(Shelf(work)) as shelf:
        data = report_data(gathered(outcomes), shelf.add)
        shelf.draw(lambda done, total: None)
    (work / "report.json").write_text(json.dumps(data), encoding="utf-8")
    (work / RESULTS).write_text(results.text(outcomes), encoding="utf-8")
    template = typeset.template()
    drawn = typeset._compiler(work).compile(template, format="png", ppi=PPI)
    return [imread(io.BytesIO(page))[..., :3].mean(axis=2) for page in drawn]


def plain(folder):
    return [
        outcome(folder, run(folder), run(folder, "raw_distance", "swings"), run(folder, "early", "fault"))
    ]


def long_names(folder):
    name = LONG + LONG.replace("_", "").replace(".", "").replace("/", "")
    odd = run(
        folder,
        title=name,
        trace=trace(names=(name, "crane.sway", EVIL, "controller.rules.power")),
        verdicts=(verdict(Status.FAIL, 1e-300, id=name, text=name, signal=name, unit=f"kN {EVIL}"),),
    )
    given = {"name": name, "title": name, "description": name, "fcl": f"{CRANE}(* {name}{name}{name} *)"}
    return [outcome(folder, odd, overrides={name: name}, **given), *plain(folder)]


def many(folder):
    runs = [run(folder, f"run_{index}", "swings") for index in range(4)]
    return [outcome(folder, run(folder), *runs)]


@pytest.mark.parametrize("made", [plain, long_names, many])
def test_nothing_stands_in_the_margins(made, tmp_path):
    inputs, work = tmp_path / "inputs", tmp_path / "work"
    inputs.mkdir()
    work.mkdir()
    edge = int((MARGIN - SLACK) / 25.4 * PPI)
    for page in pages(made(inputs), work):
        assert page[:, :edge].min() > 0.99
        assert page[:, -edge:].min() > 0.99


@pytest.mark.parametrize("made", [plain, long_names, many])
def test_the_letters_of_figures_are_large_enough_and_neither_cut_nor_upon_one_another(made, tmp_path):
    found = {}
    report_data(gathered(made(tmp_path)), lambda _, each: found.setdefault(each.name, each).name)
    assert len(found) > 8
    for picture in found.values():
        figure = picture.draw()
        shrunk = placed(picture, "", lambda *_: "")["width"] / figure.width
        smallest = min(each.size for axes in figure.axes for each in axes.of(Text))
        assert shrunk * smallest >= style.LEAST, picture.name
        assert cut(figure) == [], picture.name
        assert clashes(figure) == [], picture.name


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

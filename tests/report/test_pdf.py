"""The PDF: tagged, archivable, whole, and literal whatever names hold."""

import hashlib
import json

import pikepdf
import pytest
from pikepdf import Name

from fcl_sim.judge.verdict import Status
from fcl_sim.report import document, write
from tests.report.reading import alternatives, bare, fonts, page_words, tags, words
from tests.report.synthetic import CRANE, EVIL, LONG, outcome, run, trace, verdict


@pytest.fixture(scope="module")
def outcomes(tmp_path_factory):
    folder = tmp_path_factory.mktemp("inputs")
    first = outcome(
        folder,
        run(folder),
        run(folder, "raw_distance", "swings"),
        run(folder, "early", "fault", title="The integrator gives up"),
    )
    evil = run(
        folder,
        title=f"run {EVIL}",
        trace=trace(names=(f"signal {EVIL}", "crane.sway", LONG, "controller.rules.power")),
        verdicts=(
            verdict(id="ID <b>$y$", text=f"requirement {EVIL}", signal=f"signal {EVIL}"),
            verdict(Status.FAIL, None, id=LONG, expect_fail=True, signal=LONG),
        ),
    )
    other = outcome(
        folder,
        evil,
        name="#x/$y",
        title=f"title {EVIL}",
        description=f"story {EVIL}\n\n{LONG}",
        fcl=CRANE + f"(* source {EVIL} {LONG}{LONG} *)\n",
        overrides={"plant.parameters.load_mass": f"10 t {EVIL}"},
    )
    return [first, other]


@pytest.fixture(scope="module")
def folder(outcomes, tmp_path_factory):
    place = tmp_path_factory.mktemp("reports")
    write(outcomes, place, png=True)
    return place


@pytest.fixture(scope="module")
def pdf(folder):
    with pikepdf.open(folder / "report.pdf") as opened:
        yield opened


@pytest.fixture(scope="module")
def text(pdf):
    return words(pdf)


def test_it_calls_itself_pdf_a_3a_and_pdf_ua_1(pdf):
    with pdf.open_metadata() as metadata:
        assert metadata.pdfa_status == "3A"
        assert metadata["pdfuaid:part"] == "1"


def test_it_is_tagged_and_has_a_language_and_a_title_that_is_shown(pdf):
    assert bool(pdf.Root.MarkInfo.Marked)
    assert str(pdf.Root.Lang) == "en-GB"
    assert str(pdf.docinfo.Title) == "Container crane: closed-loop tests"
    assert bool(pdf.Root.ViewerPreferences.DisplayDocTitle)


def test_headings_figures_and_tables_are_tagged_as_such(pdf):
    found = [str(tag.S) for tag in tags(pdf)]
    for kind in ("/H1", "/H2", "/Figure", "/Caption", "/Table", "/TH", "/TOC", "/Code"):
        assert kind in found


def test_every_font_is_embedded(pdf):
    every = list(fonts(pdf))
    assert len(every) > 3
    assert all({Name.FontFile, Name.FontFile2, Name.FontFile3} & set(each.keys()) for each in every)


def test_every_figure_has_an_alternative_text_written_from_the_data(pdf, folder):
    found = alternatives(pdf)
    assert len(found) >= len(list(folder.rglob("*.png"))) > 0
    assert all(len(each) > 100 for each in found)
    told = " ".join(found).replace("\N{NO-BREAK SPACE}", " ")
    assert "crane.distance goes from 25 m to 0.001135 m" in told
    assert "raw_distance: CR-1: PASS, measured FAIL, violated from 35 s to 60 s." in told
    assert "FAULT at 19.5 s: the integrator cannot reach its tolerance." in told


def test_it_carries_the_results(pdf, folder, outcomes):
    (name, attached), *others = pdf.attachments.items()
    assert (name, others) == ("results.json", [])
    content = attached.get_file().read_bytes()
    assert content == (folder / "results.json").read_bytes()
    assert json.loads(content) == document(outcomes)


def test_it_has_bookmarks_and_contents(pdf):
    with pdf.open_outline() as outline:
        titles = [each.title for each in outline.root]
    assert any("Container crane: 25 m transfer" in each for each in titles)
    assert any(EVIL in each for each in titles)


@pytest.mark.parametrize("kind", ["title", "run", "requirement", "story", "source", "signal", "10 t"])
def test_names_appear_literally(text, kind):
    assert bare(f"{kind} {EVIL}") in text


def test_long_names_are_whole(text):
    assert bare(LONG) in text
    assert "ID<b>$y$" in text


def test_page_one_says_verdict_and_what_was_run(pdf, outcomes):
    class First:
        pages = (pdf.pages[0],)

    page = words(First)
    assert "FAULT" in page
    assert bare("2 scenarios, 4 runs, 6 verdicts: 1 FAULT, 5 PASS.") in page
    for file in outcomes[0].scenario.files:
        assert file.digest in page
    assert hashlib.sha256(CRANE.encode()).hexdigest() in page
    for fact in ("500ms", "LREAL", "numpy"):
        assert fact in page


def test_what_is_signed_is_told(text):
    for told in (
        "none: the bench is not under version control",
        "These values of plants are assumed",
        "Requirement matrix",
        "Nothing is waived.",
        "Author",
        "Checker",
        "Approver",
    ):
        assert bare(told) in text


def test_the_values_of_plant_and_blocks_are_told(text):
    for each in ("Values of the base run", "load_mass", "position at the start", "arithmetic = LREAL"):
        assert bare(each) in text


def test_what_the_check_finds_stands_with_the_rule_base(text):
    assert bare("warning FCL608 6 no rule asks for too_far of distance") in text


def test_the_words_of_every_figure_can_be_searched(text):
    for told in ("controller.rules", "distance far, angle zero: power pos_medium", "RULE 1", "degree [1]"):
        assert bare(told) in text


def test_an_expected_miss_is_told_with_its_reason(text):
    rules = "1 → pos_medium (1), 2 → pos_high (1), 3 → pos_medium (1), 4 → neg_medium (1)"
    there = f"At 35 s rules {rules} and 2 more fire, power = 10.97 kW."
    assert bare(f"raw_distance crane.distance does not settle. {there} — EXPECTED MISS") in text


def test_the_definition_of_each_metric_stands_beside_it(text):
    assert bare("CR-1 time until the signal stays within final ± band; final = 0 m, band = 0.5 m.") in text


def test_the_rule_base_is_there_as_text(text):
    at = 0
    for line in CRANE.splitlines():
        at = text.index(bare(line), at)


def test_a_report_without_runs_is_a_report(tmp_path):
    write([], tmp_path)
    with pikepdf.open(tmp_path / "report.pdf") as opened:
        assert bare("Nothing was run.") in words(opened)


def test_every_page_tells_its_number(pdf):
    count = len(pdf.pages)
    for number, page in enumerate(page_words(pdf), start=1):
        assert page.endswith(f"{number}/{count}")


@pytest.mark.parametrize("count", [4, 40])
def test_contents_of_many_scenarios_begin_where_the_table_of_them_ends(count, tmp_path):
    made = [
        outcome(tmp_path, run(tmp_path), name=f"s{each}", title=f"Scenario {each}") for each in range(count)
    ]
    write(made, tmp_path / "reports")
    with pikepdf.open(tmp_path / "reports" / "report.pdf") as opened:
        first, second, *_ = page_words(opened)
        assert ("Contents" in second, "Contents" in first) == (True, False)
        assert ("Scenario39" in second.partition("Contents")[0]) == (count == 40)
        assert all(
            each.endswith(f"{number}/{len(opened.pages)}")
            for number, each in enumerate(page_words(opened), 1)
        )

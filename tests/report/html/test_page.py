"""The page as a text: whole, alone, literal, the same each time, and readable by who cannot see it."""

import base64
import re
from hashlib import sha256
from importlib.resources import files

import pytest

from fcl_sim.report.html import page
from fcl_sim.report.html.page import FEWEST, MOST, SCRIPTS, stretches_for
from tests.report.html.pages import Page, everything, page_of
from tests.report.html.scripts import FOLDER
from tests.report.synthetic import EVIL, LONG, outcome, run


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    return Page(page_of(tmp_path_factory.mktemp("bench")))


def test_every_element_that_is_opened_is_closed_and_names_of_places_are_unique(made):
    assert made.open == []
    ids = made.attributes("id")
    assert len(ids) == len(set(ids))
    targets = {each.removeprefix("#") for each in made.attributes("href")}
    assert targets <= set(ids)


def test_nothing_is_fetched_from_elsewhere(made):
    assert {tag for tag, _ in made.elements}.isdisjoint({"link", "img", "iframe", "object", "base", "form"})
    assert made.attributes("src") == []
    assert all(each.startswith("#") for each in made.attributes("href"))
    policy = next(given["content"] for _, given in made.elements if "http-equiv" in given)
    assert policy.startswith("default-src 'none'; ")
    assert "connect-src 'none'" in policy
    assert "unsafe" not in policy


def test_only_our_own_style_and_script_are_allowed_and_no_element_has_any_of_its_own(made):
    policy = next(given["content"] for _, given in made.elements if "http-equiv" in given)
    (style,) = re.findall(r"<style>(.*?)</style>", made.text, re.DOTALL)
    script = re.findall(r"<script>(.*?)</script>", made.text, re.DOTALL)[-1]
    for kind, text in (("style", style), ("script", script)):
        digest = base64.b64encode(sha256(text.encode()).digest()).decode()
        assert f"{kind}-src 'sha256-{digest}'" in policy
    given = {name for _, each in made.elements for name in each}
    assert "style" not in given
    assert not any(name.startswith("on") for name in given)


def test_names_that_markup_would_take_for_its_own_stand_there_literally(made):
    assert EVIL in "".join(made.texts["h1"]) + "".join(made.texts["h2"])
    assert EVIL in made.texts["td"]
    assert LONG in made.texts["td"]
    assert any(f"{EVIL} </script>" in each for each in made.texts["pre"])
    kinds = [given.get("type") for tag, given in made.elements if tag == "script"]
    assert kinds == ["text/plain"] * 4 + [None]


def test_two_pages_of_the_same_runs_are_the_same_and_another_run_is_another_page(tmp_path):
    assert page_of(tmp_path) == page_of(tmp_path)
    assert page([outcome(tmp_path, run(tmp_path))]) != page([outcome(tmp_path, run(tmp_path, kind="swings"))])


def test_headings_of_tables_say_what_they_are_of_and_what_scrolls_can_be_reached(made):
    assert all("scope" in given for tag, given in made.elements if tag == "th")
    scrolled = [given for _, given in made.elements if given.get("class") == "wide"]
    assert scrolled
    assert all(given["tabindex"] == "0" and given["aria-label"] for given in scrolled)
    assert ("html", {"lang": "en"}) in made.elements
    assert [tag for tag, _ in made.elements].count("h1") == 1


def test_a_page_of_nothing_is_a_page():
    assert "Nothing was run." in "".join(Page(page([])).texts["p"])


def test_a_run_that_ended_early_is_told_on_top(made):
    told = "".join(made.texts["p"])
    assert "FAULT: the run ended at 19.5" in told
    assert "the integrator cannot reach its tolerance" in told


def test_many_runs_have_fewer_stretches_each(tmp_path):
    one = everything(tmp_path)[0]
    assert stretches_for([one]) == MOST
    assert FEWEST < stretches_for([one] * 40) < MOST
    assert stretches_for([one] * 10_000) == FEWEST


def test_the_script_is_made_of_all_its_files():
    assert sorted(SCRIPTS) == sorted(each.name for each in FOLDER.iterdir() if each.name.endswith(".js"))


LIGHT, DARK = range(2)
CONTRASTS = {
    4.5: [
        ("ink", "paper"),
        ("ink", "wash"),
        ("faint", "paper"),
        ("faint", "wash"),
        ("accent", "paper"),
        ("accent", "wash"),
        ("bound", "paper"),
        ("violation", "paper"),
        ("ink", "fires"),
        ("on-badge", "good"),
        ("on-badge", "bad"),
        ("on-badge", "doubtful"),
    ],
    3.0: [("edge", "paper"), ("bad", "paper"), *((f"run-{index}", "paper") for index in range(7))],
}
"""What WCAG 2 asks of text and of what must be seen, at least."""


def schemes():
    """Return the colours of light, of dark and of paper, by name."""
    style = files("fcl_sim.report.html").joinpath("page.css").read_text("utf-8")
    found = re.findall(r":root \{(.*?)\}", style, re.DOTALL)
    return [dict(re.findall(r"--([a-z0-9-]+): (#[0-9a-f]{6})", each)) for each in found]


def luminance(colour):
    parts = [int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5)]
    red, green, blue = (
        each / 12.92 if each <= 0.04045 else ((each + 0.055) / 1.055) ** 2.4 for each in parts
    )
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


@pytest.mark.parametrize("scheme", [LIGHT, DARK], ids=["light", "dark"])
@pytest.mark.parametrize(("least", "pairs"), CONTRASTS.items(), ids=["text", "lines"])
def test_colours_stand_out_from_what_they_lie_on(scheme, least, pairs):
    blocks = schemes()
    colours = blocks[LIGHT] | blocks[scheme]
    for one, other in pairs:
        low, high = sorted(luminance(colours[each]) for each in (one, other))
        assert (high + 0.05) / (low + 0.05) >= least, (one, other)


def test_paper_has_the_colours_of_light():
    blocks = schemes()
    assert blocks[2].items() <= blocks[LIGHT].items()
    assert blocks[2].keys() >= blocks[DARK].keys()

"""The page in a headless Chromium, where there is one: it is quiet, alone, moves, and can be used by keys."""

import json
from dataclasses import replace
from importlib.resources import files

import numpy as np
import pytest

from fcl_sim.judge.verdict import Status
from fcl_sim.report.html import page as page_text
from fcl_sim.report.html.live import Live, served
from fcl_sim.testbench import Against
from tests.report.html.browser import CHROMIUM, browser
from tests.report.html.pages import page_of
from tests.report.synthetic import EVIL, outcome, run, verdict

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium; CHROMIUM names one")

FIRST, DRIVEN = "crane/transfer", "driven"


@pytest.fixture(scope="module")
def tab():
    with browser() as found:
        yield found


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    folder = tmp_path_factory.mktemp("page")
    (folder / "report.html").write_text(page_of(folder), encoding="utf-8")
    return (folder / "report.html").as_uri()


@pytest.fixture
def page(tab, address):
    tab.look()
    tab.said.clear()
    tab.requests.clear()
    tab.open(address)
    return tab


def of(name, selector):
    """Return an expression: the first element that a selector finds in the explorer of a scenario."""
    return f"document.querySelector('.explorer[data-name={json.dumps(name)}] {selector}')"


def slide(page, name, time):
    page.value(
        f"(() => {{ const slider = {of(name, 'input[type=range]')}; slider.value = {time} * slider.max / 60;"
        " slider.dispatchEvent(new Event('input')); })()"
    )


def text(page, name, selector):
    return page.value(f"{of(name, selector)}.textContent")


def test_it_says_nothing_and_asks_for_nothing(page, address):
    page.value("document.querySelectorAll('details').forEach((each) => { each.open = true; })")
    assert page.value("document.querySelectorAll('.explorer .lane').length") > 10
    assert page.said == []
    assert page.requests == [address]


def test_the_slider_moves_the_plant_the_point_on_the_characteristic_and_all_cursors(page):
    def places():
        moved = page.value(f"{of(DRIVEN, '.sketch svg g g')}.getAttribute('transform')")
        spot = page.value(f"{of(DRIVEN, '.spot')}.style.left")
        cursors = f"[...document.querySelectorAll('.explorer[data-name={DRIVEN}] .plots > .lane .cursor')]"
        lefts = page.value(f"{cursors}.map((each) => each.style.left)")
        return moved, spot, lefts

    start = places()
    assert start[0] == "translate(-25 0)"
    slide(page, DRIVEN, 30)
    middle = places()
    assert set(middle[2]) == {"50%"}
    assert len(middle[2]) == 2
    assert all(before != after for before, after in zip(start, middle, strict=True))
    assert text(page, DRIVEN, "output") == "30.0 s"
    assert "no rule is active" in text(page, DRIVEN, ".map-reading") or "kW" in text(
        page, DRIVEN, ".map-reading"
    )


def test_the_rules_that_fire_at_the_cursor_are_highlighted_and_said_to_fire(page):
    assert page.value(f"{of(FIRST, '.rules tbody')}.querySelectorAll('.firing').length") == 6
    assert (
        text(page, FIRST, ".rules caption")
        == "controller.rules, run base: 6 of 6 rules fire at 0.0\N{NO-BREAK SPACE}s"
    )
    page.value(
        f"(() => {{ const chosen = {of(FIRST, '.details-of select')}; chosen.value = 1;"
        " chosen.dispatchEvent(new Event('change')); })()"
    )
    slide(page, FIRST, 40)
    assert page.value(f"{of(FIRST, '.rules tbody')}.querySelectorAll('.firing').length") == 0
    assert "FAULT at 19.5" in text(page, FIRST, ".lane .over")


def test_a_run_that_is_switched_off_is_gone_from_lines_and_readings(page):
    def shown():
        lines = page.value(f"{of(FIRST, '.lane-plot > svg')}.querySelectorAll('g.run:not(.off)').length")
        return lines, page.value(f"{of(FIRST, '.readings')}.children.length")

    assert shown() == (4, 4)
    page.value(f"{of(FIRST, 'fieldset label:nth-of-type(3) input')}.click()")
    assert shown() == (3, 3)


def test_it_is_zoomed_by_dragging_and_by_buttons_and_back(page):
    def window():
        return page.value(f"{of(FIRST, '.lane-plot > svg')}.getAttribute('viewBox')").split(" ")[::2]

    whole = window()
    page.value(f"{of(FIRST, '.lane-plot')}.scrollIntoView({{ block: 'center' }})")
    left, top, width = page.value(
        f"(() => {{ const box = {of(FIRST, '.lane-plot')}.getBoundingClientRect();"
        " return [box.left, box.top + 20, box.width]; })()"
    )
    page.mouse("mousePressed", left + 0.25 * width, top, buttons=1)
    page.mouse("mouseMoved", left + 0.5 * width, top, buttons=1)
    page.mouse("mouseReleased", left + 0.5 * width, top)
    begin, span = (float(each) for each in window())
    assert begin == pytest.approx(250.0, abs=3.0)
    assert span == pytest.approx(250.0, abs=3.0)
    page.value(f"{of(FIRST, '.zoom button:last-child')}.click()")
    assert window() == whole
    page.value(f"{of(FIRST, '.zoom button:first-child')}.click()")
    assert float(window()[1]) == 500.0


def test_what_the_mouse_points_at_is_shown_while_it_is_there(page):
    page.value(f"{of(FIRST, '.lane-plot')}.scrollIntoView({{ block: 'center' }})")
    left, top, width = page.value(
        f"(() => {{ const box = {of(FIRST, '.lane-plot')}.getBoundingClientRect();"
        " return [box.left, box.top + 20, box.width]; })()"
    )
    page.mouse("mouseMoved", left + 0.5 * width, top)
    page.wait(f"{of(FIRST, 'output')}.textContent === '30.0 s'")
    page.mouse("mouseMoved", 2, 2)
    page.wait(f"{of(FIRST, 'output')}.textContent === '0.0 s'")


def test_every_control_is_reached_and_used_by_keys(page):
    page.value(f"{of(DRIVEN, 'fieldset input')}.focus()")
    reached = []
    for _ in range(9):
        reached.append(
            page.value(
                "document.activeElement.tagName + ' ' + document.activeElement.textContent.slice(0, 4)"
            )
        )
        page.press("Tab")
    assert reached[:2] == ["INPUT ", "BUTTON Play"]
    assert reached[2] == "INPUT "
    assert reached[-1] == "BUTTON Whol"
    page.value(f"{of(DRIVEN, 'input[type=range]')}.focus()")
    page.press("ArrowRight", times=3)
    assert text(page, DRIVEN, "output") == "1.5 s"
    page.press("End")
    assert text(page, DRIVEN, "output") == "60.0 s"
    page.value(f"{of(DRIVEN, '.time button')}.focus()")
    page.press("Enter")
    page.wait(f"{of(DRIVEN, 'output')}.textContent !== '60.0 s'")
    page.press(" ")
    assert text(page, DRIVEN, ".time button") == "Play"


def test_a_live_page_follows_what_is_shown_and_keeps_what_was_chosen(tab, tmp_path):
    live = Live()
    before = outcome(tmp_path, run(tmp_path), run(tmp_path, "other"))
    after = replace(before, against=Against(label="before it was saved", runs=before.variants))
    live.show(1, page_text([before], live=1))
    with served(live, port=0) as address:
        tab.look()
        tab.said.clear()
        tab.open(address)
        slide(tab, FIRST, 12)
        tab.value(f"{of(FIRST, 'fieldset label:nth-of-type(2) input')}.click()")
        live.show(2, page_text([after], live=2))
        tab.wait("document.body.dataset.seen === '1'")
        assert text(tab, FIRST, "output") == "12.0 s"
        assert not tab.value(f"{of(FIRST, 'fieldset label:nth-of-type(2) input')}.checked")
        assert tab.value(f"{of(FIRST, '.lane-plot > svg')}.querySelectorAll('.older:not(.off)').length") == 1
        assert "before it was saved" in text(tab, FIRST, "fieldset")
        live.warn("crane.fcl:3:1: error <b>")
        mistake = "document.querySelector('.banner:not(.off)')"
        tab.wait(f"{mistake}?.textContent.startsWith('crane.fcl:3:1: error <b>\\n\\nBelow, what this')")
        tab.wait("parseFloat(getComputedStyle(document.body).paddingTop) > 20")
        for scrolled in (0, 400):
            tab.value(f"window.scrollTo(0, {scrolled})")
            low = f"{mistake}.getBoundingClientRect().bottom"
            assert tab.value(f"{low} <= document.querySelector('nav').getBoundingClientRect().top")
            assert scrolled or tab.value(f"{low} <= document.querySelector('h1').getBoundingClientRect().top")
        tab.value("window.scrollTo(0, 0)")
        live.show(3, page_text([after], live=3))
        tab.wait("document.querySelector('.banner').classList.contains('off')")
        tab.wait("getComputedStyle(document.body).paddingTop === '0px'")
        assert tab.said == []  # one whose server ends may say that its connection was reset
    tab.wait("document.querySelector('.banner').textContent.startsWith('fcl-sim has ended')")


def test_names_appear_literally(page):
    assert EVIL in page.value("document.querySelector('nav').textContent")
    assert EVIL in page.value("document.querySelector('#s0 h2').textContent")
    assert EVIL in text(page, FIRST, "fieldset")


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_no_fault_of_accessibility_is_found(tab, address, scheme):
    tab.look(scheme=scheme)
    tab.call("Page.setBypassCSP", enabled=True)
    tab.open(address)
    tab.value("document.querySelectorAll('details').forEach((each) => { each.open = true; })")
    tab.value(files("axe_core_python").joinpath("axe.min.js").read_text("utf-8") + "; 0")
    found = tab.value(
        "axe.run().then((found) => found.violations.map((each) => [each.id, each.nodes[0].html]))"
    )
    tab.call("Page.setBypassCSP", enabled=False)
    assert found == []


def test_nothing_is_wider_than_a_narrow_screen_or_paper(page):
    for width, media in ((390, ""), (700, "print")):
        page.look(width=width, media=media)
        assert page.value("document.documentElement.scrollWidth") <= width


def test_what_is_asked_of_one_instant_and_missed_there_is_seen(tab, tmp_path):
    band = replace(verdict().band, start=60.0, end=60.0)
    missed = replace(verdict(Status.FAIL, 0.7), band=band, violation=(60.0, 60.0))
    runs = [replace(run(tmp_path, name), verdicts=(missed,)) for name in ("base", "again")]
    page = tmp_path / "report.html"
    page.write_text(page_text([outcome(tmp_path, *runs)]), encoding="utf-8")
    tab.look()
    tab.open(page.as_uri())
    boxes = "[...document.querySelectorAll('.lane {}')].map((each) => each.getBoundingClientRect())"
    areas = tab.value(f"{boxes.format('.area')}.map((each) => each.width)")
    assert areas
    assert min(areas) > 10
    plot = "document.querySelector('.lane-plot').getBoundingClientRect()"
    bars = tab.value(f"{boxes.format('.violation')}.map((each) => {plot}.right - each.right)")
    assert len(bars) == 2
    assert min(bars) > -0.5


def test_the_instant_of_a_miss_is_shown_with_its_run_and_the_slider_goes_on_from_there(page):
    jumps = "[...document.querySelectorAll('.jump')]"
    evil = f"{jumps}.find((each) => each.dataset.run.includes('#panic'))"
    page.value(f"{of(FIRST, '.zoom button')}.click()")  # a window that does not hold it
    page.value(f"{evil}.click()")
    assert page.value(f"{evil}.textContent").replace("\N{NO-BREAK SPACE}", " ") == "Show 35 s"
    assert text(page, FIRST, "output") == "35.0 s"
    chosen = page.value(f"{of(FIRST, '.details-of select')}.selectedOptions[0].textContent")
    assert "#panic" in chosen
    assert page.value(f"document.activeElement === {of(FIRST, 'input[type=range]')}")
    cursor = page.value(f"{of(FIRST, '.cursor')}.getBoundingClientRect().x")
    plot = of(FIRST, ".lane-plot") + ".getBoundingClientRect()"
    assert page.value(f"{plot}.left") < cursor < page.value(f"{plot}.right")
    assert page.said == []


def test_of_what_is_met_no_instant_is_offered(page):
    runs = page.value("[...document.querySelectorAll('.jump')].map((each) => each.dataset.run)")
    assert len(runs) == 1


def test_an_axis_upwards_has_two_numbers_at_least(tab, tmp_path):
    made = run(tmp_path)
    page = tmp_path / "report.html"
    tab.look()
    for most in (1.4, 2.2, 3.1, 4.4, 6.3, 8.8):
        made.trace.values[:, 0] = most * np.cos(made.trace.time)
        page.write_text(page_text([outcome(tmp_path, replace(made, verdicts=()))]), encoding="utf-8")
        tab.open(page.as_uri())
        counts = "[...document.querySelectorAll('.lane-up')].map((each) => each.children.length)"
        assert tab.value(counts)[0] >= 2, most

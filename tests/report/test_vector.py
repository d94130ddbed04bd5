"""SVG: the same bytes every time, and text that is text, whatever it says."""

import re
from xml.etree import ElementTree as ET

import pytest

from fcl_sim.report.time_plots import lanes, time_plot
from fcl_sim.report.vector import LAST_RESORT, svg
from tests.report.synthetic import EVIL, trace
from tests.report.test_time_plots import shown

NAMES = {"svg": "http://www.w3.org/2000/svg"}


def figure(name: str):
    run = shown(trace=trace(names=(name, "crane.sway", "x", "controller.rules.power")))
    return time_plot([run], lanes(run))


def lines(drawing: bytes) -> list[ET.Element]:
    return ET.fromstring(drawing).findall(".//svg:text", NAMES)  # noqa: S314  our own drawing


def test_a_figure_gives_the_same_bytes_every_time():
    assert svg(figure("a")) == svg(figure("a"))


@pytest.mark.parametrize("name", ["crane.distance", "$x_1$", "$", EVIL, "a\\b^2_3", "&lt;", "𝒳漢🏗"])
def test_a_name_is_drawn_as_the_text_it_is(name):
    drawn = ["".join(line.itertext()) for line in lines(svg(figure(name)))]
    assert any(text.startswith(name) for text in drawn)


def test_what_the_font_lacks_stands_apart_in_its_place():
    line = next(line for line in lines(svg(figure("ab漢字cd"))) if "漢" in "".join(line.itertext()))
    spans = line.findall("svg:tspan", NAMES)
    assert [span.text for span in spans[:2]] == ["ab", "漢字"]
    assert "".join(line.itertext()).startswith("ab漢字cd [m]")
    assert [span.get("font-family") == LAST_RESORT for span in spans] == [False, True, False]
    places = [float(span.get("x", "nan")) for span in spans]
    assert places == sorted(places)
    assert places[0] == pytest.approx(float(line.get("x", "nan")), abs=1e-3)


def test_a_name_of_known_letters_is_left_in_one_piece():
    assert not any(line.findall("svg:tspan", NAMES) for line in lines(svg(figure("Größe µ 😀"))))


def test_no_date_and_no_version_is_in_a_drawing():
    drawing = svg(figure("a")).decode()
    assert "dc:date" not in drawing
    assert re.search(r"[Mm]atplotlib v?\d", drawing) is None

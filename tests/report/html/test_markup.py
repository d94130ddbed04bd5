"""Elements: what is put in as a text comes out as that text."""

from html.parser import HTMLParser

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.report.html.markup import element, joined, prose

TEXTS = st.text(st.characters(exclude_characters="\r\x00", exclude_categories=["Cs"]))


class Reader(HTMLParser):
    """Collects the elements and the texts of a page."""

    def __init__(self, page):
        super().__init__()
        self.elements, self.texts = [], []
        self.feed(page)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))

    def handle_data(self, data):
        self.texts.append(data)


@given(TEXTS, TEXTS)
def test_a_text_and_an_attribute_are_read_back_as_they_were(text, title):
    read = Reader(element("p", text, title=title))
    assert read.elements == [("p", {"title": title})]
    assert "".join(read.texts) == text


def test_attributes_are_named_as_in_html_and_left_out_where_there_is_nothing():
    made = element("input", class_="big", aria_label="a", data_run=3, disabled=True, hidden=False, id=None)
    assert made == '<input class="big" aria-label="a" data-run="3" disabled>'


def test_markup_stays_markup_and_nothing_is_left_out_of_a_row():
    row = [element("b", "<"), None, "&"]
    assert joined("a", row) == "a<b>&lt;</b>&amp;"
    assert element("p", row, "z") == "<p><b>&lt;</b>&amp;z</p>"


@pytest.mark.parametrize(
    ("text", "html"),
    [
        ("in run `real`, `x`", "in run <code>real</code>, <code>x</code>"),
        ("`<b>` is text", "<code>&lt;b&gt;</code> is text"),
        ("a ` alone", "a ` alone"),
        ("`` is nothing", "`` is nothing"),
    ],
)
def test_what_stands_between_backticks_is_code(text, html):
    assert prose(text) == html

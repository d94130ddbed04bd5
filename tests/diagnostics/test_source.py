"""Places in a text."""

from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.diagnostics import Source, Span

texts = st.text(alphabet="ab \t\r\n\N{LINE SEPARATOR}é", max_size=40)


@given(texts, st.data())
def test_line_and_column_lead_back_to_the_character(text, data):
    source = Source("t", text)
    start = data.draw(st.integers(0, len(text)))
    span = Span(source, start, start)
    lines = text.split("\n")
    assert sum(len(line) + 1 for line in lines[: span.line - 1]) + span.column - 1 == start


@given(texts)
def test_the_lines_of_a_source_are_the_lines_of_its_text(text):
    source = Source("t", text)
    lines = [source.line_text(number) for number in range(1, len(source.line_starts) + 1)]
    assert lines == [line.rstrip("\r") for line in text.split("\n")]


def test_spans_join_and_know_their_text():
    source = Source("t", "one two three")
    joined = Span(source, 0, 3).to(Span(source, 4, 7))
    assert joined.text == "one two"
    assert (joined.line, joined.column) == (1, 1)

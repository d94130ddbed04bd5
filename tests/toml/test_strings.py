"""Every character of a string is found where it was written."""

import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.diagnostics import Source
from fcl_sim.toml import parse
from fcl_sim.toml.strings import offsets


def entry(text):
    tree = parse(Source("x.toml", text), not_toml="SCN102", twice="SCN103")
    return tree.table["key"]


def characters(text):
    """Return each character of a value with the one that stands at its offset."""
    found = entry(text)
    return [(char, text[at]) for char, at in zip(found.value, offsets(found.span, found.value), strict=False)]


@pytest.mark.parametrize("quote", ['"', "'", '"""', "'''"])
def test_a_plain_string_begins_behind_its_quotes(quote):
    text = f"# first\nkey = {quote}abs(x) < 3 m{quote} # last"
    found = entry(text)
    places = offsets(found.span, found.value)
    start = text.index("abs")
    assert places == tuple(range(start, start + len(found.value) + 1))


def test_an_escape_stands_where_it_begins():
    text = r'key = "a\u00b0\\b\"c\td"'
    assert characters(text) == [
        ("a", "a"),
        ("°", "\\"),
        ("\\", "\\"),
        ("b", "b"),
        ('"', "\\"),
        ("c", "c"),
        ("\t", "\\"),
        ("d", "d"),
    ]


def test_a_folded_line_leaves_no_character():
    text = 'key = """\nalways \\\n    (x > 1)\n  and y"""'
    assert entry(text).value == "always (x > 1)\n  and y"
    assert all(written == read for read, written in characters(text))


def test_a_string_in_three_quotes_may_begin_with_quotes():
    text = 'key = """"a"" b"""'
    assert entry(text).value == '"a"" b'
    assert all(written == read for read, written in characters(text))


def test_what_is_no_string_stands_at_its_beginning():
    found = entry("key = 12")
    assert offsets(found.span, "12") == (6, 6, 6)


def basic(char: str) -> st.SearchStrategy[str]:
    plain = char if char.isprintable() and char not in '"\\' else f"\\U{ord(char):08x}"
    return st.sampled_from([plain, f"\\U{ord(char):08x}"])


@given(
    st.text(st.characters(exclude_categories=["Cs"]), max_size=20).flatmap(
        lambda text: st.tuples(st.just(text), st.tuples(*map(basic, text)))
    )
)
def test_however_it_is_escaped_every_character_is_found(given_):
    value, pieces = given_
    text = f'key = "{"".join(pieces)}"'
    assert tomllib.loads(text)["key"] == value
    found = entry(text)
    starts = [7 + sum(len(each) for each in pieces[:index]) for index in range(len(pieces) + 1)]
    assert list(offsets(found.span, value)) == starts

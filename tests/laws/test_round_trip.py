"""What is written reads back as the same model, and what is written again is the same text."""

import re
from collections import Counter

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fcl_sim import fcl
from fcl_sim.diagnostics import Source
from tests.house.places import ROOT
from tests.laws.models import function_blocks
from tests.laws.shapes import NUMBERS

FILES = sorted(file for folder in ("tests/fcl", "scenarios") for file in (ROOT / folder).rglob("*.fcl"))
READABLE = [each for each in FILES if not fcl.read_file(each).errors]
TEXTS = [each for each in map(fcl.open_source, READABLE) if not fcl.parse(fcl.scan(each)).tree.verbatim]
COMMENTS = (
    *("(* {} *)", "/* {} */", "// {}\n", "(* {}\n   more *)"),
    *("\n(* {} *)\n", "\n\n// {}\n\n", " (* {} *)\n", "\n\t(* {}\n\tmore *)"),
)


def rewritten(text, name="t"):
    return fcl.rewrite(Source(name, text))


def comments_of(text):
    """Count the comments of a text by what they say."""
    found = (re.sub(r"\s+", " ", each.text).strip() for each in fcl.scan(Source("t", text)).comments)
    return Counter(re.sub("^[#%]", "//", each) for each in found)


@settings(max_examples=100, deadline=None)
@given(function_blocks())
def test_a_model_reads_back_as_it_was_written(block):
    text = fcl.write(block)
    reading = fcl.read(text)
    assert reading.errors == ()
    assert reading.blocks == (block,)


@settings(max_examples=15, deadline=None)
@given(st.lists(function_blocks(), min_size=2, max_size=3, unique_by=lambda each: each.name.upper()))
def test_several_models_read_back_as_they_were_written(blocks):
    text = fcl.write(blocks)
    assert fcl.read(text).blocks == tuple(blocks)
    assert rewritten(text) == text


@settings(max_examples=40, deadline=None)
@given(function_blocks())
def test_what_is_written_is_canonical(block):
    text = fcl.write(block)
    assert rewritten(text) == text
    assert max(map(len, text.split("\n"))) <= 110 or re.search(r"\S{60}", text) or block.options


@given(NUMBERS)
def test_a_number_reads_back_to_the_last_bit(value):
    text = f"FUNCTION_BLOCK b VAR_INPUT x: LREAL := {value!r}; END_VAR END_FUNCTION_BLOCK"
    (read,) = fcl.read(fcl.write(fcl.read(text).blocks)).blocks
    assert read.inputs[0].initial.hex() == value.hex()


@pytest.mark.parametrize("file", READABLE, ids=lambda file: f"{file.parent.name}-{file.stem}")
def test_every_file_that_can_be_read_is_written_without_a_loss(file):
    source = fcl.open_source(file)
    text = fcl.rewrite(source)
    assert fcl.read(text, str(file)).blocks == fcl.read_file(file).blocks
    assert fcl.rewrite(Source(str(file), text)) == text
    assert comments_of(text) == comments_of(source.text)
    assert fcl.read(fcl.write(fcl.read_file(file).blocks), str(file)).blocks == fcl.read_file(file).blocks


def places(source):
    """Return where a comment can be put in: before any word."""
    return [each.start for each in fcl.scan(source).tokens]


@settings(max_examples=150, deadline=None)
@given(st.sampled_from(TEXTS), st.data())
def test_comments_at_any_place_are_kept_each_once(source, data):
    put = st.tuples(st.sampled_from(places(source)), st.sampled_from(COMMENTS))
    chosen = data.draw(st.lists(put, max_size=12))
    text = source.text
    for number, (place, comment) in sorted(enumerate(chosen), key=lambda each: -each[1][0]):
        text = text[:place] + comment.format(f"n{number}") + text[place:]
    if fcl.read(text, source.name).errors:
        return  # a label and its letters have come apart
    canonical = rewritten(text, source.name)
    assert comments_of(canonical) == comments_of(text)
    assert rewritten(canonical, source.name) == canonical
    assert fcl.read(canonical, source.name).blocks == fcl.read(text, source.name).blocks
    assert_no_comment_inside(canonical)


def assert_no_comment_inside(text):
    """Each comment stands behind the last word of its line, at the end of a statement, or alone."""
    for comment in fcl.scan(Source("t", text)).comments:
        before = text[: comment.start].rsplit("\n", 1)[-1]
        after = text[comment.start + len(comment.text) :].split("\n", 1)[0].strip()
        code = re.sub(r"\(\*.*?\*\)|/\*.*?\*/|^.*\*[)/]", "", before).strip()
        assert after == "" or after.startswith(("(*", "/*", "//"))
        assert code == "" or code.endswith(";") or re.match("[A-Z]+_?[A-Z]*", code)

"""No text raises, and none takes long: real texts, changed at random, are read to the end (S13, S15b)."""

from pathlib import Path

from hypothesis import given, settings
from hypothesis import strategies as st

from fcl_sim import fcl
from fcl_sim.diagnostics import Source
from fcl_sim.diagnostics.render import render_all
from fcl_sim.fcl.keywords import ENDS, SECTIONS, STRUCTURAL

TEXTS = [file.read_text("utf-8") for file in sorted(Path(__file__).parent.rglob("*.fcl"))]
WORDS = [
    *sorted(ENDS | SECTIONS | STRUCTURAL),
    *("METHOD", "DEFAULT", "RANGE", "ACCU", "STRUCT", "TYPE", "FUNCTION", "very", "any", "nan", "inf"),
    *(":=", "..", ";;", ".", "^", "#", "//", "(*", "*)", "1e999", "16#", "REAL#1"),
    *("LOCK : PREVIOUS", "ENABLED : TRUE", "TRIAN 0 1 2", "Linear 1 2", "- -", "(" * 60, "NOT " * 60),
    *("\n%", "\0", "\r", "é", "\u202e"),
]


@st.composite
def mutated(draw):
    """Draw a text of the corpus with some stretches removed, doubled, moved or replaced by words."""
    text = draw(st.sampled_from(TEXTS))
    for _ in range(draw(st.integers(1, 6))):
        start = draw(st.integers(0, len(text)))
        end = min(len(text), start + draw(st.integers(0, 40)))
        to = draw(st.integers(0, len(text)))
        change = draw(st.sampled_from(("remove", "double", "move", "insert", "cut")))
        if change == "remove":
            text = text[:start] + text[end:]
        elif change == "double":
            text = text[:end] + text[start:]
        elif change == "move":
            text = text[:to] + text[start:end] + text[to:]
        elif change == "insert":
            text = text[:start] + " " + draw(st.sampled_from(WORDS)) + " " + text[start:]
        else:
            text = text[:start]
    return text


@settings(max_examples=150, deadline=None)
@given(mutated())
def test_a_changed_text_is_read_or_refused_and_every_stage_can_be_shown(text):
    reading = fcl.read(text, "changed.fcl")
    assert bool(reading.blocks) != bool(reading.errors)
    render_all(reading.diagnostics)
    for block in reading.blocks:
        fcl.show_model(block)
    scan = fcl.scan(Source("changed.fcl", text))
    fcl.show_tokens(scan)
    fcl.show_tree(fcl.parse(scan).tree)


@settings(max_examples=100, deadline=None)
@given(st.text(max_size=200), st.sampled_from(("", "FUNCTION_BLOCK a ", "FUNCTION_BLOCK a VAR_INPUT ")))
def test_any_text_at_all_is_refused_with_a_message(text, head):
    reading = fcl.read(head + text)
    assert reading.errors or reading.blocks

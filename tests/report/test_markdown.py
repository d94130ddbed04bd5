"""A README on the page: its blocks, how words stand, and that nothing of it is lost or taken for markup."""

from hypothesis import given, settings
from hypothesis import strategies as st

from fcl_sim.report.markdown import blocks, runs
from tests.house.places import ROOT
from tests.report.reading import bare
from tests.report.synthetic import EVIL


def words(block):
    match block["kind"]:
        case "heading" | "paragraph":
            return "".join(text for text, _ in block["runs"])
        case "code":
            return block["text"]
        case "list":
            return "\n".join("".join(text for text, _ in item) for item in block["items"])
    return "\n".join("".join(text for text, _ in cell) for row in block["rows"] for cell in row)


def test_every_kind_of_block_is_read():
    text = (
        "# A *title*\n\nOne line\nand another.\n- first\n  goes on\n- second\n\n1. one\n2. two\n\n"
        "| a | b |\n|---|---|\n| x | `y \\| z` |\n\n    code  here\n\n```fcl\nTERM x\n```\nlast"
    )
    assert [(each["kind"], words(each)) for each in blocks(text)] == [
        ("heading", "A title"),
        ("paragraph", "One line and another."),
        ("list", "first goes on\nsecond"),
        ("list", "one\ntwo"),
        ("table", "a\nb\nx\ny | z"),
        ("code", "code  here"),
        ("code", "TERM x"),
        ("paragraph", "last"),
    ]


def test_words_stand_as_they_are_marked():
    assert runs("a **b** *c* `d*e` [f `g`](h.md) 2 * 3 * 4") == [
        ("a ", "plain"),
        ("b", "bold"),
        (" ", "plain"),
        ("c", "italic"),
        (" ", "plain"),
        ("d*e", "code"),
        (" f ", "plain"),
        ("g", "code"),
        (" 2 * 3 * 4", "plain"),
    ]


def test_code_within_bold_stays_code():
    assert runs("**`a`, b** c") == [("a", "code"), (", b", "bold"), (" c", "plain")]


def test_what_is_no_markdown_stays_as_it_is_written():
    evil = EVIL.replace("*", "").replace("`", "").replace("[", "")
    assert runs(evil) == [(evil, "plain")]


@settings(max_examples=60)
@given(st.text(alphabet="a b\n#|-*`1.[]()\\", max_size=60))
def test_any_text_has_blocks_and_no_letter_is_lost(text):
    found = "".join(words(each) for each in blocks(text))
    links = "".join(text.split("](")[:1])
    assert links.count("a") <= found.count("a") <= text.count("a") or "```" in text


def test_the_readmes_of_the_bench_are_read_whole():
    for file in (ROOT / "scenarios").glob("*/README.md"):
        text = file.read_text("utf-8")
        found = bare(" ".join(words(each) for each in blocks(text)))
        for word in text.replace("|", " ").replace("*", " ").replace("`", " ").split():
            if word.isalpha():
                assert word in found

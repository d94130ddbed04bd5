"""Text → tokens."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.diagnostics import Source
from fcl_sim.fcl import scan
from fcl_sim.fcl.tokens import Kind


def words(text):
    return [each.text for each in scan(Source("t", text)).tokens[:-1]]


def kinds(text):
    return [each.kind for each in scan(Source("t", text)).tokens[:-1]]


def codes(text):
    return [each.code for each in scan(Source("t", text)).diagnostics]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("temp:=(3,1)(27.5,0);", ["temp", ":=", "(", "3", ",", "1", ")", "(", "27.5", ",", "0", ")", ";"]),
        ("(0..100)", ["(", "0", "..", "100", ")"]),
        ("-5..5", ["-", "5", "..", "5"]),
        ("0.0..1.0", ["0.0", "..", "1.0"]),
        (".5 5. 1.5E-2 1e3", [".5", "5.", "1.5E-2", "1e3"]),
        ("16#FF REAL#-1.5E-3 INT#16#0A", ["16#FF", "REAL#-1.5E-3", "INT#16#0A"]),
        ("RULE 3a:", ["RULE", "3a", ":"]),
        ("colour.brown = x", ["colour", ".", "brown", "=", "x"]),
        ("1_000 a_b _c", ["1_000", "a_b", "_c"]),
        ("a/b*c^d", ["a", "/", "b", "*", "c", "^", "d"]),
    ],
)
def test_words_are_told_apart(text, expected):
    assert words(text) == expected


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("cold", Kind.NAME),
        ("IF", Kind.NAME),
        ("12", Kind.NUMBER),
        ("12.5", Kind.NUMBER),
        ("2#1010", Kind.LITERAL),
        ("REAL#1", Kind.LITERAL),
        ("T#5s", Kind.LITERAL),
        ("3a", Kind.MIXED),
        ("1.2.3", Kind.MIXED),
        ("27degC", Kind.MIXED),
        (":=", Kind.SYMBOL),
        ("§", Kind.STRAY),
        ("*)", Kind.STRAY),
    ],
)
def test_each_word_is_of_one_kind(text, kind):
    assert kinds(text) == [kind]


def test_names_compare_without_regard_to_letter_case_and_keep_their_spelling():  # S1
    first, second, _ = scan(Source("t", "Temp tEMP")).tokens
    assert first.key == second.key
    assert (first.text, second.text) == ("Temp", "tEMP")


@pytest.mark.parametrize(
    "comment",
    [
        "(* a *)",
        "/* a */",
        "// a",
        "(**)",
        "/**/",
        "(***)",
        "(* a ** b *)",
        "(* // *)",
        "/* (* */",
        "(* a\nb *)",
        "//",
    ],
)
def test_comments_are_kept_apart(comment):  # S13
    scanned = scan(Source("t", f"one {comment}\ntwo"))
    assert [each.text for each in scanned.tokens] == ["one", "two", ""]
    assert [(each.text, each.start) for each in scanned.comments] == [(comment, 4)]
    assert scanned.diagnostics == ()


@pytest.mark.parametrize("comment", ["(* a", "(*", "(*)", "/* a", "/*/", "/* *)", "(* */", "(* // *"])
def test_an_unclosed_comment_is_an_error_at_its_opening(comment):  # S13
    (diagnostic,) = scan(Source("t", f"one\n  {comment}")).diagnostics
    assert diagnostic.code == "FCL110"
    assert diagnostic.hint == ("close it with `*)`" if comment[0] == "(" else "close it with `*/`")
    span = diagnostic.places[0].span
    assert (span.line, span.column, span.text) == (2, 3, comment[:2])


def test_comments_are_not_nested():  # S13
    assert codes("(* (* *) *)") == ["FCL111"]


def test_space_is_whatever_looks_like_it():
    assert words("\ufeffa\u00a0b\r\nc\td\fe\u2003f") == list("abcdef")


def test_a_character_without_meaning_is_named_and_found_everywhere():
    (diagnostic,) = scan(Source("t", "a § b\n§")).diagnostics
    assert diagnostic.message == "`§` has no meaning in FCL"
    assert [place.span.line for place in diagnostic.places] == [1, 2]


@pytest.mark.parametrize(
    ("character", "named"),
    [
        ("\0", "U+0000 (NUL)"),
        ("\x1b", "U+001B (a control character)"),
        ("\u200b", "U+200B (ZERO WIDTH SPACE)"),
    ],
)
def test_a_character_that_cannot_be_seen_is_called_by_its_number(character, named):
    (diagnostic,) = scan(Source("t", character)).diagnostics
    assert diagnostic.message == f"the character {named} has no meaning in FCL"


@pytest.mark.parametrize(
    ("sign", "hint"), [("–", "`-`"), ("&", "AND"), ("!", "NOT"), ("[", "`(`"), ("<", "IS")]
)
def test_signs_of_other_languages_are_translated(sign, hint):
    (diagnostic,) = scan(Source("t", f"a {sign} b")).diagnostics
    assert hint in diagnostic.hint


def test_names_with_other_letters_are_read_with_one_warning_for_each_name():
    scanned = scan(Source("t", "größe GRÖSSE größe wärme"))
    assert [each.kind for each in scanned.tokens[:-1]] == [Kind.NAME] * 4
    (diagnostic,) = scanned.diagnostics
    assert (diagnostic.code, diagnostic.severity) == ("FCL115", "warning")
    assert [place.span.text for place in diagnostic.places] == ["größe", "wärme"]
    assert diagnostic.message.endswith(": `größe`, `wärme`")


def test_of_many_names_with_other_letters_the_first_five_are_named():
    (diagnostic,) = scan(Source("t", " ".join(f"ä{number}" for number in range(9)))).diagnostics
    assert diagnostic.message.endswith(": `ä0`, `ä1`, `ä2`, `ä3`, `ä4` and 4 more")
    assert len(diagnostic.places) == 9


@given(st.text(alphabet="ab1._#:=()*/;,-+ \n\t§'Eeé\0", max_size=60) | st.text(max_size=60))
def test_every_character_of_a_text_is_in_one_token_in_a_comment_or_space(text):
    scanned = scan(Source("t", text))
    openings = {each.start for each in scanned.comments}
    # the sign of a comment that is never closed is a token as well
    parts = [*(each for each in scanned.tokens if each.start not in openings), *scanned.comments]
    left = list(text)
    for part in parts:
        for offset, character in enumerate(part.text, start=part.start):
            assert left[offset] == character
            left[offset] = " "
    assert "".join(left).replace("\ufeff", " ").strip() == ""


@given(st.text(max_size=60))
def test_tokens_stand_in_the_order_of_the_text_and_end_with_its_end(text):
    tokens = scan(Source("t", text)).tokens
    assert [each.start for each in tokens] == sorted(each.start for each in tokens)
    assert (tokens[-1].kind, tokens[-1].start) == (Kind.END, len(text))

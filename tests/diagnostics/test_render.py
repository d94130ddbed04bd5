"""Diagnostics as people read them."""

import pytest

from fcl_sim.diagnostics import Diagnostic, Place, Severity, Source, Span
from fcl_sim.diagnostics.render import printable, render, render_all, summary


def span(source, word, nth=0):
    start = -1
    for _ in range(nth + 1):
        start = source.text.index(word, start + 1)
    return Span(source, start, start + len(word))


def finding(*places, message="something is wrong", hint="", severity=Severity.ERROR):
    return Diagnostic(code="FCL201", message=message, severity=severity, places=places, hint=hint)


def test_the_first_line_is_what_editors_jump_to_and_the_caret_stands_under_the_word():
    source = Source("bath.fcl", "first line\n  a wrong word\n")
    drawn = render(finding(Place(span(source, "wrong")), hint="write right"))
    assert drawn == (
        "bath.fcl:2:5: error[FCL201]: something is wrong\n"
        "  2 |   a wrong word\n"
        "    |     ^^^^^\n"
        "  hint: write right"
    )


def test_the_label_of_the_first_place_stands_beside_the_caret():
    source = Source("bath.fcl", "one two")
    assert render(finding(Place(span(source, "two"), "expected three"))).endswith("|     ^^^ expected three")


def test_a_place_with_a_label_is_drawn_and_one_without_is_named():
    source = Source("bath.fcl", "name;\nname;\nname;\n")
    places = (Place(span(source, "name", 1)), Place(span(source, "name", 2)))
    drawn = render(finding(*places, Place(span(source, "name", 0), "first here")))
    assert drawn == (
        "bath.fcl:2:1: error[FCL201]: something is wrong\n"
        "  2 | name;\n"
        "    | ^^^^\n"
        "  also at bath.fcl:3:1\n"
        "  bath.fcl:1:1: first here\n"
        "  1 | name;\n"
        "    | ^^^^"
    )


@pytest.mark.parametrize(
    ("count", "last"),
    [(6, "  also at t:6:1"), (7, "  and at 1 more place"), (36, "  and at 30 more places")],
)
def test_after_five_further_places_the_others_are_counted(count, last):
    source = Source("t", "x\n" * count)
    drawn = render(finding(*(Place(Span(source, 2 * each, 2 * each + 1)) for each in range(count))))
    assert drawn.splitlines()[-1] == last
    assert drawn.count("also at") == 5


def test_a_whole_file_and_no_place_at_all_have_no_excerpt():
    assert render(finding(Place(file="bath.fcl"))) == "bath.fcl: error[FCL201]: something is wrong"
    assert render(finding(severity=Severity.NOTE)) == "note[FCL201]: something is wrong"


def test_a_long_line_is_cut_on_both_sides_of_the_caret():
    source = Source("t", "a" * 300 + "WRONG" + "b" * 300)
    _, line, caret = render(finding(Place(span(source, "WRONG")))).splitlines()
    shown = line.removeprefix("  1 | ")
    assert len(shown) == 102
    assert shown[0] == shown[-1] == "…"
    start = caret.index("^")
    assert line[start : caret.rindex("^") + 1] == "WRONG"


@pytest.mark.parametrize("at", [0, 595])
def test_a_long_line_is_cut_on_one_side_where_the_caret_is_near_an_end(at):
    text = "a" * at + "WRONG" + "b" * (595 - at)
    source = Source("t", text)
    _, line, caret = render(finding(Place(span(source, "WRONG")))).splitlines()
    assert line.count("…") == 1
    assert line[caret.index("^") : caret.rindex("^") + 1] == "WRONG"


def test_a_span_of_several_lines_is_marked_to_the_end_of_the_first():
    source = Source("t", "RULE 1: IF\n  a THEN b;\n")
    assert render(finding(Place(Span(source, 0, 20)))).splitlines()[1:] == [
        "  1 | RULE 1: IF",
        "    | ^^^^^^^^^^",
    ]


def test_something_missing_at_the_end_of_a_line_has_one_caret_behind_it():
    source = Source("t", "a: REAL\nb")
    assert render(finding(Place(Span(source, 7, 7)))).splitlines()[1:] == ["  1 | a: REAL", "    |        ^"]


def test_an_empty_text_can_be_pointed_at():
    assert render(finding(Place(Span(Source("t", ""), 0, 0)))) == (
        "t:1:1: error[FCL201]: something is wrong\n  1 |\n    | ^"
    )


def test_the_margin_grows_with_the_line_number():
    source = Source("t", "\n" * 99 + "wrong")
    assert render(finding(Place(span(source, "wrong")))).splitlines()[1:] == [
        "  100 | wrong",
        "      | ^^^^^",
    ]


def test_tabs_and_returns_do_not_move_the_caret():
    source = Source("t", "\t\twrong\r\n")
    assert render(finding(Place(span(source, "wrong")))).splitlines()[1:] == [
        "  1 |   wrong",
        "    |   ^^^^^",
    ]


def test_wide_letters_and_accents_do_not_move_the_caret():
    wide = Source("t", "温度 wrong")
    assert render(finding(Place(span(wide, "wrong")))).splitlines()[2] == "    |      ^^^^^"
    accent = Source("t", "e\N{COMBINING ACUTE ACCENT} wrong")
    assert render(finding(Place(span(accent, "wrong")))).splitlines()[2] == "    |   ^^^^^"


def test_nothing_in_a_text_a_message_or_a_name_can_steer_the_terminal():
    source = Source("evil\x1b[2J\udcff", "\x1b[31mwrong\x00\N{RIGHT-TO-LEFT OVERRIDE}")
    drawn = render(finding(Place(span(source, "wrong")), message="what\x07\nelse", hint="\x9b"))
    assert drawn == (
        "evil�[2J�:1:6: error[FCL201]: what��else\n  1 | �[31mwrong��\n    |      ^^^^^\n  hint: �"
    )
    drawn.encode("utf-8")


def test_printable_text_stays_as_it_is():
    assert printable("größe 温度 (°C)") == "größe 温度 (°C)"


def test_several_findings_end_with_their_count():
    findings = [
        finding(message="one"),
        finding(message="two"),
        finding(severity=Severity.WARNING),
        finding(severity=Severity.NOTE),
    ]
    assert render_all(findings).splitlines()[-1] == "2 errors, 1 warning, 1 note"
    assert summary(findings[:1]) == "1 error"
    assert render_all([]) == summary([]) == "no findings"

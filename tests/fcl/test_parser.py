"""Tokens → tree: forms that are read alike, and where reading goes on after a fault."""

import pytest

from fcl_sim import fcl
from fcl_sim.model import Method, Point, Points, Singleton
from tests.fcl.texts import BATH, block, changed, codes, tree, with_rule

AREAS = (
    ("    TERM closed := 0;\n", "    {range}\n    TERM closed := (-10, 1) (10, 0);\n"),
    ("    TERM inlet := 100;\n", "    TERM inlet := (90, 0) (110, 1);\n"),
    ("METHOD: CoGS", "METHOD: CoG"),
)


# -- terms


@pytest.mark.parametrize(
    "shape", ["(3, 1) (27, 0)", "(3, 1), (27, 0)", "( 3,1 )(27 ,0)", "(+3, 1.0),(2_7, 0E0)"]
)
def test_points_are_read_with_and_without_commas_between_them(shape):  # S2
    found = block(changed(("(3, 1) (27, 0)", shape))).fuzzifications[0].terms[0]
    assert found.shape == Points((Point(3.0, 1.0), Point(27.0, 0.0)))


@pytest.mark.parametrize(
    ("value", "expected"), [("-27", -27.0), ("+.5", 0.5), ("16#10", 16.0), ("temp", "temp")]
)
def test_a_singleton_is_a_number_or_an_input(value, expected):  # 5.2.3
    found = block(changed(("TERM inlet := 100", f"TERM inlet := {value}"))).defuzzifications[0].terms[1]
    assert found.shape == Singleton(expected)


# -- settings of an output


@pytest.mark.parametrize(
    "form", ["RANGE(-10..110);", "RANGE := (-10 .. 110);", "RANGE:=(-10..110)", "range (-10.0..1.1E2);"]
)
def test_a_range_is_read_in_every_form(form):  # S3
    edits = [(old, new.replace("{range}", form)) for old, new in AREAS]
    assert block(changed(*edits)).defuzzifications[0].range == (-10.0, 110.0)


def test_a_range_may_stand_behind_the_terms():  # S3
    first, second, third = AREAS
    edits = (first[0], first[1].replace("    {range}\n", "")), second, third
    text = changed(*edits, ("    DEFAULT := 0;", "    DEFAULT := 0;\n    RANGE := (-10 .. 110);"))
    assert block(text).defuzzifications[0].range == (-10.0, 110.0)


@pytest.mark.parametrize(("form", "expected"), [("NC", None), ("nc", None), ("-2.5", -2.5), ("REAL#7", 7.0)])
def test_a_default_is_a_number_or_no_change(form, expected):
    assert block(changed(("DEFAULT := 0", f"DEFAULT := {form}"))).defuzzifications[0].default == expected


@pytest.mark.parametrize("written", ["CoGS", "COGS", "cogs"])
def test_methods_are_read_in_any_letter_case(written):  # S1
    assert block(changed(("CoGS", written))).defuzzifications[0].method is Method.COGS


# -- rules


@pytest.mark.parametrize(
    ("written", "label"),
    [
        ("RULE 1:", "1"),
        ("RULE 3a:", "3a"),
        ("RULE1:", "1"),
        ("RULE_12:", "12"),
        ("RULE R_1 :", "R_1"),
        ("rule 007:", "007"),
    ],
)
def test_a_label_is_any_run_of_letters_digits_and_underscores(written, label):  # S5
    text = with_rule(f"{written} IF temp IS cold THEN valve IS inlet;")
    assert fcl.read(text).diagnostics == ()
    assert block(text).rule_blocks[0].rules[0].label == label


def test_a_rule_without_a_label_is_called_by_its_number():
    text = with_rule("RULE: IF temp IS cold THEN valve IS inlet;")
    assert [each.label for each in block(text).rule_blocks[0].rules] == ["1", "2"]


@pytest.mark.parametrize(
    ("written", "weight"), [("", 1.0), (" WITH 0.5", 0.5), (" WITH 0", 0.0), (" WITH level", "level")]
)
def test_a_weight_is_one_a_number_or_an_input(written, weight):  # 5.2.4
    text = with_rule(f"RULE 1: IF temp IS cold THEN valve IS inlet{written};")
    assert block(text).rule_blocks[0].rules[0].conclusions[0].weight == weight


@pytest.mark.parametrize("separator", [",", " AND"])
def test_each_subconclusion_has_its_own_weight(separator):  # S6, S12
    text = with_rule(f"RULE 1: IF temp IS cold THEN valve IS inlet WITH 0.5{separator} valve IS closed;")
    assert [each.weight for each in block(text).rule_blocks[0].rules[0].conclusions] == [0.5, 1.0]


# -- function blocks and what stands around them


@pytest.mark.parametrize("name", ["Fuzzy-FB", "Fuzzy FB", "3rd block"])
def test_a_name_that_is_no_identifier_is_read_with_a_note(name):  # S17
    text = changed(("FUNCTION_BLOCK bath", f"FUNCTION_BLOCK {name}"))
    assert codes(text) == ["FCL221"]
    assert block(text).name == name


def test_a_function_block_without_a_name_is_called_by_its_file():  # S11
    text = changed(("FUNCTION_BLOCK bath", "FUNCTION_BLOCK"))
    assert fcl.read(text, "some/where/bath.fcl").blocks[0].name == "bath"
    assert fcl.read(text).blocks[0].name == "unnamed"


def test_the_name_may_stand_on_the_next_line():
    assert block(changed(("FUNCTION_BLOCK bath", "FUNCTION_BLOCK\n\n  bath"))).name == "bath"


@pytest.mark.parametrize(
    ("opening", "closing"), [("OPTION", "END_OPTION"), ("OPTIONS", "END_OPTIONS"), ("OPTIONS", "END_OPTION")]
)
def test_options_are_kept_word_for_word_and_nothing_in_them_is_a_fault(opening, closing):  # S4
    inside = "\n  cycle := 50 ms; 'text' @ § RULE 1: TERM (* kept *)\n"
    text = changed(("END_RULEBLOCK\n", f"END_RULEBLOCK\n{opening}{inside}{closing}\n"))
    assert fcl.read(text).diagnostics == ()
    assert block(text).options == (inside,)


def test_function_blocks_are_read_in_the_order_of_the_text():  # S16
    reading = fcl.read(BATH + "\n" + BATH.replace("bath", "shower"))
    assert [each.name for each in reading.blocks] == ["bath", "shower"]


def test_text_between_and_behind_function_blocks_is_passed_over():  # S15b
    reading = fcl.read(BATH + "remarks: it's § 5\n" + BATH.replace("bath", "shower") + "more of them!")
    assert len(reading.blocks) == 2
    (warning,) = reading.diagnostics
    assert [place.span.text for place in warning.places] == ["remarks", "more"]


@pytest.mark.parametrize("text", ["", "  \n", "(* nothing *)", "hello world", "x = 1;", "§§", "\0"])
def test_a_text_without_a_function_block_is_one_message(text):
    assert codes(text) == ["FCL205"]


def test_sections_may_stand_in_any_order():
    start = BATH.index("RULEBLOCK")
    rules = BATH[start : BATH.index("END_FUNCTION_BLOCK")]
    moved = BATH.replace(rules, "").replace("VAR_INPUT\n", rules + "VAR_INPUT\n", 1)
    assert block(moved) == block(BATH)


# -- keywords as names


@pytest.mark.parametrize(
    "name", ["time", "type", "true", "very", "range", "min", "default", "METHOD", "rule", "term", "is", "if"]
)
def test_keywords_can_be_names_of_variables_and_terms(name):  # S1a
    text = BATH.replace("temp", name).replace("cold", "lm")
    assert fcl.read(text).diagnostics == ()
    assert block(text).inputs[0].name == name
    text = BATH.replace("cold", name)
    assert fcl.read(text).diagnostics == ()
    assert block(text).fuzzifications[0].terms[0].name == name


# -- after a fault


def test_several_faults_are_found_in_one_go():
    text = changed(
        ("    level: REAL;", "    level = REAL;"),
        ("(3, 1) (27, 0)", "(3, 1) (27, 0"),
        ("METHOD: CoGS", "METHOD CoGS"),
        ("valve IS inlet", "valve IS intel"),
        ("RULE 2: IF", "RULE 2:"),
    )
    assert codes(text) == ["FCL201", "FCL207", "FCL201", "FCL310", "FCL201"]


def test_a_missing_semicolon_is_one_warning_with_a_place_for_each():  # S9
    lines = BATH.split("\n")
    bare = "\n".join(line.removesuffix(";") for line in lines)
    (warning,) = fcl.read(bare).diagnostics
    assert (warning.code, warning.severity) == ("FCL206", "warning")
    assert len(warning.places) == sum(line.endswith(";") for line in lines)
    assert block(bare) == block(BATH)


def test_what_is_missing_at_the_end_of_a_line_is_missed_there():
    (diagnostic,) = fcl.read(
        changed(("temp IS cold AND level IS low THEN valve IS inlet;", "temp IS"))
    ).diagnostics
    assert diagnostic.message == "a term of `temp` is expected, but the line ends"
    span = diagnostic.places[0].span
    assert (span.line, span.column) == (26, 23)


def test_a_term_that_cannot_be_read_keeps_its_name():
    assert codes(changed(("(3, 1) (27, 0)", "(3, 1) (27 0)"))) == ["FCL201"]


@pytest.mark.parametrize("name", ["temp", "level"])
def test_a_declaration_that_cannot_be_read_keeps_its_name(name):
    assert codes(changed((f"{name}: REAL", f"{name}: "))) == ["FCL209"]


def test_a_declaration_that_stops_does_not_swallow_the_next():
    text = changed(("    temp: REAL;\n", "    temp:\n"))
    (diagnostic,) = fcl.read(text).diagnostics
    assert diagnostic.message == "a data type is expected, but the line ends"
    assert codes(changed(("    temp: REAL;\n", "    temp: REAL :=\n"))) == ["FCL201"]


def slips(text):
    """Yield a text for each word, without it and with a wrong letter at its end."""
    tokens = fcl.scan(tree(text).source).tokens[:-1]
    for token in tokens:
        yield text[: token.start] + text[token.end :]
        if len(token.text) > 2:
            yield text[: token.end - 1] + "q" + text[token.end :]


def test_one_slip_of_the_pen_is_one_message():
    several = [slip for slip in slips(BATH) if len(codes(slip)) > 1]
    assert several == []


def test_hardly_a_slip_of_the_pen_goes_unnoticed():
    silent = [slip for slip in slips(BATH) if not codes(slip)]
    assert silent == [BATH.replace("bath", "batq"), BATH.replace("No1", "Noq")]

"""Tree → model: what names mean, what is chosen where the text is silent, what is refused."""

import pytest

from fcl_sim import fcl
from fcl_sim.diagnostics.render import render
from fcl_sim.model import Accumulation, Activation, AndOperator, DataType, Is, Method, OrOperator
from tests.fcl.texts import BATH, block, changed, codes, with_rule

AREAS = (
    ("TERM closed := 0", "TERM closed := (-10, 1) (10, 0)"),
    ("TERM inlet := 100", "TERM inlet := (90, 0) (110, 1)"),
)


def drawn(text):
    return "\n".join(render(each) for each in fcl.read(text, "bath.fcl").diagnostics)


# -- names


def test_every_name_of_the_model_is_spelled_as_declared():  # S1
    text = with_rule("RULE 1: IF TEMP IS Cold AND Level IS LOW THEN Valve IS InLet WITH LEVEL;")
    text = text.replace("FUZZIFY temp", "FUZZIFY Temp").replace("DEFUZZIFY valve", "DEFUZZIFY VALVE")
    found = block(text)
    rule = found.rule_blocks[0].rules[0]
    assert rule.condition.arguments == (Is("temp", "cold"), Is("level", "low"))
    (conclusion,) = rule.conclusions
    assert (conclusion.variable, conclusion.term, conclusion.weight) == ("valve", "inlet", "level")
    assert found.fuzzifications[0].variable == "temp"
    assert found.defuzzifications[0].variable == "valve"
    assert {each.code for each in fcl.read(text).diagnostics} == {"FCL304"}


def test_two_spellings_of_a_name_are_one_note():  # S1
    text = with_rule("RULE 1: IF Temp IS cold OR TEMP IS hot OR Temp IS hot THEN valve IS inlet;")
    (note,) = fcl.read(text).diagnostics
    assert note.severity == "note"
    assert note.message == "`temp` is also spelled `Temp` or `TEMP`"
    assert [place.span.text for place in note.places] == ["Temp", "TEMP"]


def test_an_unknown_name_is_one_message_with_all_its_places():
    rules = "".join(f"    RULE {each}: IF temp IS warm THEN valve IS inlet;\n" for each in range(3, 39))
    text = changed(("END_RULEBLOCK", f"{rules}END_RULEBLOCK"))
    (diagnostic,) = fcl.read(text).diagnostics
    assert len(diagnostic.places) == 36
    assert render(diagnostic).splitlines()[-3:] == [
        "  also at <text>:33:24",
        "  and at 30 more places",
        "  hint: valid here: cold or hot",
    ]


def test_a_term_of_another_variable_is_recognised_as_one():
    assert drawn(with_rule("RULE 1: IF temp IS low THEN valve IS inlet;")) == (
        "bath.fcl:26:24: error[FCL310]: `low` is not a term of `temp`, it is one of `level`\n"
        "  26 |     RULE 1: IF temp IS low THEN valve IS inlet;\n"
        "     |                        ^^^\n"
        "  hint: valid here: cold or hot"
    )


def test_an_undeclared_name_is_reported_with_the_nearest_one():
    assert drawn(with_rule("RULE 1: IF temp IS cold THEN vavle IS inlet;")) == (
        "bath.fcl:26:34: error[FCL302]: `vavle` is not declared\n"
        "  26 |     RULE 1: IF temp IS cold THEN vavle IS inlet;\n"
        "     |                                  ^^^^^\n"
        "  hint: did you mean `valve`?"
    )


def test_an_undeclared_name_that_is_like_no_other_is_reported_with_those_there_are():
    assert drawn(with_rule("RULE 1: IF x IS cold THEN valve IS inlet;")).endswith(
        "hint: declared: temp, level or valve"
    )


def test_a_name_of_any_length_is_quoted_in_forty_letters():
    (diagnostic,) = fcl.read(with_rule(f"RULE 1: IF {'x' * 5000} IS cold THEN valve IS inlet;")).diagnostics
    assert diagnostic.message == f"`{'x' * 40}…` is not declared"


def test_a_clash_shows_both_places():
    assert drawn(changed(("    level: REAL;", "    level: REAL;\n    Level: INT;"))) == (
        "bath.fcl:5:5: error[FCL301]: `level` is declared twice\n"
        "  5 |     Level: INT;\n"
        "    |     ^^^^^\n"
        "  bath.fcl:4:5: first here\n"
        "  4 |     level: REAL;\n"
        "    |     ^^^^^"
    )


def test_a_misspelt_fuzzify_does_not_make_its_rules_wrong():
    assert codes(changed(("FUZZIFY temp", "FUZZIFY tmep"))) == ["FCL302"]


# -- declarations


@pytest.mark.parametrize("data_type", list(DataType))
def test_every_elementary_type_of_a_number_is_known(data_type):
    found = block(changed(("level: REAL", f"level: {data_type.lower()}")))
    assert found.inputs[1].type is data_type


@pytest.mark.parametrize(
    ("declaration", "initial"),
    [
        ("REAL", None),
        ("REAL := 0.5", 0.5),
        ("LREAL := -1E-3", -0.001),
        ("INT := -32_768", -32768.0),
        ("USINT := 16#FF", 255.0),
        ("BOOL := TRUE", 1.0),
        ("BOOL := 0", 0.0),
    ],
)
def test_initial_values_are_read(declaration, initial):
    assert block(changed(("level: REAL", f"level: {declaration}"))).inputs[1].initial == initial


@pytest.mark.parametrize(
    ("data_type", "least", "largest"),
    [
        ("SINT", -(2**7), 2**7 - 1),
        ("INT", -(2**15), 2**15 - 1),
        ("DINT", -(2**31), 2**31 - 1),
        ("USINT", 0, 2**8 - 1),
        ("UINT", 0, 2**16 - 1),
        ("UDINT", 0, 2**32 - 1),
        ("BOOL", 0, 1),
    ],
)
def test_an_initial_value_lies_in_the_range_of_its_type(data_type, least, largest):
    for value, expected in ((least, []), (largest, []), (least - 1, ["FCL306"]), (largest + 1, ["FCL306"])):
        assert codes(changed(("level: REAL", f"level: {data_type} := {value}"))) == expected


def test_the_longest_integers_are_read_to_their_ends():
    for data_type, value in (("LINT", -(2**63)), ("LINT", 2**63 - 1), ("ULINT", 2**64 - 1)):
        assert codes(changed(("level: REAL", f"level: {data_type} := {value}"))) == []
    for data_type, value in (("LINT", -(2**64)), ("LINT", 2**64), ("ULINT", -1), ("ULINT", 2**65)):
        assert codes(changed(("level: REAL", f"level: {data_type} := {value}"))) == ["FCL306"]


def test_several_names_share_a_declaration():
    found = block(changed(("temp: REAL;\n    level: REAL;", "temp, level: LREAL := 2;")))
    assert [(each.name, each.type, each.initial) for each in found.inputs] == [
        ("temp", DataType.LREAL, 2.0),
        ("level", DataType.LREAL, 2.0),
    ]


# -- operators and methods


@pytest.mark.parametrize(
    ("written", "and_operator", "or_operator"),
    [
        ("", "MIN", "MAX"),
        ("AND: MIN;", "MIN", "MAX"),
        ("AND: PROD;", "PROD", "ASUM"),
        ("AND: BDIF;", "BDIF", "BSUM"),
        ("OR: MAX;", "MIN", "MAX"),
        ("OR: ASUM;", "PROD", "ASUM"),
        ("OR: BSUM;", "BDIF", "BSUM"),
        ("OR: ASUM AND: PROD;", "PROD", "ASUM"),
        ("AND: PROD OR: ASUM;", "PROD", "ASUM"),
        ("AND: bdif; OR: bsum;", "BDIF", "BSUM"),
    ],
)
def test_a_missing_operator_is_the_pair_of_the_other(written, and_operator, or_operator):  # S10
    text = changed(("AND: MIN;", written))
    assert fcl.read(text).diagnostics == ()
    found = block(text).rule_blocks[0]
    assert (found.and_operator, found.or_operator) == (AndOperator(and_operator), OrOperator(or_operator))


@pytest.mark.parametrize("and_operator", ["MIN", "PROD", "BDIF"])
@pytest.mark.parametrize("or_operator", ["MAX", "ASUM", "BSUM"])
def test_operators_that_are_no_pair_are_read_with_a_warning(and_operator, or_operator):  # S10, Table 3
    text = changed(("AND: MIN;", f"AND: {and_operator}; OR: {or_operator};"))
    paired = (and_operator, or_operator) in {("MIN", "MAX"), ("PROD", "ASUM"), ("BDIF", "BSUM")}
    assert codes(text) == ([] if paired else ["FCL342"])
    found = block(text).rule_blocks[0]
    assert (found.and_operator, found.or_operator) == (and_operator, or_operator)


def test_what_is_missing_is_chosen_and_said():  # S11
    text = changed(("    METHOD: CoGS;\n", ""), ("    DEFAULT := 0;\n", ""), ("    ACCU: MAX;\n", ""))
    diagnostics = fcl.read(text).diagnostics
    assert [(each.code, each.places[0].span.text) for each in diagnostics] == [
        ("FCL334", "valve"),
        ("FCL335", "valve"),
        ("FCL341", "No1"),
    ]
    found = block(text)
    assert found.defuzzifications[0].method is Method.COGS
    assert found.defuzzifications[0].default is None
    assert found.rule_blocks[0].accumulation is Accumulation.MAX
    assert found.rule_blocks[0].activation is Activation.MIN


def test_areas_without_a_method_take_the_centre_of_gravity():  # S11, S32
    text = changed(*AREAS, ("    METHOD: CoGS;\n", ""))
    assert set(codes(text)) == {"FCL334", "FCL336"}
    assert block(text).defuzzifications[0].method is Method.COG


@pytest.mark.parametrize(
    ("method", "areas", "singletons"),
    [
        ("CoG", [], ["FCL338"]),
        ("CoGS", ["FCL331"], []),
        ("CoA", [], ["FCL331"]),
        ("LM", [], []),
        ("RM", [], []),
    ],
)
def test_a_method_suits_its_terms(method, areas, singletons):  # S35
    chosen = ("METHOD: CoGS;", f"METHOD: {method}; RANGE(-10..110);")
    assert codes(changed(chosen)) == singletons
    assert codes(changed(*AREAS, chosen)) == areas


def test_the_centre_of_gravity_of_singletons_is_theirs():  # S35
    assert block(changed(("CoGS", "CoG"))).defuzzifications[0].method is Method.COGS


@pytest.mark.parametrize("method", ["PROD", "MIN"])
def test_the_activation_is_read(method):
    assert block(changed(("ACCU: MAX", f"ACT: {method}; ACCU: MAX"))).rule_blocks[0].activation == method


# -- points


def test_two_points_may_have_one_abscissa():  # S21
    assert codes(changed(("(3, 1) (27, 0)", "(3, 1) (3, 0)"))) == []


def test_points_that_are_moved_by_variables_are_not_compared():  # S22
    assert codes(changed(("(3, 1) (27, 0)", "(3, 1) (level, 0.5) (27, 0)"))) == []


@pytest.mark.parametrize("degree", ["0", "1", "0.5", "1E-9"])
def test_degrees_lie_between_0_and_1(degree):
    assert codes(changed(("(3, 1)", f"(3, {degree})"))) == []


@pytest.mark.parametrize("degree", ["-1E-9", "1.0000001", "27"])
def test_other_degrees_are_refused(degree):
    assert codes(changed(("(3, 1)", f"(3, {degree})"))) == ["FCL317"]


# -- rules


def test_a_variable_concluded_without_is_needs_no_terms():  # S28
    text = changed(
        ("    valve: REAL;", "    valve: REAL;\n    alarm: REAL;"),
        ("valve IS inlet", "valve IS inlet, alarm"),
    )
    assert codes(text) == []
    assert block(text).rule_blocks[0].rules[0].conclusions[1].term is None


def test_an_output_may_be_a_condition_once_it_has_been_concluded():  # S27a
    text = changed(("RULE 2: IF temp IS hot", "RULE 2: IF valve IS inlet"))
    assert codes(text) == ["FCL351"]
    assert block(text).rule_blocks[0].rules[1].condition.arguments[0] == Is("valve", "inlet")


def test_two_rules_with_one_label_both_count():  # S5
    text = changed(("RULE 2", "RULE 1"))
    assert codes(text) == ["FCL340"]
    assert len(block(text).rule_blocks[0].rules) == 2


def test_a_label_may_return_in_another_rule_block():
    second = BATH[BATH.index("RULEBLOCK") : BATH.index("END_FUNCTION")].replace("No1", "No2")
    assert codes(changed(("END_FUNCTION_BLOCK", second + "END_FUNCTION_BLOCK"))) == []


# -- places in the model


def test_the_model_knows_where_its_parts_stand():
    found = block(BATH)
    assert found.span.text == "bath"
    assert found.inputs[0].span.line == 3
    assert found.fuzzifications[0].terms[1].span.text == "hot"
    rule = found.rule_blocks[0].rules[0]
    assert rule.span.text == "RULE 1: IF temp IS cold AND level IS low THEN valve IS inlet"
    assert rule.condition.arguments[0].span.text == "temp IS cold"
    assert rule.conclusions[0].span.text == "valve IS inlet"

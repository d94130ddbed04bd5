"""What a plant declares is held against what a declaration may be, and told at its place in the file."""

import pytest

from tests.plant.tanks import refusal


def test_a_unit_that_is_not_known_is_shown_where_it_is_declared(tmp_path):
    text = refusal(tmp_path, ('State("level", "m"', 'State("level", "kj/K"'))
    assert text == (
        "plants/tank.py:5:28: error[PLT207]: the state `level`: there is no unit `kj`\n"
        '  5 |     states=(State("level", "kj/K", 1.0, "level"), State("flow", "m3/s", 0.0, "flow")),\n'
        "    |                            ^^^^^^\n"
        "  hint: did you mean `kJ`?"
    )


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (('"valve", "1", "opening"', '"valve", meaning="opening", unit="degc"'), "the input `valve`"),
        (('Output("level", "m"', 'Output("level", "degc"'), "the output `level`"),
        (('Parameter("area", "m2"', 'Parameter("area", "degc"'), "the parameter `area`"),
    ],
)
def test_units_of_inputs_outputs_and_parameters_are_held_to_the_same(tmp_path, change, told):
    text = refusal(tmp_path, change)
    assert f"error[PLT207]: {told}: there is no unit `degc`\n" in text
    assert text.endswith("^^^^^^\n  hint: did you mean `degC`?")


def test_a_text_in_the_place_of_a_number_is_told_with_the_number(tmp_path):
    text = refusal(tmp_path, ("2.0", '"20000 cm2"'))
    assert text == (
        "plants/tank.py:8:41: error[PLT208]: "
        "`default` of the parameter `area` is '20000 cm2', and not a number\n"
        '  8 |     parameters=(Parameter("area", "m2", "20000 cm2", "area", "[A]"),),\n'
        "    |                                         ^^^^^^^^^^^\n"
        "  hint: write 2: its unit is declared before it"
    )


def test_a_default_outside_its_own_limits_is_told_in_the_file_of_the_plant(tmp_path):
    text = refusal(tmp_path, ('"[A]"', '"[A]", 3.0'))
    assert text == (
        "plants/tank.py:8:41: error[PLT203]: "
        "the default of the parameter `area` is 2 m2, and its minimum 3 m2\n"
        '  8 |     parameters=(Parameter("area", "m2", 2.0, "area", "[A]", 3.0),),\n'
        "    |                                         ^^^\n"
        "  hint: the order is Parameter(name, unit, default, meaning, source, minimum, maximum)"
    )


def test_a_single_input_without_its_comma_is_told_so(tmp_path):
    text = refusal(tmp_path, ('(Input("valve", "1", "opening"),)', '(Input("valve", "1", "opening"))'))
    assert text == (
        "plants/tank.py:6:13: error[PLT208]: `inputs` is one Input, and not a tuple of them\n"
        '  6 |     inputs=(Input("valve", "1", "opening")),\n'
        "    |             ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^\n"
        "  hint: behind a single one stands a comma: inputs=(Input(...),)"
    )


def test_all_faults_of_a_declaration_are_told_at_once(tmp_path):
    text = refusal(
        tmp_path, ('State("level", "m"', 'State("level", "mtr"'), ('"flow")', '"flow", scale=0.0)')
    )
    assert [line.split(": ", 1)[1] for line in text.splitlines() if ": error[" in line] == [
        "error[PLT207]: the state `level`: there is no unit `mtr`",
        "error[PLT208]: `scale` of the state `flow` is 0.0, and not a number above 0",
    ]


def test_a_file_without_a_plant_is_refused(tmp_path):
    lines = ("PLANT = Plant(", "Plant(")
    assert refusal(tmp_path, lines) == (
        "plants/tank.py: error[PLT201]: a plant file declares `PLANT = Plant(...)`, and this one does not"
    )


def test_a_plant_of_another_name_is_shown(tmp_path):
    assert refusal(tmp_path, ("PLANT = Plant(", "TANK = Plant(")) == (
        "plants/tank.py:3:1: error[PLT201]: "
        "a plant file declares `PLANT = Plant(...)`, and this one does not\n"
        "  3 | TANK = Plant(\n"
        "    | ^^^^^^^^^^^^^\n"
        "  hint: `TANK` is a Plant: call it PLANT"
    )


def test_a_name_declared_twice_is_shown_where_it_stands_again(tmp_path):
    assert refusal(tmp_path, ('State("flow"', 'State("level"')) == (
        "plants/tank.py:5:54: error[PLT203]: the plant declares the state `level` twice\n"
        '  5 |     states=(State("level", "m", 1.0, "level"), State("level", "m3/s", 0.0, "flow")),\n'
        "    |                                                      ^^^^^^^"
    )


def test_a_column_counts_characters(tmp_path):
    text = refusal(tmp_path, ('"level"), State("flow", "m3/s"', '"Füllhöhe"), State("flow", "degc"'))
    excerpt, caret = text.splitlines()[1:3]
    assert caret.index("^") == excerpt.index('"degc"')


def test_what_a_loop_declares_is_told_at_the_plant(tmp_path):
    looped = '*(Output(f"level_{i}", "degc", "level") for i in range(1)),'
    text = refusal(tmp_path, ('Output("level", "m", "level"),', looped))
    assert text.startswith(
        "plants/tank.py:3:1: error[PLT207]: the output `level_0`: there is no unit `degc`\n"
        "  3 | PLANT = Plant(\n"
    )

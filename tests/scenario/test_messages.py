"""What a user reads after a slip: whole messages, with place, excerpt, caret and mend."""

import pytest

from tests.scenario.slips import CONTROLLER, RELATIVE, SLIPS, TRANSFER


@pytest.mark.parametrize(
    ("file", "edit", "message"), [each[1:] for each in SLIPS], ids=[each[0] for each in SLIPS]
)
def test_a_slip_is_told_with_its_place_and_mend(bench, file, edit, message):
    bench.edit(file, edit)
    assert bench.fault() == message


def test_every_fault_is_told_at_once_from_top_to_bottom(bench):
    bench.edit(
        TRANSFER,
        ("title = ", "titel = "),
        ('"60 s"', "60"),
        ("start   ", "strat   "),
        ("settling_time", "setling_time"),
    )
    bench.edit(CONTROLLER, ("filter", "filtre"))
    heads = [line.split(": ", 1) for line in bench.fault().splitlines() if "error[" in line]
    assert heads == [
        ["scenarios/crane/transfer.toml:1:1", "error[SCN201]: the scenario has no key `titel`"],
        [
            "scenarios/crane/transfer.toml:14:14",
            "error[SCN204]: `duration` is a time and needs a unit, not 60 alone",
        ],
        ["scenarios/crane/transfer.toml:20:1", "error[SCN201]: `plant` has no key `strat`"],
        [
            "scenarios/crane/transfer.toml:48:12",
            "error[SCN401]: there is no metric called `setling_time`",
        ],
        ["scenarios/crane/crane.controller.toml:14:61", "error[SCN201]: `speed` has no key `filtre`"],
    ]


def test_a_fault_of_the_base_is_told_once_though_every_variant_has_it(bench):
    bench.edit(TRANSFER, ('"20 t"', '"20 m"'))
    assert bench.fault().count("error[") == 1


def test_a_fault_in_the_rule_base_is_the_rule_bases_own(bench):
    bench.edit("crane_printed.fcl", ("power IS pos_high; (*", "power IS pos_big; (*"))
    first, *_, hint = bench.fault("printed.toml").splitlines()
    assert first.startswith("scenarios/crane/crane_printed.fcl:48:69: error[FCL")
    assert "did you mean `pos_high`?" in hint


def test_overrides_are_told_by_their_own_text(bench):
    assert bench.fault(overrides={"duration": "60 s", "plant.parameters.load_mas": "10 t"}) == (
        "override:2:1: error[SCN309]: the plant `crane` has no parameter called `load_mas`\n"
        '  2 | "plant.parameters.load_mas" = "10 t"\n'
        "    | ^^^^^^^^^^^^^^^^^^^^^^^^^^^\n"
        "  hint: did you mean `load_mass`?"
    )


def test_a_misspelled_input_of_a_rule_base_is_shown_where_it_is_misspelled(bench):
    bench.edit("crane.controller.toml", ('angle = "angle" }', 'angel = "angle" }'))
    told = bench.fault()
    assert "error[WIR104]: `controller.rules` has no input called `angel`" in told
    _, excerpt, caret, hint, *_ = told[told.index("scenarios/crane/crane.controller") :].splitlines()
    assert excerpt[caret.index("^") : caret.rindex("^") + 1] == "angel"
    assert hint == "  hint: did you mean `angle`?"


def test_a_misspelled_input_of_a_plant_is_shown_where_it_is_misspelled(bench):
    bench.edit("transfer.toml", ("{ power =", "{ powr ="))
    told = bench.fault()
    _, excerpt, caret, hint, *_ = told[told.index(": error[WIR104]") :].splitlines()
    assert excerpt[caret.index("^") : caret.rindex("^") + 1] == "powr"
    assert hint == "  hint: did you mean `power`?"


def test_a_unit_of_a_ratio_is_told_of_the_ratio(bench):
    bench.edit("transfer.toml", ("\n[[require]]", RELATIVE.replace("1.2", '"1.5 s"') + "\n[[require]]"))
    told = bench.fault()
    wanted = (
        "the ratio of the settling time of `crane.distance` to that of the run `light_load` is a plain number"
    )
    assert wanted in told
    assert "hint: write the number alone" in told

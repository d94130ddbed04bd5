"""`fcl-sim show matrix` and `fcl-sim matrix`: a rule base out as a table, a table in as rules."""

from tests.house.places import ROOT

CRANE = ROOT / "scenarios" / "crane"


def test_a_rule_base_goes_out_as_a_table_and_comes_in_again(invoke, tmp_path):
    shown = invoke("show", "matrix", CRANE / "crane_completed.fcl")
    assert shown.stdout.splitlines()[1].split() == [
        "distance",
        "\\",
        "angle",
        "neg_big",
        "neg_small",
        "zero",
        "pos_small",
        "pos_big",
    ]
    for form in ("csv", "toml"):
        table = tmp_path / f"crane.{form}"
        table.write_text(
            invoke("show", "matrix", CRANE / "crane_completed.fcl", "--as", form).stdout, "utf-8"
        )
        made = tmp_path / f"{form}.fcl"
        result = invoke("matrix", table, CRANE / "crane_printed.fcl", "-o", made)
        assert (result.exit_code, result.stdout, result.stderr) == (0, "", f"written: {made}\n")
        assert invoke("show", "matrix", made).stdout == shown.stdout
        assert invoke("matrix", table, CRANE / "crane_printed.fcl").stdout == made.read_text("utf-8")


def test_a_misspelt_term_is_told_with_its_cell(invoke, tmp_path):
    table = tmp_path / "crane.csv"
    table.write_text("power\ndistance \\ angle,zero\nfar,pos_meduim\n", "utf-8")
    result = invoke("matrix", table, CRANE / "crane_printed.fcl")
    assert (result.exit_code, result.stdout) == (3, "")
    assert result.stderr == (
        f"{table}:3:5: error[MTX104]: `power` has no term `pos_meduim`\n"
        "  3 | far,pos_meduim\n"
        "    |     ^^^^^^^^^^\n"
        "  hint: did you mean `pos_medium`?\n"
    )


def test_rules_that_stand_in_no_cell_are_shown_below_and_refused_in_a_table(invoke):
    oven = ROOT / "scenarios" / "oven" / "oven_printed.fcl"
    shown = invoke("show", "matrix", oven)
    assert "Not in a cell:\nRULE 1: IF humidity IS middle AND color.brown THEN" in shown.stdout
    assert "dT2\n" not in shown.stdout
    result = invoke("show", "matrix", oven, "--as", "csv")
    assert result.exit_code == 3
    assert "error[MTX106]: 3 of the rules stand in no cell of a matrix" in result.stderr


def test_a_form_is_of_a_matrix_alone(invoke):
    assert invoke("show", "model", CRANE / "crane_printed.fcl", "--as", "csv").exit_code == 2

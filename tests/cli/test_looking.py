"""Commands that look at files without running them: show, plot, schema, new."""

import json

import pytest

from fcl_sim.plant.catalog import shipped_bench
from tests.house.places import ROOT

CRANE = ROOT / "scenarios" / "crane"


# -- show


@pytest.mark.parametrize(
    ("stage", "file", "words"),
    [
        ("tokens", "crane_printed.fcl", ["FUNCTION_BLOCK", "comment"]),
        ("tree", "crane_printed.fcl", ["RULE 1", "TERM too_far := (-5, 1) (0, 0)"]),
        ("model", "crane_printed.fcl", ["METHOD CoGS", "RULE 1: IF distance IS far"]),
        ("program", "crane_printed.fcl", ["memory", "rule 6", "grid distance"]),
        ("scenario", "transfer.toml", ["crane/transfer", "CR-1"]),
        ("wiring", "transfer.toml", ["controller.speed <- differentiator", "crane.distance"]),
        ("tape", "transfer.toml", ["controller.speed, recorded in column", "SCANS"]),
    ],
)
def test_every_stage_can_be_looked_at(invoke, stage, file, words):
    result = invoke("show", stage, CRANE / file)
    assert (result.exit_code, result.stderr) == (0, "")
    for word in words:
        assert word in result.stdout


def test_what_could_be_read_is_shown_with_what_could_not(invoke, tmp_path):
    file = tmp_path / "half.fcl"
    file.write_text(
        "FUNCTION_BLOCK half VAR_INPUT x: REAL; END_VAR FUZZIFY x TERM low := (0, 1 (1, 0); END_FUZZIFY"
    )
    result = invoke("show", "tree", file)
    assert result.exit_code == 3
    assert result.stdout.startswith("FUNCTION_BLOCK half\n  VAR_INPUT\n    x: REAL\n")
    assert "error[FCL2" in result.stderr


def test_a_variant_of_a_scenario_is_chosen_by_name(invoke):
    raw = invoke("show", "wiring", CRANE / "transfer.toml", "--variant", "raw_distance").stdout
    assert "distance = controller.distance (that is crane.distance)\n       angle" in raw
    result = invoke("show", "wiring", CRANE / "transfer.toml", "--variant", "raw_distanc")
    assert result.exit_code == 3
    assert result.stderr.endswith("  hint: did you mean `raw_distance`?\n")


def test_a_stage_that_a_file_does_not_have_is_wrong_usage(invoke):
    result = invoke("show", "wiring", CRANE / "crane_printed.fcl")
    assert result.exit_code == 2
    assert (
        "there is no wiring of a rule base, but its tokens, tree, model, matrix or program" in result.stderr
    )


@pytest.mark.parametrize(("ending", "begins"), [("svg", b"<svg"), ("png", b"\x89PNG"), ("pdf", b"%PDF")])
def test_the_wiring_is_drawn_in_the_format_that_the_name_ends_in(invoke, tmp_path, ending, begins):
    target = tmp_path / f"loop.{ending}"
    result = invoke("show", "wiring", CRANE / "transfer.toml", "--figure", target)
    assert (result.exit_code, result.stderr) == (0, f"written: {target}\n")
    assert "blocks, in their order of execution" in result.stdout
    assert target.read_bytes().startswith(begins)


def test_a_figure_of_anything_else_or_into_nowhere_is_refused(invoke, tmp_path):
    other = invoke("show", "tape", CRANE / "transfer.toml", "--figure", tmp_path / "loop.svg")
    assert other.exit_code == 2
    assert "there is no figure of a tape, but of a wiring" in other.stderr
    lost = invoke("show", "wiring", CRANE / "transfer.toml", "--figure", tmp_path / "no" / "loop.svg")
    assert lost.exit_code == 3
    assert "error[RUN101]" in lost.stderr


# -- plot


@pytest.mark.parametrize(
    ("ending", "beginning"), [("png", b"\x89PNG\r\n"), ("svg", b"<svg"), ("pdf", b"%PDF-")]
)
def test_a_rule_base_is_drawn_into_one_file(invoke, tmp_path, ending, beginning):
    target = tmp_path / f"crane.{ending}"
    result = invoke("plot", CRANE / "crane_printed.fcl", "-o", target)
    assert (result.exit_code, result.stdout) == (0, f"written: {target}\n")
    assert target.read_bytes().startswith(beginning)
    assert [file.name for file in tmp_path.iterdir()] == [target.name]


def test_a_picture_lands_in_the_current_folder_and_is_the_same_again(invoke, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert invoke("plot", CRANE / "crane_printed.fcl").stdout == "written: crane_printed.png\n"
    first = (tmp_path / "crane_printed.png").read_bytes()
    invoke("plot", CRANE / "crane_printed.fcl")
    assert (tmp_path / "crane_printed.png").read_bytes() == first


def test_a_picture_of_another_kind_is_refused(invoke, tmp_path):
    result = invoke("plot", CRANE / "crane_printed.fcl", "-o", tmp_path / "crane.gif")
    assert result.exit_code == 3
    assert result.stderr == (
        f"{tmp_path / 'crane.gif'}: error[RUN106]: a picture is not written as `.gif`\n"
        "  hint: end the name in .png, .svg or .pdf\n"
    )


# -- schema


@pytest.mark.parametrize(("kind", "key"), [((), "plant"), (("controller",), "scan")])
def test_the_schema_describes_the_keys_of_a_file(invoke, kind, key):
    document = json.loads(invoke("schema", *kind).stdout)
    assert key in document["properties"]
    assert document["$schema"].startswith("https://json-schema.org/")


# -- new


def test_a_new_bench_is_the_shipped_one(invoke, tmp_path):
    folder = tmp_path / "some" / "where"
    result = invoke("new", folder)
    assert result.exit_code == 0
    assert sorted(each.name for each in folder.iterdir()) == ["plants", "scenarios"]
    copied = folder / "scenarios" / "crane" / "crane_printed.fcl"
    assert copied.read_bytes() == (shipped_bench() / "scenarios" / "crane" / "crane_printed.fcl").read_bytes()
    assert [each.name for each in folder.parent.iterdir()] == ["where"]


def test_a_folder_with_something_in_it_is_left_alone(invoke, tmp_path):
    (tmp_path / "mine").touch()
    result = invoke("new", tmp_path)
    assert result.exit_code == 3
    assert result.stderr == (
        f"{tmp_path}: error[RUN103]: there is something here already\n"
        "  hint: name a folder that is new or empty\n"
    )
    assert [each.name for each in tmp_path.iterdir()] == ["mine"]

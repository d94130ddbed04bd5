"""Baselines from the command line: the life of one, what is told, and the older versions beside it."""

import json
import subprocess

import pytest

from fcl_sim.cli.benches import scenario_files
from tests.cli.conftest import accept
from tests.house.places import ROOT

SHORT = "scenarios/crane/short.toml"
FILE = "scenarios/crane/baselines/short.base.toml"
FCL = "scenarios/crane/crane_completed.fcl"
POINT, MOVED = "TERM pos_medium := 9;", "TERM pos_medium := 10;"


def run(invoke, *more):
    result = invoke("run", "--no-report", *more)
    return result.exit_code, result.stdout.replace("\N{NO-BREAK SPACE}", " ")


def edit(bench, name, old, new):
    text = (bench / name).read_text("utf-8")
    assert old in text
    (bench / name).write_text(text.replace(old, new, 1), "utf-8")


def test_a_baseline_lives_from_none_to_accepted_to_left_to_accepted_again(invoke, bench):
    (bench / FILE).unlink()
    code, told = run(invoke)
    assert (code, "crane/short has NO BASELINE of base." in told) == (4, True)
    assert f'fcl-sim baseline update {SHORT} --reason "..."' in told
    first = invoke("baseline", "update", "--reason", "first version", "--date", "2026-01-31")
    assert first.stdout.splitlines()[0] == f"written: {FILE}"
    assert (first.exit_code, run(invoke)[0]) == (0, 0)
    assert "accepts" not in first.stdout
    edit(bench, FCL, POINT, MOVED)
    code, told = run(invoke)
    assert code == 4
    assert "crane/short base beside its baseline of 2026-01-31:" in told
    assert "edited in controller.rules: power, TERM pos_medium := 9 → TERM pos_medium := 10" in told
    assert "first diverging scan: 0 s, controller.rules.power 9 → 10 kW" in told
    assert "rule 1 fires with 1 as before, and concludes something else" in told
    assert "these edits are the whole reason" in told
    second = invoke("baseline", "update", "--reason", "more power")
    assert "S-1, peak of crane.sway:" in second.stdout
    assert run(invoke)[0] == 0


def test_a_requirement_that_a_run_is_not_asked_any_more_is_told_and_no_other_cause_is_sought(invoke, bench):
    edit(bench, SHORT, 'max = "9 deg"', 'max = "9 deg"\nruns = ["other"]\n\n[variants.other]\n')
    code, told = run(invoke)
    assert code == 4
    assert "S-1, peak of crane.sway: it was" in told
    assert "is not asked any more" in told
    assert "The run does what it did: its scenario asks something else of it." in told
    assert "look at the plant's file" not in told


OTHER = '\n[variants.other]\n"plant.parameters.load_mass" = "10 t"\n'
LOST = "scenarios/crane/baselines/short.other.toml"


@pytest.fixture
def dropped(bench):
    """Stand in the bench after a run that was accepted is taken out of its scenario."""
    whole = (bench / SHORT).read_text("utf-8")
    (bench / SHORT).write_text(whole + OTHER, "utf-8")
    accept(bench / SHORT)
    (bench / SHORT).write_text(whole, "utf-8")
    return bench


def test_the_baseline_of_a_run_that_is_no_more_is_told_and_is_not_green(invoke, dropped):
    code, told = run(invoke)
    assert code == 4
    assert f"{LOST} is the baseline of a run that crane/short no longer has." in told.splitlines()
    assert "  Delete the file if that is meant, else bring the run back." in told.splitlines()
    (dropped / LOST).unlink()
    code, told = run(invoke)
    assert (code, "no longer" in told) == (0, False)


def test_a_build_server_is_told_of_it_too(invoke, dropped):
    result = invoke("run", "--no-report", "--json", "--junit", "j.xml", "--sarif", "s.json")
    assert (result.exit_code, json.loads(result.stdout)["verdict"]) == (4, "PASS")
    assert f"{LOST}: error[JDG408]: this is the baseline of a run that" in result.stderr
    assert "JDG408" in (dropped / "j.xml").read_text("utf-8")
    (found,) = json.loads((dropped / "s.json").read_text("utf-8"))["runs"][0]["results"]
    assert found["ruleId"] == "JDG408"


def test_it_is_shown_with_what_was_accepted_unless_other_runs_are_asked_for(invoke, dropped):
    told = invoke("baseline", "show").stdout
    assert f"{LOST} is the baseline of a run that crane/short no longer has." in told
    assert LOST not in invoke("baseline", "show", "--variant", "base").stdout


def test_with_overrides_no_baseline_is_asked_about(invoke, dropped):
    code, told = run(invoke, "--set", "plant.parameters.load_mass=10 t")
    assert (code, "no longer has" in told) == (0, False)


def test_a_baseline_belongs_to_the_scenario_that_it_would_be_read_for(invoke, bench):
    dotted = "scenarios/crane/short.other.toml"
    (bench / dotted).write_bytes((bench / SHORT).read_bytes())
    accept(bench / dotted)
    assert (bench / "scenarios/crane/baselines/short.other.base.toml").exists()
    assert run(invoke)[0] == 0


def test_other_files_beside_baselines_are_left_alone(invoke, bench):
    folder = (bench / FILE).parent
    (folder / "short.notes.toml").write_text('why = "they are notes"\n')
    (folder / "short.broken.toml").write_text("variant = ")
    (folder / "short.copy.toml").write_bytes((bench / FILE).read_bytes())
    assert run(invoke)[0] == 0


def test_a_requirement_that_is_missed_goes_before_a_baseline_that_is_left(invoke, bench):
    edit(bench, FCL, POINT, MOVED)
    edit(bench, SHORT, 'max = "9 deg"', 'max = "0.001 deg"')
    assert run(invoke)[0] == 1


def test_what_is_accepted_though_it_is_missed_is_told(invoke, bench):
    edit(bench, SHORT, 'max = "9 deg"', 'max = "0.001 deg"')
    result = invoke("baseline", "update", "--reason", "as it is")
    assert result.exit_code == 0
    assert "accepts 1 FAIL: S-1 in crane/short base" in result.stdout.splitlines()


def test_overrides_are_another_run_that_is_not_compared(invoke, bench):
    (bench / FILE).unlink()
    code, told = run(invoke, "--set", "plant.parameters.load_mass=10 t")
    assert (code, "aseline" in told) == (0, False)


def test_the_results_have_what_left_the_baseline_and_why(invoke, bench):
    edit(bench, FCL, POINT, MOVED)
    document = json.loads(invoke("run", "--json", "--no-report").stdout)
    (found,) = (each["baseline"] for each in document["scenarios"][0]["variants"])
    assert (document["verdict"], found["verdict"], found["reason"]) == ("FAIL", "FAIL", "as they are")
    (metric,) = found["metrics"]
    assert metric["new"] - metric["old"] == pytest.approx(metric["change"])
    assert metric["change"] > metric["allowed"]
    assert found["cause"]["edits"][0]["name"] == "pos_medium"
    assert found["cause"]["first_divergence"]["time_s"] == 0.0
    assert found["cause"]["rule_base_is_the_whole_reason"]


def test_what_was_accepted_is_shown_without_a_run(invoke, bench, monkeypatch):
    monkeypatch.setattr("fcl_sim.testbench.running.simulate", None)
    first, figure, kept = invoke("baseline", "show").stdout.splitlines()
    assert first == "crane/short base: accepted on 2026-01-31: as they are"
    assert figure.startswith("  S-1, peak of crane.sway: 2.")
    assert "crane.distance" in kept


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["update"], "Missing option '--reason'"),
        (["update", "--reason", " "], "say in a sentence why"),
        (["update", "--reason", "r", "--date", "31.1.2026"], "write it as 2026-01-31"),
        (["update", "--reason", "r", "--date", "2026-02-31"], "write it as 2026-01-31"),
    ],
)
def test_wrong_usage_writes_nothing(invoke, bench, arguments, message):
    before = (bench / FILE).read_bytes()
    result = invoke("baseline", *arguments)
    assert (result.exit_code, message in result.stderr) == (2, True)
    assert (bench / FILE).read_bytes() == before


def test_an_unknown_variant_writes_nothing_and_is_told_with_the_nearest(invoke, bench):
    result = invoke("baseline", "update", "--reason", "r", "--variant", "bas")
    assert (result.exit_code, "did you mean `base`?" in result.stderr) == (3, True)


def test_a_baseline_is_no_scenario(invoke, bench):
    assert [each.name for each in scenario_files(())] == ["short.toml"]
    result = invoke("run", FILE)
    assert (result.exit_code, "this is a baseline, not a scenario" in result.stderr) == (3, True)


def test_the_shipped_bench_of_an_installation_is_not_written_to(invoke, bench, monkeypatch):
    monkeypatch.setattr("fcl_sim.cli.baseline.PACKAGE", bench)
    result = invoke("baseline", "update", "--reason", "r")
    assert (result.exit_code, "RUN102" in result.stderr) == (3, True)


def test_a_new_bench_has_the_baselines(invoke, tmp_path):
    invoke("new", tmp_path / "mine")
    shipped = ROOT / "scenarios/crane/baselines"
    mine = tmp_path / "mine/scenarios/crane/baselines"
    assert {each.name for each in mine.iterdir()} == {each.name for each in shipped.iterdir()}


def git(folder, *arguments):
    who = ("-c", "user.name=n", "-c", "user.email=e@example.org", "-c", "commit.gpgsign=false")
    subprocess.run(["git", *who, *arguments], cwd=folder, check=True, capture_output=True)  # noqa: S607


def row(told, metric):
    table = told.replace("\N{NO-BREAK SPACE}", " ").partition(" against ")[2]
    (found,) = (line.split() for line in table.splitlines() if f" {metric}, " in line)
    return found


def test_every_figure_stands_beside_that_of_a_revision(invoke, bench):
    git(bench, "init")
    git(bench, "add", ".")
    git(bench, "commit", "-m", "first")
    edit(bench, FCL, POINT, MOVED)
    code, told = run(invoke, "--against", "HEAD")
    assert (code, "crane/short against HEAD:" in told) == (4, True)
    assert row(told, "S-1")[-2:] == ["worse", "PASS"]
    git(bench, "commit", "-am", "second")
    _, told = run(invoke, "--against", "HEAD")
    assert row(told, "S-1")[-2:] == ["none", "PASS"]
    assert "worse" in run(invoke, "--against", "HEAD~1")[1]


def test_every_figure_stands_beside_that_of_an_older_rule_base_and_the_signals_are_drawn(invoke, bench):
    (bench / "old.fcl").write_text((bench / FCL).read_text("utf-8").replace("container_crane_25", "older"))
    edit(bench, FCL, POINT, MOVED)
    result = invoke("run", "--against", "old.fcl", "--png")
    assert row(result.stdout, "S-1")[-2:] == ["worse", "PASS"]
    drawn = bench / "reports/crane/short"
    assert (drawn / "base-against.png").read_bytes().startswith(b"\x89PNG")
    assert (drawn / "base-baseline.png").exists()
    document = json.loads((bench / "reports/results.json").read_text("utf-8"))
    assert document["scenarios"][0]["against"]["label"] == "old.fcl"


@pytest.mark.parametrize(
    ("older", "message"),
    [
        ("HEAD", "RUN109]: the bench is in no git repository"),
        ("--upload-pack=x", "RUN109]: `--upload-pack=x` is no revision"),
        ("missing.fcl", "FCL101"),
        ("other.fcl", "RUN110]: it has one or two, and no scenario uses"),
    ],
)
def test_what_nothing_can_be_held_against_is_told(invoke, bench, older, message):
    block = (bench / FCL).read_text("utf-8")
    names = [block.replace("container_crane_25", name) for name in ("one", "two")]
    (bench / "other.fcl").write_text("\n".join(names))
    result = invoke("run", "--no-report", f"--against={older}")
    assert (result.exit_code, message in result.stderr) == (3, True), result.stderr


def test_a_revision_that_git_does_not_know_is_told(invoke, bench):
    git(bench, "init")
    result = invoke("run", "--no-report", "--against", "nope")
    assert "git knows no revision `nope`" in result.stderr


def test_a_scenario_that_the_revision_does_not_have_stands_alone(invoke, bench):
    git(bench, "init")
    git(bench, "add", "scenarios/crane/crane.controller.toml")
    git(bench, "commit", "-m", "no scenario yet")
    code, told = run(invoke, "--against", "HEAD")
    assert (code, "crane/short against HEAD: there is no older version of it." in told) == (0, True)

import csv
import json
import re

import numpy as np
import pytest

from tests.cli.conftest import accept
from tests.house.places import ROOT


def lines(text):
    return [line.rstrip() for line in text.splitlines()]


def test_the_bench_of_the_current_folder_is_run_and_its_reports_written(invoke, bench):
    result = invoke("run")
    assert (result.exit_code, result.stderr) == (0, "")
    *table, kept, covered, written, seconds = lines(result.stdout)
    assert table[0].split() == ["scenario", "variant", "requirement", "asked", "measured", "verdict"]
    assert table[1].split()[:7] == ["crane/short", "base", "S-1", "at", "most", "9", "deg"]
    assert table[1].endswith("deg  PASS")
    assert table[2] == "1 scenario, 1 run, 1 verdict: 1 PASS."
    assert kept == "Baselines of 1 run: 1 PASS."
    assert covered.startswith("Of 25 rules ")
    assert written == "written: reports/report.pdf"
    assert re.fullmatch(r"\d+\.\d s: .*typesetting \d+\.\d s.*", seconds)
    assert (bench / "reports" / "report.pdf").read_bytes().startswith(b"%PDF-")


FCL = "scenarios/crane/crane_completed.fcl"


def test_warnings_of_a_rule_base_are_counted_once_and_who_tells_them_is_named(invoke, bench):
    text = (bench / FCL).read_text("utf-8")
    (bench / FCL).write_text(text.replace("REAL;", "REAL", 1), "utf-8")
    short = bench / "scenarios/crane/short.toml"
    short.with_name("other.toml").write_text(short.read_text() + "\n[variants.again]\n")
    accept(short, short.with_name("other.toml"))
    result = invoke("run", "--no-report")
    assert lines(result.stderr) == [f"{FCL}: 1 warning (fcl-sim check {FCL} tells it)"]
    assert result.exit_code == 0
    assert "FCL206" in invoke("check", FCL).stdout
    as_json = invoke("run", "--no-report", "--json")
    assert json.loads(as_json.stdout)["verdict"] == "PASS"
    assert f"{FCL}: 1 warning" in as_json.stderr


def test_faults_of_a_rule_base_are_told_relative_to_the_current_folder_as_all_others(invoke, bench):
    text = (bench / FCL).read_text("utf-8")
    (bench / FCL).write_text(text.replace("RULEBLOCK", "RULEBLOK", 1), "utf-8")
    for paths in ((), (bench,), ("scenarios",)):
        result = invoke("run", "--no-report", *paths)
        assert (result.exit_code, result.stderr.split(":")[0]) == (3, FCL)


def test_a_verdict_other_than_pass_is_exit_code_1(invoke, bench):
    short = bench / "scenarios" / "crane" / "short.toml"
    short.write_text(short.read_text().replace('max = "9 deg"', 'max = "0.001 deg"'))
    result = invoke("run", "--no-report")
    assert result.exit_code == 1
    assert lines(result.stdout)[1].endswith("deg  FAIL")


def test_of_several_scenarios_each_run_is_a_line_and_what_is_not_green_is_told(invoke, bench):
    short = bench / "scenarios" / "crane" / "short.toml"
    other = short.with_name("other.toml")
    other.write_text(short.read_text().replace('max = "9 deg"', 'max = "0.001 deg"'))
    accept(other)
    brief = lines(invoke("run", "--no-report").stdout)
    assert [line.split() for line in brief[:3]] == [
        ["scenario", "variant", "requirements", "verdict"],
        ["crane/other", "base", "0", "of", "1", "FAIL"],
        ["crane/short", "base", "1", "of", "1", "PASS"],
    ]
    row, how = [line for line in brief if "S-1" in line]
    assert row.startswith("crane/other")
    assert how.startswith("crane/other base, S-1: The largest magnitude of crane.sway is ")
    assert re.search(r"first violated from 0\.\d+ s to .* At 0\.\d+\ss rules? .* power\s=\s", how)
    whole = lines(invoke("run", "--no-report", "-v").stdout)
    assert [line.split()[-1] for line in whole if " S-1 " in line] == ["FAIL", "PASS"]


def test_of_many_misses_the_first_are_told_and_with_v_all(invoke, bench):
    short = bench / "scenarios" / "crane" / "short.toml"
    text = short.read_text().replace('max = "9 deg"', 'max = "0.001 deg"')
    head, asked = text.split("[[require]]")
    short.write_text("[[require]]".join([head, *(asked.replace("S-1", f"S-{each}") for each in range(8))]))

    def told(*more):
        return [line for line in lines(invoke("run", "--no-report", *more).stdout) if "base, S-" in line]

    assert len(told()) == 5
    assert "and 3 further misses (-v tells them)" in invoke("run", "--no-report").stdout
    assert len(told("-v")) == 8


def test_a_requirement_that_several_runs_miss_is_told_once(invoke, bench):
    short = bench / "scenarios" / "crane" / "short.toml"
    text = short.read_text().replace('max = "9 deg"', 'max = "0.001 deg"')
    short.write_text(f'{text}\n[variants.heavy]\n"plant.parameters.load_mass" = "30 t"\n')
    (told,) = [line for line in lines(invoke("run", "--no-report").stdout) if ", S-1: " in line]
    assert told.endswith(" heavy misses it, too.")


def test_overrides_reach_the_scenario(invoke, bench):
    result = invoke("run", "--no-report", "--set", "duration=0.5 s", "--set", "require=[]")
    assert result.exit_code == 1
    assert lines(result.stdout)[0] == "1 scenario, 1 run, 0 verdicts: nothing was asked of them."


@pytest.mark.parametrize("text", ["duration", "=1 s"])
def test_an_override_that_sets_nothing_is_wrong_usage(invoke, bench, text):
    result = invoke("run", "--set", text)
    assert result.exit_code == 2
    assert f"Error: Invalid value for '--set': `{text}` sets nothing: write KEY=VALUE" in result.stderr


def test_json_is_one_document_on_stdout_and_the_same_as_the_file(invoke, bench):
    result = invoke("run", "--json")
    document = json.loads(result.stdout)
    assert (document["schema"], document["verdict"]) == (1, "PASS")
    assert result.stdout == (bench / "reports" / "results.json").read_text("utf-8")
    assert "written: reports/report.pdf" in result.stderr


def test_no_report_leaves_no_file(invoke, bench):
    assert invoke("run", "--no-report").exit_code == 0
    assert not (bench / "reports").exists()


def test_a_trace_has_every_signal_of_the_run(invoke, bench):
    assert invoke("run", "--no-report", "--trace", "x.csv").exit_code == 0
    with (bench / "x.csv").open(newline="", encoding="utf-8") as file:
        header, *rows = csv.reader(file)
    assert header[:2] == ["time [s]", "crane.distance [m]"]
    assert (len(rows), float(rows[-1][0])) == (21, 1.0)


def test_traces_of_several_runs_carry_their_names(invoke, bench):
    short = bench / "scenarios" / "crane" / "short.toml"
    short.write_text(short.read_text() + '\n[variants.light]\n"plant.parameters.load_mass" = "10 t"\n')
    accept(short)
    assert invoke("run", "--no-report", "--trace", "x.npz").exit_code == 0
    written = sorted(file.name for file in bench.glob("*.npz"))
    assert written == ["x-crane_short-base.npz", "x-crane_short-light.npz"]
    with np.load(bench / written[0]) as base, np.load(bench / written[1]) as light:
        assert not np.array_equal(base["values"], light["values"])


def test_one_broken_scenario_hides_neither_the_others_nor_itself(invoke, bench):
    short = bench / "scenarios" / "crane" / "short.toml"
    (short.parent / "typo.toml").write_text(short.read_text().replace("plant]\nmodel", "plant]\nmodle"))
    result = invoke("run")
    assert result.exit_code == 3
    assert lines(result.stdout)[1].endswith("PASS")
    assert "scenarios/crane/typo.toml:" in result.stderr
    assert "hint: did you mean `model`?" in result.stderr
    assert not (bench / "reports").exists()


def test_the_same_fault_of_two_scenarios_is_said_once(invoke, bench):
    crane = bench / "scenarios" / "crane"
    (crane / "again.toml").write_text((crane / "short.toml").read_text())
    (crane / "crane_completed.fcl").unlink()
    assert invoke("run").stderr == (
        "scenarios/crane/crane.controller.toml:19:10: error[SCN101]: "
        "there is no file `scenarios/crane/crane_completed.fcl`\n"
        '  19 | file   = "crane_completed.fcl"\n'
        "     |          ^^^^^^^^^^^^^^^^^^^^^\n"
        "  hint: did you mean `crane_printed.fcl`?\n"
    )


def test_whoever_waits_for_the_compiler_is_told(invoke, bench, monkeypatch):
    told = "Compiling the simulator for this machine."
    assert told not in invoke("run", "--no-report").stderr
    monkeypatch.setattr("fcl_sim.cli.run._is_warm", lambda: False)
    monkeypatch.setattr("fcl_sim.cli.stopwatch.TENTH", 0.0)  # a run of less is not told of at all
    result = invoke("run", "--no-report")
    assert result.stderr.startswith(told)
    assert "compiling, simulating and judging" in result.stdout


def test_in_a_pipe_a_verdict_stays_one_line(invoke, bench):
    short = bench / "scenarios" / "crane" / "short.toml"
    name = "a_long_name_" * 20
    short.write_text(short.read_text() + f'\n[variants.{name}]\n"plant.parameters.load_mass" = "10 t"\n')
    accept(short)
    shown = lines(invoke("run", "--no-report").stdout)
    assert [line.endswith("  PASS") for line in shown if name in line] == [True]


def test_the_shipped_bench_is_run_in_a_folder_without_one_and_reports_stay_there(
    invoke, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("fcl_sim.cli.run.testbench.run_files", refuse)
    result = invoke("run")
    assert result.exit_code == 3
    named = [line.partition(":")[0] for line in result.stderr.splitlines()]
    shipped = [each for each in (ROOT / "scenarios").rglob("*.toml") if each.parent.name != "baselines"]
    assert named == sorted(str(file) for file in shipped if not file.name.endswith(".controller.toml"))


def refuse(paths, _overrides):
    from fcl_sim.diagnostics import InputFault

    return [InputFault.at_file("RUN999", str(path), "no time for this") for path in paths]

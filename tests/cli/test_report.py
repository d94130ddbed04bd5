"""`fcl-sim report`: what it writes from what was stored, and how it leaves."""

import shutil

from fcl_sim.diagnostics.page import frame


def test_a_run_is_reported_again_without_its_files_whole_or_in_part(invoke, bench):
    reports = bench / "reports"
    assert invoke("run", "--html").exit_code == 0
    shutil.rmtree(bench / "scenarios")
    before = {
        name: (reports / name).read_bytes()
        for name in ("report.pdf", "report.html", "results.json", "results.npz")
    }
    assert invoke("report", reports / "results.json", "--html").exit_code == 0
    assert {name: (reports / name).read_bytes() for name in before} == before
    result = invoke("report", reports / "results.json", "crane/short", "--pages")
    assert result.exit_code == 0
    assert (reports / "crane_short" / "report.pdf").is_file()
    assert (reports / "crane_short" / "pages" / "001.png").is_file()


def test_what_is_not_there_is_told(invoke, tmp_path):
    result = invoke("report", tmp_path / "results.json")
    assert result.exit_code == 3
    assert "RUN204" in result.stderr
    assert "there are no such results" in result.stderr


def test_a_rule_base_is_reported_alone(invoke, tmp_path):
    (tmp_path / "valve.fcl").write_text(frame(complete=True), "utf-8")
    result = invoke("report", tmp_path / "valve.fcl", "--reports", tmp_path / "reports")
    assert result.exit_code == 0
    assert (tmp_path / "reports" / "valve.pdf").read_bytes().startswith(b"%PDF-1.7")


def test_a_rule_base_has_no_runs_for_a_page(invoke, tmp_path):
    (tmp_path / "valve.fcl").write_text(frame(complete=True), "utf-8")
    result = invoke("report", tmp_path / "valve.fcl", "--html")
    assert result.exit_code == 2
    assert "leave --html out" in result.stderr


def test_a_rule_base_has_no_scenarios(invoke, tmp_path):
    (tmp_path / "valve.fcl").write_text(frame(complete=True), "utf-8")
    result = invoke("report", tmp_path / "valve.fcl", "crane/transfer")
    assert result.exit_code == 2
    assert "a rule base has no scenarios" in result.stderr

"""A rule base alone: its report needs no run, tells what was found, and is the same twice."""

import pikepdf
import pytest

from fcl_sim.diagnostics import InputFault
from fcl_sim.report.writer import write_alone
from tests.report.reading import bare, words
from tests.report.synthetic import CRANE, ONE_INPUT


def test_it_tells_rules_findings_and_source_and_is_the_same_twice(tmp_path, monkeypatch):
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    file = tmp_path / "crane.fcl"
    file.write_text(CRANE)
    (first,) = write_alone(file, tmp_path / "a")
    (second,) = write_alone(file, tmp_path / "b")
    assert first.name == "crane.pdf"
    assert first.read_bytes() == second.read_bytes()
    with pikepdf.open(first) as pdf:
        text = words(pdf)
        assert list(pdf.attachments) == ["results.json"]
        assert len(pdf.pages) < 8
    for told in (
        "4 WARNINGS",
        "6 rules, 2 inputs, 1 output: 4 warnings.",
        "FCL601",
        "Basic Level",
        "Approver",
    ):
        assert bare(told) in text


def test_pages_and_pictures_are_written_on_request(tmp_path):
    file = tmp_path / "valve.fcl"
    file.write_text(ONE_INPUT)
    written = write_alone(file, tmp_path / "reports", png=True, pages=True)
    names = [each.relative_to(tmp_path / "reports").as_posix() for each in written]
    assert names[0] == "valve.pdf"
    assert "pages/valve/001.png" in names
    assert "rule-bases/valve-surface.png" in names


def test_its_pages_leave_those_of_another_report_alone_and_none_of_its_own_before(tmp_path):
    file, pages = tmp_path / "valve.fcl", tmp_path / "reports" / "pages"
    file.write_text(ONE_INPUT)
    (pages / "valve").mkdir(parents=True)
    for name in ("001.png", "valve/099.png"):
        (pages / name).write_text("another")
    write_alone(file, tmp_path / "reports", pages=True)
    assert (pages / "001.png").read_text() == "another"
    assert not (pages / "valve" / "099.png").exists()


def test_one_with_errors_is_refused(tmp_path):
    file = tmp_path / "crane.fcl"
    file.write_text(CRANE.replace("IS far", "IS fur"))
    with pytest.raises(InputFault, match="fur"):
        write_alone(file, tmp_path / "reports")

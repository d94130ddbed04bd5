"""`fcl-sim fmt`: what is written where, and what is left alone."""

import os
import stat

import pytest
from click.testing import CliRunner

from fcl_sim.cli.doors import Exit
from fcl_sim.cli.program import program
from tests.fcl.texts import BATH

UGLY = BATH.replace("temp: REAL;", "temp : REAL;   // in °C").replace("closed := 0", "closed:=0.0")


@pytest.fixture
def folder(tmp_path, monkeypatch, invoke):
    """Stand in a folder with a rule base in the canonical form, one that is not, and one with an error."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "ugly.fcl").write_text(UGLY, "utf-8")
    (tmp_path / "tidy.fcl").write_text(UGLY, "utf-8")
    assert invoke("fmt", "tidy.fcl").exit_code == Exit.GREEN
    (tmp_path / "bad.fcl").write_text(UGLY.replace("IS inlet", "IS outlet"), "utf-8")
    return tmp_path


def test_files_are_rewritten_in_place_and_those_that_changed_are_named(folder, invoke):
    result = invoke("fmt", "ugly.fcl", "tidy.fcl")
    assert (result.exit_code, result.stdout) == (Exit.GREEN, "ugly.fcl: rewritten\n")
    assert (folder / "ugly.fcl").read_bytes() == (folder / "tidy.fcl").read_bytes()
    assert "    temp: REAL; // in °C\n" in (folder / "ugly.fcl").read_text("utf-8")
    assert invoke("fmt", ".").exit_code == Exit.INPUT
    assert invoke("fmt", "*y.fcl").stdout == ""


def test_check_writes_nothing_and_is_red_where_a_file_would_change(folder, invoke):
    result = invoke("fmt", "--check", "ugly.fcl", "tidy.fcl")
    assert (result.exit_code, result.stdout) == (Exit.VERDICT, "ugly.fcl: would be rewritten\n")
    assert (folder / "ugly.fcl").read_text("utf-8") == UGLY
    assert invoke("fmt", "--check", "tidy.fcl").exit_code == Exit.GREEN


def test_diff_shows_what_would_change_and_writes_nothing(folder, invoke):
    result = invoke("fmt", "--diff", "ugly.fcl", "tidy.fcl")
    assert result.exit_code == Exit.GREEN
    lines = result.stdout.splitlines()
    assert lines[:2] == ["--- ugly.fcl", "+++ ugly.fcl (canonical)"]
    assert "-    temp : REAL;   // in °C" in lines
    assert "+    temp: REAL; // in °C" in lines
    assert (folder / "ugly.fcl").read_text("utf-8") == UGLY
    assert invoke("fmt", "--diff", "--check", "ugly.fcl").exit_code == Exit.VERDICT


def test_a_file_that_differs_in_its_bytes_alone_is_rewritten(folder, invoke):
    tidy = (folder / "tidy.fcl").read_bytes()
    (folder / "tidy.fcl").write_bytes(b"\xef\xbb\xbf" + tidy.replace(b"\n", b"\r\n"))
    assert invoke("fmt", "--diff", "tidy.fcl").stdout == "tidy.fcl: encoding or line ends would change\n"
    assert invoke("fmt", "tidy.fcl").stdout == "tidy.fcl: rewritten\n"
    assert (folder / "tidy.fcl").read_bytes() == tidy
    (folder / "tidy.fcl").write_bytes(tidy.decode().encode("cp1252"))
    assert invoke("fmt", "tidy.fcl").stdout == "tidy.fcl: rewritten\n"
    assert (folder / "tidy.fcl").read_bytes() == tidy


def test_a_text_without_a_last_line_end_is_shown_as_such(folder, invoke):
    (folder / "tidy.fcl").write_text((folder / "tidy.fcl").read_text("utf-8").rstrip(), "utf-8")
    assert invoke("fmt", "--diff", "tidy.fcl").stdout.splitlines()[-3:] == [
        "-END_FUNCTION_BLOCK",
        "\\ No newline at end of file",
        "+END_FUNCTION_BLOCK",
    ]


def test_a_file_with_errors_is_left_alone_and_the_others_are_not(folder, invoke):
    before = (folder / "bad.fcl").read_bytes()
    result = invoke("fmt", "bad.fcl", "ugly.fcl")
    assert (result.exit_code, result.stdout) == (Exit.INPUT, "ugly.fcl: rewritten\n")
    assert "bad.fcl:26:60: error[FCL310]: `outlet` is not a term of `valve`" in result.stderr
    assert (folder / "bad.fcl").read_bytes() == before


def test_characters_that_no_encoding_explains_are_not_lost(folder, invoke):
    content = UGLY.encode("cp1252").replace("°".encode("cp1252"), b"\x81")
    (folder / "ugly.fcl").write_bytes(content)
    result = invoke("fmt", "ugly.fcl")
    assert result.exit_code == Exit.INPUT
    assert (
        "this file is neither UTF-8 nor Windows-1252: some of its characters would be lost" in result.stderr
    )
    assert (folder / "ugly.fcl").read_bytes() == content


def test_a_file_that_is_not_there_is_said_once(folder, invoke):
    result = invoke("fmt", "ugli.fcl")
    assert (result.exit_code, result.stdout) == (Exit.INPUT, "")
    assert result.stderr.count("FCL101") == 1
    assert "did you mean `ugly.fcl`?" in result.stderr


def test_a_file_keeps_its_mode_and_a_link_its_target(folder, invoke):
    (folder / "ugly.fcl").chmod(0o640)
    (folder / "link.fcl").symlink_to("ugly.fcl")
    assert invoke("fmt", "link.fcl").stdout == "link.fcl: rewritten\n"
    assert (folder / "link.fcl").is_symlink()
    assert stat.S_IMODE((folder / "ugly.fcl").stat().st_mode) == 0o640
    assert (folder / "ugly.fcl").read_bytes() == (folder / "tidy.fcl").read_bytes()
    assert sorted(each.name for each in folder.iterdir()) == ["bad.fcl", "link.fcl", "tidy.fcl", "ugly.fcl"]


def test_what_cannot_be_put_in_place_leaves_the_old_file_and_nothing_else(folder, invoke, monkeypatch):
    def refuse(handle):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", refuse)
    result = invoke("fmt", "ugly.fcl")
    assert result.exit_code == Exit.INPUT
    assert "No space left on device" in result.stderr
    assert (folder / "ugly.fcl").read_text("utf-8") == UGLY
    assert sorted(each.name for each in folder.iterdir()) == ["bad.fcl", "tidy.fcl", "ugly.fcl"]


def test_stdin_goes_to_stdout(folder):
    def pipe(name):
        return CliRunner().invoke(program, ["fmt", "-"], input=(folder / name).read_bytes())

    result = pipe("ugly.fcl")
    assert (result.exit_code, result.stdout_bytes) == (Exit.GREEN, (folder / "tidy.fcl").read_bytes())
    result = pipe("bad.fcl")
    assert (result.exit_code, result.stdout) == (Exit.INPUT, "")
    assert "<stdin>:26:60: error[FCL310]" in result.stderr


def test_the_basic_level_is_written_or_refused(folder, invoke):
    assert invoke("fmt", "--level", "basic", "tidy.fcl").stdout == "tidy.fcl: rewritten\n"
    assert "    RULE 2a: IF temp IS hot THEN valve IS closed;\n" in (folder / "tidy.fcl").read_text("utf-8")
    (folder / "ugly.fcl").write_text(UGLY.replace("level IS low", "level IS NOT low"), "utf-8")
    result = invoke("fmt", "--level", "basic", "ugly.fcl")
    assert (result.exit_code, result.stdout) == (Exit.INPUT, "")
    assert "ugly.fcl:26:33: error[FCL501]: the Basic Level has no NOT" in result.stderr

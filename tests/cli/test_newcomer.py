"""Whole processes in an empty folder, as a user meets them: nothing that goes wrong there is a traceback."""

import os
import signal
import stat
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.cli.conftest import environment
from tests.house.places import ROOT

CRANE = ROOT / "scenarios" / "crane" / "crane_printed.fcl"


def message(result, code=3):
    """Return the one message of a process that ended with `code`, and check that it is one."""
    assert result.returncode == code, result.stderr
    assert "Traceback" not in result.stderr
    assert result.stderr.count("error[") == 1
    return result.stderr


def test_without_anything_the_commands_are_listed(start):
    result = start()
    assert result.returncode == 2
    assert "Commands:" in result.stderr + result.stdout


def test_a_word_that_is_no_command_gets_the_nearest(start):
    result = start("rnu")
    assert (result.returncode, result.stdout) == (2, "")
    assert result.stderr.endswith("Error: There is no command 'rnu'. Did you mean 'run'?\n")


def test_a_missing_fcl_file_is_named(start):
    assert message(start("eval", "crane.fcl", "x=1")) == "crane.fcl: error[FCL101]: there is no such file\n"


def test_a_plant_with_a_missing_derivative_is_named_with_its_line(start, bench):
    (bench / "plants").mkdir()
    text = (ROOT / "plants" / "crane.py").read_text("utf-8")
    line = next(line for line in text.splitlines() if line.strip().startswith("dx[2] ="))
    (bench / "plants" / "crane.py").write_text(text.replace(line + "\n", ""))
    told = message(start("run", cwd=bench))
    assert told.startswith("plants/crane.py:") or str(bench / "plants" / "crane.py") in told
    assert "`dynamics` leaves dx[2] (`angle`) unset" in told


def test_a_typo_in_a_scenario_is_shown_at_its_place(start, bench):
    short = bench / "scenarios" / "crane" / "short.toml"
    short.write_text(short.read_text().replace("crane.sway", "crane.swey"))
    told = message(start("run", cwd=bench))
    assert told.startswith("scenarios/crane/short.toml:")
    assert told.endswith("hint: did you mean `crane.sway`?\n")


def test_a_folder_that_cannot_be_made_for_reports(start, bench):
    (bench / "reports").write_text("in the way")
    assert "the report cannot be written" in message(start("run", cwd=bench))


def test_a_folder_that_may_not_be_written(start, bench):
    if os.geteuid() == 0:
        place = "/proc/fcl_sim"  # what even root cannot make
    else:
        place = bench / "locked"
        place.mkdir(mode=stat.S_IRUSR | stat.S_IXUSR)
    assert "the report cannot be written" in message(start("run", "--reports", place, cwd=bench))


def test_a_full_disk_below_the_output(start):
    with Path("/dev/full").open("w") as full:
        result = start("check", CRANE, stdout=full)
    assert message(result) == "error[RUN101]: the system refused: No space left on device\n"


def test_a_reader_that_leaves_early_is_no_error(tmp_path):
    command = [sys.executable, "-m", "fcl_sim", "show", "tokens", str(CRANE)]
    with subprocess.Popen(
        command, cwd=tmp_path, env=environment(), stdout=subprocess.PIPE, stderr=subprocess.PIPE
    ) as process:
        process.stdout.close()
        told = process.stderr.read()
    assert (process.returncode, told) == (141, b"")


def test_signs_that_a_terminal_lacks_do_not_stop_a_command(start, bench):
    result = start("run", "--no-report", cwd=bench, env=environment(PYTHONIOENCODING="ascii"))
    assert result.returncode == 0


@pytest.mark.parametrize("sent", [signal.SIGKILL, signal.SIGINT], ids=["killed", "interrupted"])
def test_a_run_that_is_ended_leaves_no_half_written_file(bench, sent):
    complete = reports(bench, lambda process: process.wait())
    assert {"report.pdf", "results.json"} < set(complete)
    for file in (bench / "reports").rglob("*.*"):
        file.unlink()
    seen = reports(bench, lambda process: end_while_writing(process, bench / "reports", sent))
    assert all(complete[name] == content for name, content in seen.items())


def heed_interrupts():
    """Undo what a shell does to programs that it starts in the background: they do not hear of SIGINT."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def reports(bench, finish):
    """Run the bench, let `finish` end the process, return its visible files below reports/."""
    with subprocess.Popen(
        [sys.executable, "-m", "fcl_sim", "run", "--png"],
        cwd=bench,
        env=environment(),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        preexec_fn=heed_interrupts,  # noqa: PLW1509  no thread of ours is running
    ) as process:
        finish(process)
        told = process.stderr.read().decode()
    assert "Traceback" not in told
    folder = bench / "reports"
    files = [file for file in folder.rglob("*") if file.is_file()]
    visible = [
        file for file in files if not any(part.startswith(".") for part in file.relative_to(folder).parts)
    ]
    return {file.relative_to(folder).as_posix(): file.read_bytes() for file in visible}


def end_while_writing(process, folder, sent):
    while process.poll() is None:
        if any(folder.glob(".*/*.svg")) or any(folder.glob(".*/*/*/*.svg")):
            process.send_signal(sent)
            break
        time.sleep(0.002)
    process.wait()
    assert process.returncode in {-signal.SIGKILL, 130}

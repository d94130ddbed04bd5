"""Writing: whole or not at all, the same bytes from the same inputs, faults in one message."""

import errno
import os
import signal
import subprocess
import sys
from contextlib import closing
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import pytest

from fcl_sim import forked
from fcl_sim.diagnostics import InputFault
from fcl_sim.report import exclusive, write, writer
from fcl_sim.report.characteristics import memberships
from fcl_sim.report.exclusive import PREFIX, workplace
from fcl_sim.report.provenance import EPOCH, date_of
from fcl_sim.report.vector import svg
from tests.house.places import ROOT
from tests.report.synthetic import crane, outcome, run


@pytest.fixture
def small(tmp_path):
    folder = tmp_path / "inputs"
    folder.mkdir()
    return [outcome(folder, run(folder))]


def other_than(outcomes):
    """Return outcomes with other results, of the same names."""
    return [replace(each, variants={"base": replace(each.base, title="another")}) for each in outcomes]


def everything(folder: Path) -> dict[str, bytes]:
    return {str(each.relative_to(folder)): each.read_bytes() for each in folder.rglob("*") if each.is_file()}


def test_two_reports_from_the_same_inputs_are_the_same_bytes(small, tmp_path, monkeypatch):
    monkeypatch.delenv("SOURCE_DATE_EPOCH", raising=False)
    first, second = tmp_path / "first", tmp_path / "second"
    written = write(small, first, png=True)
    write(small, second, png=True)
    assert written[0] == first / "report.pdf"
    assert sorted(str(each.relative_to(first)) for each in written) == sorted(everything(first))
    assert sorted(everything(first)) == [
        "crane/transfer/base-controller.rules-activation.png",
        "crane/transfer/base-controller.rules.png",
        "crane/transfer/base-time.png",
        "crane/transfer/wiring.png",
        "report.pdf",
        "results.json",
        "results.npz",
        "rule-bases/crane-steps.png",
        "rule-bases/crane-surface.png",
        "rule-bases/crane-terms.png",
    ]
    assert everything(first) == everything(second)


def test_pictures_are_written_on_request_and_those_of_an_older_report_do_not_stay(small, tmp_path):
    write(small, tmp_path / "reports", png=True, pages=True)
    (tmp_path / "reports" / "crane" / "mine.png").write_text("mine")
    (tmp_path / "reports" / "pages" / "1st.png").write_text("mine")
    write(other_than(small), tmp_path / "reports")
    assert sorted(everything(tmp_path / "reports")) == [
        "crane/mine.png",
        "pages/1st.png",
        "report.pdf",
        "results.json",
        "results.npz",
    ]


def test_the_page_for_a_browser_is_written_on_request_and_that_of_an_older_report_does_not_stay(
    small, tmp_path
):
    written = write(small, tmp_path / "reports", html=True)
    assert [each.name for each in written] == ["report.pdf", "report.html", "results.json", "results.npz"]
    assert written[1].read_text("utf-8").startswith("<!DOCTYPE html>")
    write(other_than(small), tmp_path / "reports")
    assert sorted(everything(tmp_path / "reports")) == ["report.pdf", "results.json", "results.npz"]


def test_what_shows_the_same_results_stays(small, tmp_path):
    write(small, tmp_path / "reports", png=True, html=True, pages=True)
    before = everything(tmp_path / "reports")
    write(small, tmp_path / "reports")
    assert everything(tmp_path / "reports") == before


def test_a_scenario_may_be_called_as_the_folder_of_the_pages_is(small, tmp_path):
    folder = tmp_path / "inputs"
    named = [outcome(folder, run(folder), run(folder, "2nd"), name="pages")]
    written = write(named, tmp_path / "reports", png=True, pages=True)
    assert {each for each in written if not each.is_file()} == set()
    assert tmp_path / "reports" / "pages" / "2nd-time.png" in written


def test_what_is_done_is_told_in_its_order(small, tmp_path):
    told: list[str] = []
    write(small, tmp_path / "reports", lap=told.append)
    assert told == ["drawing", "typesetting", "writing"]


def test_a_report_replaces_the_one_before_and_leaves_other_files_alone(small, tmp_path):
    place = tmp_path / "reports"
    place.mkdir()
    (place / "report.pdf").write_text("old")
    (place / "README.md").write_text("mine")
    write(small, place)
    assert (place / "report.pdf").read_bytes().startswith(b"%PDF")
    assert (place / "README.md").read_text() == "mine"


def test_the_date_is_that_of_the_newest_input_or_the_one_given(small, monkeypatch):
    monkeypatch.delenv("SOURCE_DATE_EPOCH", raising=False)
    newest = small[0].scenario.files[1].path
    os.utime(small[0].scenario.files[0].path, (10**9, 10**9))
    os.utime(newest, (11 * 10**8, 11 * 10**8))
    assert date_of(small) == datetime.fromtimestamp(11 * 10**8, UTC)
    assert date_of([]) == EPOCH
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1234567890")
    assert date_of(small) == datetime.fromtimestamp(1234567890, UTC)


@pytest.mark.parametrize("given", ["soon", "1e9", "9" * 30])
def test_a_given_date_that_is_none_is_one_message(small, monkeypatch, given):
    monkeypatch.setenv("SOURCE_DATE_EPOCH", given)
    with pytest.raises(InputFault) as caught:
        date_of(small)
    assert str(caught.value) == (
        f"error[RUN203]: SOURCE_DATE_EPOCH is `{given}`, which is not a date\n"
        "  hint: give whole seconds since 1970"
    )


DYING = """
import os, signal, sys
from pathlib import Path
from fcl_sim.report import write
from tests.report.synthetic import outcome, run

def progress(done, total):
    if done == total - 1:
        os.kill(os.getpid(), signal.SIGKILL)

inputs, place = map(Path, sys.argv[1:])
write([outcome(inputs, run(inputs))], place, progress)
"""


def test_a_run_that_is_killed_leaves_nothing_to_be_seen_and_the_next_one_cleans_up(small, tmp_path):
    place = tmp_path / "reports"
    dying = subprocess.run([sys.executable, "-c", DYING, tmp_path / "inputs", place], cwd=ROOT, check=False)
    assert dying.returncode == -signal.SIGKILL
    (left,) = place.iterdir()
    assert left.name.startswith(PREFIX)
    assert any(left.rglob("*.svg"))
    write(small, place)
    assert not any(each.name.startswith(PREFIX) for each in place.iterdir())


def test_an_interrupted_run_leaves_nothing(small, tmp_path):
    def progress(done: int, total: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write(small, tmp_path / "reports", progress)
    assert list((tmp_path / "reports").iterdir()) == []


def test_the_workplace_of_a_run_that_lives_is_left_alone(tmp_path, monkeypatch):
    monkeypatch.setattr(exclusive, "PATIENCE", 0.1)
    with workplace(tmp_path) as ours:
        with pytest.raises(InputFault) as caught, workplace(tmp_path):
            pass
        assert ours.is_dir()
    assert not ours.exists()
    assert str(caught.value) == (
        f"{tmp_path}: error[RUN202]: another run is writing its report here\n"
        "  hint: wait for it to end, or name another folder"
    )


def test_a_folder_that_cannot_be_written_is_one_message(small, tmp_path):
    file = tmp_path / "file"
    file.write_text("")
    with pytest.raises(InputFault) as caught:
        write(small, file / "reports")
    assert str(caught.value) == (
        f"{file / 'reports'}: error[RUN201]: the report cannot be written: Not a directory\n"
        "  hint: name a folder that can be written"
    )


@pytest.mark.parametrize(
    ("number", "hint"),
    [
        (errno.ENOSPC, "make room, or name a folder elsewhere"),
        (errno.EACCES, "name a folder that can be written"),
    ],
)
def test_a_disk_that_refuses_in_mid_report_is_one_message_and_leaves_nothing(
    small, tmp_path, monkeypatch, number, hint
):
    def refuse(*_):
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr(writer.typeset, "pdf", refuse)
    place = tmp_path / "reports"
    with pytest.raises(InputFault) as caught:
        write(small, place)
    assert str(caught.value) == (
        f"{place}: error[RUN201]: the report cannot be written: {os.strerror(number)}\n  hint: {hint}"
    )
    assert list(place.iterdir()) == []


@pytest.mark.parametrize(
    ("name", "stem"),
    [
        ("crane", "crane"),
        ("../etc", "_etc"),
        ("..", "_"),
        ("", "_"),
        ("a b/c", "a_b_c"),
        ("µ", "_"),
        ("x" * 300, "x" * 80),
    ],
)
def test_names_become_file_names_that_stay_inside(name, stem):
    assert writer.slug(name) == stem


def test_pictures_that_share_a_name_get_files_of_their_own(tmp_path):
    (picture,) = memberships(crane(), {}, "Terms")
    with closing(writer.Shelf(tmp_path)) as shelf:
        assert [shelf.add("a/b", picture) for _ in range(3)] == [
            "a/b/Terms.svg",
            "a/b/Terms-2.svg",
            "a/b/Terms-3.svg",
        ]


@pytest.mark.parametrize("processors", [1, 2, 3])
def test_pictures_are_drawn_once_each_whoever_draws_them(processors, tmp_path, monkeypatch):
    for module in (writer, forked):
        monkeypatch.setattr(module, "able", lambda workers=None: processors)
    (picture,) = memberships(crane(), {}, "Terms")
    told = []
    with closing(writer.Shelf(tmp_path)) as shelf:
        names = [shelf.add(f"{number}", picture) for number in range(5 * writer.BATCH)]
        shelf.draw(lambda done, count: told.append((done, count)))
    assert {(tmp_path / name).read_bytes() for name in names} == {svg(picture.draw())}
    assert told[-1] == (len(names), len(names))
    assert told == sorted(told)
    assert (told[0][0] > 0) == (processors > 1)  # what was begun while there were more to come


def test_what_cannot_be_drawn_is_told_of_also_where_a_copy_should_have(tmp_path, monkeypatch):
    monkeypatch.setattr(writer, "able", lambda: 2)
    (picture,) = memberships(crane(), {}, "Terms")
    broken = replace(picture, draw=lambda: 1 / 0)
    with closing(writer.Shelf(tmp_path)) as shelf:
        for number in range(writer.BATCH):
            shelf.add(f"{number}", broken if number == 3 else picture)
        with pytest.raises(ZeroDivisionError):
            shelf.draw(lambda done, count: None)

"""Files written by copies of this process are those that it would have written alone."""

import os
import sys
from functools import partial
from pathlib import Path

import pytest

from fcl_sim.report import lettering
from fcl_sim.report.forked import FEW, do_all

HERE = os.getpid()


def written(folder: Path, number: int) -> None:
    (folder / f"{number}").write_text(f"{number}", encoding="utf-8")


def tasks(folder, count=40):
    return [partial(written, folder, number) for number in range(count)]


@pytest.mark.parametrize("workers", [1, 2, 3])
@pytest.mark.parametrize("count", [0, 1, 17, 40])
def test_every_task_is_done(tmp_path, workers, count):
    heard = []
    do_all(tasks(tmp_path, count), heard.append, workers)
    assert sorted(int(file.name) for file in tmp_path.iterdir()) == list(range(count))
    assert heard == sorted(heard)


@pytest.mark.skipif(sys.platform != "linux", reason="done by one process")
def test_a_copy_does_its_share(tmp_path):
    def by_whom(number: int) -> None:
        (tmp_path / f"{number}").write_text(str(os.getpid()), encoding="utf-8")

    do_all([partial(by_whom, number) for number in range(20)], lambda _: None, 2)
    assert len({file.read_text(encoding="utf-8") for file in tmp_path.iterdir()}) == 2


def test_what_a_copy_fails_at_is_done_here(tmp_path):
    def only_here(number: int) -> None:
        if os.getpid() != HERE:
            os._exit(9)
        written(tmp_path, number)

    do_all([partial(only_here, number) for number in range(20)], lambda _: None, 2)
    assert len([*tmp_path.iterdir()]) == 20


def test_a_task_that_fails_everywhere_is_told_of(tmp_path):
    def fails() -> None:
        raise OSError("no space")

    for place in (0, 1):  # of this process, of the copy
        given = tasks(tmp_path)
        given[place] = fails
        with pytest.raises(OSError, match="no space"):
            do_all(given, lambda _: None, 2)


@pytest.mark.skipif(sys.platform != "linux", reason="done by one process")
def test_an_interrupt_ends_the_copies_and_is_passed_on(tmp_path, monkeypatch):
    copies, fork = [], os.fork

    def noted():
        copy = fork()
        copies.append(copy)
        return copy

    def interrupted() -> None:
        if os.getpid() == HERE:
            raise KeyboardInterrupt
        written(tmp_path, 0)

    monkeypatch.setattr("fcl_sim.report.forked.os.fork", noted)
    with pytest.raises(KeyboardInterrupt):
        do_all([interrupted] * 40, lambda _: None, 3)
    assert len(copies) == 2
    for copy in copies:
        with pytest.raises(ChildProcessError):
            os.waitpid(copy, os.WNOHANG)


@pytest.mark.skipif(sys.platform != "linux", reason="copies of a process")
def test_copies_of_a_process_measure_the_same_letters_at_the_same_time(tmp_path):
    letters = [chr(each) for each in range(0x100, 0x400)]

    def measured() -> str:
        lettering._advance.cache_clear()
        return " ".join(str(lettering._advance(each, bold=False)) for each in letters)

    def into(file: Path) -> None:
        try:
            told = measured()
        except RuntimeError as error:
            told = str(error)
        file.write_text(told, encoding="utf-8")

    alone = measured()
    do_all([partial(into, tmp_path / str(each)) for each in range(FEW + 4)], lambda _: None, workers=4)
    assert {each.read_text(encoding="utf-8") for each in tmp_path.iterdir()} == {alone}

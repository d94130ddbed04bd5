"""What copies of this process do and send back is what it would have come to alone."""

import os
import signal
import sys
import time
from functools import partial
from pathlib import Path
from types import MappingProxyType

import numpy as np
import pytest

from fcl_sim.forked import Copies, do_all, results

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
def test_a_copy_does_its_share_while_this_process_is_busy(tmp_path):
    def by_whom(number: int) -> None:
        (tmp_path / f"{number}").write_text(str(os.getpid()), encoding="utf-8")
        while len(writers()) < 2:  # neither does it all before the other has begun
            time.sleep(0.001)

    def writers() -> set[str]:
        return {file.read_text(encoding="utf-8") for file in tmp_path.iterdir()} - {""}

    do_all([partial(by_whom, number) for number in range(20)], lambda _: None, 2)
    assert len(writers()) == 2
    assert len(list(tmp_path.iterdir())) == 20


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
        time.sleep(0.05)  # a copy that is quick would leave nothing to do for this process
        written(tmp_path, 0)

    monkeypatch.setattr("fcl_sim.forked.os.fork", noted)
    with pytest.raises(KeyboardInterrupt):
        do_all([interrupted] * 40, lambda _: None, 3)
    assert len(copies) == 2
    for copy in copies:
        with pytest.raises(ChildProcessError):
            os.waitpid(copy, os.WNOHANG)


@pytest.fixture
def two():
    copies = Copies(2)
    yield copies
    copies.close()


copied = pytest.mark.skipif(sys.platform != "linux", reason="done by one process")


@copied
def test_what_copies_come_to_is_sent_back_whichever_is_done_first(two):
    works = [two.begin(lambda number=number: (number, os.getpid()), weight=number % 3) for number in range(9)]
    found = [two.result(work) for work in works]
    assert [number for number, _ in found] == [*range(9)]
    assert len({process for _, process in found} - {HERE}) == 9


@pytest.mark.parametrize("workers", [1, 2, 3])
@pytest.mark.parametrize("count", [0, 1, 2, 7])
def test_results_stand_in_the_order_of_their_tasks(workers, count):
    assert results([partial(pow, number, 2) for number in range(count)], workers) == [
        number**2 for number in range(count)
    ]


@copied
def test_numbers_come_back_bit_for_bit_those_of_a_part_of_an_array_too(two):
    whole = np.random.default_rng(5).normal(size=(40, 7))
    whole[3, 2] = np.nan
    sent = {
        "rows": whole[3:9],
        "columns": whole[:, 2:5],
        "one": whole.T[4],
        "none": whole[:0],
        "bits": whole > 0,
    }
    found = two.result(two.begin(lambda: sent))
    assert {name: (each.dtype, each.shape, each.tobytes()) for name, each in found.items()} == {
        name: (each.dtype, each.shape, each.tobytes()) for name, each in sent.items()
    }
    found["rows"][:] = 0.0  # it is memory of this process
    assert np.isfinite(whole[4]).all()


@copied
def test_what_is_known_comes_back_as_itself(two):
    known = [lambda: 1, MappingProxyType({"a": 1})]
    found, other = two.result(two.begin(lambda: (known[0], MappingProxyType({"b": known[1]})), known=known))
    assert found is known[0]
    assert isinstance(other, MappingProxyType)
    assert other["b"] is known[1]


@copied
def test_what_cannot_be_sent_or_fails_in_a_copy_is_done_here(two):
    works = [two.begin(lambda: lambda: 5), two.begin(lambda: os.getpid() == HERE or os._exit(9))]
    assert two.result(works[0])() == 5
    assert two.result(works[1]) is True


@copied
def test_what_fails_everywhere_is_raised_to_whoever_asks(two):
    def fails() -> None:
        raise OSError("no space")

    work = two.begin(fails)
    with pytest.raises(OSError, match="no space"):
        two.result(work)


@copied
def test_no_more_work_than_told_is_under_way_and_the_heaviest_goes_first(tmp_path):
    def noted(name: str) -> None:
        with (tmp_path / "order").open("a", encoding="utf-8") as file:
            file.write(name)

    copies = Copies(1)
    assert copies.free()
    held = copies.begin(lambda: time.sleep(0.05))
    assert not copies.free()
    works = [
        copies.begin(partial(noted, name), weight) for name, weight in (("a", 1.0), ("b", 3.0), ("c", 2.0))
    ]
    for work in (held, *works):
        copies.result(work)
    assert (tmp_path / "order").read_text(encoding="utf-8") == "bca"
    assert copies.free()


@pytest.fixture
def interruptible():
    """Let SIGINT interrupt, which a process that a shell has put into the background ignores."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture
def refused(monkeypatch):
    """Let the system refuse every fork but so many first ones; return what sets how many."""
    left, fork = [0], os.fork

    def refusing():
        if not left[0]:
            raise BlockingIOError(11, "Resource temporarily unavailable")
        left[0] -= 1
        return fork()

    monkeypatch.setattr("fcl_sim.forked.os.fork", refusing)
    return partial(left.__setitem__, 0)


def opened():
    return len(list(Path("/proc/self/fd").iterdir()))


@copied
@pytest.mark.parametrize("granted", [0, 1])
def test_where_a_copy_is_refused_those_that_there_are_do_every_task(tmp_path, refused, granted):
    refused(granted)
    do_all(tasks(tmp_path), lambda _: None, 3)
    assert len(list(tmp_path.iterdir())) == 40
    with pytest.raises(ChildProcessError):
        os.waitpid(-1, os.WNOHANG)


@copied
@pytest.mark.parametrize("granted", [0, 1])
def test_work_whose_copy_is_refused_is_done_here_and_nothing_stays_open(refused, granted):
    before = opened()
    refused(granted)
    copies = Copies(2)
    works = [copies.begin(lambda number=number: number) for number in range(4)]
    assert [copies.result(work) for work in works] == [0, 1, 2, 3]
    copies.close()
    assert opened() == before


@copied
def test_nothing_stays_open_of_work_that_is_interrupted_as_it_begins(monkeypatch):
    def interrupted():
        raise KeyboardInterrupt

    before = opened()
    monkeypatch.setattr("fcl_sim.forked.os.fork", interrupted)
    with pytest.raises(KeyboardInterrupt):
        Copies(1).begin(lambda: 1)
    assert opened() == before


@copied
def test_what_is_asked_for_after_the_end_is_done_here():
    copies = Copies(1)
    works = [copies.begin(lambda number=number: (number, os.getpid())) for number in range(2)]
    copies.close()
    assert [copies.result(work) for work in works] == [(0, HERE), (1, HERE)]


def test_without_a_copy_at_work_nothing_is_waited_for(monkeypatch):
    def refusing(read, write, failed, seconds=None):
        raise OSError(10022, "An invalid argument was supplied")

    monkeypatch.setattr("fcl_sim.forked.select.select", refusing)
    monkeypatch.setattr("fcl_sim.forked.sys.platform", "win32")
    copies = Copies(2)
    assert not copies.free()
    assert copies.result(copies.begin(lambda: 5)) == 5


@copied
@pytest.mark.usefixtures("interruptible")
def test_an_interrupt_in_the_midst_of_a_fork_is_not_lost():
    os.register_at_fork(after_in_parent=partial(interrupt_once, [signal.SIGINT]))
    with pytest.raises(KeyboardInterrupt):
        Copies(1).begin(partial(time.sleep, 5.0))
    with pytest.raises(ChildProcessError):
        os.waitpid(-1, os.WNOHANG)


def interrupt_once(left):
    """Interrupt this process, at the first call."""
    if left:
        signal.raise_signal(left.pop())

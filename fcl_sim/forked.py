"""Work for all processors, by processes that begin as copies of this one.

In: tasks. Out: the files that they write (`do_all`), or what they come to,
sent back (`results`, `Copies`). A process runs Python in one thread at a time. A copy
knows what this process knows, and need not be told. Only Linux is trusted with
copies of a process that has called system libraries; elsewhere, and where a
copy fails, this process does the work itself. Imports nothing of ours.
Tests: tests/test_forked.py.
"""

import gc
import io
import mmap
import os
import pickle
import select
import signal
import sys
import threading
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from itertools import accumulate
from types import MappingProxyType
from typing import Any, Generic, TypeVar

import numpy as np

FEW = 16
"""Tasks that write a file and are not worth a copy, at most."""
NUMBER = 8
"""Bytes of a whole number."""
ALIGNED = 64
"""Arrays that are sent begin at multiples of so many bytes."""

Task = Callable[[], object]
"""Writes a file of its own; done twice it writes the same."""

Value = TypeVar("Value")


def able(workers: int | None = None) -> int:
    """Return how many processes can work at a time: `workers`, else one for each processor; 1 is this one."""
    return (workers or os.cpu_count() or 1) if sys.platform == "linux" else 1


def do_all(tasks: Sequence[Task], done: Callable[[int], None], workers: int | None = None) -> None:
    """Do every task, each process the next when it is free; `done` hears how many of all are.

    Raises what the first task that fails raises.
    """
    count = able(workers)
    if count == 1 or len(tasks) <= FEW:
        for number, task in enumerate(tasks):
            done(number)
            task()
    else:
        _share(tasks, done, count)
    done(len(tasks))


def _share(tasks: Sequence[Task], done: Callable[[int], None], count: int) -> None:
    """Do every task by `count` processes, which read the numbers of tasks from one file, at one place."""
    finished = mmap.mmap(-1, len(tasks))
    queue = os.memfd_create("tasks")
    os.write(queue, b"".join(number.to_bytes(NUMBER, "little") for number in range(len(tasks))))
    os.lseek(queue, 0, os.SEEK_SET)

    def work(done: Callable[[int], None]) -> None:
        while given := os.read(queue, NUMBER):
            number = int.from_bytes(given, "little")
            done(number)
            tasks[number]()
            finished[number] = 1

    copies: list[int] = []
    try:
        with suppress(OSError):  # the system has room for no more: those that there are do it all
            for _ in range(1, count):
                copy = _copy(lambda: work(_silent))
                copies.append(copy)
        work(done)
        for copy in copies:
            os.waitpid(copy, 0)
    except BaseException:
        _end(copies)
        raise
    finally:
        os.close(queue)
    for number, task in enumerate(tasks):
        if not finished[number]:
            task()


def _copy(task: Task) -> int:
    """Start a copy of this process that does a task and ends, with 0 if that went well; return its number."""
    copy = _fork()
    if copy:
        return copy
    code = 1
    try:
        gc.freeze()  # what it has in common with this process stays as it is, and is shared
        task()
        code = 0
    finally:  # whatever comes, a copy never goes on with what this process does next
        os._exit(code)


def _fork() -> int:
    """Fork this process; an interrupt waits meanwhile, as what a hook of the fork raises is lost."""
    handler = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or not callable(handler):
        return os.fork()
    waiting: list[int] = []
    signal.signal(signal.SIGINT, lambda number, _: waiting.append(number))
    try:
        copy = os.fork()
    finally:
        signal.signal(signal.SIGINT, handler)
    if copy and waiting:
        _end([copy])
        signal.raise_signal(signal.SIGINT)
    return copy


def _end(copies: Sequence[int]) -> None:
    for copy in copies:
        with suppress(ProcessLookupError, ChildProcessError):
            os.kill(copy, signal.SIGKILL)
            os.waitpid(copy, 0)


def _silent(_: int) -> None:
    """Take no notice."""


@dataclass(eq=False)
class Work(Generic[Value]):
    """What a copy is to do: a task, how much it is, and what it knows from before and may name in its answer.

    Every object of `known` comes back as itself.
    """

    task: Callable[[], Value]
    weight: float
    known: Sequence[object]
    answer: list[Value] = field(default_factory=list)
    is_open: bool = True


@dataclass(frozen=True, slots=True)
class _Under:
    """Work under way: the process that does it, the pipe that ends with it, the file that it answers in."""

    work: Work[Any]
    copy: int
    pipe: int
    file: int


class Copies:
    """Copies of this process that work, `count` at a time, and send back what they come to."""

    def __init__(self, count: int) -> None:
        self._count = count if sys.platform == "linux" else 0
        self._waiting: list[Work[Any]] = []
        self._under_way: list[_Under] = []

    def begin(
        self, task: Callable[[], Value], weight: float = 1.0, known: Sequence[object] = ()
    ) -> Work[Value]:
        """Give work to the next copy that is free, the heaviest first. What comes of it must be data."""
        work = Work(task, weight, known)
        self._waiting.append(work)
        self._look(0.0)
        return work

    def free(self) -> bool:
        """Return whether a copy would take up at once what is begun now."""
        self._look(0.0)
        return len(self._waiting) + len(self._under_way) < self._count

    def result(self, work: Work[Value]) -> Value:
        """Return what comes of some work, once it has; where its copy fails it is done here."""
        if not self._count:
            return work.task()
        while work.is_open:
            self._look(None)
        return work.answer.pop() if work.answer else work.task()

    def close(self) -> None:
        """End what is under way; what is asked for after that is done here."""
        _end([each.copy for each in self._under_way])
        for each in self._under_way:
            os.close(each.pipe)
            os.close(each.file)
        for work in (*self._waiting, *(each.work for each in self._under_way)):
            work.is_open = False
        self._under_way, self._waiting = [], []

    def _look(self, seconds: float | None) -> None:
        """Take what was answered, once there is any or so much time has passed, and start what can be."""
        self._start()
        pipes = [each.pipe for each in self._under_way]
        if not pipes:  # of which some systems cannot select one
            return
        ended, _, _ = select.select(pipes, [], [], seconds)
        for each in [each for each in self._under_way if each.pipe in ended]:
            self._under_way.remove(each)
            each.work.answer += _answer(each)
            each.work.is_open = False
        self._start()

    def _start(self) -> None:
        while self._waiting and len(self._under_way) < self._count:
            heaviest = max(self._waiting, key=lambda each: each.weight)
            self._waiting.remove(heaviest)
            try:
                self._under_way.append(_started(heaviest))
            except OSError:  # the system has room for no more: whoever asks for it does it
                heaviest.is_open = False


def results(tasks: Sequence[Callable[[], Value]], workers: int | None = None) -> list[Value]:
    """Return what each task comes to, in their order: data. Each process does a part of them."""
    count = min(able(workers), len(tasks))
    if count < 2:
        return [task() for task in tasks]

    def share(first: int) -> list[Value]:
        return [task() for task in tasks[first::count]]

    copies = Copies(count - 1)
    try:
        works = [copies.begin(partial(share, first)) for first in range(1, count)]
        shares = [share(0), *map(copies.result, works)]
    finally:
        copies.close()
    return [shares[number % count][number // count] for number in range(len(tasks))]


def _started(work: Work[Any]) -> _Under:
    opened = [os.memfd_create("answer")]
    try:
        opened += os.pipe()
        file, pipe, end = opened
        copy = _copy(lambda: _send(work.task(), work.known, file))
    except BaseException:
        for each in opened:
            os.close(each)
        raise
    os.close(end)
    return _Under(work, copy, pipe, file)


def _answer(under: _Under) -> list[Any]:
    """Return what a copy has sent back; nothing where it failed."""
    _, status = os.waitpid(under.copy, 0)
    try:
        return [] if os.waitstatus_to_exitcode(status) else [_received(under.work.known, under.file)]
    finally:
        os.close(under.pipe)
        os.close(under.file)


class _Sender(pickle.Pickler):
    """Pickles data; of what is known on both sides, its number."""

    def __init__(
        self, file: io.BytesIO, known: Sequence[object], keep: Callable[[pickle.PickleBuffer], Any]
    ) -> None:
        super().__init__(file, protocol=5, buffer_callback=keep)
        self._numbers = {id(each): number for number, each in enumerate(known)}

    def persistent_id(self, value: object) -> int | None:
        return self._numbers.get(id(value))

    def reducer_override(self, value: Any) -> Any:
        if isinstance(value, MappingProxyType):
            return _read_only, (dict(value),)
        if isinstance(value, np.ndarray) and not (value.flags.c_contiguous or value.flags.f_contiguous):
            return np.ascontiguousarray(value).__reduce_ex__(5)  # an array with gaps would be pickled twice
        return NotImplemented


class _Receiver(pickle.Unpickler):
    def __init__(self, file: io.BytesIO, known: Sequence[object], buffers: Sequence[memoryview]) -> None:
        super().__init__(file, buffers=buffers)
        self._known = known

    def persistent_load(self, number: Any) -> object:
        return self._known[number]


def _read_only(values: dict[Any, Any]) -> Mapping[Any, Any]:
    return MappingProxyType(values)


def _send(value: object, known: Sequence[object], file: int) -> None:
    """Write a value: the number of its parts, their lengths, its arrays, and behind these its pickle."""
    buffers: list[pickle.PickleBuffer] = []
    pickled = io.BytesIO()
    _Sender(pickled, known, buffers.append).dump(value)
    parts = [*(each.raw() for each in buffers), pickled.getbuffer()]
    lengths = [len(each) for each in parts]
    with open(file, "wb", closefd=False) as out:
        out.write(np.array([len(parts), *lengths], dtype=np.int64).tobytes())
        for start, part in zip(_starts(lengths), parts, strict=True):
            out.seek(start)
            out.write(part)


def _received(known: Sequence[object], file: int) -> Any:
    """Return the value that was sent. Its arrays stay in the memory that they were written to."""
    memory = memoryview(mmap.mmap(file, 0, access=mmap.ACCESS_COPY))
    count = int(np.frombuffer(memory, np.int64, 1)[0])
    lengths = np.frombuffer(memory, np.int64, count, NUMBER).tolist()
    *buffers, pickled = [
        memory[start : start + length] for start, length in zip(_starts(lengths), lengths, strict=True)
    ]
    return _Receiver(io.BytesIO(pickled), known, buffers).load()


def _starts(lengths: Sequence[int]) -> list[int]:
    """Return where parts of these lengths begin in a file."""
    head = NUMBER * (1 + len(lengths))
    return [*accumulate(-(-each // ALIGNED) * ALIGNED for each in (head, *lengths))][:-1]

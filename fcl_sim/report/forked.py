"""Many files to write, on all processors: by processes that begin as copies of this one.

Drawing is Python, of which a process runs one thread at a time. A copy knows
what this process knows, and need not be told; what it comes to are files. Only
Linux is trusted with copies of a process that has called system libraries;
elsewhere, and where a copy fails, this process does the work itself.
"""

import os
import signal
import sys
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress

FEW = 16
"""Tasks that are not worth a copy, at most."""

Task = Callable[[], object]
"""Writes a file of its own; done twice it writes the same."""


def do_all(tasks: Sequence[Task], done: Callable[[int], None], workers: int | None = None) -> None:
    """Do every task; `done` hears how many of all are. Raises what the first task that fails raises."""
    count = workers or os.cpu_count() or 1
    if count == 1 or len(tasks) <= FEW or sys.platform != "linux":
        _do(tasks, done)
        return
    shares = [tasks[first::count] for first in range(count)]
    copies = [_copy(share) for share in shares[1:]]
    try:
        _do(shares[0], lambda number: done(number * count))
        failed = [share for share, copy in zip(shares[1:], copies, strict=True) if not _went_well(copy)]
    except BaseException:
        for copy in copies:
            with suppress(ProcessLookupError, ChildProcessError):
                os.kill(copy, signal.SIGKILL)
                os.waitpid(copy, 0)
        raise
    for share in failed:
        _do(share, _silent)
    done(len(tasks))


def _do(tasks: Iterable[Task], done: Callable[[int], None]) -> None:
    for number, task in enumerate(tasks):
        done(number)
        task()


def _copy(tasks: Sequence[Task]) -> int:
    """Start a copy of this process that does some tasks and ends; return its number."""
    copy = os.fork()
    if copy:
        return copy
    code = 1
    try:
        _do(tasks, _silent)
        code = 0
    finally:  # whatever comes, a copy never goes on with what this process does next
        os._exit(code)


def _went_well(copy: int) -> bool:
    _, status = os.waitpid(copy, 0)
    return os.waitstatus_to_exitcode(status) == 0


def _silent(_: int) -> None:
    """Take no notice."""

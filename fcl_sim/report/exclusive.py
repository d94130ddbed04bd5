"""One writer at a time in a folder, and what dead ones left behind."""

import os
import shutil
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from fcl_sim.diagnostics import InputFault

if sys.platform != "win32":
    import fcntl


PREFIX = ".fcl-sim-report-"
PATIENCE = 60.0
"""Seconds to wait for another writer."""


@contextmanager
def workplace(folder: Path) -> Iterator[Path]:
    """Hand out a hidden temporary folder inside `folder`, ours alone, gone afterwards.

    The folder itself is locked, which a process that dies lets go of; so
    whatever temporary folders stand there when we hold the lock belong to the
    dead and are removed. OSError where the system refuses, InputFault where
    another run writes for too long.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with _locked(folder):
        for left in folder.glob(f"{PREFIX}*"):
            shutil.rmtree(left, ignore_errors=True)
        ours = Path(tempfile.mkdtemp(prefix=PREFIX, dir=folder))
        try:
            yield ours
        finally:
            shutil.rmtree(ours, ignore_errors=True)


@contextmanager
def _locked(folder: Path) -> Iterator[None]:
    if sys.platform == "win32":  # no locks on folders there
        yield
        return
    handle = os.open(folder, os.O_RDONLY)
    try:
        _wait_for(handle, folder)
        yield
    finally:
        os.close(handle)


def _wait_for(handle: int, folder: Path) -> None:
    end = time.monotonic() + PATIENCE
    while True:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            if time.monotonic() > end:
                raise InputFault.at_file(
                    "RUN202",
                    str(folder),
                    "another run is writing its report here",
                    "wait for it to end, or name another folder",
                ) from None
            time.sleep(0.05)
        except OSError:
            return  # a file system without locks: go on without
        else:
            return

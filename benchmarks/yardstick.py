"""Compile the C yardsticks, and take turns with them."""

import ctypes
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Line:
    """What was measured, the result in words, and where there is one its ratio to C within this run."""

    what: str
    result: str
    ratio: float | None = None

    @classmethod
    def of(cls, measured: "Line | str") -> "Line":
        """Return a line of `what: result`, or the one that it is already."""
        if isinstance(measured, Line):
            return measured
        what, _, result = measured.partition(": ")
        return cls(what, result)


def compiled(source: str) -> ctypes.CDLL:
    """Return a C file of this folder as a library, built with `gcc -O3`; exit where there is no gcc."""
    gcc = shutil.which("gcc")
    if gcc is None:
        sys.exit("the benchmarks compare with C and need gcc")
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder) / "yardstick.so"
        path = Path(__file__).parent / source
        command = [gcc, "-O3", "-shared", "-fPIC", "-o", str(library), str(path), "-lm"]
        subprocess.run(command, check=True)
        return ctypes.CDLL(str(library))


def pointer(values: NDArray[np.float64]) -> object:
    """Return an array as C takes it."""
    return values.ctypes.data_as(ctypes.POINTER(ctypes.c_double))


def in_turns(
    ours: Callable[[], object],
    theirs: Callable[[], object],
    rounds: int = 41,
    clock: Callable[[], float] = time.thread_time,
) -> tuple[float, float]:
    """Return the median seconds of each of two functions, called in turns after a warm-up.

    CPU time of this thread, unless `clock` says otherwise: what else the
    machine does counts little.
    """
    times: tuple[list[float], list[float]] = ([], [])
    for round_number in range(rounds + 3):
        for function, kept in zip((ours, theirs), times, strict=True):
            begin = clock()
            function()
            if round_number >= 3:
                kept.append(clock() - begin)
    return median(times[0]), median(times[1])

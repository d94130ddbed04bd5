"""The page docs/speed.md: what was measured, on what, when."""

import os
import platform
import shutil
import subprocess
from collections.abc import Iterable
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

import numba
import numpy as np

from benchmarks.yardstick import Line

PAGE = Path(__file__).parents[1] / "docs" / "speed.md"

HEAD = """\
# Speed

Written by `make speed` on {date}, on: {machine}.

All take turns in one run; times are medians, of processor time but for those "called from Python" and on
several processors. The load average says how busy the machine was with other work. Read the ratios: another
machine has other times, and about the same ratios.

C is written by hand, does the same work, and is compiled with `gcc -O3`; its sources stand in `benchmarks/`.
Other libraries for Python have an environment of their own. How far off a result is, is its distance from
that of exact fractions: where singletons are averaged all are right, areas are sampled by all but ours. An
evaluation called from Python is one call with both inputs by name, and the output read.
"""


@dataclass(frozen=True)
class Section:
    """A table: what was measured, and the result."""

    title: str
    lines: tuple[Line, ...]


def setting() -> str:
    """Return machine and versions in a line."""
    versions = [
        f"Python {platform.python_version()}",
        f"numpy {np.__version__}",
        f"numba {numba.__version__}",
    ]
    compiler = _compiler()
    return ", ".join([_processor(), f"{os.cpu_count()} processors", *versions, *compiler, *_load()])


def _load() -> list[str]:
    """Return how busy the machine is, where it tells: times of the clock mean little on a busy one."""
    return [f"load average {os.getloadavg()[0]:.1f}"] if hasattr(os, "getloadavg") else []


def write(sections: Iterable[Section]) -> None:
    """Write the page."""
    parts = [HEAD.format(date=datetime.now(UTC).date().isoformat(), machine=setting())]
    for section in sections:
        rows = [f"| {each.what} | {each.result} |" for each in section.lines]
        parts.append("\n".join([f"## {section.title}", "", "| what | measured |", "|---|---|", *rows, ""]))
    PAGE.write_text("\n".join(parts), "utf-8")


def _processor() -> str:
    """Return the processor's own name where the system tells it."""
    told = Path("/proc/cpuinfo")
    if told.exists():
        for line in told.read_text("utf-8").splitlines():
            key, _, name = line.partition(":")
            if key.strip() == "model name":
                return name.strip()
    return platform.processor() or platform.machine()


def _compiler() -> list[str]:
    gcc = shutil.which("gcc")
    if gcc is None:
        return []
    told = subprocess.run([gcc, "-dumpfullversion"], capture_output=True, text=True, check=False)
    return [f"gcc {told.stdout.strip()}"]

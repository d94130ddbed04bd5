"""From a new process to its first finished run, with kernels compiled and with kernels cached."""

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from statistics import median

from fcl_sim.plant.catalog import shipped_bench

PROGRAM = """
import sys
from pathlib import Path
from fcl_sim.loop.run import run
from fcl_sim.scenario.binder import bind
from fcl_sim.scenario.reader import read
assert run(bind(read(Path(sys.argv[1])))).fault is None
"""


def measure_start(rounds: int = 5) -> Iterator[str]:
    """Yield two lines: the first process on a machine, and every later one."""
    scenario = str(shipped_bench() / "scenarios" / "crane" / "transfer.toml")
    with tempfile.TemporaryDirectory() as cache:
        environment = {**os.environ, "FCL_SIM_CACHE_DIR": cache}
        times = []
        for _ in range(rounds + 1):
            begin = time.perf_counter()
            subprocess.run([sys.executable, "-c", PROGRAM, scenario], env=environment, check=True)
            times.append(time.perf_counter() - begin)
    until = "new process to its first finished run"
    yield f"{until}, kernels to compile: {times[0]:.1f} s"
    yield f"{until}, kernels cached: {median(times[1:]):.2f} s (median of {rounds})"

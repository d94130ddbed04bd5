"""60 s of the container crane in closed loop, against the same algorithm in C."""

import ctypes
from collections.abc import Iterator

import numpy as np

from benchmarks.yardstick import compiled, in_turns
from fcl_sim.loop.diagram import Diagram
from fcl_sim.loop.run import run_tape
from fcl_sim.loop.tape import lower
from fcl_sim.loop.wiring import wire
from fcl_sim.plant.catalog import shipped_bench
from fcl_sim.scenario.binder import bind
from fcl_sim.scenario.reader import read

PARAMETERS = (15_000.0, 20_000.0, 10.0, 9.81, 2.5, 1.0, 0.1, 0.005, 200.0, 0.005, 0.12, 5e4)
"""The crane's, in the order of crane_loop.c."""
COLUMNS = 38


def crane(scan: str) -> Diagram:
    """Return the loop of the shipped crane at another scan time, in LREAL as C's double is."""
    overrides = {"controller.scan": scan, "controller.blocks.rules.arithmetic": "LREAL"}
    return bind(read(shipped_bench() / "scenarios" / "crane" / "transfer.toml", overrides))


def measure_loop() -> Iterator[str]:
    """Yield a line for each scan time: ours, C, the ratio; the two must agree."""
    library = compiled("crane_loop.c")
    for milliseconds in (10, 50):
        diagram = crane(f"{milliseconds} ms")
        tape = lower(wire(diagram))
        scans = 60_000 // milliseconds
        record = np.zeros((scans + 1, COLUMNS))

        def in_c(scans: int = scans, scan: float = milliseconds / 1000, record: np.ndarray = record) -> None:
            x = np.array([-25.0, 0.0, 0.0, 0.0, 0.0])
            p = np.array(PARAMETERS)
            library.crane_loop(
                _pointer(p),
                _pointer(x),
                ctypes.c_long(scans),
                ctypes.c_double(scan),
                ctypes.c_double(1e-8),
                _pointer(record),
            )

        ours, theirs = in_turns(lambda tape=tape: run_tape(tape), in_c)
        off = np.abs(run_tape(tape)["crane.position"] - record[:, 3]).max()
        yield (
            f"crane, 60 s, {milliseconds} ms scan: {1e3 * ours:.2f} ms, C {1e3 * theirs:.2f} ms, "
            f"{ours / theirs:.2f} times C (positions differ by at most {off:.1g} m)"
        )


def _pointer(values: np.ndarray) -> object:
    return values.ctypes.data_as(ctypes.POINTER(ctypes.c_double))

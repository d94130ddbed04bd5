"""A loop of little but a fuzzy block, against the same in C."""

import ctypes
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from benchmarks.block import crane
from benchmarks.yardstick import compiled, in_turns, pointer
from fcl_sim.loop.diagram import Diagram, FuzzyNode, Integration, PlantNode, Timing, Wire
from fcl_sim.loop.run import run_tape
from fcl_sim.loop.tape import lower
from fcl_sim.loop.wiring import wire
from fcl_sim.plant.catalog import load

SCANS = 100_000
SCAN = 0.01
COLUMNS = 13
PARAMETERS = (1.0, 3.0, 4.0, 12.0)


def lag_loop() -> Diagram:
    """Return the crane's block of 6 rules on a second-order lag, one step of Runge-Kutta a scan."""
    units = {"distance": "m", "angle": "deg", "power": "kW"}
    inputs = {name: Wire(f"plant.{name}") for name in ("distance", "angle")}
    nodes = (FuzzyNode(name="rules", block=crane(with_areas=False), inputs=inputs, units=units),)
    model = load(Path(__file__).parent / "lag_plant.py")
    plant = PlantNode(name="plant", model=model, inputs={"power": Wire("rules.power")})
    scan = round(SCAN * 1e9)
    return Diagram(
        plant=plant,
        nodes=nodes,
        timing=Timing(scan=scan, duration=SCANS * scan),
        integration=Integration(scheme="rk4", step=SCAN),
    )


def measure_lag() -> Iterator[str]:
    """Yield a line: ours, C, the ratio; the two must agree."""
    library = compiled("block.c")
    tape = lower(wire(lag_loop()))
    record = np.zeros((SCANS + 1, COLUMNS))
    p = np.array(PARAMETERS)

    def in_c() -> None:
        x = np.zeros(2)
        library.lag_loop(pointer(p), pointer(x), ctypes.c_long(SCANS), ctypes.c_double(SCAN), pointer(record))

    ours, theirs = in_turns(lambda: run_tape(tape), in_c, rounds=21)
    off = np.abs(run_tape(tape)["plant.distance"] - record[:, 0]).max()
    yield (
        f"lag plant, one step a scan: {1e9 * ours / SCANS:.0f} ns a scan, C {1e9 * theirs / SCANS:.0f} ns, "
        f"{ours / theirs:.2f} times C (distances differ by at most {off:.1g} m)"
    )

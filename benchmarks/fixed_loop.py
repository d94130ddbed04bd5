"""Loops with a fixed step and little around the fuzzy block, against the same in C."""

import ctypes
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from benchmarks.block import crane
from benchmarks.yardstick import Line, compiled, in_turns, pointer
from fcl_sim.loop.diagram import Diagram, FuzzyNode, Integration, PlantNode, Timing, Wire
from fcl_sim.loop.run import run_tape
from fcl_sim.loop.tape import lower
from fcl_sim.loop.wiring import wire
from fcl_sim.plant.catalog import load

SCAN = 0.01
COLUMNS = 13
LAG = (1.0, 3.0, 4.0, 12.0)
CRANE = (15_000.0, 20_000.0, 10.0, 9.81, 200.0, 1000.0)


def fixed_loop(plant: str, scans: int, steps: int) -> Diagram:
    """Return the crane's block of 6 rules on a plant of this folder, so many steps of Runge-Kutta a scan."""
    units = {"distance": "m", "angle": "deg", "power": "kW"}
    inputs = {name: Wire(f"plant.{name}") for name in ("distance", "angle")}
    nodes = (FuzzyNode(name="rules", block=crane(with_areas=False), inputs=inputs, units=units),)
    model = load(Path(__file__).parent / f"{plant}.py")
    node = PlantNode(name="plant", model=model, inputs={"power": Wire("rules.power")})
    scan = round(SCAN * 1e9)
    return Diagram(
        plant=node,
        nodes=nodes,
        timing=Timing(scan=scan, duration=scans * scan),
        integration=Integration(scheme="rk4", step=SCAN / steps),
    )


def measure_fixed() -> Iterator[Line]:
    """Yield a line for a lag with one step a scan, and one for a crane with ten: ours, C, the ratio."""
    library = compiled("block.c")
    p, of_crane = np.array(LAG), np.array(CRANE)
    scan = ctypes.c_double(SCAN)

    def lag(scans: int, record: object) -> None:
        x = np.zeros(2)
        library.lag_loop(pointer(p), pointer(x), ctypes.c_long(scans), scan, record)

    def plain_crane(scans: int, record: object) -> None:
        x, steps = np.array([-25.0, 0.0, 0.0, 0.0]), ctypes.c_long(10)
        library.plain_crane_loop(pointer(of_crane), pointer(x), ctypes.c_long(scans), scan, steps, record)

    yield _compared("lag plant, one step a scan", "lag_plant", 100_000, 1, lag)
    yield _compared(
        "plain crane, 60 s, ten steps of 1 ms a scan", "plain_crane_plant", 6_000, 10, plain_crane
    )


def _compared(title: str, plant: str, scans: int, steps: int, theirs: Callable[[int, object], None]) -> Line:
    """Return a line: ours, C, the ratio; the two must agree."""
    tape = lower(wire(fixed_loop(plant, scans, steps)))
    record = np.zeros((scans + 1, COLUMNS))
    ours, other = in_turns(lambda: run_tape(tape), lambda: theirs(scans, pointer(record)), rounds=21)
    off = np.abs(run_tape(tape)["plant.distance"] - record[:, 0]).max()
    return Line(
        title,
        f"{1e9 * ours / scans:.0f} ns a scan, C {1e9 * other / scans:.0f} ns, "
        f"{ours / other:.2f} times C (distances differ by at most {off:.1g} m)",
        ours / other,
    )

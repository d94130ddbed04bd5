"""60 s of the container crane in closed loop, against the same algorithm in C."""

import ctypes
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from benchmarks.yardstick import Line, compiled, in_turns, pointer
from fcl_sim.loop.diagram import Diagram, Node, Wire
from fcl_sim.loop.run import run_tape
from fcl_sim.loop.tape import Tape, lower
from fcl_sim.loop.wiring import wire
from fcl_sim.plant.catalog import shipped_bench
from fcl_sim.scenario.binder import bind
from fcl_sim.scenario.reader import read
from fcl_sim.units import parse_quantity

PARAMETERS = (15_000.0, 20_000.0, 10.0, 9.81, 2.5, 1.0, 0.1, 0.005, 200.0, 0.005, 0.12, 5e4)
"""The crane's, in the order of crane_loop.c."""
COLUMNS = 38
SENSORS = {"distance": ("m", 0.002, 0.005), "angle": ("deg", 0.02, 0.05)}
"""Standard deviation of the noise and step of the quantiser, by the signal of the crane."""
LATENCY = 0.003


class Disturbance(ctypes.Structure):
    """The struct of crane_loop.c."""

    _fields_ = (
        ("distance_noise", ctypes.POINTER(ctypes.c_double)),
        ("angle_noise", ctypes.POINTER(ctypes.c_double)),
        ("distance_step", ctypes.c_double),
        ("angle_step", ctypes.c_double),
        ("latency", ctypes.c_double),
    )


def crane(scan: str) -> Diagram:
    """Return the loop of the shipped crane at another scan time, in LREAL as C's double is."""
    overrides = {"controller.scan": scan, "controller.blocks.rules.arithmetic": "LREAL"}
    return bind(read(shipped_bench() / "scenarios" / "crane" / "transfer.toml", overrides))


def disturbed(diagram: Diagram) -> Diagram:
    """Return the loop with noise and quantisation on both sensors, and a latency of 3 ms."""
    nodes: list[Node] = []
    seen = {}
    for name, (unit, sigma, step) in SENSORS.items():
        noise, sensed, read = (f"{what}_{name}" for what in ("noise", "sensed", "read"))
        gains = {f"crane.{name}": parse_quantity(1.0), noise: parse_quantity(1.0)}
        inputs = {source: Wire(source) for source in gains}
        sigmas = {"sigma": parse_quantity(f"{sigma} {unit}")}
        steps = {"step": parse_quantity(f"{step} {unit}")}
        nodes += [
            Node(name=noise, type="noise", inputs={}, parameters=sigmas),
            Node(name=sensed, type="sum", inputs=inputs, parameters=gains),
            Node(name=read, type="quantiser", inputs={"input": Wire(sensed)}, parameters=steps),
        ]
        seen[f"controller.{name}"] = Wire(read)
    return replace(
        diagram,
        nodes=(*nodes, *diagram.nodes),
        aliases={**diagram.aliases, **seen},
        timing=replace(diagram.timing, latency=round(LATENCY * 1e9)),
    )


def measure_loop() -> Iterator[Line]:
    """Yield a line for each scan time, and one with disturbances: ours, C, the ratio; the two must agree."""
    library = compiled("crane_loop.c")
    for milliseconds in (10, 50):
        title = f"crane, 60 s, {milliseconds} ms scan"
        tape = lower(wire(crane(f"{milliseconds} ms")))
        yield _compared(title, tape, library.crane_loop, milliseconds, COLUMNS)
    tape = lower(wire(disturbed(crane("10 ms"))))
    run = run_tape(tape)
    samples = [np.ascontiguousarray(run[f"noise_{name}"]) for name in SENSORS]
    by = Disturbance(
        *(pointer(each) for each in samples), *(step for _, _, step in SENSORS.values()), LATENCY
    )
    title = "the same at 10 ms, with noise, quantisation and latency"
    yield _compared(title, tape, library.crane_loop_disturbed, 10, COLUMNS + 6, ctypes.byref(by))


def _compared(
    title: str, tape: Tape, theirs: Callable[..., object], milliseconds: int, columns: int, *further: object
) -> Line:
    scans = 60_000 // milliseconds
    record = np.zeros((scans + 1, columns))
    p = np.array(PARAMETERS)

    def in_c() -> None:
        x = np.array([-25.0, 0.0, 0.0, 0.0, 0.0])
        theirs(
            pointer(p),
            pointer(x),
            ctypes.c_long(scans),
            ctypes.c_double(milliseconds / 1000),
            ctypes.c_double(1e-8),
            pointer(record),
            *further,
        )

    ours, other = in_turns(lambda: run_tape(tape), in_c)
    off = np.abs(run_tape(tape)["crane.position"] - record[:, 3]).max()
    ratio = ours / other
    return Line(
        title,
        f"{1e3 * ours:.2f} ms, C {1e3 * other:.2f} ms, "
        f"{ratio:.2f} times C (positions differ by at most {off:.1g} m)",
        ratio,
    )

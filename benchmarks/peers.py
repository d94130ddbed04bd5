"""The crane called from Python, here and in other libraries: time per call, and distance from the truth.

The others live in an environment of their own below build/, made when it is
missing. They run in a process of their own that takes turns with ours; every
round has new points, since scikit-fuzzy remembers those that it has seen. Some
rule fires at each of them: scikit-fuzzy has no DEFAULT. The truth is that of
the tests' rational oracle.
"""

import json
import subprocess
import sys
import venv
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median
from time import process_time
from typing import IO

import numpy as np
from numpy.typing import NDArray

from benchmarks.block import crane
from fcl_sim.block import Block
from tests import oracle

PEERS = {"scikit-fuzzy": "0.5.0", "pyfuzzylite": "8.0.6", "simpful": "2.12.0"}
BESIDES = ("numpy==1.26.4", "scipy==1.17.1", "networkx==3.6.1", "packaging==26.3")
"""What they need: scikit-fuzzy imports the last two, and does not say so."""
FOLDER = Path(__file__).parents[1] / "build" / "peers"

ROUNDS, POINTS = 9, 100
Points = NDArray[np.float64]


@dataclass(frozen=True)
class Peer:
    """A process that answers for the libraries."""

    requests: IO[str]
    answers: IO[str]

    def measure(self, name: str, points: Points, *, areas: bool) -> tuple[float, list[float]]:
        """Return the seconds that the points took, and what came out."""
        request = {"peer": name, "areas": areas, "points": points.tolist()}
        print(json.dumps(request), file=self.requests, flush=True)
        answer = json.loads(self.answers.readline())
        return answer["seconds"], answer["values"]


@dataclass
class Tally:
    """Seconds per call of each round, and the largest error in kW."""

    times: list[float] = field(default_factory=list)
    error: float = 0.0

    def add(self, seconds: float, values: list[float], exact: list[float]) -> None:
        """Count a round."""
        self.times.append(seconds / len(exact))
        apart = [abs(value - truth) for value, truth in zip(values, exact, strict=True)]
        self.error = max(self.error, *apart)


def measure_peers() -> Iterator[str]:
    """Yield a line for each library and each crane; one line where they cannot be installed."""
    python, reason = _environment()
    if python is None:
        yield f"other Python libraries: not measured, {reason}"
        return
    worker = Path(__file__).with_name("peer_worker.py")
    with subprocess.Popen(
        [python, worker], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdin is not None  # noqa: S101  as Popen was asked for pipes
        assert process.stdout is not None  # noqa: S101
        peer = Peer(process.stdin, process.stdout)
        for areas in (False, True):
            yield from _measured(peer, areas=areas)
        process.stdin.close()


def _measured(peer: Peer, *, areas: bool) -> Iterator[str]:
    title = "crane, exact CoG" if areas else "crane, CoGS"
    block = crane(with_areas=areas)
    names = [name for name in PEERS if areas or name != "scikit-fuzzy"]
    ours, theirs = Tally(), {name: Tally() for name in names}
    random = np.random.default_rng(3)
    for number in range(ROUNDS + 1):
        points = _points(block, random)
        exact = [_exact(block, *point) for point in points.tolist()]
        rounds = [(ours, _ours(block, points))]
        rounds += [(theirs[name], peer.measure(name, points, areas=areas)) for name in names]
        for tally, (seconds, values) in rounds:
            if number > 0:  # the first warms up
                tally.add(seconds, values, exact)
    time = median(ours.times)
    yield f"{title}, ours: {_shown(time)}, off by {ours.error:.1g} kW at most"
    for name, tally in theirs.items():
        theirs_time = median(tally.times)
        yield (
            f"{title}, {name} {PEERS[name]}: {_shown(theirs_time)}, {theirs_time / time:.0f} times ours, "
            f"off by {tally.error:.1g} kW at most"
        )
    if not areas:
        yield f"{title}, scikit-fuzzy: has no singletons"


def _ours(block: Block, points: Points) -> tuple[float, list[float]]:
    instance, values = block.instance(), []
    inputs = points.tolist() * 10  # or the clock is too coarse
    begin = process_time()
    for distance, angle in inputs:
        instance(distance=distance, angle=angle)
        values.append(instance.power)
    seconds = (process_time() - begin) / 10
    return seconds, values[: len(points)]


def _points(block: Block, random: np.random.Generator) -> Points:
    """Return points, (POINTS, 2), at which some rule fires."""
    drawn = random.uniform((-4.0, -20.0), (28.0, 20.0), (20 * POINTS, 2))
    found = block.evaluation({"distance": drawn[:, 0], "angle": drawn[:, 1]})
    chosen: Points = drawn[found.active["power"]][:POINTS]
    return chosen


def _exact(block: Block, distance: float, angle: float) -> float:
    opinion = oracle.evaluate(block.function_block, {"distance": distance, "angle": angle})
    return float(opinion.outputs["power"])


def _shown(seconds: float) -> str:
    return f"{1e6 * seconds:.2f} µs" if seconds < 1e-5 else f"{1e6 * seconds:.0f} µs"


def _environment() -> tuple[Path | None, str]:
    """Return the interpreter that has the libraries, or None and the reason."""
    wanted = [*(f"{name}=={version}" for name, version in PEERS.items()), *BESIDES]
    stamp = FOLDER / "installed"
    python = FOLDER / ("Scripts" if sys.platform == "win32" else "bin") / "python"
    if stamp.exists() and stamp.read_text("utf-8").split() == wanted:
        return python, ""
    print("Installing other Python libraries to build/peers ...", file=sys.stderr)
    command = [str(python), "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *wanted]
    try:
        venv.create(FOLDER, clear=True, with_pip=True)
        subprocess.run(command, capture_output=True, check=True)
    except subprocess.CalledProcessError:
        return None, "for pip could not install them (is its package index in reach?)"
    stamp.write_text("\n".join(wanted), "utf-8")
    return python, ""

"""`NUMBA_DISABLE_JIT=1 python -m tests.loop.python_mode WHAT FILE`: what plain Python has to tell, as a file.

`traces` writes to an NPZ the values of every run of the shipped scenarios,
shortened, and of a loop with every block; `counts` to a JSON how often each
block of that loop was executed.
"""

import json
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import replace
from importlib import import_module
from inspect import getmodule
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from fcl_sim.loop import execute
from fcl_sim.loop.blocks import BLOCKS, FAMILIES, fuzzy
from fcl_sim.loop.blocks.setting import Text
from fcl_sim.loop.diagram import Diagram, Node
from fcl_sim.loop.run import run
from fcl_sim.loop.trace import Trace
from fcl_sim.plant.catalog import shipped_bench
from fcl_sim.scenario.bench import scenarios_below
from fcl_sim.scenario.reader import read
from fcl_sim.testbench import prepare
from tests.loop.block_bench import diagram
from tests.loop.diagrams import constant

COUNTER = "def step(inputs, state, t):\n    state['n'] = state.get('n', 0) + 1\n    return state['n']\n"

SECONDS = "2 s"


def traces(folder: Path) -> Iterator[tuple[str, Trace]]:
    """Yield the trace of each variant of each shipped scenario, shortened, and of every block."""
    yield "every block", run(every_block(folder))
    for path in scenarios_below(shipped_bench()):
        for each in prepare(read(path, {"duration": SECONDS, "vary": False})):
            yield f"{path.stem}/{each.variant}", run(each.diagram)


def every_block(folder: Path) -> Diagram:
    """Return a loop of every case of the references, a fuzzy block, and a counter in Python."""
    files = sorted((Path(__file__).parent / "references").glob("*.py"))
    cases = [case for file in files for case in import_module(f"tests.loop.references.{file.stem}").CASES]
    nodes = [replace(case.node(), name=f"block_{number}") for number, case in enumerate(cases)]
    own = {"file": Text("own.py", COUNTER), "outputs": {"n": "1"}}
    own_node = Node(name="own", type="python", parameters=own)
    return diagram(folder, *nodes, constant("rules", 1.0, "signals.ratio", {}), own_node)


def counted(loop: Diagram) -> dict[str, Any]:
    """Return how often each block was executed, those in Python by what they gave at last."""
    found: Counter[str] = Counter()

    def counting(kernel: Callable[..., None], which: Callable[..., str]) -> Callable[..., None]:
        def counts(*arguments: Any) -> None:
            found[which(*arguments)] += 1
            kernel(*arguments)

        return counts

    kernels = {kind.kernel for kind in BLOCKS.values() if kind.kernel is not None}
    for module in (execute, *(getmodule(family.execute) for family in FAMILIES if family.execute)):
        for name, each in list(vars(module).items()):
            if callable(each) and each in kernels:
                setattr(module, name, counting(each, lambda row: f"row {row.at}"))
    for name in ("infer", "infer_jointly"):
        setattr(fuzzy, name, counting(getattr(fuzzy, name), lambda *arguments: f"instance {arguments[-1]}"))
    trace = run(loop)
    own = next(name for name in trace.names if name.partition(".")[0] == "own")
    found["own"] = int(trace[own][-1])
    return {"scans": trace.ticks.size, "blocks": len(loop.nodes), "counts": found}


def main(what: str, file: Path) -> None:
    """Write the file."""
    with TemporaryDirectory() as folder:
        if what == "traces":
            np.savez(file, **{name: trace.values for name, trace in traces(Path(folder))})
        else:
            file.write_text(json.dumps(counted(every_block(Path(folder)))), "utf-8")


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]))

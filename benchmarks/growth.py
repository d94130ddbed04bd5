"""Time per evaluation against the number of rules that fire, and memory over many calls."""

import sys
import tracemalloc
from collections.abc import Iterator

import numpy as np

from benchmarks.block import chain, crane
from benchmarks.yardstick import in_turns
from fcl_sim.block import Block, loads

SIZES = ((2, 5), (10, 10), (25, 40), (100, 100))
"""Numbers of terms of the two inputs; every pair is a rule."""
CALLS = 1_000_000


def table(rows: int, columns: int) -> Block:
    """Return a table of rows × columns rules, all of which fire while both inputs lie within ±1."""

    def terms(count: int) -> str:
        return "\n".join(f"TERM t{i} := ({-2 - i}, 0) (0, 1) ({3 + 2 * i}, 0);" for i in range(count))

    rules = "\n".join(
        f"RULE {columns * i + j + 1}: IF a IS t{i} AND b IS t{j} THEN y IS s{(i + 3 * j) % 7};"
        for i in range(rows)
        for j in range(columns)
    )
    singletons = "\n".join(f"TERM s{k} := {k};" for k in range(7))
    return loads(
        "FUNCTION_BLOCK table\nVAR_INPUT a: LREAL; b: LREAL; END_VAR\nVAR_OUTPUT y: LREAL; END_VAR\n"
        f"FUZZIFY a\n{terms(rows)}\nEND_FUZZIFY\nFUZZIFY b\n{terms(columns)}\nEND_FUZZIFY\n"
        f"DEFUZZIFY y\n{singletons}\nMETHOD: CoGS;\nDEFAULT := 0;\nEND_DEFUZZIFY\n"
        f"RULEBLOCK r\nAND: MIN;\nACCU: MAX;\n{rules}\nEND_RULEBLOCK\nEND_FUNCTION_BLOCK\n"
    )


def measure_growth() -> Iterator[str]:
    """Yield a line for each number of rules, one for the slope, one for memory."""
    times = []
    for rows, columns in SIZES:
        count = rows * columns
        times.append(_seconds(table(rows, columns), max(20, 200_000 // count)))
        yield f"{count} rules, all fire: {1e9 * times[-1]:.0f} ns, {1e9 * times[-1] / count:.2f} ns a rule"
    sizes = [rows * columns for rows, columns in SIZES]
    exponent = np.log(times[-1] / times[1]) / np.log(sizes[-1] / sizes[1])
    yield f"from {sizes[1]} to {sizes[-1]} rules: time grows as their number to the power of {exponent:.2f}"
    yield _memory()


def _seconds(block: Block, points: int) -> float:
    """Return the median seconds of one evaluation."""
    random = np.random.default_rng(2)
    a, b = random.uniform(-1.0, 1.0, (2, points))
    program = block.program
    memory = program.initial.copy()
    ours, _ = in_turns(lambda: chain(program.ints, program.floats, memory, a, b), lambda: None, rounds=11)
    fired = memory[program.degrees_at : program.degrees_at + len(program.rule_labels)]
    if not np.all(fired > 0.0):
        sys.exit("the benchmark of growth wants every rule to fire")
    return ours / points


def _memory() -> str:
    """Return a line: what is left allocated after many calls, once the first have been made."""
    instance = crane(with_areas=True).instance()
    angles = np.linspace(-20.0, 20.0, 1000).tolist()

    def calls(rounds: int) -> int:
        for _ in range(rounds):
            for angle in angles:
                instance(distance=12.0, angle=angle)
        return tracemalloc.get_traced_memory()[0]

    tracemalloc.start()
    try:
        before = calls(10)
        growth = calls(CALLS // len(angles)) - before
    finally:
        tracemalloc.stop()
    return f"memory over {CALLS:,} calls of the crane, exact CoG: grows by {growth} bytes"

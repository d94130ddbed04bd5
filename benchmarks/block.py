"""One evaluation of a fuzzy block, against hand-written C: in a loop, over arrays, and called from Python."""

import ctypes
import timeit
from collections.abc import Iterator
from dataclasses import dataclass
from os import cpu_count
from statistics import median
from time import perf_counter, process_time, thread_time

import numpy as np
from numpy import float64, int64
from numpy.typing import NDArray

from benchmarks.yardstick import Line, compiled, in_turns, pointer
from fcl_sim.block import Block, loads
from fcl_sim.engine.infer import infer
from fcl_sim.engine.joint import infer_jointly
from fcl_sim.jit import F, I, entry, f8, signature

Values = NDArray[float64]

CRANE = """
FUNCTION_BLOCK crane
VAR_INPUT distance: LREAL; angle: LREAL; END_VAR
VAR_OUTPUT power: LREAL; END_VAR
FUZZIFY distance
    TERM zero := (-5, 0) (0, 1) (5, 0);
    TERM close := (0, 0) (5, 1) (10, 0);
    TERM medium := (5, 0) (10, 1) (22, 0);
    TERM far := (10, 0) (22, 1);
END_FUZZIFY
FUZZIFY angle
    TERM neg_big := (-50, 1) (-5, 0);
    TERM neg_small := (-50, 0) (-5, 1) (0, 0);
    TERM zero := (-5, 0) (0, 1) (5, 0);
    TERM pos_small := (0, 0) (5, 1) (50, 0);
    TERM pos_big := (5, 0) (50, 1);
END_FUZZIFY
DEFUZZIFY power
    {terms}
    DEFAULT := 0;
END_DEFUZZIFY
RULEBLOCK rules
    AND: MIN; ACT: MIN; ACCU: MAX;
    RULE 1: IF distance IS far AND angle IS zero THEN power IS pos_medium;
    RULE 2: IF distance IS far AND angle IS neg_small THEN power IS pos_high;
    RULE 3: IF distance IS far AND angle IS neg_big THEN power IS pos_medium;
    RULE 4: IF distance IS medium AND angle IS neg_small THEN power IS neg_medium;
    RULE 5: IF distance IS close AND angle IS pos_small THEN power IS pos_medium;
    RULE 6: IF distance IS zero AND angle IS zero THEN power IS zero;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""
PLACES = {"neg_high": -27, "neg_medium": -9, "zero": 0, "pos_medium": 9, "pos_high": 27}


def crane(*, with_areas: bool) -> Block:
    """Return the crane of Annex C with its singletons, or with triangles around them."""
    lines = [f"TERM {name} := {place};" for name, place in PLACES.items()] + ["METHOD: CoGS;"]
    if with_areas:
        lines = [
            f"TERM {name} := ({place - 18}, 0) ({place}, 1) ({place + 18}, 0);"
            for name, place in PLACES.items()
        ]
        lines += ["METHOD: CoG;", "RANGE := (-36 .. 36);"]
    return loads(CRANE.format(terms="\n    ".join(lines)))


def table(size: int = 7, *, places: int = 7) -> Block:
    """Return a table of size² rules: triangles around whole numbers for both inputs, singletons for y."""
    half = size // 2
    terms = []
    for i in range(size):
        left = [f"({i - half - 1}, 0)"] if i > 0 else []
        right = [f"({i - half + 1}, 0)"] if i < size - 1 else []
        terms.append(f"TERM t{i} := {' '.join([*left, f'({i - half}, 1)', *right])};")
    rules = [
        f"RULE {size * i + j + 1}: IF a IS t{i} AND b IS t{j} THEN y IS "
        f"s{min(places - 1, max(0, i + j - (size - 1) + places // 2))};"
        for i in range(size)
        for j in range(size)
    ]
    fuzzify = "\n".join(f"FUZZIFY {name}\n{chr(10).join(terms)}\nEND_FUZZIFY" for name in ("a", "b"))
    singletons = "\n".join(f"TERM s{k} := {k - places // 2};" for k in range(places))
    return loads(
        "FUNCTION_BLOCK table\nVAR_INPUT a: LREAL; b: LREAL; END_VAR\nVAR_OUTPUT y: LREAL; END_VAR\n"
        f"{fuzzify}\nDEFUZZIFY y\n{singletons}\nMETHOD: CoGS;\nDEFAULT := 0;\nEND_DEFUZZIFY\n"
        f"RULEBLOCK r\nAND: MIN;\nACCU: MAX;\n{chr(10).join(rules)}\nEND_RULEBLOCK\nEND_FUNCTION_BLOCK\n"
    )


@entry(signature(f8, I, F, F, F, F))
def chain(ints: NDArray[int64], floats: Values, memory: Values, a: Values, b: Values) -> float:
    """Evaluate a block of two inputs and one output over and over, each result going into the next inputs."""
    y = 0.0
    for i in range(a.size):
        memory[0] = a[i] + 1e-12 * y
        memory[1] = b[i] - 1e-12 * y
        infer(ints, floats, 0, memory, 0)
        y = memory[2]
    return y


@entry(signature(f8, I, F, F, F, F))
def chain_jointly(ints: NDArray[int64], floats: Values, memory: Values, a: Values, b: Values) -> float:
    """Do what `chain` does, with a program that has a table of joint cells."""
    y = 0.0
    for i in range(a.size):
        memory[0] = a[i] + 1e-12 * y
        memory[1] = b[i] - 1e-12 * y
        infer_jointly(ints, floats, 0, memory, 0)
        y = memory[2]
    return y


CHAINS = {"plain": chain, "joint": chain_jointly}
"""By the form of a program."""


@dataclass(frozen=True)
class Case:
    """A block, what its C twin is called, and the ranges of its inputs."""

    title: str
    block: Block
    twin: str
    ranges: tuple[tuple[float, float], tuple[float, float]]


def cases() -> tuple[Case, ...]:
    """Return the blocks that are measured."""
    reach = ((-8.0, 30.0), (-20.0, 20.0))
    return (
        Case("crane, CoGS", crane(with_areas=False), "cogs", reach),
        Case("crane, exact CoG", crane(with_areas=True), "cog", reach),
        Case("49 rules, CoGS", table(), "table", ((-4.0, 4.0), (-4.0, 4.0))),
    )


def measure_block() -> Iterator[Line | str]:
    """Yield lines for each block: in a loop, over an array, from Python."""
    library = compiled("block.c")
    for case in cases():
        yield from _measured(case, library)
    yield from _growth()


def _measured(case: Case, library: ctypes.CDLL) -> Iterator[Line | str]:
    random = np.random.default_rng(1)
    n = 200_000
    path = tuple(_swept(limits, n, turns) for limits, turns in zip(case.ranges, (35, 414), strict=True))
    yield _chained(f"{case.title}, in a loop", case, library, path)
    a, b = (random.uniform(*limits, n) for limits in case.ranges)
    yield _chained(f"{case.title}, in a loop at random points", case, library, (a, b))
    pointers = (pointer(a), pointer(b))
    names = case.block.inputs
    values = dict(zip(names, (a, b), strict=True))
    results = np.empty(n)
    batch = getattr(library, f"{case.twin}_batch")
    for clock, what in ((process_time, "processor time"), (perf_counter, f"{cpu_count()} processors")):
        ours, theirs = in_turns(
            lambda: case.block.evaluate(values),
            lambda: batch(*pointers, pointer(results), ctypes.c_size_t(n)),
            rounds=11,
            clock=clock,
        )
        yield _line(f"{case.title}, over arrays ({what})", ours / n, theirs / n)
    (outputs,) = case.block.evaluate(values).values()
    yield f"{case.title}: results differ by at most {np.abs(outputs - results).max():.1g}"
    written = f"instance({names[0]}=12.0, {names[1]}=4.0)"
    call = timeit.Timer(written, timer=thread_time, globals={"instance": case.block.instance()})
    times = [call.timeit(10_000) / 10_000 for _ in range(11)]
    yield f"{case.title}, called from Python: {1e6 * median(times):.2f} µs"


def _swept(limits: tuple[float, float], n: int, turns: int) -> Values:
    """Return n numbers that swing to and fro between limits, as slowly as the signals of a loop do."""
    low, high = limits
    swing: Values = low + (high - low) * (0.5 + 0.5 * np.sin(np.linspace(0.0, 2.0 * np.pi * turns, n)))
    return swing


def _chained(title: str, case: Case, library: ctypes.CDLL, inputs: tuple[Values, Values]) -> Line:
    """Return a line on dependent evaluations: each waits for the one before."""
    a, b = inputs
    twin = getattr(library, f"{case.twin}_chain")
    twin.restype = ctypes.c_double
    program = case.block.program
    memory = program.initial.copy()
    ours, theirs = in_turns(
        lambda: CHAINS[program.form](program.ints, program.floats, memory, a, b),
        lambda: twin(pointer(a), pointer(b), ctypes.c_size_t(a.size)),
        rounds=11,
    )
    return _line(title, ours / a.size, theirs / a.size)


def _growth() -> Iterator[str]:
    """Yield a line for each size of a table of which at most four rules can fire at a time."""
    for size in (3, 10, 32, 100):
        block = table(size)
        random = np.random.default_rng(2)
        a, b = (random.uniform(-size / 2, size / 2, 50_000) for _ in range(2))
        program = block.program
        memory = program.initial.copy()
        ours, _ = in_turns(
            lambda program=program, memory=memory, a=a, b=b: CHAINS[program.form](
                program.ints, program.floats, memory, a, b
            ),
            lambda: None,
            rounds=11,
        )
        yield f"{size * size} rules of which four can fire, in a loop: {1e9 * ours / a.size:.0f} ns"


def _line(title: str, ours: float, theirs: float) -> Line:
    ratio = ours / theirs
    return Line(title, f"{1e9 * ours:.1f} ns, C {1e9 * theirs:.1f} ns, {ratio:.2f} times C", ratio)

"""Each block against its equation, alone; the table walked, so that none is forgotten."""

import inspect
import re
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim import concept
from fcl_sim.loop import execute as dispatch
from fcl_sim.loop import layout
from fcl_sim.loop.blocks import BLOCKS, CODES, FAMILIES, OPCODES
from fcl_sim.loop.blocks.declaration import KINDS
from fcl_sim.loop.row import Row
from fcl_sim.loop.run import run
from tests.loop.block_bench import Alone, diagram
from tests.loop.diagrams import crane, timing

numbers = st.floats(-1e6, 1e6)
CASES = [
    case
    for file in sorted((Path(__file__).parent / "references").glob("*.py"))
    for case in import_module(f"tests.loop.references.{file.stem}").CASES
]
IDS = [f"{case.block}-{number}" for number, case in enumerate(CASES)]
ELSEWHERE = {
    "fuzzy": "tests/engine, and the crane below",
    "python": "tests/loop/test_outside.py",
    **dict.fromkeys([*concept.BLOCKS, "from_int"], "tests/loop/test_concept_blocks.py"),
}


class Bench:
    """One row of a block with one output, by the signs and numbers that its kernel finds."""

    def __init__(self, name, signs, parameters=()):
        count = len(signs)
        block = BLOCKS[name]
        self.kernel = block.kernel
        self.ints = np.array(
            [OPCODES[name], layout.FIRST_INPUT + count, count, count + 1, 0, count, *range(count)],
            dtype=np.int64,
        )
        self.floats = np.array([*signs, *parameters], dtype=np.float64)
        self.memory = np.zeros(count + 1 + block.states)

    def step(self, *inputs, cycle=0.05):
        self.memory[: len(inputs)] = inputs
        self.kernel(Row(self.ints, self.floats, self.memory, 0, cycle, 0.0, 0))
        return self.memory[len(inputs)]


def source_of(kernel):
    return inspect.getsource(getattr(kernel, "py_func", kernel))


def test_every_block_of_the_tables_has_an_equation_and_a_branch_of_the_dispatch():
    for family in FAMILIES:
        source = source_of(family.execute or dispatch.execute)
        for code, block in enumerate(family.table):
            branch = re.search(rf"code == {code}:\n +(\w+)\(", source)
            if block.kernel is not None and block.name not in concept.BLOCKS:  # the library's go by its table
                assert branch[1] == block.kernel.__name__
            assert block.equation
            assert block.source
            assert block.summary
    assert BLOCKS["python"] is FAMILIES[0].table[dispatch.PYTHON_OPCODE]


def test_every_family_has_its_branch_and_its_numbers():
    source = source_of(dispatch.further_with)
    for number, family in enumerate(FAMILIES[1:], start=1):
        assert f"has_{family.name} and family == {number}:\n            {family.name}.execute(" in source
        assert f"{family.name}.{family.execute.__name__}" in source
        assert len(family.table) <= CODES
    assert len(FAMILIES) - 1 == dispatch.FAMILIES
    assert (1 << dispatch.FAMILY_SHIFT, dispatch.CODE_MASK) == (CODES, CODES - 1)
    assert len(BLOCKS) == sum(len(family.table) for family in FAMILIES)


def test_a_tape_has_compiled_what_its_families_need():
    opcodes = [OPCODES[name] for name in ("gain", "dead_band", "step", "ramp")]
    assert dispatch.further_for(opcodes) is dispatch.further_with(frozenset({2, 4}))
    assert dispatch.further_for(opcodes[:1]) is dispatch.further_with(frozenset())


def test_no_two_sets_of_families_are_compiled_under_one_name():
    """Their symbols are made of it, and two from the cache may have been compiled by different processes."""
    families = range(dispatch.FIRST_FAMILY, dispatch.FIRST_FAMILY + dispatch.FAMILIES)
    sets = [frozenset(), *(frozenset({a, b}) for a in families for b in families)]
    names = {dispatch.further_with(each).function.__qualname__ for each in sets}
    assert len(names) == len(set(sets))


def test_every_declaration_is_sound():
    for name, block in BLOCKS.items():
        keys = [each.name for each in (*block.inputs, *block.parameters)]
        keys += [block.group.name] if block.group else []
        assert len(set(keys)) == len(keys), name
        assert "type" not in keys
        for parameter in block.parameters:
            assert parameter.kind in KINDS
            assert bool(parameter.choices) == (parameter.kind == "choice")
            assert parameter.kind == "rows" or bool(parameter.columns) == (parameter.kind == "table")
            assert not parameter.port or parameter.kind == "quantity"
        if block.group:
            assert block.group.form in {"gains", "list", "named"}
            # names of the user's own must not meet those of the block
            assert block.group.form == "list" or not (block.inputs or block.ports)


def test_every_block_has_a_reference():
    assert {case.block for case in CASES} == set(BLOCKS) - set(ELSEWHERE)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("signals")


@pytest.mark.parametrize("case", CASES, ids=IDS)
def test_a_block_alone_gives_what_its_reference_gives(case, folder):
    loop = diagram(folder, case.node())
    alone, scans = Alone(loop), 250
    random = np.random.default_rng(1)
    raw = random.choice([-2.0, -0.5, 0.0, 0.0, 1.0, 3.0], (scans, len(case.inputs)))
    names = list(case.inputs.values())
    raw = raw[:, [names.index(name) for name in names]]  # ports that read one signal read the same
    times = [0.02 * n for n in range(scans)]
    given = np.array([alone.step(raw[n], 0.02, times[n], n) for n in range(scans)])
    signs = [-1.0 if name.startswith("-") else 1.0 for name in names]
    samples = {port: (signs[i] * raw[:, i]).tolist() for i, port in enumerate(case.inputs)}
    assert given == pytest.approx(
        case.expected(samples, times, 0.02), abs=case.tolerance, rel=0, nan_ok=False
    )


@pytest.mark.parametrize("case", CASES, ids=IDS)
def test_a_block_of_a_tape_gives_what_its_reference_gives(case, folder):
    trace = run(diagram(folder, case.node()))
    assert trace.fault is None
    outputs = [name for name in trace.names if name.partition(".")[0] == "block"]
    expected = case.expected(case.read(trace), trace.time.tolist(), 0.02)
    given = np.array([trace[name] for name in outputs]).T
    assert given == pytest.approx(expected, abs=case.tolerance, rel=0, nan_ok=False)


@given(st.lists(st.tuples(numbers, numbers), min_size=1, max_size=6))
def test_a_sum_adds_its_weighted_inputs(terms):
    gains, inputs = zip(*terms, strict=True)
    total = 0.0
    for gain, value in terms:
        total += gain * value
    assert Bench("sum", gains).step(*inputs) == total


@given(numbers, numbers, st.sampled_from([1.0, -1.0]))
def test_a_gain_multiplies(factor, value, sign):
    assert Bench("gain", [sign], [factor]).step(value) == factor * (sign * value)


@given(st.lists(numbers, min_size=2, max_size=20), st.floats(0.0, 10.0), st.floats(1e-3, 1.0))
def test_a_differentiator_follows_its_recursion_from_rest(values, lag, cycle):
    bench = Bench("differentiator", [1.0], [lag])
    y = 0.0
    for index, value in enumerate(values):
        if index:
            y = y + cycle / (lag + cycle) * ((value - values[index - 1]) / cycle - y)
        assert bench.step(value, cycle=cycle) == y


@given(st.floats(-100, 100), st.floats(-100, 100), st.floats(1e-3, 1.0))
def test_a_differentiator_without_a_filter_gives_the_slope_of_a_ramp(start, slope, cycle):
    bench = Bench("differentiator", [1.0], [0.0])
    outputs = [bench.step(start + slope * n * cycle, cycle=cycle) for n in range(10)]
    assert outputs[0] == 0.0
    assert outputs[1:] == pytest.approx([slope] * 9, abs=1e-9 / cycle)


def test_a_filtered_differentiator_settles_on_the_slope_of_a_ramp_with_its_time_constant():
    lag, cycle = 0.5, 0.001
    bench = Bench("differentiator", [1.0], [lag])
    outputs = np.array([bench.step(2.0 * n * cycle, cycle=cycle) for n in range(3001)])
    expected = 2.0 * (1 - np.exp(-np.arange(3001) * cycle / lag))
    assert np.abs(outputs - expected).max() <= 2.0 * cycle / lag


def test_the_blocks_of_a_tape_give_what_they_give_alone():
    trace = run(crane(timing=timing(50.0, 10.0)))
    speed = Bench("differentiator", [-1.0], [0.05])
    predicted = Bench("sum", [1.0, -6.0])
    for n in range(trace.time.size):
        rate = speed.step(trace["crane.distance"][n], cycle=0.05)
        assert trace["controller.speed"][n] == rate
        assert trace["controller.predicted"][n] == predicted.step(trace["crane.distance"][n], rate)

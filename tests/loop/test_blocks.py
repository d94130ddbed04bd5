"""Each block against its equation, alone; the table walked, so that none is forgotten."""

import inspect

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fcl_sim.loop import execute as dispatch
from fcl_sim.loop import layout
from fcl_sim.loop.blocks import BLOCKS, TABLE, differentiator, fuzzy, linear
from fcl_sim.loop.run import run
from tests.loop.diagrams import crane, timing

KERNELS = {
    "sum": linear.weighted_sum,
    "gain": linear.gain,
    "differentiator": differentiator.differentiate,
    "fuzzy": fuzzy.evaluate,
}
numbers = st.floats(-1e6, 1e6)


class Bench:
    """One block row over hand-made buffers: inputs at slots 0.., the output behind them, then its states."""

    def __init__(self, name, signs, parameters=()):
        count = len(signs)
        block = BLOCKS[name]
        self.kernel = KERNELS[name]
        self.ints = np.array(
            [TABLE.index(block), layout.FIRST_INPUT + count, count, count + 1, 0, count, *range(count)],
            dtype=np.int64,
        )
        self.floats = np.array([*signs, *parameters], dtype=np.float64)
        self.memory = np.zeros(count + 1 + block.states)

    def step(self, *inputs, cycle=()):
        self.memory[: len(inputs)] = inputs
        self.kernel(self.ints, self.floats, self.memory, 0, *cycle)
        return self.memory[len(inputs)]


def test_every_block_of_the_table_has_a_kernel_an_equation_and_a_branch_of_the_dispatch():
    source = inspect.getsource(getattr(dispatch.execute, "py_func", dispatch.execute))
    assert set(KERNELS) == set(BLOCKS)
    for opcode, block in enumerate(TABLE):
        kernel = KERNELS[block.name]
        branch = source.split(f"opcode == {opcode}:")[1].split("elif")[0]
        assert getattr(kernel, "__name__", "") in branch
        assert block.equation
        assert block.source
        assert block.summary


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
        assert bench.step(value, cycle=(cycle,)) == y


@given(st.floats(-100, 100), st.floats(-100, 100), st.floats(1e-3, 1.0))
def test_a_differentiator_without_a_filter_gives_the_slope_of_a_ramp(start, slope, cycle):
    bench = Bench("differentiator", [1.0], [0.0])
    outputs = [bench.step(start + slope * n * cycle, cycle=(cycle,)) for n in range(10)]
    assert outputs[0] == 0.0
    assert outputs[1:] == pytest.approx([slope] * 9, abs=1e-9 / cycle)


def test_a_filtered_differentiator_settles_on_the_slope_of_a_ramp_with_its_time_constant():
    lag, cycle = 0.5, 0.001
    bench = Bench("differentiator", [1.0], [lag])
    outputs = np.array([bench.step(2.0 * n * cycle, cycle=(cycle,)) for n in range(3001)])
    expected = 2.0 * (1 - np.exp(-np.arange(3001) * cycle / lag))
    assert np.abs(outputs - expected).max() <= 2.0 * cycle / lag


def test_the_blocks_of_a_tape_give_what_they_give_alone():
    trace = run(crane(timing=timing(50.0, 10.0)))
    speed = Bench("differentiator", [-1.0], [0.05])
    predicted = Bench("sum", [1.0, -6.0])
    for n in range(trace.time.size):
        rate = speed.step(trace["crane.distance"][n], cycle=(0.05,))
        assert trace["controller.speed"][n] == rate
        assert trace["controller.predicted"][n] == predicted.step(trace["crane.distance"][n], rate)

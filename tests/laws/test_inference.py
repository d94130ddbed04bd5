"""Laws of the engine, on random rule bases."""

import os
import subprocess
import sys
from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

import fcl_sim.engine.infer as kernel
from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.evaluate import evaluate
from fcl_sim.engine.instance import Instance
from fcl_sim.model import Accumulation
from tests.engine.agreement import errors, infer
from tests.engine.random_bases import random_base, random_values
from tests.house.places import ROOT

SEEDS = st.integers(0, 2**32 - 1)
SIZES = st.sampled_from((0, 1, 2, 5, 12, 31, 32, 33, 70))


@settings(max_examples=400)
@given(SEEDS, SIZES)
def test_every_step_agrees_with_the_oracle(seed, rules):
    base = random_base(seed, rules)
    for what, error, bound in errors(base, [random_values(seed, base)]):
        assert error <= bound, what


@settings(max_examples=50)
@given(SEEDS, SIZES)
def test_a_call_and_an_array_give_the_same_bits(seed, rules):
    base = random_base(seed, rules)
    program = assemble(base)
    points = [random_values(seed + n, base) for n in range(5)]
    columns = {name: [point[name] for point in points] for name in program.input_names}
    together = evaluate(program, columns)
    for n, point in enumerate(points):
        instance = Instance(base, program)
        instance(**point)
        for name, value in instance.outputs.items():
            assert value.hex() == together.outputs[name][n].hex()
            assert instance.active[name] == together.active[name][n]


@settings(max_examples=50)
@given(SEEDS, SIZES)
def test_the_order_of_rules_changes_nothing_that_does_not_ask_for_it(seed, rules):
    base = random_base(seed, rules, chained=False)
    shuffle = np.random.default_rng(seed)
    shuffled = replace(
        base,
        rule_blocks=tuple(
            replace(each, rules=tuple(each.rules[place] for place in shuffle.permutation(len(each.rules))))
            for each in base.rule_blocks
        ),
    )
    values = random_values(seed, base)
    ours, theirs = (infer(assemble(each), values) for each in (base, shuffled))
    words = assemble(base).layout.accumulated.values()
    chosen = {each.accumulation for each in (*base.rule_blocks, *base.defuzzifications)} - {None}
    maximal = chosen == {Accumulation.MAX}
    for word in words:  # a sum is rounded as it comes, a maximum is not
        assert ours[word] == theirs[word] if maximal else abs(ours[word] - theirs[word]) <= 1e-14


@given(SEEDS)
def test_a_rule_with_weight_0_counts_for_nothing(seed):
    base = random_base(seed, 9, chained=False)
    idle = [
        replace(rule, conclusions=tuple(replace(each, weight=0.0) for each in rule.conclusions))
        for rule in base.rule_blocks[0].rules
    ]
    first, second = base.rule_blocks
    silenced = replace(base, rule_blocks=(replace(first, rules=tuple(idle)), second))
    without = replace(base, rule_blocks=(replace(first, rules=()), second))
    values = random_values(seed, base)
    ours, theirs = (evaluate(assemble(each), values) for each in (silenced, without))
    for name in ("y", "z"):
        assert ours.active[name] == theirs.active[name]
        if first.accumulation is second.accumulation:
            assert ours.outputs[name] == theirs.outputs[name]


@given(SEEDS, st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=7, max_size=7))
def test_a_finite_input_gives_a_finite_output(seed, numbers):
    base = random_base(seed, 20)
    program = assemble(base)
    memory = infer(program, dict(zip(program.input_names, numbers, strict=True)))
    assert np.isfinite(memory[: program.recorded]).all()
    assert (memory[program.degrees_at : program.recorded] <= 1.0).all()


def memories(evaluated=infer):
    """Return what many evaluations leave in the head of their memories, in hexadecimal."""
    lines = []
    for seed in range(60):
        base = random_base(seed, (3, 20, 40)[seed % 3])
        program = assemble(base)
        for n in range(4):
            memory = evaluated(program, random_values(seed + n, base))
            lines.append(memory[: program.recorded].tobytes().hex())
    return lines


def infer_placed(program, values):
    """Return the instance memory after one evaluation by the kernel itself, far inside shared buffers."""
    ints = np.concatenate([np.full(7, -9), program.placed(5)])
    floats = np.concatenate([np.full(5, np.nan), program.floats])
    memory = np.concatenate([np.full(3, np.nan), program.initial])
    for place, name in enumerate(program.input_names):
        memory[3 + place] = values[name]
    kernel.infer(ints, floats, 7, memory, 3)
    assert np.isnan(memory[:3]).all()
    return memory[3:]


UNCOMPILED = """
from tests.laws.test_inference import infer_placed, memories
print("\\n".join([*memories(), *memories(infer_placed)]))
"""


def test_compiled_or_not_and_wherever_placed_the_kernel_gives_the_same_bits():
    uncompiled = subprocess.run(
        [sys.executable, "-W", "error", "-c", UNCOMPILED],
        cwd=ROOT,
        env={**os.environ, "NUMBA_DISABLE_JIT": "1", "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert uncompiled.stderr == ""
    assert uncompiled.stdout.split() == 2 * memories()

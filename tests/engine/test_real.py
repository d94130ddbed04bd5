"""REAL: the same kernels in binary32 throughout, as a PLC computes (S36)."""

import os
import subprocess
import sys

import numpy as np
import pytest

from fcl_sim.arithmetic.pairs import conjunction
from fcl_sim.block import loads
from fcl_sim.diagnostics import InputFault
from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.narrow import narrowed
from fcl_sim.engine.precision import REAL
from fcl_sim.jit import F4, CompileError, compiled, entry, f8, flat, i8, signature
from tests.engine.agreement import errors, infer
from tests.engine.random_bases import random_base, random_values

SEEDS = range(0, 400, 5)

BATH = """
FUNCTION_BLOCK bath
VAR_INPUT temp: REAL; END_VAR
VAR_OUTPUT valve: REAL; END_VAR
FUZZIFY temp TERM cold := (0.1, 1) (0.7, 0); TERM warm := (0.1, 0) (0.7, 1); END_FUZZIFY
DEFUZZIFY valve TERM shut := 0.1; TERM open := 100.3; METHOD: CoGS; DEFAULT := 0.1; END_DEFUZZIFY
RULEBLOCK No1 RULE 1: IF temp IS cold THEN valve IS open; RULE 2: IF temp IS warm THEN valve IS shut WITH 0.3;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""


@pytest.mark.parametrize("seed", SEEDS)
def test_every_number_is_within_its_bound_of_the_exact_one(seed):
    base = random_base(seed, seed % 13)
    for what, error, bound in errors(base, [random_values(seed, base)], REAL):
        assert error <= bound, what


def digest(seeds):
    """Return the bits of everything that these evaluations leave in their memory."""
    bits = []
    for seed in seeds:
        base = narrowed(random_base(seed, seed % 13), REAL)
        program = assemble(base, REAL)
        bits.append(infer(program, random_values(seed, base)).tobytes().hex())
    return bits


@pytest.mark.skipif(not compiled(), reason="compares compiled with uncompiled")
def test_the_uncompiled_text_gives_the_same_bits():
    program = "import tests.engine.test_real as own; print(*own.digest(own.SEEDS), sep='\\n')"
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1"}
    run = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", program],
        capture_output=True,
        text=True,
        env=environment,
        check=True,
    )
    assert run.stdout.split("\n")[:-1] == digest(SEEDS)


@flat
def third(x):
    return x / 3.0


@flat
def counted(x, count):
    return third(x) * count


@entry(signature(f8, F4, i8))
def first_counted(values, count):
    return counted(values[0], count)


@pytest.mark.skipif(not compiled(), reason="a matter of compiling")
def test_a_kernel_that_meets_a_binary64_number_in_binary32_does_not_compile():
    assert third(np.float32(1.0)) == np.float32(1.0) / np.float32(3.0)
    assert counted(1.0, 3) == 1.0
    with pytest.raises(CompileError, match="binary64 in counted"):
        first_counted(np.ones(1, np.float32), 3)


def test_literals_take_the_precision_of_what_they_meet():
    degree, complement = conjunction(-8, np.float32(0.1), np.float32(0.9), np.float32(1.0), np.float32(0.0))
    assert np.float32(degree) == np.float32(0.1)
    assert np.float32(complement) == np.float32(0.9)


def test_breakpoints_and_constants_are_rounded_when_the_block_is_assembled():
    block = loads(BATH)
    program = block.program_in("REAL")
    assert program.floats.dtype == program.initial.dtype == np.float32
    for number in (0.1, 0.7, 0.3, 100.3):
        assert np.float32(number) in program.floats
    run = np.float32(float(np.float32(0.7)) - float(np.float32(0.1)))
    assert run in program.floats
    assert block.program.floats.dtype == np.float64


def test_an_instance_computes_and_answers_in_binary32():
    block = loads(BATH)
    real, long = block.instance(arithmetic="REAL"), block.instance()
    real(temp=0.45)
    long(temp=0.45)
    assert real.inputs["temp"] == float(np.float32(0.45))
    assert real.valve == float(np.float32(real.valve))
    assert real.valve != long.valve
    assert real.valve == pytest.approx(long.valve, rel=1e-6)
    assert block.evaluate({"temp": [0.45]}, arithmetic="REAL")["valve"] == [real.valve]
    assert block.evaluate({"temp": [0.45]})["valve"] == [long.valve]


def test_an_explanation_tells_the_numbers_of_binary32():
    explained = loads(BATH).instance(arithmetic="REAL").explain(temp=0.45)
    assert explained.defuzzified[0].places == (float(np.float32(0.1)), float(np.float32(100.3)))
    assert explained.activated[1].weight == float(np.float32(0.3))


def test_inputs_that_binary32_cannot_hold_are_refused_by_name():
    block = loads(BATH)
    instance = block.instance(arithmetic="REAL")
    instance(temp=0.5)
    before = instance.inputs, instance.outputs
    with pytest.raises(ValueError, match=r"temp is 1e\+39; REAL reaches to 3.40282e\+38"):
        instance(temp=1e39)
    with pytest.raises(ValueError, match="temp is nan"):
        instance(temp=float("nan"))
    assert before == (instance.inputs, instance.outputs)
    with pytest.raises(ValueError, match="temp has values beyond"):
        block.evaluate({"temp": [0.0, -1e39]}, arithmetic="REAL")


@pytest.mark.parametrize(
    ("old", "new"), [("100.3", "1.0E31"), ("(0.1, 1) (0.7, 0)", "(0.1, 0) (1.0E29, 1.0E-15)")]
)
def test_numbers_that_binary32_cannot_carry_are_refused(old, new):
    block = loads(BATH.replace(old, new))
    block.instance()
    with pytest.raises(InputFault, match="numbers of `bath` exceed what REAL can carry") as fault:
        block.instance(arithmetic="REAL")
    assert [each.code for each in fault.value.diagnostics] == ["FCL407"]


def test_a_default_that_is_no_number_is_none_in_binary32_either():
    gap = BATH.replace("(0.7, 0)", "(0.3, 0)").replace("(0.1, 0) (0.7, 1)", "(0.5, 0) (0.7, 1)")
    written = gap.replace("DEFAULT := 0.1", "DEFAULT := nan")
    instance = loads(written).instance("REAL")
    instance(temp=0.4)
    assert np.isnan(instance.valve)
    instance(temp=0.1)
    assert instance.valve == np.float32(100.3)

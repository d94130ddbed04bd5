"""The largest and smallest numbers, in rule bases and as inputs: numbers come out or a refusal, never NaN."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import fcl_sim
from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.narrow import narrowed
from fcl_sim.engine.precision import LREAL, REAL
from fcl_sim.model import Points, Singleton
from tests.engine.agreement import PREVIOUS, infer
from tests.engine.random_bases import random_base, random_values

SEEDS = st.integers(0, 2**32 - 1)
SIZES = st.sampled_from((1, 5, 12, 33))
SCALES = {
    LREAL: (5e-324, 1e-320, 1e-308, 1e-160, 1e-9, 1e150, 1e297),
    REAL: (1e-45, 1e-40, 1e-38, 1e-20, 1e9, 1e20, 1e26),
}
"""From numbers that hardly exist, where points fall together, to nearly the largest that are read."""


def scaled(base, factor):
    """Return `base` with all its abscissae, places and ranges times a factor."""

    def number(value):
        return value if isinstance(value, str) else value * factor

    def term(each):
        if isinstance(each.shape, Singleton):
            return replace(each, shape=Singleton(number(each.shape.value)))
        return replace(
            each, shape=Points(tuple(replace(point, x=number(point.x)) for point in each.shape.points))
        )

    def section(each, **more):
        return replace(each, terms=tuple(map(term, each.terms)), **more)

    return replace(
        base,
        fuzzifications=tuple(map(section, base.fuzzifications)),
        defuzzifications=tuple(
            section(
                each,
                range=tuple(map(number, each.range)) if each.range and factor > 1e-40 else each.range,
                default=None if each.default is None else number(each.default),
            )
            for each in base.defuzzifications
        ),
    )


def evaluated(program, values):
    """Return the head of the memory after two evaluations, the second from what the first has left."""
    memory = infer(program, values, PREVIOUS)
    kept = dict(zip(program.output_names, memory[program.outputs_at :].astype(float), strict=False))
    return infer(program, values, kept)[: program.recorded]


@pytest.mark.parametrize("precision", [LREAL, REAL], ids=lambda each: each.name)
@settings(max_examples=200)
@given(st.data(), SEEDS, SIZES)
def test_a_base_of_extreme_numbers_gives_finite_numbers(precision, data, seed, rules):
    factor = data.draw(st.sampled_from(SCALES[precision]))
    largest = float(precision.largest)
    base = scaled(random_base(seed, rules), factor)
    numbers = {
        name: min(largest, max(-largest, value * factor))
        for name, value in random_values(seed, random_base(seed, rules)).items()
    }
    beyond = st.floats(-largest, largest, width=32 if precision is REAL else 64)
    for name in data.draw(st.sets(st.sampled_from(sorted(numbers)))):
        numbers[name] = data.draw(beyond)
    program = assemble(narrowed(base, precision), precision)
    memory = evaluated(program, numbers)
    assert np.isfinite(memory).all()
    degrees = memory[program.degrees_at :]
    assert ((degrees >= 0.0) & (degrees <= 1.0)).all()


VALVE = """
FUNCTION_BLOCK valve
VAR_INPUT level: INT; flow: INT; END_VAR
VAR_OUTPUT open: INT; END_VAR
FUZZIFY level TERM low := (10, 1) (900, 0); TERM high := (10, 0) (900, 1); END_FUZZIFY
FUZZIFY flow TERM small := (0, 1) (5000, 0); TERM large := (0, 0) (5000, 1); END_FUZZIFY
DEFUZZIFY open TERM shut := 0; TERM wide := 10000; METHOD: CoGS; DEFAULT := 0; END_DEFUZZIFY
RULEBLOCK No1
    AND: PROD;
    RULE 1: IF level IS low AND flow IS small THEN open IS wide;
    RULE 2: IF level IS high THEN open IS shut WITH 0.5;
END_RULEBLOCK
END_FUNCTION_BLOCK
"""


@pytest.fixture(scope="module")
def valve():
    return fcl_sim.loads(VALVE)


@given(st.floats(), st.floats(), st.sampled_from(("truncate", "round")))
def test_in_int_any_number_gives_counts_or_an_error_by_name(valve, level, flow, rounding):
    instance = valve.instance(arithmetic="INT", rounding=rounding)
    instance(level=100, flow=100)
    before = instance.open
    told = None
    try:
        instance(level=level, flow=flow)
    except (ValueError, OverflowError) as error:
        told = str(error)
    if told is None:
        assert instance.open == int(instance.open)
        assert 0 <= instance.open <= 10000
    else:
        assert "level" in told or "flow" in told
        assert instance.open == before

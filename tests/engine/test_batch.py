"""Points that are evaluated together give, bit for bit, what each of them gives alone."""

from dataclasses import replace
from itertools import count, islice

import numpy as np
import pytest

from fcl_sim.engine import evaluate as evaluation
from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.batch import TOGETHER_AT_MOST
from fcl_sim.engine.entries import evaluate_once
from fcl_sim.engine.evaluate import evaluate
from fcl_sim.engine.precision import LREAL, REAL
from fcl_sim.engine.program import ALL_TOGETHER, ONE_BY_ONE, TOGETHER, UP_TO_RULES
from fcl_sim.engine.together import FEW_RULES
from fcl_sim.model import Accumulation, AndOperator, Conclusion, Hedge, Is, Method, Not, Or, Rule, Singleton
from tests.engine.bases import CRANE, output, points, rule, tabulated
from tests.engine.random_bases import random_base, random_values

SIZES = (0, 1, 3, 9, 20, 40)
WAYS = pytest.mark.parametrize("way", [ONE_BY_ONE, UP_TO_RULES, ALL_TOGETHER])


def with_singletons(base, seed):
    """Return `base` with constant singletons for all terms of its outputs, CoGS and accumulation by MAX."""
    random = np.random.default_rng(seed)
    outputs = tuple(
        replace(
            each,
            method=Method.COGS,
            range=None,
            accumulation=None,
            terms=tuple(replace(term, shape=Singleton(random.uniform(-100, 100))) for term in each.terms),
        )
        for each in base.defuzzifications
    )
    blocks = tuple(replace(each, accumulation=Accumulation.MAX) for each in base.rule_blocks)
    return replace(base, defuzzifications=outputs, rule_blocks=blocks)


def bases(way, number, precision):
    """Return seeds, random bases and programs of which the steps that `way` says are taken together."""

    def made():
        for seed in count():
            base = random_base(seed, SIZES[seed % len(SIZES)], chained=False)
            if way == ALL_TOGETHER:
                base = with_singletons(base, seed)
            program = assemble(base, precision)
            if program.ints[TOGETHER] == way:
                yield seed, base, program

    return islice(made(), number)


def alone(program, values, previous, point):
    """Return the outputs and flags of one evaluation, as bytes."""
    memory = program.initial.copy()
    given = {**values, **previous}
    for place, name in enumerate((*program.input_names, *program.output_names)):
        memory[place] = given[name][point]
    evaluate_once(program, memory)
    return memory[program.outputs_at : program.degrees_at].astype(np.float64).tobytes()


def together(program, values, previous):
    """Return for each point the outputs and flags of one evaluation over arrays, as bytes."""
    result = evaluate(program, values, previous)
    columns = [*result.outputs.values(), *result.active.values()]
    return [row.tobytes() for row in np.stack([column.astype(np.float64) for column in columns], axis=-1)]


def values_of(base, seed, size):
    rows = [random_values(size * seed + point, base) for point in range(size)]
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


@pytest.mark.parametrize("precision", [LREAL, REAL], ids=lambda each: each.name)
@WAYS
def test_each_point_of_many_gives_what_it_gives_alone(way, precision):
    for seed, base, program in bases(way, 12, precision):
        size = (1, 2, 9, 10)[seed % 4] if seed % 3 else TOGETHER_AT_MOST + 20
        values = values_of(base, seed, size)
        random = np.random.default_rng(seed)
        previous = {name: random.uniform(-5, 5, size) for name in program.output_names}
        expected = [alone(program, values, previous, point) for point in range(size)]
        assert together(program, values, previous) == expected, f"seed {seed}"


@pytest.mark.parametrize("default", [0.0, None])
def test_knots_and_what_lies_beyond_them_are_as_alone(default):
    program = assemble(
        replace(CRANE, defuzzifications=(replace(CRANE.defuzzifications[0], default=default),))
    )
    knots = np.array([-1e6, -50.0, -5.0, 0.0, 5.0, 10.0, 22.0, 50.0, 1e6])
    near = np.concatenate([knots, np.nextafter(knots, -np.inf), np.nextafter(knots, np.inf)])
    distance, angle = (each.ravel() for each in np.meshgrid(near, near))
    values, previous = {"distance": distance, "angle": angle}, {"power": np.linspace(-1, 1, distance.size)}
    expected = [alone(program, values, previous, point) for point in range(distance.size)]
    assert program.ints[TOGETHER] == ALL_TOGETHER
    assert together(program, values, previous) == expected


def test_threads_give_what_one_thread_gives(monkeypatch):
    program = assemble(CRANE)
    random = np.random.default_rng(3)
    values = {"distance": random.uniform(-8, 30, 2000), "angle": random.uniform(-20, 20, 2000)}
    one = evaluate(program, values)
    monkeypatch.setattr(evaluation, "FOR_A_THREAD", 300)
    monkeypatch.setattr(evaluation, "cpu_count", lambda: 5)
    many = evaluate(program, values)
    assert many.outputs["power"].tobytes() == one.outputs["power"].tobytes()
    assert many.active["power"].tolist() == one.active["power"].tolist()


def changed(**changes):
    """Return the crane with its one rule block changed."""
    return replace(CRANE, rule_blocks=(replace(CRANE.rule_blocks[0], **changes),))


def with_rule(condition):
    return changed(rules=(*CRANE.rule_blocks[0].rules, rule("7", condition, ("power", "zero"))))


HEDGED = Conclusion("power", "zero", hedges=(Hedge.VERY,))


def with_areas():
    terms = tuple(
        points(term.name, (term.shape.value - 9, 0), (term.shape.value, 1), (term.shape.value + 9, 0))
        for term in CRANE.defuzzifications[0].terms
    )
    return replace(CRANE, defuzzifications=(output("power", *terms, method=Method.COG),))


def tables(size):
    return tabulated({"a": tuple(map(float, range(size)))}, lambda a: a)


@pytest.mark.parametrize(
    ("base", "way"),
    [
        (CRANE, ALL_TOGETHER),
        (changed(and_operator=AndOperator.PROD), ALL_TOGETHER),
        (changed(accumulation=Accumulation.BSUM), UP_TO_RULES),
        (changed(accumulation=Accumulation.ASUM), ONE_BY_ONE),
        (with_areas(), UP_TO_RULES),
        (changed(rules=(Rule("1", Is("angle", "zero"), (HEDGED,)),)), ONE_BY_ONE),
        (with_rule(Or((Is("distance", "zero"), Is("angle", "zero")))), ONE_BY_ONE),
        (with_rule(Not(Is("distance", "zero"))), ALL_TOGETHER),
        (tables(FEW_RULES), ALL_TOGETHER),
        (tables(FEW_RULES + 1), ONE_BY_ONE),
    ],
)
def test_a_program_says_which_steps_are_taken_together(base, way):
    assert assemble(base).ints[TOGETHER] == way

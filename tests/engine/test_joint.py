"""A table of joint cells changes nothing but the time: every degree and every result, bit for bit."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from fcl_sim.engine.assemble import assemble
from fcl_sim.engine.assemble_joint import MOST_CELLS
from fcl_sim.engine.entries import evaluate_once
from fcl_sim.engine.precision import LREAL, REAL
from fcl_sim.engine.program import JOINT, JOINT_HELD
from fcl_sim.model import Accumulation, And, AndOperator, Is, Not, RuleBlock, Variable
from tests.engine.bases import CRANE, block, every, output, points, rule, singleton, tabulated

PRECISIONS = pytest.mark.parametrize("precision", [LREAL, REAL], ids=lambda each: each.name)


def plain_base(seed):
    """Return a base of which the engine makes a table: one to three inputs, one or two outputs."""
    random = np.random.default_rng(seed)
    count = int(random.integers(1, 4))
    inputs = {name: _terms(random, 5 - count, 6 - count) for name in "abc"[:count]}
    outputs = tuple(
        output(
            name,
            *(singleton(f"s{k}", float(random.integers(-9, 10))) for k in range(random.integers(1, 5))),
            default=random.choice([None, 0.0, 2.5]),
        )
        for name in "yz"[: random.integers(1, 3)]
    )
    rules = tuple(_rule(random, str(number), inputs, outputs) for number in range(random.integers(1, 30)))
    return block(inputs, outputs, RuleBlock(name="r", rules=rules))


def _terms(random, most_terms, most_points):
    """Return terms with points on a grid of eighths, so that knots coincide; some have vertical edges."""
    terms = []
    for number in range(random.integers(1, most_terms + 1)):
        xs = np.sort(random.integers(-24, 25, random.integers(2, most_points + 1))) / 8
        degrees = random.choice([0.0, 0.25, 1.0], xs.size)
        terms.append(points(f"t{number}", *zip(xs.tolist(), degrees.tolist(), strict=True)))
    return tuple(terms)


def _rule(random, label, inputs, outputs):
    names = random.permutation(list(inputs))[: random.integers(1, len(inputs) + 1)]
    conditions = []
    for name in names:
        leaf = Is(name, random.choice([term.name for term in inputs[name]]))
        conditions.append(Not(leaf) if random.random() < 0.2 else leaf)
    when = conditions[0] if len(conditions) == 1 else And(tuple(conditions))
    targets = random.permutation(len(outputs))[: random.integers(1, len(outputs) + 1)]
    then = [
        (outputs[at].variable, random.choice([each.name for each in outputs[at].terms])) for at in targets
    ]
    return rule(label, when, *then)


def walk(seed, inputs):
    """Return points of a way that stays in its cells, meets knots, jumps and comes back."""
    random = np.random.default_rng(seed)
    here = random.uniform(-3, 3, inputs)
    for _ in range(120):
        kind = random.integers(4)
        if kind == 0:
            here = random.uniform(-4, 4, inputs)
        elif kind == 1:
            here = np.round(here * 8) / 8
        elif kind == 2:
            here = here + random.uniform(-0.05, 0.05, inputs)
        yield here


def seen(program, memory):
    """Return what an evaluation leaves for others to see: head, degrees of terms, what has accumulated."""
    layout = program.layout
    words = [*layout.terms.values(), *layout.complements.values(), *layout.accumulated.values()]
    return memory[: program.recorded].tobytes(), memory[words].tobytes()


def table(size):
    """Return a base of size² rules by MIN."""
    peaks = tuple(float(each) for each in range(size))
    return tabulated({"a": peaks, "b": peaks}, lambda a, b: a + b, AndOperator.MIN, shared=True)


def without_table(program):
    ints = program.ints.copy()
    ints[JOINT] = 0
    return replace(program, ints=ints)


@PRECISIONS
def test_a_base_with_a_table_does_to_the_last_bit_what_it_does_without(precision):
    for seed in range(60):
        program = assemble(plain_base(seed), precision)
        plain = without_table(program)
        assert (program.form, plain.form) == ("joint", "plain")
        memory, other = program.initial.copy(), program.initial.copy()
        for point in walk(seed, len(program.input_names)):
            memory[: point.size] = other[: point.size] = point
            evaluate_once(program, memory)
            evaluate_once(plain, other)
            assert seen(program, memory) == seen(program, other), (seed, point)


@PRECISIONS
def test_what_is_no_number_comes_to_what_it_does_without_a_table(precision):
    program = assemble(CRANE, precision)
    plain = without_table(program)
    for point in ((np.nan, 4.0), (12.0, np.nan), (np.nan, np.nan), (12.0, 4.0)):
        memory, other = program.initial.copy(), program.initial.copy()
        memory[:2] = other[:2] = point
        evaluate_once(program, memory)
        evaluate_once(plain, other)
        head = program.recorded
        assert np.array_equal(memory[:head], other[:head], equal_nan=True), point


def test_a_rule_that_is_taken_out_concludes_nothing_though_the_table_lists_it():
    program = assemble(CRANE)
    rule_six = program.rule_labels.index("6")
    memory = program.initial.copy()
    memory[:2] = 0.0, 0.0
    less = program.without(rule_six)
    evaluate_once(less, memory)
    assert memory[program.active_at] == 0.0


def test_the_record_of_the_last_joint_cell_is_held_until_the_inputs_leave_it():
    program = assemble(CRANE)
    memory = program.initial.copy()
    held = []
    for distance in (12.0, 13.0, 22.0, 23.0, 24.0, 12.0):
        memory[:2] = distance, 4.0
        evaluate_once(program, memory)
        held.append(memory[program.ints[JOINT_HELD]])
    same = [first == second for first, second in pairwise(held)]
    assert same == [True, False, False, True, False]
    assert held[-1] == held[0]


SMALL = {"x": (points("low", (0, 1), (1, 0)), points("high", (0, 0), (1, 1)))}
Y = output("y", singleton("s", 1), singleton("t", 2))


@pytest.mark.parametrize(
    "base",
    [
        block(SMALL, (Y,), RuleBlock(name="r", rules=(rule("1", every(("x", "low")), ("y", "s", 0.5)),))),
        block(
            SMALL,
            (Y,),
            RuleBlock(
                name="r",
                and_operator=AndOperator.PROD,
                rules=(rule("1", every(("x", "low"), ("x", "high")), ("y", "s")),),
            ),
        ),
        block(
            SMALL,
            (Y,),
            RuleBlock(
                name="r",
                accumulation=Accumulation.BSUM,
                rules=(rule("1", every(("x", "low")), ("y", "s")),),
            ),
        ),
        block(
            {"x": (points("low", ("m", 1), (1, 0)),)},
            (Y,),
            RuleBlock(name="r", rules=(rule("1", every(("x", "low")), ("y", "s")),)),
            more_inputs=(Variable("m"),),
        ),
        table(40),
    ],
    ids=["weight", "PROD", "BSUM", "moved point", "too many cells"],
)
def test_there_is_no_table_where_the_lists_would_not_be_the_whole_truth(base):
    assert assemble(base).ints[JOINT] == 0


def test_a_table_has_a_record_for_each_way_in_which_cells_meet():
    program = assemble(table(7))
    knots = 7
    records = program.ints[program.ints[JOINT] :][: (2 * knots + 1) ** 2]
    assert records.size <= MOST_CELLS
    assert len(set(records.tolist())) == records.size

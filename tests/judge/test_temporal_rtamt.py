"""rtamt finds the same robustness on 10,000 random formulae and traces, and where it does not, why.

Its trees are built by hand: its parser would take a minute and a half for them.
"""

import math
import random
import warnings

import numpy as np
import pytest

from fcl_sim.formula.tree import Arithmetic, Number, Signal
from fcl_sim.judge.temporal.evaluate import HIGH, LOW, evaluate
from fcl_sim.judge.temporal.tree import TO_THE_END, Comparison, Edge, Interval, Junction, Not, Until, Window
from fcl_sim.judge.temporal.verdict import Truth, consider
from fcl_sim.units import Quantity
from tests.judge.formulae import LEVELS, RELATIONS, SPAN, STEP, formula, trace

with warnings.catch_warnings():
    warnings.simplefilter("ignore", DeprecationWarning)  # its parser imports typing.io
    rtamt = pytest.importorskip("rtamt", exc_type=ImportError)
    from rtamt.semantics.enumerations.comp_oper import StlComparisonOperator
    from rtamt.semantics.interval.interval import Interval as Bounds
    from rtamt.syntax.node.arithmetic.abs import Abs
    from rtamt.syntax.node.arithmetic.subtraction import Subtraction
    from rtamt.syntax.node.ltl.always import Always
    from rtamt.syntax.node.ltl.conjunction import Conjunction
    from rtamt.syntax.node.ltl.constant import Constant
    from rtamt.syntax.node.ltl.disjunction import Disjunction
    from rtamt.syntax.node.ltl.eventually import Eventually
    from rtamt.syntax.node.ltl.implies import Implies
    from rtamt.syntax.node.ltl.neg import Neg
    from rtamt.syntax.node.ltl.predicate import Predicate
    from rtamt.syntax.node.ltl.strong_previous import StrongPrevious
    from rtamt.syntax.node.ltl.until import Until as FreeUntil
    from rtamt.syntax.node.ltl.variable import Variable
    from rtamt.syntax.node.stl.timed_always import TimedAlways
    from rtamt.syntax.node.stl.timed_eventually import TimedEventually
    from rtamt.syntax.node.stl.timed_until import TimedUntil

THEIR_RELATIONS = dict(zip(RELATIONS, ("LESS", "LEQ", "GREATER", "GEQ", "EQ", "NEQ"), strict=True))
JUNCTIONS = {"and": Conjunction, "or": Disjunction, "implies": Implies}
FREE = {"always": Always, "eventually": Eventually}
TIMED = {"always": TimedAlways, "eventually": TimedEventually}
CASES = 10_000


def random_tree(draw: random.Random, depth: int):
    if depth == 0 or draw.random() < 0.2:
        return _random_comparison(draw)
    kind = draw.choice(["not", "and", "or", "implies", "rise", "fall", "always", "eventually", "until"])
    part = random_tree(draw, depth - 1)
    if kind == "not":
        return Not(part, SPAN)
    if kind in {"rise", "fall"}:
        return Edge(kind, part, SPAN)
    if kind in TIMED:
        return Window(kind, _random_interval(draw), part, SPAN)
    other = random_tree(draw, depth - 1)
    return (
        Until(_random_interval(draw), part, other, SPAN)
        if kind == "until"
        else Junction(kind, part, other, SPAN)
    )


def _random_comparison(draw):
    x, y = Signal("x", SPAN), Signal("y", SPAN)
    left = draw.choice([x, y, Arithmetic("abs", (x,), SPAN), Arithmetic("-", (x, y), SPAN)])
    level = Number(Quantity(draw.choice([*LEVELS, draw.uniform(-2, 2)])), SPAN)
    return Comparison(draw.choice(list(RELATIONS)), left, level, SPAN)


def _random_interval(draw):
    start = draw.randint(0, 4)
    return draw.choice([TO_THE_END, Interval(start * STEP, draw.randint(start, start + 5) * STEP)])


def random_trace(draw):
    count = draw.randint(2, 12)
    x, y = ([draw.choice([*LEVELS, draw.uniform(-3, 3)]) for _ in range(count)] for _ in range(2))
    return trace(x, y)


def theirs(node):  # noqa: PLR0911
    """Return a tree of ours as theirs."""
    match node:
        case Number():
            return Constant(node.quantity.value)
        case Signal():
            return Variable(node.name)
        case Arithmetic(operator="abs"):
            return Abs(theirs(node.operands[0]))
        case Arithmetic(operator="-"):
            return Subtraction(*map(theirs, node.operands))
        case Comparison():
            relation = StlComparisonOperator[THEIR_RELATIONS[node.operator]]
            return Predicate(theirs(node.left), theirs(node.right), relation)
        case Not():
            return Neg(theirs(node.operand))
        case Junction():
            return JUNCTIONS[node.operator](theirs(node.left), theirs(node.right))
        case _:
            return _their_window(node)


def _their_window(node):
    match node:
        case Edge():
            now, before = theirs(node.operand), StrongPrevious(Neg(theirs(node.operand)))
            if node.operator == "fall":
                now, before = Neg(theirs(node.operand)), StrongPrevious(theirs(node.operand))
            return Conjunction(now, before)
        case Window(interval=interval) if interval == TO_THE_END:
            return FREE[node.operator](theirs(node.operand))
        case Window():
            return TIMED[node.operator](theirs(node.operand), _bounds(node.interval))
        case Until(interval=interval) if interval == TO_THE_END:
            return FreeUntil(theirs(node.left), theirs(node.right))
        case Until():
            return TimedUntil(theirs(node.left), theirs(node.right), _bounds(node.interval))


def _bounds(interval):
    return Bounds(interval.start // STEP, interval.end // STEP, "s", "s")


@pytest.fixture(scope="module")
def their_robustness():
    specification = rtamt.StlDiscreteTimeSpecification()
    specification.declare_var("x", "float")
    specification.declare_var("y", "float")
    specification.spec = "x > 0 and y > 0"
    specification.parse()

    def robustness(run, *, tree=None, text=""):
        own = specification
        if text:
            own = rtamt.StlDiscreteTimeSpecification()
            own.declare_var("x", "float")
            own.spec = text
            own.parse()
        else:
            own.ast.specs = [theirs(tree)]
        samples = {"time": (run.ticks // STEP).tolist(), "x": run["x"].tolist(), "y": run["y"].tolist()}
        return [value for _, value in own.evaluate(samples)]

    return robustness


def test_robustness_is_theirs_wherever_the_trace_decides_it_and_within_our_bounds_elsewhere(their_robustness):
    """Beyond the end rtamt takes always for true and eventually for false; we leave it open."""
    draw = random.Random(20041014)  # noqa: S311
    decided = 0
    for _ in range(CASES):
        tree, run = random_tree(draw, 3), random_trace(draw)
        rows, found = evaluate(tree, run).rows, np.array(their_robustness(run, tree=tree))
        known = rows[LOW] == rows[HIGH]
        assert (found[known] == rows[LOW][known]).all()
        assert (rows[LOW] <= found).all()
        assert (found <= rows[HIGH]).all()
        decided += int(known.sum())
    assert decided > 3 * CASES


def test_an_edge_needs_a_scan_before_and_rtamt_takes_the_first_one_for_an_edge(their_robustness):
    """It lets everything both rise and fall there: what was before is whatever suits the operator."""
    run = trace([1.0, 1.0])
    assert their_robustness(run, text="rise(x > 0)")[0] == 1.0
    assert their_robustness(run, text="fall(x > 2)")[0] == 1.0
    assert consider(formula("rise(x > 0)"), run).truth is Truth.FAILS
    assert consider(formula("fall(x > 2)"), run).truth is Truth.FAILS


def test_nan_never_passes_and_rtamt_lets_it(their_robustness):
    """A comparison with NaN is false, so that the minimum of what came before stays."""
    run = trace([1.0, math.nan, 1.0])
    assert their_robustness(run, text="always(x > 0)")[0] == 1.0
    assert consider(formula("always x > 0"), run).truth is Truth.BROKEN


def test_the_end_of_a_trace_decides_nothing_and_rtamt_takes_it_for_good(their_robustness):
    run = trace([1.0, 1.0])
    assert their_robustness(run, text="always[0:5](x > 0)")[0] == 1.0
    assert consider(formula("always[0 s, 5 s] x > 0"), run).truth is Truth.OPEN

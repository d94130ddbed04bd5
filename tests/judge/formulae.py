"""Formulae and traces for tests, and what a formula means, spelled out scan by scan."""

import math
import operator

import numpy as np
from hypothesis import strategies as st

from fcl_sim.diagnostics import Source, Span
from fcl_sim.formula.text import plain
from fcl_sim.formula.tree import Arithmetic, Number, Signal
from fcl_sim.judge.temporal.formula import Formula, bind, read
from fcl_sim.judge.temporal.tree import Comparison, Edge, Interval, Junction, Not, Truth, Until, Window
from fcl_sim.loop.trace import Trace
from fcl_sim.units import Quantity

STEP = 1_000_000_000
SPAN = Span(Source("<test>", ""), 0, 0)
UNITS = {"x": "", "y": ""}
RELATIONS = {
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
    "==": operator.eq,
    "!=": operator.ne,
}
LEVELS = (-2.0, -1.0, 0.0, 0.5, 1.0, 2.0)
"""Few, so that signals often lie on a bound."""


def trace(x, y=None, ticks=None, units=UNITS) -> Trace:
    x = np.asarray(x, dtype=float)
    y = np.zeros_like(x) if y is None else np.asarray(y, dtype=float)
    ticks = np.arange(len(x)) * STEP if ticks is None else ticks
    return Trace(
        ticks=np.asarray(ticks, dtype=np.int64),
        names=tuple(units),
        units=units,
        values=np.column_stack([x, y]),
    )


def formula(text: str, units=UNITS) -> Formula:
    return bind(read(plain(text)), units)


def intervals():
    """Bounds, some between the scans, some to the end."""
    bound = st.integers(0, 10).map(lambda half: half * STEP // 2)
    return st.tuples(bound, bound | st.none()).map(
        lambda two: Interval(two[0], None) if two[1] is None else Interval(min(two), max(two))
    )


def comparisons():
    number = st.sampled_from(LEVELS).map(lambda level: Number(Quantity(level), SPAN))
    signal = st.sampled_from(["x", "y"]).map(lambda name: Signal(name, SPAN))
    whole = st.one_of(
        signal,
        signal.map(lambda each: Arithmetic("abs", (each,), SPAN)),
        st.just(Arithmetic("-", (Signal("x", SPAN), Signal("y", SPAN)), SPAN)),
    )
    return st.builds(Comparison, st.sampled_from(list(RELATIONS)), whole, number, st.just(SPAN))


def trees():
    leaf = comparisons() | st.booleans().map(lambda value: Truth(value, SPAN))

    def grown(inner):
        span = st.just(SPAN)
        return st.one_of(
            st.builds(Not, inner, span),
            st.builds(Junction, st.sampled_from(["and", "or", "implies"]), inner, inner, span),
            st.builds(Edge, st.sampled_from(["rise", "fall"]), inner, span),
            st.builds(Window, st.sampled_from(["always", "eventually"]), intervals(), inner, span),
            st.builds(Until, intervals(), inner, inner, span),
        )

    return st.recursive(leaf, grown, max_leaves=5)


@st.composite
def traces(draw, *, regular=False):
    count = draw(st.integers(1, 9))
    value = st.sampled_from(LEVELS) | st.floats(-3, 3)
    x, y = (draw(st.lists(value, min_size=count, max_size=count)) for _ in range(2))
    steps = st.just(2) if regular else st.integers(1, 5)
    ticks = np.cumsum([0, *draw(st.lists(steps, min_size=count - 1, max_size=count - 1))]) * (STEP // 2)
    return trace(x, y, ticks)


INF = math.inf
UNKNOWN = (-INF, INF, -INF, INF)
"""Least and largest robustness, least and largest truth of what is beyond the end."""


def meaning(node, scan: int, run: Trace):  # noqa: PLR0911
    """Return least and largest robustness, least and largest truth of a formula at a scan, by definition."""
    if scan == len(run.ticks):
        return UNKNOWN
    match node:
        case Truth():
            return ((INF if node.value else -INF),) * 4
        case Comparison():
            return _compared(node, scan, run)
        case Not():
            return _contrary(meaning(node.operand, scan, run))
        case Edge():
            if scan == 0:
                return (-INF,) * 4
            now, before = meaning(node.operand, scan, run), meaning(node.operand, scan - 1, run)
            if node.operator == "rise":
                return _least(now, _contrary(before))
            return _least(_contrary(now), before)
        case Junction(operator="implies"):
            return meaning(Junction("or", Not(node.left, SPAN), node.right, SPAN), scan, run)
        case Junction():
            both = meaning(node.left, scan, run), meaning(node.right, scan, run)
            return _least(*both) if node.operator == "and" else _largest(*both)
        case Window():
            values = [meaning(node.operand, each, run) for each in reached(node.interval, scan, run)]
            return _least(*values) if node.operator == "always" else _largest(*values)
        case Until():
            return _largest(*_promises(node, scan, run))


def reached(interval: Interval, scan: int, run: Trace) -> list[int]:
    """Return the scans that hold at some time of an interval; one more stands for what is to come."""
    start = run.ticks[scan] + interval.start
    if start > run.ticks[-1]:
        return [len(run.ticks)]
    end = run.ticks[-1] if interval.end is None else run.ticks[scan] + interval.end
    holds = max(each for each in range(len(run.ticks)) if run.ticks[each] <= start)
    later = [each for each in range(len(run.ticks)) if start < run.ticks[each] <= end]
    beyond = [len(run.ticks)] if end > run.ticks[-1] else []
    return [holds, *later, *beyond]


def _promises(node, scan, run):
    for come in reached(node.interval, scan, run):
        held = [meaning(node.left, each, run) for each in range(scan, come)]
        yield _least(meaning(node.right, come, run), *held)


def _compared(node, scan, run):
    left, right = (_number(each, scan, run) for each in (node.left, node.right))
    if not math.isfinite(left - right):
        return UNKNOWN
    margin = {"<": right - left, "<=": right - left, ">": left - right, ">=": left - right}.get(node.operator)
    if margin is None:
        margin = abs(left - right) * (-1 if node.operator == "==" else 1)
    truth = INF if RELATIONS[node.operator](left, right) else -INF
    return margin, margin, truth, truth


def _number(node, scan, run):
    match node:
        case Number():
            return node.quantity.value
        case Signal():
            return float(run[node.name][scan])
        case Arithmetic(operator="abs"):
            return abs(_number(node.operands[0], scan, run))
        case Arithmetic(operator="-"):
            return _number(node.operands[0], scan, run) - _number(node.operands[1], scan, run)


def _contrary(value):
    return tuple(-value[each] for each in (1, 0, 3, 2))


def _least(*values):
    return tuple(min(each) for each in zip(*values, strict=True))


def _largest(*values):
    return tuple(max(each) for each in zip(*values, strict=True))

"""Tree + Trace → at every scan, whether a formula holds and by how much.

The semantics are those of signal temporal logic: truth after O. Maler and
D. Nickovic, "Monitoring temporal properties of continuous signals", FORMATS
2004; robustness, the distance to the other truth, after A. Donzé and O. Maler,
"Robust satisfaction of temporal logic over real-valued signals", FORMATS 2010.
Where these leave a choice, or where we take another:

- A formula is looked at where a controller looks: at the scans. Between two
  scans every signal, and every part of a formula, is held. So the window
  [a, b] from a scan at t goes from the scan that holds at t + a to the last one
  at or before t + b; it is never empty, and its bounds are closed and compared
  in nanoseconds.
- `p until[a, b] q`: q holds at a scan of the window, and p at every scan from
  this one up to that one, which is not included. (Both papers include it. Then
  no p could hand over to a q that ends it, as `motor` does to `done`.)
- `rise` and `fall` compare with the scan before. The first scan has none, so
  nothing rises or falls there.
- Without bounds, or to `end`, a window reaches to the end of the trace. With
  bounds that lie beyond it, what is to come is unknown: truth and robustness
  are intervals (J. Deshmukh et al., "Robust online monitoring of signal
  temporal logic", 2017), and the verdict is open where both ends differ.

Four rows carry this: the least and the largest robustness, the least and the
largest truth, with inf for true and -inf for false. Truth stands apart since a
robustness of 0 says nothing: 0.5 < 0.5 is false, 0.5 <= 0.5 is true.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from fcl_sim.formula.tree import Arithmetic, Expression, Number, Scaled, Signal
from fcl_sim.judge.temporal import windows
from fcl_sim.judge.temporal.tree import Comparison, Edge, Formula, Junction, Not, Truth, Until, Window
from fcl_sim.judge.temporal.windows import Reach
from fcl_sim.loop.trace import Trace, Values

LOW, HIGH, SURE, POSSIBLE = range(4)
"""Rows: least and largest robustness, least and largest truth."""
SWAPPED = (HIGH, LOW, POSSIBLE, SURE)
UNKNOWN = np.array([[-np.inf], [np.inf], [-np.inf], [np.inf]])

RELATIONS: Mapping[str, Callable[[Values, Values], NDArray[np.bool_]]] = MappingProxyType(
    {
        "<": np.less,
        "<=": np.less_equal,
        ">": np.greater,
        ">=": np.greater_equal,
        "==": np.equal,
        "!=": np.not_equal,
    }
)
ARITHMETIC: Mapping[str, Callable[[list[Values]], Values]] = MappingProxyType(
    {
        "negative": lambda given: -given[0],
        "abs": lambda given: np.abs(given[0]),
        "min": np.minimum.reduce,
        "max": np.maximum.reduce,
        "+": lambda given: given[0] + given[1],
        "-": lambda given: given[0] - given[1],
        "*": lambda given: given[0] * given[1],
        "/": lambda given: given[0] / given[1],
    }
)


@dataclass(frozen=True, slots=True, eq=False)
class Course:
    """A part of a formula over the n scans of a trace.

    `rows` (4, n); `parts` what it is built from. `over` is what
    a window reaches; `broken` (n,) where a comparison has no finite numbers.
    """

    node: Formula
    rows: Values
    parts: tuple["Course", ...] = ()
    over: Reach = field(default_factory=lambda: Reach(np.zeros(0, np.int64), np.zeros(0, np.int64)))
    broken: NDArray[np.bool_] = field(default_factory=lambda: np.zeros(0, np.bool_))


def evaluate(tree: Formula, trace: Trace) -> Course:
    """Return the course of a resolved formula over a trace of at least one scan."""
    with np.errstate(all="ignore"):
        return _course(tree, trace)


def _course(node: Formula, trace: Trace) -> Course:  # noqa: PLR0911  one for each kind of node
    match node:
        case Truth():
            level = np.inf if node.value else -np.inf
            return Course(node, np.full((4, trace.ticks.size), level))
        case Comparison():
            return _comparison(node, trace)
        case Not():
            part = _course(node.operand, trace)
            return Course(node, _negative(part.rows), (part,))
        case Edge():
            return _edge(node, _course(node.operand, trace))
        case Junction():
            return _junction(node, _course(node.left, trace), _course(node.right, trace))
        case Window():
            return _window(node, _course(node.operand, trace), trace)
        case Until():
            return _until(node, _course(node.left, trace), _course(node.right, trace), trace)
    raise TypeError(node)


def _negative(rows: Values) -> Values:
    return -rows[SWAPPED, :]


def _comparison(node: Comparison, trace: Trace) -> Course:
    left, right = _number(node.left, trace), _number(node.right, trace)
    margin = left - right
    broken = ~np.isfinite(margin)
    if node.operator in {"==", "!="}:
        margin = np.abs(margin)
    if node.operator in {"<", "<=", "=="}:
        margin = -margin
    truth = np.where(RELATIONS[node.operator](left, right), np.inf, -np.inf)
    rows = np.array([margin, margin, truth, truth])
    if broken.any():
        rows[:, broken] = UNKNOWN
    return Course(node, rows, broken=broken)


def _number(node: Expression, trace: Trace) -> Values:
    match node:
        case Number():
            return np.full(trace.ticks.size, node.quantity.value)
        case Signal():
            return trace[node.name]
        case Scaled():
            return node.factor * _number(node.operand, trace)
        case Arithmetic():
            given = [_number(each, trace) for each in node.operands]
            return ARITHMETIC[node.operator](given)


def _edge(node: Edge, part: Course) -> Course:
    now, before = part.rows, _negative(part.rows)
    if node.operator == "fall":
        now, before = before, now
    rows = np.full_like(now, -np.inf)
    rows[:, 1:] = np.minimum(now[:, 1:], before[:, :-1])
    return Course(node, rows, (part,))


def _junction(node: Junction, left: Course, right: Course) -> Course:
    if node.operator == "and":
        rows = np.minimum(left.rows, right.rows)
    else:
        rows = np.maximum(left.rows if node.operator == "or" else _negative(left.rows), right.rows)
    return Course(node, rows, (left, right))


def _window(node: Window, part: Course, trace: Trace) -> Course:
    over = windows.reach(trace.ticks, node.interval.start, node.interval.end)
    always = node.operator == "always"
    pick = np.minimum if always else np.maximum
    if node.interval.end is None:
        rows = windows.to_the_end(part.rows, UNKNOWN, over, pick)
    else:
        rows = windows.extreme(part.rows, UNKNOWN, over, pick, np.inf if always else -np.inf)
    return Course(node, rows, (part,), over)


def _until(node: Until, left: Course, right: Course, trace: Trace) -> Course:
    """Return the course of until in time n log n.

    `p until[a, b] q` is the least of: p at the scans before the window; from
    its first scan, p until q without bounds; q somewhere in the window
    (A. Donzé, T. Ferrère, O. Maler, "Efficient robust monitoring for STL",
    CAV 2013).
    """
    over = windows.reach(trace.ticks, node.interval.start, node.interval.end)
    endless = node.interval.end is None
    never = np.full_like(UNKNOWN, -np.inf)
    free = windows.until(left.rows, right.rows, never if endless else UNKNOWN)
    if over.at_once:
        rows = free
    else:
        later = np.hstack([free, UNKNOWN])[:, over.first]
        rows = np.minimum(later, windows.before(left.rows, over))
    if not endless:
        come = windows.extreme(right.rows, UNKNOWN, over, np.maximum, -np.inf)
        rows = np.minimum(rows, come)
    return Course(node, rows, (left, right), over)

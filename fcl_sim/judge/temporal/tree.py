"""The tree of a formula: what was written, each node with its place.

A formula is a truth at every scan, built from comparisons of numbers. The
resolver replaces numbers by ones in the units of the signals; the shape stays.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field

from fcl_sim.diagnostics import Span
from fcl_sim.formula import tree as arithmetic
from fcl_sim.formula.tree import Expression, Signal


@dataclass(frozen=True, slots=True)
class Truth:
    """`true` or `false`."""

    value: bool
    span: Span = field(compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Comparison:
    """`<`, `<=`, `>`, `>=`, `==` or `!=` of two numbers; `unit`, once resolved, is that of both."""

    operator: str
    left: Expression
    right: Expression
    span: Span = field(compare=False, repr=False)
    unit: str = field(default="", compare=False)


@dataclass(frozen=True, slots=True)
class Not:
    """The contrary."""

    operand: "Formula"
    span: Span = field(compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Junction:
    """`and`, `or` or `implies` of two truths."""

    operator: str
    left: "Formula"
    right: "Formula"
    span: Span = field(compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Edge:
    """`rise`: true now and not at the scan before; `fall`: the other way round."""

    operator: str
    operand: "Formula"
    span: Span = field(compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Interval:
    """Closed bounds in nanoseconds from the scan that is looked at; `end` None: the end of the trace."""

    start: int = 0
    end: int | None = None


TO_THE_END = Interval()


@dataclass(frozen=True, slots=True)
class Window:
    """`always` or `eventually` of a truth in an interval."""

    operator: str
    interval: Interval
    operand: "Formula"
    span: Span = field(compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Until:
    """`right` comes true in the interval, and `left` is true at all scans before that."""

    interval: Interval
    left: "Formula"
    right: "Formula"
    span: Span = field(compare=False, repr=False)


Formula = Truth | Comparison | Not | Junction | Edge | Window | Until
Node = Expression | Formula


def parts(node: Node) -> tuple[Node, ...]:
    """Return what a node is built from."""
    match node:
        case Not() | Edge() | Window():
            return (node.operand,)
        case Comparison() | Junction() | Until():
            return (node.left, node.right)
        case Truth():
            return ()
        case _:
            return arithmetic.parts(node)


def signals(node: Node) -> Iterator[str]:
    """Yield the names of the signals in a tree, from left to right."""
    if isinstance(node, Signal):
        yield node.name
    for each in parts(node):
        yield from signals(each)

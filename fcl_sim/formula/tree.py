"""The tree of arithmetic: what was written, each node with its place."""

from collections.abc import Iterator
from dataclasses import dataclass, field

from fcl_sim.diagnostics import Span
from fcl_sim.units import Quantity


@dataclass(frozen=True, slots=True)
class Number:
    """A number with its unit."""

    quantity: Quantity
    span: Span = field(compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Signal:
    """The samples of a signal."""

    name: str
    span: Span = field(compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Scaled:
    """A number times `factor`, which takes it into another unit; only the resolver makes it."""

    factor: float
    operand: "Expression"
    span: Span = field(compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Arithmetic:
    """`+`, `-`, `*`, `/` of two numbers, `negative` of one, or a function by its name."""

    operator: str
    operands: tuple["Expression", ...]
    span: Span = field(compare=False, repr=False)


Expression = Number | Signal | Scaled | Arithmetic


def parts(node: Expression) -> tuple[Expression, ...]:
    """Return what a number is calculated from."""
    match node:
        case Arithmetic():
            return node.operands
        case Scaled():
            return (node.operand,)
        case _:
            return ()


def signals(node: Expression) -> Iterator[str]:
    """Yield the names of the signals in a number, from left to right."""
    if isinstance(node, Signal):
        yield node.name
    for each in parts(node):
        yield from signals(each)

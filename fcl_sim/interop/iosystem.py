"""A function block as a discrete system of python-control."""

from math import isfinite
from typing import Any

import control
import numpy as np
from numpy.typing import NDArray

from fcl_sim.block import Block
from fcl_sim.engine.assemble_outputs import holds
from fcl_sim.model import Call, Expression, Formula, FunctionBlock, Operation, Reference

Values = NDArray[np.float64]


def to_iosystem(
    block: Block, dt: float, *, name: str | None = None, arithmetic: str = "LREAL"
) -> control.NonlinearIOSystem:
    """Return a system that evaluates `block` once every `dt` seconds, computing in `arithmetic` (S36).

    Its inputs and outputs have the names of the block's; a member of a
    structure, `color.brown`, is `color_brown`, since python-control keeps the
    dot for itself. Outputs follow inputs at once: y[k] = f(u[k], y[k-1]). The
    states are the previous values of the outputs that depend on them, those
    with NC above all; they start at python-control's X0, which is 0 unless it is
    given. A block without such outputs has no state: it can be called, with u
    or with one column for each of several points, and has a describing function.

    Raises ValueError for a `dt` that is not positive and for an unknown
    arithmetic; evaluating raises as an Instance does (S37).
    """
    kept = remembered(block.function_block)
    rows = [block.outputs.index(each) for each in kept]
    instance = block.instance(arithmetic)

    def evaluate(x: Values, point: Values) -> list[float]:
        instance.resume(**dict(zip(kept, x.tolist(), strict=False)))  # a static system is given an x of 1
        instance(**dict(zip(block.inputs, point.tolist(), strict=True)))
        return [*instance.outputs.values()]

    def output(_time: float, x: Values, u: Values, _parameters: dict[str, Any]) -> Values:
        points = np.asarray(u, np.float64).reshape(len(block.inputs), -1)
        columns = np.array([evaluate(x, point) for point in points.T]).T
        return columns if np.ndim(u) > 1 else columns.reshape(-1)

    def update(time: float, x: Values, u: Values, parameters: dict[str, Any]) -> Values:
        return output(time, x, u, parameters)[rows]

    return control.NonlinearIOSystem(
        update if kept else None,
        output,
        inputs=labels(block.inputs),
        outputs=labels(block.outputs),
        states=state_labels(kept) or None,
        dt=seconds(dt),
        name=name,
    )


def remembered(block: FunctionBlock) -> tuple[str, ...]:
    """Return the outputs whose previous value an evaluation may depend on, in the order of the text.

    Those are outputs with NC, those that nothing is said about, and those that a formula names.
    """
    said = {each.variable.casefold(): holds(each) for each in block.defuzzifications}
    concluded = {
        each.variable.casefold()
        for rules in block.rule_blocks
        for rule in rules.rules
        for each in rule.conclusions
    }
    shapes = [term.shape for each in block.defuzzifications for term in each.terms]
    named = {name for shape in shapes if isinstance(shape, Formula) for name in _names(shape.expression)}
    names = [each.name for each in block.outputs]
    return tuple(
        name
        for name in names
        if name.casefold() in named or said.get(name.casefold(), name.casefold() not in concluded)
    )


def _names(expression: Expression) -> set[str]:
    """Return the variables in an expression, letter case folded."""
    match expression:
        case Reference():
            return {expression.variable.casefold()}
        case Operation() | Call():
            return {name for each in expression.arguments for name in _names(each)}
    return set()


def labels(names: tuple[str, ...]) -> list[str]:
    """Return the names of signals in python-control; ValueError where two become one."""
    plain = [name.replace(".", "_") for name in names]
    for index, label in enumerate(plain):
        if label in plain[:index]:
            first = names[plain.index(label)]
            raise ValueError(f"{first} and {names[index]} would both be called {label} in python-control")
    return plain


def state_labels(kept: tuple[str, ...]) -> list[str]:
    """Return the names of the states that hold previous outputs."""
    return [f"{label}_before" for label in labels(kept)]


def seconds(dt: float) -> float:
    """Return `dt` if it is a time between scans; else ValueError."""
    if isinstance(dt, bool) or not isfinite(dt) or dt <= 0:
        raise ValueError(f"dt must be the seconds between two scans, not {dt}")
    return float(dt)

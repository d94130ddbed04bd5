"""Tree → text of a formula, with the parentheses that make its reading plain."""

from functools import lru_cache

from fcl_sim.formula import write as arithmetic
from fcl_sim.formula.tree import Arithmetic, Number, Scaled, Signal
from fcl_sim.judge.temporal.sentences import QUOTED
from fcl_sim.judge.temporal.tree import (
    TO_THE_END,
    Comparison,
    Edge,
    Formula,
    Interval,
    Junction,
    Node,
    Not,
    Truth,
    Until,
    Window,
)
from fcl_sim.units import short


@lru_cache(maxsize=1024)
def written(node: Node) -> str:
    """Return the text of a tree; read again, it gives the same tree.

    It is remembered: at each point of an envelope the same is told.
    """
    match node:
        case Number() | Signal() | Scaled() | Arithmetic():
            return arithmetic.written(node, QUOTED)
        case Comparison():
            return f"{written(node.left)} {node.operator} {written(node.right)}"
        case _:
            return _truth(node)


def name(signal: str) -> str:
    """Return the name of a signal as a formula has it, in backquotes where it is no plain name."""
    return arithmetic.name(signal, QUOTED)


def _truth(node: Formula) -> str:
    match node:
        case Truth():
            return "true" if node.value else "false"
        case Not():
            return f"not {_enclosed(node.operand)}"
        case Edge():
            return f"{node.operator}({written(node.operand)})"
        case Window():
            return f"{node.operator}{interval(node.interval)} {_enclosed(node.operand)}"
        case Junction():
            return f"{_enclosed(node.left)} {node.operator} {_enclosed(node.right)}"
        case Until():
            return f"{_enclosed(node.left)} until{interval(node.interval)} {_enclosed(node.right)}"
    raise TypeError(node)


def _enclosed(node: Formula) -> str:
    return written(node) if isinstance(node, Truth | Edge) else f"({written(node)})"


def interval(given: Interval) -> str:
    """Return bounds as they are written; nothing where they are the whole trace."""
    if given == TO_THE_END:
        return ""
    end = "end" if given.end is None else f"{short(given.end / 1e9)} s"
    return f"[{short(given.start / 1e9)} s, {end}]"

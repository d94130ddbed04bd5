"""Tree → text of a formula, with the parentheses that make its reading plain."""

from fcl_sim.judge.temporal.sentences import QUOTED
from fcl_sim.judge.temporal.tokens import NAME
from fcl_sim.judge.temporal.tree import (
    TO_THE_END,
    Arithmetic,
    Comparison,
    Edge,
    Formula,
    Interval,
    Junction,
    Node,
    Not,
    Number,
    Scaled,
    Signal,
    Truth,
    Until,
    Window,
)
from fcl_sim.units import short


def written(node: Node) -> str:
    """Return the text of a tree; read again, it gives the same tree."""
    match node:
        case Number():
            unit = node.quantity.unit.symbol.replace(" ", "*")
            return f"{short(node.quantity.value)} {unit}".rstrip()
        case Signal():
            return name(node.name)
        case Scaled():
            return written(node.operand)
        case Arithmetic():
            return _arithmetic(node)
        case Comparison():
            return f"{written(node.left)} {node.operator} {written(node.right)}"
        case _:
            return _truth(node)


def name(signal: str) -> str:
    """Return the name of a signal as a formula has it, in backquotes where it is no plain name."""
    return signal if NAME.fullmatch(signal) and signal not in QUOTED else f"`{signal}`"


def _arithmetic(node: Arithmetic) -> str:
    given = [written(each) for each in node.operands]
    if node.operator in {"abs", "min", "max"}:
        return f"{node.operator}({', '.join(given)})"
    enclosed = [
        f"({text})" if isinstance(each, Arithmetic) and each.operator not in {"abs", "min", "max"} else text
        for each, text in zip(node.operands, given, strict=True)
    ]
    if node.operator == "negative":
        return f"-{enclosed[0]}"
    return f" {node.operator} ".join(enclosed)


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

"""Tree of arithmetic → text, with the parentheses that make its reading plain."""

from collections.abc import Container

from fcl_sim.formula.tokens import NAME
from fcl_sim.formula.tree import Arithmetic, Expression, Number, Scaled, Signal
from fcl_sim.units import short

SYMBOLS = frozenset({"+", "-", "*", "/"})


def written(node: Expression, quoted: Container[str] = ()) -> str:
    """Return the text of a number; read again, it gives the same tree.

    `quoted` are the words of the language: a signal called so is in backquotes.
    """
    match node:
        case Number():
            unit = node.quantity.unit.symbol.replace(" ", "*")
            return f"{short(node.quantity.value)} {unit}".rstrip()
        case Signal():
            return name(node.name, quoted)
        case Scaled():
            return written(node.operand, quoted)
        case Arithmetic():
            return _arithmetic(node, quoted)


def name(signal: str, quoted: Container[str] = ()) -> str:
    """Return the name of a signal as a formula has it, in backquotes where it is no plain name."""
    return signal if NAME.fullmatch(signal) and signal not in quoted else f"`{signal}`"


def _arithmetic(node: Arithmetic, quoted: Container[str]) -> str:
    given = [written(each, quoted) for each in node.operands]
    if node.operator not in SYMBOLS | {"negative"}:
        return f"{node.operator}({', '.join(given)})"
    enclosed = [
        f"({text})" if _is_open(each) else text for each, text in zip(node.operands, given, strict=True)
    ]
    return f"-{enclosed[0]}" if node.operator == "negative" else f" {node.operator} ".join(enclosed)


def _is_open(node: Expression) -> bool:
    """Return whether a part is written without parentheses of its own."""
    return isinstance(node, Arithmetic) and node.operator in SYMBOLS | {"negative"}

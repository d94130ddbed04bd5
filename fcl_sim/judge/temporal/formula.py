"""Text → formula in the units of a run, ready to be judged."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from fcl_sim.diagnostics import InputFault
from fcl_sim.formula.text import Text
from fcl_sim.formula.tokens import Kind, scan
from fcl_sim.judge.temporal.parse import Parser
from fcl_sim.judge.temporal.resolve import resolve
from fcl_sim.judge.temporal.sentences import BEGINNINGS, sentence
from fcl_sim.judge.temporal.tree import Comparison, Node, parts, signals
from fcl_sim.judge.temporal.tree import Formula as Tree
from fcl_sim.judge.temporal.words import BEHIND_NUMBERS, INSTEAD
from fcl_sim.judge.temporal.write import written
from fcl_sim.units import parse_unit


@dataclass(frozen=True, slots=True)
class Statement:
    """A formula or a sentence, read. `words` is the sentence as it was written, empty for a formula."""

    tree: Tree
    words: str

    @property
    def formula(self) -> str:
        """The formula as text; of a sentence, the one that it stands for."""
        return written(self.tree)


@dataclass(frozen=True, slots=True)
class Formula:
    """A formula in the units of a run.

    `signals` are those it looks at, each once. `unit` is that of a difference in
    the one unit of all its comparisons, K of degC; None where they have several:
    then its robustness is a number of no unit, and only the comparison that
    decides it is told.
    """

    statement: Statement
    tree: Tree = field(repr=False)
    signals: tuple[str, ...]
    unit: str | None

    def __str__(self) -> str:
        """Return the formula, behind the sentence that it stands for where it was written as one."""
        words, formula = self.statement.words, self.statement.formula
        return f"{words}; that is: {formula}" if words else formula


def read(text: Text) -> Statement:
    """Return what a text says; InputFault, at its place, where it says nothing."""
    tokens = scan(text, BEHIND_NUMBERS, INSTEAD)
    parser = Parser(tokens)
    tree = sentence(parser)
    parser.ended("join truths by `and`, `or`, `implies` or `until`")
    names = [each.text for each in tokens if each.kind is Kind.NAME]
    in_words = "lasts" in names or (tokens[0].kind is Kind.NAME and tokens[0].text in BEGINNINGS)
    return Statement(tree, " ".join(text.text.split()) if in_words else "")


def bind(statement: Statement, units: Mapping[str, str]) -> Formula:
    """Return a statement in the units of the signals of a run; InputFault with all that does not fit."""
    tree, faults = resolve(statement.tree, units)
    if faults:
        raise InputFault(faults)
    found = list(dict.fromkeys(_units(tree)))
    return Formula(
        statement,
        tree,
        tuple(dict.fromkeys(signals(tree))),
        parse_unit(found[0]).difference.symbol if len(found) == 1 else None,
    )


def _units(node: Node) -> list[str]:
    if isinstance(node, Comparison):
        return [node.unit]
    return [unit for part in parts(node) for unit in _units(part)]

"""Tokens → tree. Whether a name is known and a unit fits is the resolver's business.

The grammar stands in the docstrings of the parse functions, from the loosest
binding to the tightest.
"""

from collections.abc import Callable

from fcl_sim.formula.functions import OF_REQUIREMENTS
from fcl_sim.formula.parse import Parser as ArithmeticParser
from fcl_sim.formula.text import fault
from fcl_sim.formula.tokens import Token
from fcl_sim.formula.tree import Expression, Signal
from fcl_sim.judge.temporal.tree import (
    TO_THE_END,
    Comparison,
    Edge,
    Interval,
    Junction,
    Node,
    Not,
    Truth,
    Until,
    Window,
)
from fcl_sim.judge.temporal.tree import Formula as Tree
from fcl_sim.judge.temporal.words import WORDS
from fcl_sim.units import UnitError, nanoseconds

LAST_TICK = 2**62
"""No time may lie beyond, so that the sum of two is still a number of the clock."""

WINDOWS = ("always", "eventually")
EDGES = ("rise", "fall")
COMPARISONS = ("<", "<=", ">", ">=", "==", "!=")
RESERVED = frozenset({*WINDOWS, *EDGES, *OF_REQUIREMENTS, *WORDS, "true", "false", "end"})


class Parser(ArithmeticParser):
    """A place among the tokens of a requirement."""

    functions = OF_REQUIREMENTS
    calls = (*EDGES, *WINDOWS)
    instead_of_much = "make several requirements of it"

    def formula(self) -> Tree:
        """Parse a truth."""
        return truth(self.expression(), "a formula")

    def expression(self) -> Node:
        """Parse anything; what must be a truth or a number is told apart where it is used.

        formula = disjunction [ "implies" formula ]
        """
        left = self.disjunction()
        word = self.taken("implies")
        if word is None:
            return left
        right = self.deeper(self.expression)
        return _junction(word, left, right)

    def disjunction(self) -> Node:
        """Parse: disjunction = conjunction { "or" conjunction } ."""
        return self._joined("or", self.conjunction)

    def conjunction(self) -> Node:
        """Parse: conjunction = promise { "and" promise } ."""
        return self._joined("and", self.promise)

    def _joined(self, symbol: str, part: Callable[[], Node]) -> Node:
        found, count = part(), 0
        while word := self.taken(symbol):
            count += 1
            found = _junction(word, found, self.deeper(part, count))
        return found

    def promise(self) -> Node:
        """Parse: promise = unary [ "until" [ interval ] unary ] ."""
        left = self.unary()
        if not self.taken("until"):
            return left
        interval = self.interval()
        right = self.deeper(self.unary)
        return Until(interval, truth(left, "`until`"), truth(right, "`until`"), left.span.to(right.span))

    def unary(self) -> Node:
        """Parse what stands before one truth.

        unary = "not" unary | ( "always" | "eventually" ) [ interval ] unary
              | ( "rise" | "fall" ) "(" formula ")" | comparison
        """
        word = self.taken("not", *WINDOWS, *EDGES)
        if word is None:
            return self.comparison()
        if word.text in EDGES:
            opening = self.need("(", f"after `{word.text}`")
            inner = truth(self.deeper(self.expression), f"what `{word.text}` takes")
            closing = self.need(")", "", opening)
            return Edge(word.text, inner, word.span.to(closing.span))
        interval = TO_THE_END if word.text == "not" else self.interval()
        operand = truth(self.deeper(self.unary), f"what follows `{word.text}`")
        span = word.span.to(operand.span)
        return Not(operand, span) if word.text == "not" else Window(word.text, interval, operand, span)

    def interval(self) -> Interval:
        """Parse bounds of time.

        interval = "[" time "," ( time | "end" ) "]"
        """
        opening = self.taken("[")
        if opening is None:
            return TO_THE_END
        start = self.time()
        self.need(",", "between the two times")
        end = None if self.taken("end") else self.time()
        closing = self.need("]", "behind the second time", opening)
        if end is not None and end < start:
            span = opening.span.to(closing.span)
            raise fault("JDG205", "the interval ends before it begins", span, "are they exchanged?")
        return Interval(start, end)

    def time(self) -> int:
        """Parse a time of whole nanoseconds, 0 or more."""
        token = self.take()
        if token.quantity is None:
            hint = 'write it with its unit, as in "2 s"; the end of the trace is `end`'
            raise fault("JDG205", f"a time is wanted here, not {token.shown}", token.span, hint)
        try:
            ticks = nanoseconds(token.quantity)
        except UnitError as error:
            hint = f"write `{token.text} s`" if not token.quantity.unit.symbol else error.hint
            raise fault("JDG205", str(error), token.span, hint) from error
        if ticks > LAST_TICK:
            raise fault("JDG205", "no trace is so long", token.span, "the end of the trace is `end`")
        return ticks

    def comparison(self) -> Node:
        """Parse: comparison = sum { relation sum } ; of several, all hold."""
        left = self.sum()
        found: Tree | None = None
        while relation := self.taken(*COMPARISONS):
            low = number(left, f"`{relation.text}`")
            right = number(self.deeper(self.sum), f"`{relation.text}`")
            each = Comparison(relation.text, low, right, left.span.to(right.span))
            found = each if found is None else Junction("and", found, each, found.span.to(each.span))
            left = right
        return left if found is None else found

    def inner(self) -> Node:
        """Parse what may stand in parentheses: inner = formula ."""
        return self.expression()

    def number(self, found: Node, where: str) -> Expression:
        """Return a node that is a number; a fault where it is a truth."""
        return number(found, where)

    def word(self, token: Token) -> Node:
        """Return what a name stands for: "true" | "false" | signal ."""
        if token.text in {"true", "false"}:
            return Truth(token.text == "true", token.span)
        if token.text in RESERVED:
            hint = f"if it is a signal, write it in backquotes: `{token.text}`"
            raise fault("JDG201", f"`{token.text}` cannot stand here", token.span, hint)
        return Signal(token.text, token.span)


def _junction(word: Token, left: Node, right: Node) -> Tree:
    where = f"`{word.text}`"
    return Junction(word.text, truth(left, where), truth(right, where), left.span.to(right.span))


def number(node: Node, where: str) -> Expression:
    """Return a node that is a number; a fault where it is a truth."""
    if isinstance(node, Expression):
        return node
    message = f"{where} takes numbers, and this is true or false"
    raise fault("JDG204", message, node.span, "compare numbers, and join what comes of it by and, or, not")


def truth(node: Node, where: str) -> Tree:
    """Return a node that is a truth; a fault where it is a number."""
    if not isinstance(node, Expression):
        return node
    shown = node.span.text
    hint = f"compare it, as in `{shown} > 0.5`" if isinstance(node, Signal) else "compare it with something"
    message = f"{where} takes what is true or false" if where[0] == "`" else f"{where} is true or false"
    raise fault("JDG204", f"{message}, and this is a number", node.span, hint)

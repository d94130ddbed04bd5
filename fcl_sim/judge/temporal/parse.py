"""Tokens → tree. Whether a name is known and a unit fits is the resolver's business.

The grammar stands in the docstrings of the parse functions, from the loosest
binding to the tightest.
"""

from collections.abc import Callable
from dataclasses import replace

from fcl_sim.diagnostics import Span, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.judge.temporal.text import fault
from fcl_sim.judge.temporal.tokens import WORDS, Kind, Token
from fcl_sim.judge.temporal.tree import (
    TO_THE_END,
    Arithmetic,
    Comparison,
    Edge,
    Expression,
    Interval,
    Junction,
    Node,
    Not,
    Number,
    Signal,
    Truth,
    Until,
    Window,
)
from fcl_sim.judge.temporal.tree import Formula as Tree
from fcl_sim.units import UnitError, nanoseconds

DEEPEST = 30
LONGEST = 2_000
"""How many operators may stand within each other, and how many tokens a formula may have."""

LAST_TICK = 2**62
"""No time may lie beyond, so that the sum of two is still a number of the clock."""

WINDOWS = ("always", "eventually")
EDGES = ("rise", "fall")
FUNCTIONS = {"abs": 1, "min": 0, "max": 0}
"""Functions of numbers, each with its number of arguments; 0 for two or more."""
COMPARISONS = ("<", "<=", ">", ">=", "==", "!=")
RESERVED = frozenset({*WINDOWS, *EDGES, *FUNCTIONS, *WORDS, "true", "false", "end"})


class Parser:
    """A place among tokens."""

    def __init__(self, tokens: tuple[Token, ...]) -> None:
        self.tokens = tokens
        self.at = 0
        self.depth = 0
        if len(tokens) > LONGEST:
            message = f"the formula has more than {LONGEST} words"
            raise fault("JDG207", message, tokens[LONGEST].span, "make several requirements of it")

    @property
    def next(self) -> Token:
        """The token that is looked at."""
        return self.tokens[self.at]

    def take(self) -> Token:
        """Return the token that is looked at, and go on."""
        token = self.next
        self.at += token.kind is not Kind.END
        return token

    def sees(self, *texts: str) -> bool:
        """Return whether one of these words or symbols is next."""
        return self.next.kind in {Kind.NAME, Kind.SYMBOL} and self.next.text in texts

    def taken(self, *texts: str) -> Token | None:
        """Return one of these words or symbols and go on, or None."""
        return self.take() if self.sees(*texts) else None

    def need(self, text: str, where: str, opening: Token | None = None) -> Token:
        """Return what must come here; a fault where something else does."""
        token = self.taken(text)
        if token is None:
            hint = f"`{opening.text}` is opened before it and not closed" if opening else ""
            raise self.unexpected(f"`{text}` is missing {where}".rstrip(), hint)
        return token

    def unexpected(self, message: str, hint: str = "") -> Exception:
        """Return the fault of the token that is looked at."""
        return fault("JDG201", f"{message}, before {self.next.shown}", self.next.span, hint)

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
        right = self._deeper(self.expression)
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
            found = _junction(word, found, self._deeper(part, count))
        return found

    def promise(self) -> Node:
        """Parse: promise = unary [ "until" [ interval ] unary ] ."""
        left = self.unary()
        if not self.taken("until"):
            return left
        interval = self.interval()
        right = self._deeper(self.unary)
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
            inner = truth(self._deeper(self.expression), f"what `{word.text}` takes")
            closing = self.need(")", "", opening)
            return Edge(word.text, inner, word.span.to(closing.span))
        interval = TO_THE_END if word.text == "not" else self.interval()
        operand = truth(self._deeper(self.unary), f"what follows `{word.text}`")
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
            right = number(self._deeper(self.sum), f"`{relation.text}`")
            each = Comparison(relation.text, low, right, left.span.to(right.span))
            found = each if found is None else Junction("and", found, each, found.span.to(each.span))
            left = right
        return left if found is None else found

    def sum(self) -> Node:
        """Parse: sum = product { ( "+" | "-" ) product } ."""
        return self._chain(("+", "-"), self.product)

    def product(self) -> Node:
        """Parse: product = factor { ( "*" | "/" ) factor } ."""
        return self._chain(("*", "/"), self.factor)

    def _chain(self, symbols: tuple[str, ...], part: Callable[[], Node]) -> Node:
        found, count = part(), 0
        while symbol := self.taken(*symbols):
            count += 1
            left = number(found, f"`{symbol.text}`")
            right = number(self._deeper(part, count), f"`{symbol.text}`")
            found = Arithmetic(symbol.text, (left, right), left.span.to(right.span))
        return found

    def factor(self) -> Node:
        """Parse the smallest parts.

        factor = "-" factor | quantity | signal | "true" | "false"
               | function "(" sum { "," sum } ")" | "(" formula ")"
        """
        token = self.take()
        if token.quantity is not None:
            return Number(token.quantity, token.span)
        if token.kind is Kind.QUOTED:
            return Signal(token.text, token.span)
        if token.kind is Kind.SYMBOL and token.text == "-":
            operand = number(self._deeper(self.factor), "`-`")
            if isinstance(operand, Number):
                quantity = operand.quantity
                return Number(replace(quantity, value=-quantity.value), token.span.to(operand.span))
            return Arithmetic("negative", (operand,), token.span.to(operand.span))
        if token.kind is Kind.SYMBOL and token.text == "(":
            inner = self._deeper(self.expression)
            self.need(")", "", token)
            return inner
        if token.kind is Kind.NAME:
            return self._named(token)
        raise fault("JDG201", f"a number, a signal or `(` is wanted here, not {token.shown}", token.span)

    def _named(self, token: Token) -> Node:
        if self.sees("("):
            return self._call(token)
        if token.text in {"true", "false"}:
            return Truth(token.text == "true", token.span)
        if token.text in RESERVED:
            hint = f"if it is a signal, write it in backquotes: `{token.text}`"
            raise fault("JDG201", f"`{token.text}` cannot stand here", token.span, hint)
        return Signal(token.text, token.span)

    def _call(self, token: Token) -> Node:
        opening = self.take()
        if token.text not in FUNCTIONS:
            known = [*FUNCTIONS, *EDGES, *WINDOWS]
            near = nearest(token.text, known)
            hint = f"did you mean `{near}`?" if near else f"there are {listed(known)}"
            raise fault("JDG206", f"there is no function called `{token.text}`", token.span, hint)
        operands = [number(self._deeper(self.expression), f"`{token.text}`")]
        while self.taken(","):
            operands.append(number(self._deeper(self.expression), f"`{token.text}`"))
        closing = self.need(")", "", opening)
        span = token.span.to(closing.span)
        self._count(token, len(operands), span)
        return Arithmetic(token.text, tuple(operands), span)

    def _count(self, token: Token, given: int, span: Span) -> None:
        wanted = FUNCTIONS[token.text]
        if given != wanted and (wanted or given < 2):
            takes = "one number" if wanted == 1 else "two numbers or more"
            raise fault("JDG206", f"`{token.text}` takes {takes}, and here are {given}", span)

    def _deeper(self, part: Callable[[], Node], more: int = 1) -> Node:
        """Parse a part one step deeper; of a chain, as many steps deeper as it has links."""
        self.depth += more
        if self.depth > DEEPEST:
            message = f"more than {DEEPEST} operators stand within each other"
            raise fault("JDG207", message, self.next.span, "make several requirements of it")
        found = part()
        self.depth -= more
        return found


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

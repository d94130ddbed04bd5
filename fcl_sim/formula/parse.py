"""Tokens → tree of arithmetic. Whether a name is known and a unit fits is the resolver's business.

The grammar stands in the docstrings of the parse functions, from the loosest
binding to the tightest.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from fcl_sim.diagnostics import Span, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.formula.functions import FUNCTIONS, Function
from fcl_sim.formula.text import fault
from fcl_sim.formula.tokens import Kind, Token
from fcl_sim.formula.tree import Arithmetic, Expression, Number, Signal
from fcl_sim.units import UnitError, parse_unit

DEEPEST = 30
LONGEST = 2_000
"""How many operators may stand within each other, and how many tokens a formula may have."""

Found = Any
"""An Expression, or what else there is in a language that builds on this one."""


class Parser:
    """A place among tokens.

    A language that builds on arithmetic says in `functions` which it has and in
    `calls` what else stands before a parenthesis; it overrides `inner`, what
    may stand in parentheses, `number` and `word`.
    """

    functions: Mapping[str, Function] = FUNCTIONS
    calls: tuple[str, ...] = ()
    instead_of_much = "make two of it"

    def __init__(self, tokens: tuple[Token, ...]) -> None:
        self.tokens = tokens
        self.at = 0
        self.depth = 0
        if len(tokens) > LONGEST:
            message = f"the formula has more than {LONGEST} words"
            raise fault("JDG207", message, tokens[LONGEST].span, self.instead_of_much)

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
        hint = self._whole_unit() or hint
        return fault("JDG201", f"{message}, before {self.next.shown}", self.next.span, hint)

    def ended(self, hint: str = "") -> None:
        """Find the end of the formula here, or else a fault."""
        if self.next.kind is not Kind.END:
            message = f"{self.next.shown} does not belong here: the formula has ended before it"
            raise fault("JDG201", message, self.next.span, self._whole_unit() or hint)

    def _whole_unit(self) -> str:
        """Return a hint where a blank parts the token that is looked at from the unit that it belongs to."""
        before = self.tokens[self.at - 1] if self.at else self.next
        if before.quantity is None or not before.quantity.unit.symbol or self.next.kind is not Kind.NAME:
            return ""
        try:
            parse_unit(self.next.text)
        except UnitError:
            return ""
        return f"a unit has no blanks in a formula: write `{before.text}*{self.next.text}`"

    def inner(self) -> Found:
        """Parse what may stand in parentheses."""
        return self.sum()

    def number(self, found: Found, where: str) -> Expression:  # noqa: ARG002  for those who override it
        """Return what was found, which must be a number; `where` says what takes it."""
        expression: Expression = found
        return expression

    def word(self, token: Token) -> Found:
        """Return what a name stands for."""
        return Signal(token.text, token.span)

    def sum(self) -> Found:
        """Parse: sum = product { ( "+" | "-" ) product } ."""
        return self._chain(("+", "-"), self.product)

    def product(self) -> Found:
        """Parse: product = factor { ( "*" | "/" ) factor } ."""
        return self._chain(("*", "/"), self.factor)

    def _chain(self, symbols: tuple[str, ...], part: Callable[[], Found]) -> Found:
        found, count = part(), 0
        while symbol := self.taken(*symbols):
            count += 1
            left = self.number(found, f"`{symbol.text}`")
            right = self.number(self.deeper(part, count), f"`{symbol.text}`")
            found = Arithmetic(symbol.text, (left, right), left.span.to(right.span))
        return found

    def factor(self) -> Found:
        """Parse the smallest parts.

        factor = "-" factor | quantity | signal | function "(" inner { "," inner } ")" | "(" inner ")"
        """
        token = self.take()
        if token.quantity is not None:
            return Number(token.quantity, token.span)
        if token.kind is Kind.QUOTED:
            return Signal(token.text, token.span)
        if token.kind is Kind.SYMBOL and token.text == "-":
            operand = self.number(self.deeper(self.factor), "`-`")
            if isinstance(operand, Number):
                quantity = operand.quantity
                return Number(replace(quantity, value=-quantity.value), token.span.to(operand.span))
            return Arithmetic("negative", (operand,), token.span.to(operand.span))
        if token.kind is Kind.SYMBOL and token.text == "(":
            found = self.deeper(self.inner)
            self.need(")", "", token)
            return found
        if token.kind is Kind.NAME:
            return self._call(token) if self.sees("(") else self.word(token)
        raise fault("JDG201", f"a number, a signal or `(` is wanted here, not {token.shown}", token.span)

    def _call(self, token: Token) -> Arithmetic:
        opening = self.take()
        if token.text not in self.functions:
            known = [*self.functions, *self.calls]
            near = nearest(token.text, known)
            hint = f"did you mean `{near}`?" if near else f"there are {listed(known)}"
            raise fault("JDG206", f"there is no function called `{token.text}`", token.span, hint)
        operands = [self._operand(token)]
        while self.taken(","):
            operands.append(self._operand(token))
        closing = self.need(")", "", opening)
        span = token.span.to(closing.span)
        self._count(token, len(operands), span)
        return Arithmetic(token.text, tuple(operands), span)

    def _operand(self, function: Token) -> Expression:
        return self.number(self.deeper(self.inner), f"`{function.text}`")

    def _count(self, token: Token, given: int, span: Span) -> None:
        wanted = self.functions[token.text].arguments
        if given != wanted and (wanted or given < 2):
            takes = {1: "one number", 2: "two numbers"}.get(wanted, "two numbers or more")
            raise fault("JDG206", f"`{token.text}` takes {takes}, and here are {given}", span)

    def deeper(self, part: Callable[[], Found], more: int = 1) -> Found:
        """Parse a part one step deeper; of a chain, as many steps deeper as it has links."""
        self.depth += more
        if self.depth > DEEPEST:
            message = f"more than {DEEPEST} operators stand within each other"
            raise fault("JDG207", message, self.next.span, self.instead_of_much)
        found = part()
        self.depth -= more
        return found

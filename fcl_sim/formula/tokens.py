"""Text of a formula → tokens. A number and its unit are one token, the path of a signal is one."""

import re
from collections.abc import Container, Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType

from fcl_sim.diagnostics import Span
from fcl_sim.formula.text import Text, fault
from fcl_sim.units import Quantity, UnitError, parse_quantity, parse_unit


class Kind(StrEnum):
    """What a token is."""

    NUMBER = "a number"
    NAME = "a name"
    QUOTED = "a name in backquotes"
    SYMBOL = "a symbol"
    END = "the end of the formula"


@dataclass(frozen=True, slots=True)
class Token:
    """A word of a formula; `quantity` is what a number says."""

    kind: Kind
    text: str
    span: Span
    quantity: Quantity | None = None

    @property
    def shown(self) -> str:
        """The token as a message names it."""
        return str(self.kind) if self.kind is Kind.END else f"`{self.text}`"


NAME = re.compile(r"[^\W\d]\w*(?:\.\w+)*")
"""The path of a signal that needs no backquotes."""

_TOKEN = re.compile(
    rf"""\s*(?:
      (?P<number>(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?)
    | (?P<name>{NAME.pattern})
    | `(?P<quoted>[^`\n]*)`
    | (?P<symbol><=|>=|==|!=|[-+*/<>()\[\],])
    | (?P<stray>\S)
    )""",
    re.VERBOSE,
)
_UNIT = re.compile(r"\s*(1/)?(?=[^\W\d_]|[%°])")
_FACTOR = re.compile(r"(?:[^\W\d_]+|%|°C?)(?:\^[+-]?\d{1,2}|\d{1,2})?(?![\w.(`])")
_JOIN = re.compile(r"[*/·]")

INSTEAD: Mapping[str, str] = MappingProxyType(
    {"−": "write the minus sign as `-`", "{": "write `(`", "}": "write `)`", "^": "write `pow(a, b)`"}
)
"""What to write in place of a character that has no meaning."""


def scan(text: Text, words: Container[str] = (), instead: Mapping[str, str] = INSTEAD) -> tuple[Token, ...]:
    """Return the tokens of a formula, `Kind.END` the last; InputFault at what is none.

    `words` are those that may stand behind a number and are no unit; `instead`
    says what to write in place of a character.
    """
    return tuple(_tokens(text, words, instead))


def _tokens(text: Text, words: Container[str], instead: Mapping[str, str]) -> Iterator[Token]:
    at, whole = 0, text.text
    while match := _TOKEN.match(whole, at):
        kind = str(match.lastgroup)
        start, at = match.start(kind), match.end()
        word = match[kind]
        if kind == "number":
            at, quantity = _quantity(text, start, at, words)
            yield Token(Kind.NUMBER, whole[start:at], text.span(start, at), quantity)
        elif kind == "stray":
            raise _stray(text, word, start, instead)
        else:
            start -= kind == "quoted"
            yield Token(Kind[kind.upper()], word, text.span(start, at))
    yield Token(Kind.END, "", text.span(len(whole), len(whole)))


def _stray(text: Text, word: str, start: int, instead: Mapping[str, str]) -> Exception:
    hint = instead.get(word, "")
    if word == "`":
        return fault("JDG201", "a name in backquotes is not closed", text.span(start, start + 1), hint)
    shown = f"`{word}`" if word.isprintable() else f"the character U+{ord(word):04X}"
    return fault("JDG201", f"{shown} has no meaning in a formula", text.span(start, start + 1), hint)


def _quantity(text: Text, start: int, end: int, words: Container[str]) -> tuple[int, Quantity]:
    """Return where a number ends with its unit, and what it says."""
    whole = text.text
    stop = _unit_end(whole, end, words)
    unit = whole[end:stop].strip().replace("·", "*")
    try:
        return stop, Quantity(parse_quantity(whole[start:end]).value, parse_unit(unit))
    except UnitError as error:
        begin = stop - len(whole[end:stop].lstrip()) if unit else start
        raise fault("JDG201", str(error), text.span(begin, stop), error.hint) from error


def _unit_end(whole: str, end: int, words: Container[str]) -> int:
    """Return where the unit behind a number ends: `end` where there is none.

    unit = [ "1/" ] power { ( "*" | "/" ) power } ; without blanks, since words
    and names follow numbers.
    """
    opening = _UNIT.match(whole, end)
    if opening is None:
        return end
    factor = _FACTOR.match(whole, opening.end())
    if factor is None or factor[0] in words:
        return end
    stop = factor.end()
    while (join := _JOIN.match(whole, stop)) and (factor := _FACTOR.match(whole, join.end())):
        if not _is_unit(factor[0]):
            break
        stop = factor.end()
    return stop


def _is_unit(word: str) -> bool:
    try:
        parse_unit(word)
    except UnitError:
        return False
    return True

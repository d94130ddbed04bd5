"""Requirements in words: a handful of sentences, and the formula that each stands for."""

from collections.abc import Callable, Mapping
from types import MappingProxyType

from fcl_sim.formula.tokens import Kind
from fcl_sim.judge.temporal.parse import RESERVED, Parser
from fcl_sim.judge.temporal.tree import TO_THE_END, Edge, Formula, Interval, Junction, Not, Until, Window


def sentence(words: Parser) -> Formula:
    """Parse a sentence, or a formula where none of their words stands.

    sentence = whenever | never | from | within | no | formula [ lasts ]
    """
    begun = words.taken(*BEGINNINGS) if words.next.kind is Kind.NAME else None
    if begun is not None:
        return BEGINNINGS[begun.text](words)
    found = words.formula()
    return _lasts(words, found) if words.taken("lasts") else found


def _whenever(words: Parser) -> Formula:
    """Parse a response.

    whenever = "whenever" formula [","] "then" [ "within" time ] formula [ for ]
    stands for: always (TRIGGER implies eventually[0 s, TIME] (always[0 s, HOLD] RESPONSE))
    """
    trigger = words.formula()
    words.taken(",")
    words.need("then", "behind the trigger")
    within = words.time() if words.taken("within") else None
    response = _held(words, words.formula())
    if within is not None:
        response = Window("eventually", Interval(0, within), response, response.span)
    span = trigger.span.to(response.span)
    return Window("always", TO_THE_END, Junction("implies", trigger, response, span), span)


def _never(words: Parser) -> Formula:
    """Parse what must not be: "never" formula ; stands for: always (not CONDITION)."""
    operand = words.formula()
    return Window("always", TO_THE_END, Not(operand, operand.span), operand.span)


def _from(words: Parser) -> Formula:
    """Parse what holds in a stretch of time.

    from = "from" time ( "on" | "to" time ) [","] formula
    stands for: always[TIME, end] CONDITION, or always[TIME, TIME] CONDITION
    """
    start = words.time()
    end = None
    if not words.taken("on"):
        words.need("to", "or `on`")
        end = words.time()
    words.taken(",")
    operand = words.formula()
    return Window("always", Interval(start, end), operand, operand.span)


def _within(words: Parser) -> Formula:
    """Parse what comes in time.

    within = "within" time [","] formula [ "for" "good" | for ]
    stands for: eventually[0 s, TIME] (always CONDITION), where it is for good
    """
    end = words.time()
    words.taken(",")
    operand = words.formula()
    held = _held(words, operand, good=True)
    return Window("eventually", Interval(0, end), held, operand.span)


def _held(words: Parser, operand: Formula, *, good: bool = False) -> Formula:
    """Parse: for = "for" "at" "least" time ."""
    if not words.taken("for"):
        return operand
    if good and words.taken("good"):
        return Window("always", TO_THE_END, operand, operand.span)
    words.need("at", "or `good`" if good else "behind `for`")
    words.need("least", "behind `at`")
    return Window("always", Interval(0, words.time()), operand, operand.span)


def _no(words: Parser) -> Formula:
    """Parse an order of events.

    no = "no" formula "before" formula
    stands for: (not EVENT) until FIRST or always (not EVENT)
    """
    event = words.formula()
    words.need("before", "behind the event")
    first = words.formula()
    absent = Not(event, event.span)
    span = event.span.to(first.span)
    return Junction(
        "or", Until(TO_THE_END, absent, first, span), Window("always", TO_THE_END, absent, span), span
    )


def _lasts(words: Parser, state: Formula) -> Formula:
    """Parse how long a state lasts once it begins.

    lasts = "lasts" "at" ( "least" | "most" ) time
    stands for: always (rise(STATE) implies always[0 s, TIME] STATE),
    or: always (STATE implies eventually[0 s, TIME] (not STATE))
    """
    words.need("at", "behind `lasts`")
    word = words.taken("least", "most")
    if word is None:
        raise words.unexpected("`least` or `most` is missing")
    interval, span = Interval(0, words.time()), state.span
    if word.text == "least":
        trigger: Formula = Edge("rise", state, span)
        outcome: Formula = Window("always", interval, state, span)
    else:
        trigger, outcome = state, Window("eventually", interval, Not(state, span), span)
    return Window("always", TO_THE_END, Junction("implies", trigger, outcome, span), span)


BEGINNINGS: Mapping[str, Callable[[Parser], Formula]] = MappingProxyType(
    {"whenever": _whenever, "never": _never, "from": _from, "within": _within, "no": _no}
)
"""The words that begin a sentence; a signal of that name stands in backquotes."""

QUOTED = RESERVED | BEGINNINGS.keys()
"""Names of signals that are written in backquotes."""

"""Numbers, units and names as a reader wants them."""

import math
import re
from collections.abc import Sequence
from decimal import Decimal

from fcl_sim.judge import wording
from fcl_sim.judge.formulae import margin_told
from fcl_sim.judge.verdict import Requirement, Status, Verdict
from fcl_sim.loop.trace import Fault

MINUS = "\N{MINUS SIGN}"
NO_BREAK = "\N{NO-BREAK SPACE}"

EXPONENT = re.compile(r"e\+?(-?)0*")

BLANKS = re.compile(f"[^\\S{NO_BREAK}]+")
"""Blanks and ends of lines, at which a line may be broken."""

QUANTITY = re.compile(r"(?<![\w.-])(-?\d[\d.]*(?:e[+-]?\d+)?)( (?=[^\W\d]|[%°]))?")
"""A number, and the blank before its unit."""

WRITTEN, COMPUTED = 12, 9
"""A number of more digits than anybody writes was computed, and is told with so many."""

MILLION = 1e6
"""Below this a number has no exponent, be it rounded to fewer digits: `14410` reads better than `1.441e4`."""

CUT, LEAST = 6, 1e-5
"""A decimal of so many digits, and no less than this, may be a fraction cut off."""

BIG = 1e5
SCALED = re.compile(r"(W|J|N|Pa|Hz|Wh)(?![A-Za-z0-9])")
SCALED_BY = (("G", 9), ("M", 6), ("k", 3))
"""Units in which nobody writes numbers as large as these, and what is written instead."""

CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff\ufffe\uffff]")
"""Characters that no page can show: a TOML key or an FCL comment may hold them."""


def plain(text: str) -> str:
    """Return text that a page can show: control characters become U+FFFD, tabs four blanks."""
    return CONTROL.sub("\N{REPLACEMENT CHARACTER}", text.replace("\r\n", "\n").replace("\t", "    "))


def one_line(text: str) -> str:
    """Return text on one line, as a label or a table's cell needs it; what must not part stays together."""
    return BLANKS.sub(" ", plain(text)).strip()


def number(value: float, digits: int = 4) -> str:
    """Return a number for a reader: `digits` significant figures, a true minus sign, no `-0`."""
    if not math.isfinite(value):
        return "not a number" if math.isnan(value) else f"{MINUS if value < 0 else ''}∞"
    rounded = f"{value:.{digits}g}"
    plainly = "e+" in rounded and abs(value) < MILLION
    return printed(f"{float(rounded):.0f}" if plainly else rounded) if value else "0"


INTEGRALS = ("iae", "ise", "itae", "itse")
"""Metrics that are known by the letters of their names."""


def metric_name(metric: str) -> str:
    """Return a metric as it is called in a sentence."""
    return metric.upper() if metric in INTEGRALS else metric.replace("_", " ")


def with_unit(value: float, unit: str, digits: int = 4) -> str:
    """Return a number with its unit, which it does not part from; a pure number shows none."""
    return _joined(number(value, digits), unit)


def exactly(value: float, unit: str) -> str:
    """Return a number that the user wrote with all its digits, and its unit; a computed one is rounded."""
    digits = wording.exactly(value, "")
    if sum(each.isdigit() for each in EXPONENT.split(digits)[0].lstrip("-0.")) > WRITTEN:
        digits = wording.exactly(float(f"{value:.{COMPUTED}g}"), "")
    return _joined(printed(digits), unit)


def readably(value: float, unit: str) -> str:
    """Return what `exactly` does, digit for digit, in the unit that takes the fewest zeros: `1.1 MW`.

    A decimal that is a fraction cut off is told as the fraction, `1/600 Hz`.
    """
    digits = repr(float(value)).partition("e")[0].lstrip("-0.").replace(".", "").rstrip("0")
    if CUT <= len(digits) <= WRITTEN and unit not in {"", "1"} and "/" not in unit and LEAST < value < 1.0:
        whole = round(1.0 / value)
        if float(f"{1.0 / whole:.{len(digits)}g}") == value:
            return _joined(f"1/{whole}", unit)
    if SCALED.match(unit) and BIG <= abs(value) < math.inf:
        prefix, power = next(each for each in SCALED_BY if abs(value) >= 10 ** each[1])
        return exactly(float(Decimal(repr(float(value))).scaleb(-power)), f"{prefix}{unit}")
    return exactly(value, unit)


def printed(digits: str) -> str:
    """Return a number of Python's as it is printed: `1e-05` as `1e−5`."""
    return EXPONENT.sub(r"e\1", digits).replace("-", MINUS)


def together(text: str) -> str:
    """Return text whose numbers have a true minus sign and do not part from their units; code stays code."""
    parts = text.split("`")
    told = [each if at % 2 else QUANTITY.sub(_quantity, each) for at, each in enumerate(parts)]
    return "`".join(told)


def _quantity(found: re.Match[str]) -> str:
    return printed(found[1]) + (NO_BREAK if found[2] else "")


def _joined(digits: str, unit: str) -> str:
    return digits + ("" if unit in {"", "1"} else f"{NO_BREAK}{one_line(unit)}")


def bracketed(name: str, unit: str) -> str:
    """Return the label of an axis: the name and its unit, `[1]` where it has none."""
    return f"{one_line(name)} [{one_line(unit) or '1'}]"


def bound(requirement: Requirement) -> str:
    """Return what a requirement asks of its metric: `at most 35 s`, `−1 m to 1 m`; or what else it asks."""
    if requirement.formula is not None:
        return "the formula holds"
    if requirement.corridor is not None:
        return "inside of it"
    low, high, unit = requirement.minimum, requirement.maximum, requirement.unit
    if low is not None and high is not None:
        return (
            f"{exactly(low, unit)} to {exactly(high, unit)}"
            if low != high
            else f"exactly {exactly(low, unit)}"
        )
    if high is not None:
        return f"at most {exactly(high, unit)}"
    return "no bound" if low is None else f"at least {exactly(low, unit)}"


def value(verdict: Verdict) -> str:
    """Return what was measured, to as many digits as tell it from its bound; a dash where nothing was.

    Of a formula over several units it is the margin of the comparison that decided.
    """
    if verdict.value is not None:
        return figure(verdict.requirement, verdict.value)
    margin = "" if verdict.requirement.formula is None else margin_told(verdict.reason)
    return f"margin{NO_BREAK}{together(margin)}" if margin else "\N{EM DASH}"


def figure(asked: Requirement, measured: float) -> str:
    """Return a figure of a requirement, to as many digits as tell it from its bound; a margin says so."""
    limits = [each for each in (asked.minimum, asked.maximum) if each is not None]
    near = min(limits, key=lambda each: abs(each - measured), default=None)
    if asked.formula is not None or asked.corridor is not None:
        return f"margin{NO_BREAK}{_joined(printed(wording.number(measured, near=0.0)), asked.unit)}"
    return _joined(printed(wording.number(measured, near=near)), asked.unit)


def expectation(verdict: Verdict) -> str:
    """Return how a requirement came out that is expected to fail and did not; nothing for the others."""
    if not verdict.requirement.expect_fail or verdict.status is Status.PASS:
        return ""
    if verdict.measured is Status.PASS:
        return "met, though expected to fail"
    return f"expected to fail; measured {verdict.measured}"


def counted(count: int, noun: str, plural: str = "") -> str:
    """Return a count with its noun: `1 run`, `4 runs`."""
    return f"{count} {noun}" if count == 1 else f"{count} {plural or noun + 's'}"


def joined(words: Sequence[str]) -> str:
    """Return words as a sentence lists them: `a, b and c`."""
    if len(words) < 2:
        return "".join(words)
    return ", ".join(words[:-1]) + " and " + words[-1]


def ending(fault: Fault) -> str:
    """Return how a run ended early: the time, the signal, the reason."""
    at = with_unit(fault.tick / 1e9, "s", 9)
    return f"FAULT: the run ended at {at}, at {one_line(fault.signal)}: {one_line(fault.reason)}"

"""The sentences of a verdict: number, unit, bound and signal, for a reader of the report."""

from fcl_sim.judge.metric import WINDOW, Kind, Metric
from fcl_sim.judge.verdict import Corridor, Form, Relative, Requirement
from fcl_sim.units import parse_unit, short

DIGITS = 4
MOST_DIGITS = 17


def number(value: float, unit: str = "", near: float | None = None) -> str:
    """Return `value` to four digits with its unit; to more where it would seem beyond `near`."""
    digits = DIGITS
    while near is not None and digits < MOST_DIGITS and not _in_place(value, near, digits):
        digits += 1
    return f"{_digits(value, digits)} {unit}".rstrip()


def _digits(value: float, digits: int) -> str:
    return short(float(f"{value:.{digits}g}"))


def _in_place(value: float, near: float, digits: int) -> bool:
    shown = float(f"{value:.{digits}g}")
    return (shown < near, shown > near) == (value < near, value > near)


def bound(requirement: Requirement) -> str:
    """Return what is required, in words: `at most 35 s is allowed`."""
    low, high, unit = requirement.minimum, requirement.maximum, requirement.unit
    if low is not None and high is not None:
        return f"{short(low)} to {exactly(high, unit)} is required"
    if high is not None:
        return f"at most {exactly(high, unit)} is allowed"
    if low is not None:
        return f"at least {exactly(low, unit)} is required"
    return "nothing is required"


def exactly(value: float, unit: str) -> str:
    """Return a number that the user wrote, as it was written, with its unit."""
    return f"{short(value)} {unit}".rstrip()


def seconds(time: float) -> str:
    """Return a time of the trace: what its clock says, not rounded."""
    return exactly(time, "s")


def apart(unit: str) -> str:
    """Return the unit of a difference of two values in `unit`: K of degC."""
    return parse_unit(unit).difference.symbol


def definition(metric: Metric, requirement: Requirement, signal_unit: str) -> str:
    """Return the metric in words, with the arguments that this requirement gives or leaves."""
    units = {Kind.SIGNAL: signal_unit, Kind.DIFFERENCE: apart(signal_unit), Kind.TIME: "s", Kind.NUMBER: ""}
    given = []
    for each in (*metric.arguments, *WINDOW):
        default = each.default if each in metric.arguments else None
        value = requirement.arguments.get(each.name, default)
        if value is not None:
            given.append(f"{each.name} = {exactly(value, units[each.kind])}")
    if requirement.restart_at:
        times = ", ".join(short(each) for each in requirement.restart_at)
        given.append(f"restart_at = {times} s")
    return f"{metric.definition}; {', '.join(given)}" if given else metric.definition


def corridor(asked: Corridor) -> str:
    """Return what the margin of a corridor is."""
    first, last = (seconds(each / 1e9) for each in (asked.ticks[0], asked.ticks[-1]))
    return (
        f"smallest distance of the signal from the edges in {asked.name}, negative outside of them, "
        f"at the scans from {first} to {last}; the edges are linear between the rows of the table"
    )


def relation(relative: Relative) -> str:
    """Return what is bounded instead of a figure alone."""
    to = "to" if relative.form is Form.RATIO else "from"
    return f"{relative.form} {to} that of the run `{relative.variant}`"


def finding(metric: Metric, requirement: Requirement, value: float) -> str:
    """Return what was measured and what is required, without a full stop."""
    limits = [each for each in (requirement.minimum, requirement.maximum) if each is not None]
    near = min(limits, key=lambda each: abs(each - value), default=None)
    shown = number(value, requirement.unit, near)
    return f"the {metric.words} of {requirement.signal} is {shown}; {bound(requirement)}"


def never(metric: Metric, requirement: Requirement, end: float, last: str) -> str:
    """Return that what is timed does not happen; `last` is the signal's value at `end` seconds."""
    at = f"at {seconds(end)} it is at {last}"
    return f"{requirement.signal} does not {metric.never}: {at}; {bound(requirement)}"


def as_sentence(text: str, requirement: Requirement) -> str:
    """Return text with a capital and a full stop; a signal keeps its letter case."""
    if requirement.formula is None and text.startswith(requirement.signals):
        return f"{text}."
    return f"{text[0].upper()}{text[1:]}."

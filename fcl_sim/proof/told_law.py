"""The control law in words and as JSON's types."""

from collections.abc import Iterator, Mapping
from math import isfinite
from typing import Any

from fcl_sim.proof.law import Course, Extreme, Gain, OutputLaw
from fcl_sim.proof.universe import Universe

Json = dict[str, Any]


def law_lines(law: OutputLaw, universe: Universe) -> Iterator[str]:
    """Yield the lines on one output."""
    if law.unknown or law.least is None or law.most is None:
        yield f"  {law.output}: its law is not bounded: {law.unknown}"
        return
    yield f"  {law.output}: {_end(law.least, 'below')} to {_end(law.most, 'above')}"
    yield f"    least at {_point(law.least.at)}; most at {_point(law.most.at)}"
    for each in law.gains:
        yield f"    along {each.variable}: {_course(each)}; {_steepest(each, universe)}"
    if law.at_zero is not None:
        symmetry = f"; {law.symmetry} around it, by samples" if law.symmetry else ""
        yield f"    {_number(law.at_zero)} where all inputs are 0{symmetry}"
    for zone in law.dead_zones:
        ends = f"{_number(zone.low)} to {_number(zone.high)}"
        yield f"    the same for {zone.variable} from {ends}, the others being 0 (by samples)"


def _end(end: Extreme, beyond: str) -> str:
    if end.is_exact:
        return _number(end.reached)
    return f"{_number(end.reached)} (nowhere {beyond} {_number(end.bound)})"


def _course(gain: Gain) -> str:
    if gain.course is Course.BOTH:
        up, down = gain.shown
        return f"rises (at {_point(up)}) and falls (at {_point(down)})"
    proved = "" if gain.course is Course.OPEN else ", proved"
    return f"{gain.course}{proved}"


def _steepest(gain: Gain, universe: Universe) -> str:
    unit = universe.unit(gain.variable)
    per = f" per {unit}" if unit else ""
    end = gain.steepest
    if not isfinite(end.bound):
        return f"no bound on its slope: it may jump, as near {_point(end.at)}"
    if end.is_exact:
        return f"at most {_number(abs(end.reached))}{per}, at {_point(end.at)}"
    return f"{_number(abs(end.reached))}{per} at {_point(end.at)}, nowhere above {_number(end.bound)}{per}"


def _number(value: float) -> str:
    return f"{value + 0.0:.5g}"


def _point(point: Mapping[str, float]) -> str:
    return " ".join(f"{name}={_number(value)}" for name, value in point.items())


def law_json(law: OutputLaw) -> Json:
    """Return a law as JSON's types; what has no bound is null."""
    return {
        "output": law.output,
        "unknown": law.unknown,
        "least": extreme_json(law.least),
        "most": extreme_json(law.most),
        "gains": [_gain(each) for each in law.gains],
        "at_zero": law.at_zero,
        "symmetry": law.symmetry,
        "dead_zones": [
            {"variable": each.variable, "low": each.low, "high": each.high} for each in law.dead_zones
        ],
    }


def extreme_json(end: Extreme | None) -> Json | None:
    """Return a largest or least value as JSON's types."""
    if end is None:
        return None
    bound = end.bound if isfinite(end.bound) else None
    reached = end.reached if isfinite(end.reached) else None
    certainty = "exact" if end.is_exact else "bounded"
    return {"reached": reached, "bound": bound, "certainty": certainty, "witness": dict(end.at)}


def _gain(gain: Gain) -> Json:
    return {
        "variable": gain.variable,
        "steepest": extreme_json(gain.steepest),
        "course": str(gain.course),
        "witnesses": [dict(each) for each in gain.shown],
    }

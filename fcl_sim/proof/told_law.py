"""The control law in words and as JSON's types."""

from collections.abc import Iterator, Mapping
from math import isfinite
from typing import Any

from fcl_sim.proof.finding import boxes_json
from fcl_sim.proof.jumps import Jump
from fcl_sim.proof.law import Course, DeadZone, Extreme, Gain, OutputLaw
from fcl_sim.proof.saturation import Saturation
from fcl_sim.proof.universe import Universe
from fcl_sim.proof.words import box, percent

Json = dict[str, Any]

SHOWN = 2
"""Boxes that a line names."""


def law_lines(law: OutputLaw, universe: Universe) -> Iterator[str]:
    """Yield the lines on one output."""
    if law.unknown or law.least is None or law.most is None:
        yield f"  {law.output}: its law is not bounded: {law.unknown}"
        return
    yield f"  {law.output}: {_end(law.least, 'below')} to {_end(law.most, 'above')}"
    yield f"    least at {_point(law.least.at)}; most at {_point(law.most.at)}"
    for each in law.gains:
        yield f"    along {each.variable}: {_course(each)}; {_steepest(each, universe)}"
    yield from (f"    {_jump(each, universe)}" for each in law.jumps)
    yield from (f"    {_saturation(each, universe)}" for each in law.saturations)
    if law.at_zero is not None:
        sure = "proved" if law.is_symmetry_proved else "by samples"
        symmetry = f"; {law.symmetry} around it, {sure}" if law.symmetry else ""
        yield f"    {_number(law.at_zero)} where all inputs are 0{symmetry}"
    for zone in law.dead_zones:
        ends = f"{_number(zone.low)} to {_number(zone.high)}"
        sure = "exactly" if zone.is_exact else "by samples"
        yield f"    the same for {zone.variable} from {ends}, the others being 0 ({sure})"


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
        return "no bound on its slope"
    if end.is_exact:
        return f"at most {_number(abs(end.reached))}{per}, at {_point(end.at)}"
    return f"{_number(abs(end.reached))}{per} at {_point(end.at)}, nowhere above {_number(end.bound)}{per}"


def _jump(jump: Jump, universe: Universe) -> str:
    unit = universe.unit(jump.variable)
    side = f", where no rule is active {jump.without} it" if jump.without else ""
    how = "" if jump.is_exact else ", by halving"
    at = f"{jump.variable} = {_number(jump.at[jump.variable])}{f' {unit}' if unit else ''}"
    rest = {name: value for name, value in jump.at.items() if name != jump.variable}
    others = f" with {_point(rest)}" if rest else ""
    values = f"from {_number(jump.before)} to {_number(jump.behind)}"
    return f"jumps along {jump.variable} by {_number(jump.height)}, {values}, at {at}{others}{side}{how}"


def _saturation(own: Saturation, universe: Universe) -> str:
    part = "" if own.share is None else f" in {percent(own.share)} of the universe"
    told = [box(each.sides, universe) for each in own.boxes[:SHOWN]]
    rest = "" if len(own.boxes) <= SHOWN and not own.more else "; and more"
    return f"stays at {_number(own.value)}{part}: {'; '.join(told)}{rest}"


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
        "symmetry_proved": law.is_symmetry_proved,
        "dead_zones": [_dead_zone(each) for each in law.dead_zones],
        "jumps": [_jump_json(each) for each in law.jumps],
        "saturations": [_saturation_json(each) for each in law.saturations],
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


def _dead_zone(zone: DeadZone) -> Json:
    certainty = "exact" if zone.is_exact else "sampled"
    return {"variable": zone.variable, "low": zone.low, "high": zone.high, "certainty": certainty}


def _jump_json(jump: Jump) -> Json:
    return {
        "variable": jump.variable,
        "before": jump.before,
        "behind": jump.behind,
        "without": jump.without,
        "certainty": "exact" if jump.is_exact else "sampled",
        "witness": dict(jump.at),
    }


def _saturation_json(own: Saturation) -> Json:
    return {
        "value": own.value,
        "share": None if own.share is None else float(own.share),
        "share_exact": None if own.share is None else str(own.share),
        "boxes": boxes_json(own.boxes),
        "more_boxes": own.more,
    }

"""Alternative texts of pictures, written from the data that they show."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from fcl_sim.engine.smooth import degrees_at, sight, turns
from fcl_sim.judge.verdict import Verdict
from fcl_sim.loop.trace import Values
from fcl_sim.model import Curve as Smooth
from fcl_sim.model import CurveKind, Singleton, Singletons, Term
from fcl_sim.report.memberships import Panel
from fcl_sim.report.sampling import Curve, Surface, Track
from fcl_sim.report.terms import DRAWN, points_of
from fcl_sim.report.time_plots import Lane, Shown
from fcl_sim.report.words import counted, joined, number, one_line, with_unit

TWO_SIGMOIDS = ("gain", "inflection", "gain", "inflection")
NAMES: Mapping[CurveKind, tuple[str, ...]] = MappingProxyType(
    {
        CurveKind.GAUSSIAN: ("mean", "deviation"),
        CurveKind.GAUSSIAN_PRODUCT: ("left mean", "deviation", "right mean", "deviation"),
        CurveKind.BELL: ("half width", "slope", "centre"),
        CurveKind.SIGMOID: ("gain", "inflection"),
        CurveKind.SIGMOID_DIFFERENCE: TWO_SIGMOIDS,
        CurveKind.SIGMOID_DISTANCE: TWO_SIGMOIDS,
        CurveKind.SIGMOID_PRODUCT: TWO_SIGMOIDS,
        CurveKind.COSINE: ("half width", "centre"),
        CurveKind.Z_SHAPE: ("start", "end"),
        CurveKind.S_SHAPE: ("start", "end"),
        CurveKind.PI_SHAPE: ("rise from", "to", "fall from", "to"),
        CurveKind.SPIKE: ("centre", "width"),
        CurveKind.CONCAVE: ("inflection", "end"),
    }
)
"""What the parameters of a curve are called."""
LEVEL = 1e-9
"""Degrees that differ less are one."""


def of_runs(runs: Sequence[Shown], shown: Sequence[Lane]) -> str:
    """Return what a time plot shows: of each signal start, end and range, of each verdict how it came out."""
    labels = joined([one_line(run.label) for run in runs])
    end = max(run.duration for run in runs)
    parts = [f"{counted(len(shown), 'time plot')} over {with_unit(end, 's')}, run {labels}."]
    for run in runs:
        prefix = f"{one_line(run.label)}: " if len(runs) > 1 else ""
        plotted = [lane for lane in shown if lane.focus is None and lane.signal in run.trace]
        parts += [f"{prefix}{_course(lane, run.trace[lane.signal])}" for lane in plotted]
        names = {name for lane in shown for name in lane.names}
        parts += [
            f"{prefix}{_verdict(each)}"
            for each in run.verdicts
            if not names.isdisjoint(each.requirement.signals)
        ]
        if run.trace.fault is not None:
            fault = run.trace.fault
            parts.append(f"{prefix}FAULT at {with_unit(fault.tick / 1e9, 's', 9)}: {one_line(fault.reason)}.")
    return " ".join(parts)


def _course(lane: Lane, values: Values) -> str:
    finite = values[np.isfinite(values)]
    name = one_line(lane.signal)
    if not len(finite):
        return f"{name} has no value."
    ends = f"from {with_unit(float(finite[0]), lane.unit)} to {with_unit(float(finite[-1]), lane.unit)}"
    return f"{name} goes {ends}, {_between(finite, lane.unit)}."


def _verdict(verdict: Verdict) -> str:
    text = f"{one_line(verdict.requirement.id)}: {verdict.status}"
    if verdict.measured is not verdict.status:
        text += f", measured {verdict.measured}"
    if verdict.violation is not None:
        start, end = (with_unit(each, "s") for each in verdict.violation)
        text += f", violated from {start} to {end}"
    return text + "."


def of_surfaces(surfaces: Sequence[Surface], fixed: Mapping[str, float], track: Track | None) -> str:
    """Return what heat maps show: ranges, how much is undefined, where the run begins and ends."""
    first = surfaces[0]
    across, up = one_line(first.across.name), one_line(first.up.name)
    parts = [f"Heat map of {one_line(first.name)} over {across} and {up}."]
    if fixed:
        parts.append(
            "Held: " + joined([f"{one_line(name)} at {number(at)}" for name, at in fixed.items()]) + "."
        )
    for surface in surfaces:
        where = (
            f"{across} {_range(surface.x, surface.across.unit)}, {up} {_range(surface.y, surface.up.unit)}"
        )
        parts.append(f"{surface.title.capitalize()}, {where}: {_levels(surface)}.")
    if track is not None and len(track.x):
        parts.append(_way(track, first.across.unit, first.up.unit))
    return " ".join(parts)


def _levels(surface: Surface) -> str:
    area = np.diff(surface.y)[:, None] * np.diff(surface.x)[None, :]
    share = float(area[surface.undefined].sum() / area.sum())
    undefined = f"no rule is active on {number(100.0 * share, 3)} % of it"
    defined = surface.values[~surface.undefined & np.isfinite(surface.values)]
    if not len(defined):
        return undefined
    return f"{_between(defined, surface.unit)}, {undefined}"


def _between(values: Values, unit: str) -> str:
    return f"between {number(float(values.min()))} and {with_unit(float(values.max()), unit)}"


def of_curve(curve: Curve, track: Track | None) -> str:
    """Return what a characteristic curve shows."""
    x = one_line(curve.across.name)
    parts = [f"Curve of {one_line(curve.name)} over {x}, {_range(curve.x, curve.across.unit)}."]
    defined = curve.values[~curve.undefined & np.isfinite(curve.values)]
    if len(defined):
        parts.append(f"It lies {_between(defined, curve.unit)}.")
    if curve.undefined.any():
        parts.append("Where it is hatched, no rule is active.")
    if track is not None and len(track.x):
        parts.append(_way(track, curve.across.unit, curve.unit))
    return " ".join(parts)


def _way(track: Track, x_unit: str, y_unit: str) -> str:
    start, end = (
        f"{with_unit(float(track.x[at]), x_unit)}, {with_unit(float(track.y[at]), y_unit)}" for at in (0, -1)
    )
    return f"The run goes from ({start}) to ({end})."


def _range(values: Values | NDArray[np.float64], unit: str) -> str:
    return f"from {number(float(values[0]))} to {with_unit(float(values[-1]), unit)}"


def of_memberships(shown: Sequence[Panel]) -> str:
    """Return the terms of each variable with their points, and the ranges visited."""
    return " ".join(_panel(panel) for panel in shown)


def _panel(panel: Panel) -> str:
    terms = [f"{one_line(term.name)} {_shape(term)}" for term in panel.terms]
    terms += [f"{formula}, calculated at each evaluation" for formula in panel.formulae]
    visits = "".join(
        f" Visited by {one_line(each.label)}: {number(each.low)} to {with_unit(each.high, panel.unit)}."
        for each in panel.visits
    )
    told = "; ".join(terms) or "no terms"
    return f"{panel.role.capitalize()} {one_line(panel.variable)}: {told}.{visits}"


def _shape(term: Term) -> str:
    shape = term.shape
    if isinstance(shape, Singleton):
        return f"at {number(float(shape.value))}"
    if isinstance(shape, Smooth):
        return _smooth(shape)
    points = shape.points if isinstance(shape, Singletons) else points_of(term)
    return " ".join(f"({number(float(point.x))}, {number(point.degree)})" for point in points)


def _smooth(curve: Smooth) -> str:
    """Return kind and parameters of a curve, and where it is highest of what a picture shows."""
    low, high = sight(curve)
    xs = np.unique(np.array([*np.linspace(low, high, DRAWN), *turns(curve)]))
    degrees = degrees_at(curve, xs)
    top = float(degrees.max())
    highest = xs[degrees >= top - LEVEL]
    ends = list(dict.fromkeys(number(float(x)) for x in (highest[0], highest[-1])))
    named = zip(NAMES[curve.kind], curve.parameters, strict=False)
    parameters = ", ".join(f"{name} {number(float(value))}" for name, value in named)
    seen = f"seen from {number(low)} to {number(high)}"
    return f"{curve.kind}, {parameters}; {seen}, highest, {number(top)}, at {' to '.join(ends)}"

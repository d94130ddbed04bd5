"""Which pictures a fuzzy block gets: its terms, and each output over its inputs."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from fcl_sim.block import Block
from fcl_sim.loop.trace import FuzzyRecord, Values
from fcl_sim.report import alt, exits, sampling
from fcl_sim.report.memberships import Visit, membership_plot, panels, parted
from fcl_sim.report.pictures import Picture, numbered
from fcl_sim.report.provenance import fuzzy_nodes
from fcl_sim.report.ranges import width
from fcl_sim.report.sampling import Domain, Surface, Track
from fcl_sim.report.surface import curve_plot, surface_plot
from fcl_sim.report.terms import as_seen, moves
from fcl_sim.report.words import joined, number, one_line, with_unit
from fcl_sim.testbench import Run

MOST_BARS = 6
"""Runs whose visited ranges are told apart; more are drawn as one."""

SWEEP = 41
"""Places at which an output is asked how far an input moves it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Subject:
    """An output of a block; of a run what it saw, by input, and gave, and where a rule was active, (n,).

    `known` is what the run saw that tells which inputs are drawn, and where the others are held.
    """

    block: Block
    output: str
    unit: str
    inputs: tuple[Domain, ...]
    seen: Mapping[str, Values]
    known: Mapping[str, Values]
    given: Values
    active: NDArray[np.bool_]
    time: Values
    name: str


def over_inputs(run: Run) -> list[Picture]:
    """Return each output of each fuzzy block over its inputs, with the run drawn over it."""
    return [
        replace(each, caption=f"Run {one_line(run.variant)}: {each.caption}")
        for node in fuzzy_nodes(run)
        for each in characteristic(
            node.block,
            node.units,
            f"{run.variant}-{node.name}",
            run.trace.fuzzy.get(node.name),
            run.trace.time,
        )
    ]


def characteristic(
    block: Block,
    units: Mapping[str, str],
    stem: str,
    record: FuzzyRecord | None = None,
    time: Values | None = None,
    held: FuzzyRecord | None = None,
) -> list[Picture]:
    """Return a picture of each output over its inputs, with the run of `record` drawn over it.

    Two inputs make a map, one a curve. Of more, the two that move the output most
    are drawn and the others held at their medians in that run, or in the one `held`,
    or in the middle; without a run to draw, a map stands beside the surface in space.
    Nothing is drawn of a block without inputs.
    `time` (n,) are the seconds of the run.
    """
    inputs = sampling.domains(as_seen(block.function_block, record or held), units)
    unit_of = {name.casefold(): unit for name, unit in units.items()}
    seen = {} if record is None else _seen(record, inputs)
    known = seen if held is None else _seen(held, inputs)
    pictures = []
    for column, output in enumerate(block.outputs):
        subject = Subject(
            block=block,
            output=output,
            unit=unit_of.get(output.casefold(), ""),
            inputs=inputs,
            seen=seen,
            known=known,
            given=record.outputs[:, column] if record else np.zeros(0),
            active=record.active[:, column] if record else np.zeros(0, dtype=bool),
            time=np.zeros(0) if time is None else time,
            name=stem if len(block.outputs) == 1 else f"{stem}-{output}",
        )
        if inputs:
            pictures.append(_curve(subject) if len(inputs) == 1 else _map(subject))
    return pictures


def _seen(record: FuzzyRecord, inputs: Sequence[Domain]) -> dict[str, Values]:
    """Return what a run saw, by input; letter case is ignored."""
    columns = {name.casefold(): column for column, name in enumerate(record.input_names)}
    return {each.name: record.inputs[:, columns[each.name.casefold()]] for each in inputs}


def _curve(subject: Subject) -> Picture:
    across, track = subject.inputs[0], None
    if subject.seen:
        across = sampling.following(across, subject.seen[across.name])
        track = Track(subject.seen[across.name], subject.given, subject.active, subject.time)
    line = sampling.curve(subject.block, subject.output, across, {}, subject.unit)
    caption = [f"{one_line(subject.output)} over {one_line(across.name)}."]
    if line.undefined.any():
        caption.append("Hatched: no rule is active.")
    if track is not None:
        caption.append(exits.told(track.x, track.y, (across.low, across.high), (-np.inf, np.inf)))
    return Picture(
        name=subject.name,
        caption=" ".join(caption).rstrip(),
        alt=alt.of_curve(line, track),
        draw=partial(curve_plot, line, track),
    )


def _map(subject: Subject) -> Picture:
    plane, fixed = plane_of(subject)
    track, near = None, None
    if subject.seen:
        paths = [subject.seen[each.name] for each in plane]
        track = Track(paths[0], paths[1], subject.active, subject.time)
        plane = [sampling.following(each, path) for each, path in zip(plane, paths, strict=True)]
        near = sampling.closer(plane, paths)
    views = [(plane, "all terms"), *([(near, "where the run went")] if near else [])]
    maps = [
        sampling.surface(subject.block, subject.output, (across, up), fixed, subject.unit, title)
        for (across, up), title in views
    ]
    return Picture(
        name=subject.name,
        caption=_caption(maps[0], _held(subject, fixed), track, known=bool(subject.known)),
        alt=alt.of_surfaces(maps, fixed, track),
        draw=partial(surface_plot, maps, track, in_space=track is None),
    )


def plane_of(subject: Subject) -> tuple[list[Domain], dict[str, float]]:
    """Return the two inputs that move the output most, each alone, and the values of the others."""
    middles = {each.name: _middle(each, subject.known) for each in subject.inputs}
    weight = {
        each.name: (_effect(subject, each, middles), _moved(each, subject.known)) for each in subject.inputs
    }
    chosen = sorted(subject.inputs, key=lambda each: weight[each.name], reverse=True)[:2]
    fixed = {each.name: middles[each.name] for each in subject.inputs if each not in chosen}
    return [each for each in subject.inputs if each in chosen], fixed


def _effect(subject: Subject, domain: Domain, middles: Mapping[str, float]) -> float:
    """Return how far an input moves the output over what was seen of it, with the others in their middles."""
    if len(subject.inputs) < 3:
        return 0.0
    finite = _finite(subject.known, domain.name)
    ends = (float(finite.min()), float(finite.max())) if len(finite) else (domain.low, domain.high)
    point: dict[str, float | Values] = {**middles, domain.name: np.linspace(*ends, SWEEP)}
    found = subject.block.evaluation(point).outputs[subject.output]
    told = found[np.isfinite(found)]
    return width(told)


def _moved(domain: Domain, seen: Mapping[str, Values]) -> float:
    finite = _finite(seen, domain.name)
    return width(finite) / (domain.high - domain.low)


def _middle(domain: Domain, seen: Mapping[str, Values]) -> float:
    finite = _finite(seen, domain.name)
    return float(np.median(finite)) if len(finite) else (domain.low + domain.high) / 2.0


def _finite(seen: Mapping[str, Values], name: str) -> Values:
    values = seen.get(name, np.zeros(0))
    return values[np.isfinite(values)]


def _held(subject: Subject, fixed: Mapping[str, float]) -> list[str]:
    """Return the values at which inputs are held, and from where to where each went in the run."""
    told = []
    for each in subject.inputs:
        if each.name not in fixed:
            continue
        value = f"{one_line(each.name)} = {with_unit(fixed[each.name], each.unit)}"
        finite = _finite(subject.known, each.name)
        ends = [number(float(end)) for end in (finite.min(), finite.max())] if len(finite) else ["", ""]
        told.append(value if ends[0] == ends[1] else f"{value} (of {ends[0]} to {ends[1]})")
    return told


def _caption(surface: Surface, held: Sequence[str], track: Track | None, *, known: bool) -> str:
    across, up = one_line(surface.across.name), one_line(surface.up.name)
    text = f"{one_line(surface.name)} over {across} and {up}"
    if held:
        where = f" at {'the' if track else 'a'} run's median" if known else ""
        text += f"; {joined(list(held))} held{where}"
    if surface.undefined.any():
        text += (
            ". Hatched, and left out in space: no rule is active"
            if track is None
            else ". Hatched: no rule is active"
        )
    shown = [(float(edges[0]), float(edges[-1])) for edges in (surface.x, surface.y)]
    left = "" if track is None else exits.told(track.x, track.y, shown[0], shown[1])
    return f"{text}. {left}".rstrip()


def memberships(
    block: Block, units: Mapping[str, str], stem: str, visited: Mapping[str, FuzzyRecord] | None = None
) -> list[Picture]:
    """Return the terms of every variable, with the ranges that the runs `visited`, by label, reached."""
    records = visited or {}
    first = next(iter(records.items()), None) if moves(block.function_block) else None
    shown = as_seen(block.function_block, first[1] if first else None)
    every = panels(shown, units, _visits(records))
    caption = f"Terms of {one_line(block.function_block.name)}; singletons are stems."
    if first:
        caption += f" Points that inputs move stand at the medians of run {one_line(first[0])}."
    if records:
        caption += " A bar below an axis is the range that a run visited."
    pages = parted(every)
    return [
        Picture(
            name=numbered(stem, index, len(pages)),
            caption=caption,
            alt=alt.of_memberships(page),
            draw=partial(membership_plot, page),
        )
        for index, page in enumerate(pages)
    ]


def _visits(records: Mapping[str, FuzzyRecord]) -> dict[str, list[Visit]]:
    visits: dict[str, list[Visit]] = {}
    for label, record in records.items():
        names = (*record.input_names, *record.output_names)
        for name, values in zip(names, np.hstack([record.inputs, record.outputs]).T, strict=True):
            finite = values[np.isfinite(values)]
            if len(finite):
                visits.setdefault(name, []).append(Visit(label, float(finite.min()), float(finite.max())))
    return {name: _merged(each) for name, each in visits.items()}


def _merged(visits: list[Visit]) -> list[Visit]:
    if len(visits) <= MOST_BARS:
        return visits
    low, high = min(each.low for each in visits), max(each.high for each in visits)
    return [Visit(f"all {len(visits)} runs", low, high)]

"""The characteristic of a rule base for the page: what it gives over one or two inputs, once for all runs."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from fcl_sim.block import Block
from fcl_sim.loop.trace import FuzzyRecord, Values
from fcl_sim.report import ranges, sampling
from fcl_sim.report.characteristics import Subject, plane_of
from fcl_sim.report.html.pack import Pack
from fcl_sim.report.raster import NONE, SHADES
from fcl_sim.report.sampling import Domain, Surface
from fcl_sim.report.stretches import stretches
from fcl_sim.report.terms import as_seen
from fcl_sim.report.words import joined, number, one_line

Json = dict[str, Any]


def characteristics(
    block: Block, units: Mapping[str, str], records: Sequence[FuzzyRecord], pack: Pack
) -> list[Json]:
    """Return each output of a block over what moves it most in its runs `records`, wide enough for all."""
    inputs = sampling.domains(as_seen(block.function_block, records[0] if records else None), units)
    seen = {each.name: np.concatenate([_seen(record, each) for record in records]) for each in inputs}
    unit_of = {name.casefold(): unit for name, unit in units.items()}
    made = []
    for output in block.outputs:
        subject = Subject(
            block=block,
            output=output,
            unit=unit_of.get(output.casefold(), ""),
            inputs=inputs,
            seen=seen,
            known=seen,
            given=np.zeros(0),
            active=np.zeros(0, dtype=bool),
            time=np.zeros(0),
            name=output,
        )
        made.append(_curve(subject, pack) if len(inputs) == 1 else _map(subject, pack))
    return made


def _seen(record: FuzzyRecord, domain: Domain) -> Values:
    names = [name.casefold() for name in record.input_names]
    return record.inputs[:, names.index(domain.name.casefold())]


def _axis(domain: Domain) -> Json:
    return {"input": domain.name, "name": one_line(domain.name), "unit": one_line(domain.unit)}


def _curve(subject: Subject, pack: Pack) -> Json:
    across = sampling.following(subject.inputs[0], subject.seen[subject.inputs[0].name])
    line = sampling.curve(subject.block, subject.output, across, {}, subject.unit)
    last = len(line.x) - 1
    ends = [(max(begin - 1, 0), min(end, last)) for begin, end in stretches(line.undefined)]
    return {
        "output": one_line(subject.output),
        "unit": one_line(subject.unit),
        "across": _axis(across),
        "x": pack.series(line.x, whole=True),
        "values": pack.series(np.where(line.undefined, np.nan, line.values), whole=True),
        "undefined": [[float(line.x[begin]), float(line.x[end])] for begin, end in ends],
        "note": "",
    }


def _map(subject: Subject, pack: Pack) -> Json:
    plane, fixed = plane_of(subject)
    paths = [subject.seen[each.name] for each in plane]
    wide = [sampling.following(each, path) for each, path in zip(plane, paths, strict=True)]
    near = sampling.closer(wide, paths)
    shown = [("all terms", wide), *([("where the runs went", near)] if near else [])]
    maps = [
        sampling.surface(subject.block, subject.output, (across, up), fixed, subject.unit, title)
        for title, (across, up) in shown
    ]
    low, high = _range(maps)
    held = joined([f"{one_line(name)} = {number(at)}" for name, at in fixed.items()])
    return {
        "output": one_line(subject.output),
        "unit": one_line(subject.unit),
        "across": _axis(wide[0]),
        "up": _axis(wide[1]),
        "low": low,
        "high": high,
        "views": [_view(each, (low, high), pack) for each in maps],
        "note": f"Drawn for {held}, the medians of the runs." if held else "",
    }


def _range(maps: Sequence[Surface]) -> tuple[float, float]:
    told = ranges.finite(each.values[~each.undefined] for each in maps)
    low, high = (float(told.min()), float(told.max())) if told.size else (0.0, 1.0)
    return low, high if ranges.moves(low, high) else low + max(1.0, abs(low))


def _view(surface: Surface, limits: tuple[float, float], pack: Pack) -> Json:
    low, high = limits
    told = ~surface.undefined & np.isfinite(surface.values)
    values = np.where(told, surface.values, low)
    share = np.clip(
        (values / 2.0 - low / 2.0) / (high / 2.0 - low / 2.0), 0.0, 1.0
    )  # the span may be infinite
    shades = np.where(told, share * (SHADES - 1) + 0.5, NONE).astype(np.uint8)
    return {
        "x": pack.series(surface.x, whole=True),
        "y": pack.series(surface.y, whole=True),
        "cells": pack.plain(shades),
        "undefined": bool(surface.undefined.any()),
    }

"""An outcome → what the script draws: signals of all runs, bands, rules, characteristics, the plant."""

from collections.abc import Container, Mapping, Sequence
from typing import Any

import numpy as np

from fcl_sim.judge.verdict import Band, Corridor
from fcl_sim.loop.diagram import FuzzyNode
from fcl_sim.loop.trace import FuzzyRecord, Values
from fcl_sim.model.labels import unique_labels
from fcl_sim.report import style
from fcl_sim.report.allowed import of_runs
from fcl_sim.report.bands import FAR, MISSED_FAR
from fcl_sim.report.html.maps import characteristics
from fcl_sim.report.html.pack import Pack
from fcl_sim.report.pictures import view_of
from fcl_sim.report.plant_sketches import sketches_of
from fcl_sim.report.provenance import fuzzy_nodes
from fcl_sim.report.sketch import Amount, Delayed, Group, Motion, Paint, Piece, Sketch, Tint
from fcl_sim.report.stretches import stretches
from fcl_sim.report.time_plots import Lane, Shown, bands_of, corridors_of, lanes_of, missed_bands
from fcl_sim.report.violations import violations
from fcl_sim.report.words import one_line
from fcl_sim.testbench import Outcome, Run
from fcl_sim.verify.cover import rule_text

Json = dict[str, Any]


def scenario_data(outcome: Outcome, pack: Pack) -> Json:
    """Return an outcome as the script takes it; its numbers go into `pack`."""
    runs = list(outcome.variants.values())
    older = [] if outcome.against is None else list(outcome.against.runs.values())
    views = [view_of(run) for run in runs]
    bases = _Bases(pack)
    drawn = sketches_of(runs)
    return {
        "name": outcome.scenario.name,
        "lanes": [_lane(each, views) for each in lanes_of(views, [view_of(run) for run in older])],
        "runs": [_run(run, sketch, bases, pack) for run, sketch in zip(runs, drawn, strict=True)],
        "older": [_older(run, pack) for run in older],
        "olderLabel": "" if outcome.against is None else one_line(outcome.against.label),
        "bases": bases.told(),
    }


def _lane(lane: Lane, views: Sequence[Shown]) -> Json:
    missed = missed_bands(views)
    return {
        "signal": lane.signal,
        "names": [one_line(name) for name in lane.names],
        "unit": one_line(lane.unit),
        "judged": lane.judged,
        "focus": lane.focus,
        "allowed": [_stretch(each) for each in of_runs([list(bands_of(lane, [view])) for view in views])],
        "bands": [_band(*each, missed) for each in bands_of(lane, views).items()],
        "corridors": [_corridor(each) for each in corridors_of(lane, views)],
    }


def _stretch(band: Band) -> Json:
    return {"low": band.low, "high": band.high, "from": band.start, "to": band.end}


def _band(band: Band, ids: Sequence[str], missed: Container[Band]) -> Json:
    far = MISSED_FAR if band in missed else FAR
    return _stretch(band) | {"ids": [one_line(each) for each in ids], "far": far}


def _corridor(corridor: Corridor) -> Json:
    return {
        "time": [tick / 1e9 for tick in corridor.ticks],
        "low": _numbers(corridor.low),
        "high": _numbers(corridor.high),
    }


def _numbers(values: Sequence[float]) -> list[float | None]:
    return [each if np.isfinite(each) else None for each in values]


def _run(run: Run, sketch: Sketch | None, bases: "_Bases", pack: Pack) -> Json:
    fault = run.trace.fault
    return {
        **_older(run, pack),
        "title": one_line(run.title),
        "verdict": str(run.verdict),
        "fault": None if fault is None else fault.tick / 1e9,
        "violations": [
            {"signals": [one_line(name) for name in told], "from": start, "to": end}
            for each in run.verdicts
            for told in [each.blamed or each.requirement.signals]
            for start, end in violations(run.trace, each, told)
        ],
        "blocks": [_block(run, node, bases, pack) for node in fuzzy_nodes(run)],
        "sketch": None if sketch is None else _sketch(sketch),
    }


def _older(run: Run, pack: Pack) -> Json:
    """Return what is drawn of any run, one of an older version too."""
    trace, timing = run.trace, run.diagram.timing
    return {
        "name": one_line(run.variant),
        "time": pack.times(trace.ticks),
        "duration": timing.duration / 1e9,
        "scan": timing.scan / 1e9,
        "signals": {name: pack.series(trace.values[:, at]) for at, name in enumerate(trace.names)},
        "units": {name: one_line(trace.units[name]) for name in trace.names},
    }


def _block(run: Run, node: FuzzyNode, bases: "_Bases", pack: Pack) -> Json:
    record = run.trace.fuzzy[node.name]
    return {
        "name": one_line(node.name),
        "base": bases.add(node, record),
        "inputs": _columns(record.input_names, record.inputs, pack),
        "outputs": _columns(record.output_names, record.outputs, pack),
        "idle": {
            name: _idle(~record.active[:, at], run.trace.time) for at, name in enumerate(record.output_names)
        },
        "degrees": [pack.series(column) for column in record.degrees.T],
    }


def _columns(names: Sequence[str], values: Values, pack: Pack) -> Json:
    return {name: pack.series(values[:, at]) for at, name in enumerate(names)}


def _idle(flags: Any, time: Values) -> list[list[float]]:
    """Return from when to when no rule is active."""
    last = len(time) - 1
    return [[float(time[begin]), float(time[min(end, last)])] for begin, end in stretches(flags)]


class _Bases:
    """The rule bases of a scenario, each once, with the runs that its characteristic is drawn for."""

    def __init__(self, pack: Pack) -> None:
        self._pack = pack
        self._found: dict[tuple[str, Any], tuple[int, FuzzyNode, list[FuzzyRecord]]] = {}

    def add(self, node: FuzzyNode, record: FuzzyRecord) -> int:
        key = (node.name, node.block.function_block)
        number, _, records = self._found.setdefault(key, (len(self._found), node, []))
        records.append(record)
        return number

    def told(self) -> list[Json]:
        return [self._told(node, records) for _, node, records in self._found.values()]

    def _told(self, node: FuzzyNode, records: Sequence[FuzzyRecord]) -> Json:
        block = node.block.function_block
        texts = [one_line(rule_text(rule)) for each in block.rule_blocks for rule in each.rules]
        return {
            "name": one_line(block.name),
            "rules": [
                [one_line(label), text] for label, text in zip(unique_labels(block), texts, strict=True)
            ],
            "maps": characteristics(node.block, node.units, records, self._pack),
        }


def _sketch(sketch: Sketch) -> Json:
    return {
        "low": sketch.low,
        "high": sketch.high,
        "hasScale": sketch.has_scale,
        "about": one_line(sketch.about),
        "parts": [_part(each) for each in sketch.group.parts],
        "readings": [
            {"at": each.at, "signal": each.signal, "word": each.word, "on": each.on}
            for each in sketch.readings
        ],
        "warmth": style.WARMTH,
    }


def _part(part: Piece | Group) -> Json:
    if isinstance(part, Piece):
        return {"points": part.points, "role": part.role, "closed": part.closed, **_colour(part)}
    motions: Mapping[str, Motion | None] = {
        "across": part.across,
        "turn": part.turn,
        "grow": part.grow,
        "rise": part.rise,
    }
    moved = {word: _amount(each) for word, each in motions.items() if each is not None}
    return {**moved, "at": part.at, "parts": [_part(each) for each in part.parts]}


def _colour(piece: Piece) -> Json:
    colour = piece.colour
    if isinstance(colour, Paint):
        return {"paint": [_amount(each) for each in colour.parts]}
    if isinstance(colour, Tint):
        return {"tint": {"value": _amount(colour.value), "low": colour.low, "high": colour.high}}
    return {}


def _amount(amount: Amount) -> Json:
    if isinstance(amount, Delayed):
        return {"signal": amount.signal, "flow": amount.flow, "amount": amount.amount}
    return {"signal": amount.signal, "factor": amount.factor}

"""A rule base and the records of its runs → coverage."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isfinite

import numpy as np
from numpy.typing import NDArray

from fcl_sim.engine.hedged import hedged_degree
from fcl_sim.engine.plan_areas import conclusions
from fcl_sim.engine.switches import counted
from fcl_sim.fcl.write_rules import conclusion, condition_text
from fcl_sim.loop.trace import FuzzyRecord, Values
from fcl_sim.model import Conclusion, Defuzzification, FunctionBlock, Points, Rule, Singleton
from fcl_sim.verify import term_grid
from fcl_sim.verify.coverage import Coverage, OutputCoverage, RuleCoverage, Scan, Seen
from fcl_sim.verify.subject import Subject

LEAST = 0.01
"""The part of its range by which an output must change for a rule to be decisive, where nothing is said."""

Flags = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True)
class Visit:
    """What a run recorded of a fuzzy block; `run` is its name, `ticks` (n,) are nanoseconds."""

    run: str
    ticks: NDArray[np.int64]
    record: FuzzyRecord


def cover(subject: Subject, visit: Visit, least: float = LEAST, file: str = "") -> Coverage:
    """Return how far a run has exercised a rule base.

    A rule is decisive where an evaluation without it, at the inputs of that
    scan and after the output of the scan before, gives an output that differs
    by more than `least` of its range (`ranges`).
    """
    block, record = subject.block.function_block, visit.record
    changes = _changes(subject, record)
    leads = dominant(block, record)
    rules = [rule for each in block.rule_blocks for rule in each.rules]
    return Coverage(
        name=block.name,
        file=file,
        runs=(visit.run,),
        scans=len(visit.ticks),
        least=least,
        rules=tuple(
            RuleCoverage(
                label=label,
                text=rule_text(rule),
                fired=_seen(record.degrees[:, place] > 0.0, visit),
                dominant=_seen(leads[:, place], visit),
                decisive=_seen(changes[:, place] > least, visit),
                change=float(np.max(changes[:, place], initial=0.0)),
            )
            for place, (label, rule) in enumerate(zip(record.rule_labels, rules, strict=True))
        ),
        inputs=term_grid.cells(block, record.input_names, record.inputs),
        grid=term_grid.grid(block, subject.program, record.inputs),
        outputs=tuple(
            OutputCoverage(variable=name, undefined=_seen(~record.active[:, place], visit))
            for place, name in enumerate(record.output_names)
        ),
    )


def rule_text(rule: Rule) -> str:
    """Return a rule without its label, on one line."""
    return f"IF {condition_text(rule.condition)} THEN {', '.join(map(conclusion, rule.conclusions))}"


def _seen(where: Flags, visit: Visit) -> Seen:
    scans = np.flatnonzero(where)
    first = Scan(visit.run, int(visit.ticks[scans[0]])) if scans.size else None
    return Seen(int(scans.size), first)


def dominant(block: FunctionBlock, record: FuzzyRecord) -> Flags:
    """Return where each rule has the largest degree above 0 of those that conclude on one variable."""
    brought = {name.casefold(): record.inputs[:, place] for place, name in enumerate(record.input_names)}
    starts = np.cumsum([0, *(len(each.rules) for each in block.rule_blocks)])
    shares: dict[str, list[tuple[int, Values]]] = {}
    for (number, place, _), _, each in conclusions(counted(block)):
        rule = int(starts[number]) + place
        share = _concluded(each, record.degrees[:, rule], brought)
        shares.setdefault(each.variable.casefold(), []).append((rule, share))
    found = np.zeros(record.degrees.shape, np.bool_)
    for own in shares.values():
        largest = np.max([share for _, share in own], axis=0)
        for rule, share in own:
            found[:, rule] |= (share == largest) & (share > 0.0)
    return found


def _concluded(each: Conclusion, degrees: Values, brought: Mapping[str, Values]) -> Values:
    """Return the degrees of a conclusion, after its hedges and its weight."""
    hedged = degrees
    if each.hedges:
        hedged = np.array([hedged_degree(each.hedges, degree) for degree in degrees.tolist()])
    weight = each.weight
    return (np.clip(brought[weight.casefold()], 0.0, 1.0) if isinstance(weight, str) else weight) * hedged


def _changes(subject: Subject, record: FuzzyRecord) -> Values:
    """Return by what part of its range an output changes at most without each rule, (n, rules).

    A rule that does not fire changes nothing, so that only the scans are
    evaluated in which it does.
    """
    spans = ranges(subject.block.function_block, record)
    widths = np.array([spans[name] for name in record.output_names])
    previous = record.previous(subject.initial)
    found = np.zeros(record.degrees.shape)
    fired = record.degrees > 0.0
    for rule in np.flatnonzero(fired.any(axis=0)).tolist():
        scans = fired[:, rule]
        without = subject.outputs(record.inputs[scans], previous[scans], rule)
        apart = np.nan_to_num(np.abs(record.outputs[scans] - without), nan=np.inf)
        parts = np.divide(apart, widths, out=np.full_like(apart, np.inf), where=widths > 0.0)
        found[scans, rule] = np.max(np.where(apart > 0.0, parts, 0.0), axis=1)
    return found


def ranges(block: FunctionBlock, record: FuzzyRecord) -> dict[str, float]:
    """Return the width of each output's range.

    That is its RANGE, else from the least to the largest of its terms' points
    and DEFAULT; of an output without terms, 1. Points that variables move count
    where they were in the record, and places that are calculated do by what
    came out.
    """
    defined = {each.variable.casefold(): each for each in block.defuzzifications}
    found = {}
    for place, name in enumerate(record.output_names):
        output = defined.get(name.casefold())
        found[name] = 1.0 if output is None else _width(output, record, record.outputs[:, place])
    return found


def _width(output: Defuzzification, record: FuzzyRecord, given: Values) -> float:
    if output.range is not None:
        low, high = output.range
        return high - low
    marks = [] if output.default is None or not isfinite(output.default) else [output.default]
    moved = {name.casefold(): record.inputs[:, place] for place, name in enumerate(record.input_names)}
    for spot in _spots(output):
        values = given if spot is None else moved[spot.casefold()] if isinstance(spot, str) else [spot]
        marks += [float(np.min(values)), float(np.max(values))]
    return max(marks) - min(marks) if marks else 0.0


def _spots(output: Defuzzification) -> Sequence[float | str | None]:
    """Return the abscissae of the terms; None where they are calculated, or a shape has no points."""
    found: list[float | str | None] = []
    for term in output.terms:
        shape = term.shape
        if isinstance(shape, Singleton):
            found.append(shape.value)
        elif isinstance(shape, Points):
            found += [point.x for point in shape.points]
        else:
            found.append(None)
    return found

"""A run → the baseline that it leaves: figures, thinned signals, rule bases, each with its tolerances."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from fcl_sim.fcl import write
from fcl_sim.judge.baseline import Baseline, Figure, MetricReference, RuleBaseReference, SignalReference
from fcl_sim.judge.compare import about
from fcl_sim.judge.metrics import METRICS
from fcl_sim.judge.oscillation import half_waves
from fcl_sim.judge.thin import thin
from fcl_sim.judge.verdict import Requirement, Verdict
from fcl_sim.loop.diagram import Diagram, FuzzyNode, Wire
from fcl_sim.loop.trace import Trace, Values
from fcl_sim.units import parse_unit
from fcl_sim.verify.setting import setting_of

RELATIVE = 1e-3
"""Part of a figure by which it may change, unless somebody says otherwise."""
OF_SPAN = 1e-4
"""Part of the span of its signal, or of its bound, by which a figure may change besides."""
THINNED, ABSOLUTE = 2e-3, 3e-3
"""Parts of its span by which a thinned signal may be off its samples, and another run off it."""

SWINGS, LASTING, LARGE = 4, 0.9, 0.25
"""Half-waves, decay ratio and part of the span that make a swing at the end of a run a lasting one."""
END = 2.0 / 3.0
"""Part of a run after which a swing is one at its end."""

MOST_SAMPLES = 500
"""Samples of a line beyond which it follows noise, and nobody reads it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Acceptance:
    """Who accepts which run: the names of scenario and variant, the day as 2026-01-31, and why."""

    scenario: str
    variant: str
    date: str
    reason: str


def record(
    accepted: Acceptance,
    diagram: Diagram,
    trace: Trace,
    verdicts: Sequence[Verdict],
    *,
    signals: Sequence[str] | None = None,
    former: Baseline | None = None,
) -> Baseline:
    """Return the baseline of a run that ended without a fault.

    `signals` are those that are kept; without them the outputs of the plant and
    the inputs that a rule base moves, but for those that noise moves: they need
    more than `MOST_SAMPLES`. Where an output still swings at the end, none is
    kept: the phase of a limit cycle is nothing to hold a run against.
    Tolerances of `former` are kept.
    """
    chosen = signals is not None
    left_out = "" if chosen else limit_cycle(diagram, trace)
    if signals is None:
        signals = () if left_out else usual_signals(diagram)
    metrics = {} if former is None else {each.id: each for each in former.metrics}
    kept = {} if former is None else {each.name: each for each in former.signals}
    lines = [_signal(trace, name, diagram.timing.scan, kept.get(name)) for name in signals]
    noisy = [] if chosen else [each for each in lines if each.ticks.size > MOST_SAMPLES]
    if noisy:
        left_out = f"noise moves {', '.join(each.name for each in noisy)}: figures tell of them"
    return Baseline(
        scenario=accepted.scenario,
        variant=accepted.variant,
        date=accepted.date,
        reason=accepted.reason,
        setting=tuple(setting_of(diagram)),
        metrics=tuple(
            _metric(trace, each, diagram.timing.scan, metrics.get(each.requirement.id)) for each in verdicts
        ),
        signals=tuple(each for each in lines if each not in noisy),
        left_out=left_out,
        rule_bases=tuple(
            RuleBaseReference(block=each.name, arithmetic=each.arithmetic, text=canonical(each))
            for each in diagram.nodes
            if isinstance(each, FuzzyNode)
        ),
    )


def usual_signals(diagram: Diagram) -> list[str]:
    """Return the outputs of the plant, and its inputs that a fuzzy block moves."""
    plant = diagram.plant
    outputs = [f"{plant.name}.{each.name}" for each in plant.model.declaration.outputs]
    return outputs + [f"{plant.name}.{name}" for name, wire in plant.inputs.items() if _moved(diagram, wire)]


def _moved(diagram: Diagram, wire: Wire) -> bool:
    """Return whether a fuzzy block stands upstream of a wire, the plant not passed through."""
    waiting, seen = [wire.source], set[str]()
    while waiting:
        name = waiting.pop()
        if name in seen:
            continue
        seen.add(name)
        if name in diagram.aliases:
            waiting.append(diagram.aliases[name].source)
        for node in diagram.nodes:
            if name == node.name or name.startswith(f"{node.name}."):
                if isinstance(node, FuzzyNode):
                    return True
                waiting += [each.source for each in node.inputs.values()]
    return False


def unfit(trace: Trace, signals: Sequence[str]) -> str:
    """Return why a run is nothing to hold others against: it broke down, or a signal is not finite."""
    if trace.fault is not None:
        return f"it ended at {trace.fault.tick / 1e9:g} s: {trace.fault.signal} {trace.fault.reason}"
    broken = [name for name in signals if not np.isfinite(trace[name]).all()]
    return f"{broken[0]} is not a finite number throughout" if broken else ""


def canonical(node: FuzzyNode) -> str:
    """Return the rule base of a fuzzy block in canonical FCL, without comments."""
    return write(node.block.function_block, terse=True)


def limit_cycle(diagram: Diagram, trace: Trace) -> str:
    """Return the sentence that an output of the plant still swings at the end; nothing where none does.

    It swings where, in the last third of the run, it crosses its mean there
    more than `SWINGS` times, loses less than a tenth of its amplitude from one
    period to the next, and is no trifle beside what it spans in the whole run.
    """
    late = trace.ticks >= END * trace.ticks[-1]
    for output in diagram.plant.model.declaration.outputs:
        name = f"{diagram.plant.name}.{output.name}"
        if name in trace and _swings(trace.time[late], trace[name][late], _span(trace[name])):
            return f"{name} still swings at the end of the run: a limit cycle keeps figures alone"
    return ""


def _swings(time: Values, values: Values, span: float) -> bool:
    middle = float(np.max(values) + np.min(values)) / 2.0
    _, peaks = half_waves(time, values, middle, LARGE * span)
    if len(peaks) < SWINGS:
        return False
    return bool(peaks[-1] >= peaks[0] * LASTING ** ((len(peaks) - 1) / 2.0))


def _span(values: Values) -> float:
    """Return how far a signal goes; of one that stands still, its size, of one that is 0, 1."""
    finite = values[np.isfinite(values)]
    if not finite.size:
        return 1.0
    span = float(np.max(finite) - np.min(finite))
    return span or float(np.max(np.abs(finite))) or 1.0


def _metric(trace: Trace, verdict: Verdict, scan: int, former: MetricReference | None) -> MetricReference:
    asked = verdict.requirement
    made = MetricReference(
        id=asked.id,
        about=about(asked),
        figure=Figure.of(verdict),
        unit=asked.unit,
        absolute=_step(trace, asked, scan / 1e9),
        relative=RELATIVE,
    )
    if former is None or former.about != made.about or former.unit != made.unit:
        return made
    return replace(made, absolute=former.absolute, relative=former.relative)


def _step(trace: Trace, asked: Requirement, scan: float) -> float:
    """Return by how much a figure may change in its own nature: a time by a scan, a part by a thousandth."""
    signals = [each for each in asked.signals if each in trace.units]  # a formula names parameters, too
    spans = [_span(trace[each]) for each in signals if trace.units[each] == asked.unit]
    metric = METRICS.get(asked.metric)
    if metric is None:
        return even(OF_SPAN * max(spans, default=0.0))
    if parse_unit(asked.unit).same_as(parse_unit("")):
        return RELATIVE
    rule = metric.unit
    if rule.signal == 0 and rule.time == 1:
        return scan
    own = _span(trace[asked.signal]) ** rule.signal * scan**rule.time
    bound = max(abs(each) for each in (asked.minimum, asked.maximum, 0.0) if each is not None)
    return even(OF_SPAN * max(own, bound))  # what is a trifle beside its bound may be mere rounding


def _signal(trace: Trace, name: str, scan: int, former: SignalReference | None) -> SignalReference:
    span = _span(trace[name])
    thinned, absolute = even(THINNED * span), even(ABSOLUTE * span)
    relative, leading, lagging = 0.0, scan, scan
    if former is not None and former.unit == trace.units[name]:
        thinned, absolute, relative = former.thinned, former.absolute, former.relative
        leading, lagging = former.leading, former.lagging
    ticks, values = thin(trace.ticks, trace[name], thinned)
    return SignalReference(
        name=name,
        unit=trace.units[name],
        ticks=ticks,
        values=values,
        thinned=thinned,
        absolute=absolute,
        relative=relative,
        leading=leading,
        lagging=lagging,
    )


def even(value: float) -> float:
    """Return a positive number as the next of 1, 2, 5, 10, ... that is not smaller; 0 as it is."""
    if not value > 0.0 or not math.isfinite(value):
        return 0.0
    power = math.floor(math.log10(value))
    steps = [float(f"{digit}e{power}") for digit in (1, 2, 5, 10)]
    return next((each for each in steps if each >= value), steps[-1])

"""[[require]] → requirements: first as written, then in the units of the signals they bound."""

import math
from collections.abc import Container, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Any

from fcl_sim.diagnostics import Diagnostic, InputFault, Place, nearest
from fcl_sim.diagnostics.spelling import listed
from fcl_sim.judge.metric import RESTART_AT, WINDOW, Argument, Kind, Metric
from fcl_sim.judge.metrics import METRICS
from fcl_sim.judge.verdict import Form, Over, Relative, Requirement
from fcl_sim.scenario.asked_runs import NOMINAL_RUN, RUNS, asked_of, asked_runs, expected, run_faults
from fcl_sim.scenario.corridors import corridor_of, corridor_text
from fcl_sim.scenario.envelope import over_of, points_asked
from fcl_sim.scenario.formulae import in_units, statement_of
from fcl_sim.scenario.model import CorridorText, RequirementText
from fcl_sim.scenario.quantities import converted
from fcl_sim.scenario.reading import Reading
from fcl_sim.toml.tree import Entry, finding
from fcl_sim.units import Unit, parse_unit

SIGNAL = "signal"
KINDS = ("metric", "formula", "corridor")
"""What a requirement asks; it has one of them."""
ASKED = ("formula", "corridor", "min", "max")
"""Where it stands what is asked, for who misses it."""


@dataclass(frozen=True, slots=True)
class Units:
    """The unit of each signal, and of each constant that formulae may name: a parameter of the plant."""

    signals: Mapping[str, str]
    constants: Mapping[str, str] = field(default_factory=dict)


OF_METRICS = ("relative_to", "min", "max")
"""What bounds a metric, and nothing else."""


def requirement_texts(
    entries: Sequence[Entry], variants: Sequence[str], reading: Reading
) -> tuple[tuple[RequirementText, ...], list[Diagnostic]]:
    """Return the requirements as written, and what is wrong with them but for their shape.

    `variants` are the names of all runs, the base run's included; `reading`
    opens the tables of corridors.
    """
    faults: list[Diagnostic] = []
    texts: list[RequirementText] = []
    for entry in entries:
        text = _text(entry, variants, reading, faults)
        if text is not None:
            faults += _twice(text, texts)
            texts.append(text)
    return tuple(texts), faults


def _text(
    entry: Entry, variants: Sequence[str], reading: Reading, faults: list[Diagnostic]
) -> RequirementText | None:
    identity, words = entry.get("id"), entry.get("text")
    metric, formula, corridor = (entry.get(name) for name in KINDS)
    runs = asked_runs(entry.get(RUNS), variants)
    faults += run_faults(entry, variants, runs)
    faults += _kind_faults(entry)
    found = _measured(entry, metric, faults) if metric is not None else None
    if formula is not None:
        statement = statement_of(formula, faults)
        found = None if statement is None else {"statement": statement}
    if corridor is not None:
        limits = corridor_text(reading, corridor, faults)
        found = None if limits is None else {"corridor": limits}
    if found is None or identity is None or words is None:
        return None
    return RequirementText(
        id=str(identity.value),
        text=str(words.value),
        runs=runs,
        expect=expected(entry.get("expect"), variants) & runs,
        span=identity.span,
        asked=tuple(each.span for name in ASKED if (each := entry.get(name)) is not None),
        over=over_of(entry.get("over")),
        at_least=entry.get("at_least"),
        **found,
    )


def _kind_faults(entry: Entry) -> Iterator[Diagnostic]:
    """Yield what is wrong with the choice between a metric, a formula and a corridor."""
    asked = [name for name in KINDS if entry.get(name) is not None]
    if not asked:
        hint = 'write metric = { NAME = { signal = ... } } with min or max, or formula = "..."'
        yield finding("SCN408", "the requirement asks nothing: it has no `metric`", entry.key, hint)
        return
    *others, kind = asked
    for name in (*others, *(OF_METRICS if kind != "metric" else ())):
        other = entry.get(name)
        if other is not None:
            hint = (
                "a second requirement can have it" if name in KINDS else f"the {kind} says its bounds itself"
            )
            yield finding("SCN408", f"a requirement with a `{kind}` has no `{name}`", other.key, hint)


def _measured(entry: Entry, metric: Entry, faults: list[Diagnostic]) -> dict[str, Any] | None:
    """Return what a requirement says about its metric."""
    if not metric.is_table:
        return None
    faults += _metric_faults(metric, entry)
    if len(metric.table) != 1:
        return None
    ((name, arguments),) = metric.table.items()
    signal = arguments.get(SIGNAL)
    if name not in METRICS or signal is None:
        return None
    return {
        "metric": name,
        "signal": signal,
        "arguments": arguments.without(SIGNAL).table,
        "relative_to": _relative(entry.get("relative_to")),
        "minimum": entry.get("min"),
        "maximum": entry.get("max"),
    }


def _twice(text: RequirementText, before: Sequence[RequirementText]) -> Iterator[Diagnostic]:
    for other in before:
        if other.id == text.id:
            places = (Place(span=text.span), Place(span=other.span, label="the first of them"))
            yield Diagnostic(code="SCN407", message=f"two requirements are called `{text.id}`", places=places)


def _relative(entry: Entry | None) -> Relative | None:
    variant, form = (entry.get(name) if entry else None for name in ("variant", "as"))
    if variant is None or form is None or form.value not in list(Form):
        return None
    return Relative(str(variant.value), Form(form.value))


def _metric_faults(metric: Entry, requirement: Entry) -> Iterator[Diagnostic]:
    if len(metric.table) != 1:
        hint = "write metric = { NAME = { signal = ..., ... } }; for a second metric, a second [[require]]"
        yield finding(
            "SCN401", f"`metric` names {len(metric.table) or 'no'} metrics instead of one", metric.key, hint
        )
    for name, arguments in metric.table.items():
        if name not in METRICS:
            near = nearest(name, METRICS)
            hint = f"did you mean `{near}`?" if near else f"there are {listed(METRICS)}"
            yield finding("SCN401", f"there is no metric called `{name}`", arguments.key, hint)
        elif arguments.is_table:
            yield from _argument_faults(METRICS[name], arguments)
    if requirement.get("min") is None and requirement.get("max") is None:
        hint = 'give `min` or `max` or both, as in max = "35 s"'
        yield finding("SCN406", "the requirement bounds nothing", requirement.key, hint)


def _argument_faults(metric: Metric, arguments: Entry) -> Iterator[Diagnostic]:
    known = [SIGNAL, *(each.name for each in (*metric.arguments, *WINDOW, RESTART_AT))]
    meant = set()
    for name, entry in arguments.table.items():
        if name not in known:
            near = nearest(name, known)
            meant.add(near)
            hint = f"did you mean `{near}`?" if near else f"it takes {listed(known)}"
            yield finding("SCN402", f"`{metric.name}` has no argument `{name}`", entry.key, hint)
    wanted = [(SIGNAL, "the signal it is taken of")]
    wanted += [(each.name, f"the {each.meaning}") for each in metric.arguments if each.required]
    for name, meaning in wanted:
        if name not in arguments.table and name not in meant:
            yield finding("SCN402", f"`{metric.name}` needs `{name}`: {meaning}", arguments.key)
    if metric.any_of and not set(metric.any_of) & (arguments.table.keys() | meant):
        names = " or ".join(f"`{each}`" for each in metric.any_of)
        yield finding("SCN402", f"`{metric.name}` needs {names}, or both", arguments.key)
    signal = arguments.get(SIGNAL)
    if signal is not None and not isinstance(signal.value, str):
        yield finding("SCN402", "`signal` is the name of a signal, in quotes", signal)


def requirements_for(
    texts: Sequence[RequirementText],
    variant: str,
    units: Units,
    asked_over: Container[Over] = NOMINAL_RUN,
) -> tuple[Requirement, ...]:
    """Return the requirements on the run of a variant, in the units of its signals.

    One that is relative to that run itself is none; nor is one that is asked of
    other runs, or over something else than is `asked_over`.

    `units` are those of the run or the recorded trace.
    InputFault where a signal does not exist or a unit does not fit.
    """
    faults: list[Diagnostic] = []
    found = [(text, _in_units(text, variant, units, faults)) for text in asked_of(texts, variant, asked_over)]
    if faults:
        raise InputFault(faults)
    return tuple(
        replace(each, over=text.over, at_least=points_asked(text.at_least, variant))
        for text, each in found
        if each is not None
    )


def _in_units(
    text: RequirementText, variant: str, units: Units, faults: list[Diagnostic]
) -> Requirement | None:
    if text.corridor is not None:
        return _of_corridor(text, text.corridor, variant, units.signals, faults)
    if text.statement is None:
        return _of_metric(text, variant, units.signals, faults)
    formula = in_units(text.statement, {**units.constants, **units.signals}, faults)
    if formula is None:
        return None
    return Requirement(
        id=text.id,
        text=text.text,
        formula=formula,
        unit=formula.unit or "",
        expect_fail=variant in text.expect,
        span=text.span,
        asked=text.asked,
    )


def _of_corridor(
    text: RequirementText,
    corridor: CorridorText,
    variant: str,
    units: Mapping[str, str],
    faults: list[Diagnostic],
) -> Requirement | None:
    limits = corridor_of(corridor, units, faults)
    if limits is None:
        return None
    return Requirement(
        id=text.id,
        text=text.text,
        corridor=limits,
        unit=parse_unit(units[limits.signal]).difference.symbol,
        expect_fail=variant in text.expect,
        span=text.span,
        asked=text.asked,
    )


def _of_metric(
    text: RequirementText, variant: str, units: Mapping[str, str], faults: list[Diagnostic]
) -> Requirement | None:
    signal = str(text.signal.value) if text.signal else ""
    if signal not in units:
        near = nearest(signal, units) or nearest(signal.rpartition(".")[2], units)
        hint = f"did you mean `{near}`?" if near else f"there are {listed(sorted(units))}"
        faults.append(finding("SCN403", f"there is no signal called `{signal}`", text.signal, hint))
        return None
    metric, before = METRICS[text.metric], len(faults)
    unit = parse_unit(units[signal])
    arguments = {
        name: _argument(metric, name, entry, unit, faults) or 0.0
        for name, entry in text.arguments.items()
        if name != RESTART_AT.name
    }
    own = metric.unit.unit(unit)
    if text.relative_to is not None:
        own = parse_unit("") if text.relative_to.form is Form.RATIO else own.difference
    what = _bounded(metric, signal, text.relative_to)
    minimum = converted(text.minimum, own, what, faults)
    maximum = converted(text.maximum, own, what, faults)
    faults += _crossed(text, minimum, maximum, arguments)
    restarts = _restarts(text, arguments, faults)
    if len(faults) > before:
        return None
    return Requirement(
        id=text.id,
        text=text.text,
        metric=text.metric,
        signal=signal,
        arguments=arguments,
        restart_at=restarts,
        relative_to=text.relative_to,
        minimum=minimum,
        maximum=maximum,
        unit=own.symbol,
        expect_fail=variant in text.expect,
        span=text.span,
        asked=text.asked,
    )


def _bounded(metric: Metric, signal: str, relative: Relative | None) -> str:
    """Return what the bounds of a requirement are on, as a sentence begins."""
    if relative is None:
        return f"a {metric.words} of `{signal}`"
    return f"the {relative.form} of the {metric.words} of `{signal}` to that of the run `{relative.variant}`"


def _restarts(
    text: RequirementText, arguments: Mapping[str, float], faults: list[Diagnostic]
) -> tuple[float, ...]:
    """Return the times at which a metric is taken anew, in seconds."""
    entry = text.arguments.get(RESTART_AT.name)
    if entry is None:
        return ()
    if not entry.items:
        hint = 'write it as in restart_at = ["20 s", "40 s"]'
        faults.append(finding("SCN402", "`restart_at` is a list of times", entry, hint))
        return ()
    second, what = parse_unit("s"), f"a time of `{RESTART_AT.name}`"
    times = [converted(each, second, what, faults) for each in entry.items]
    found = tuple(each for each in times if each is not None)
    inside = (arguments.get("from", 0.0), *found, arguments.get("to", math.inf))
    if len(found) == len(times) and any(later <= before for before, later in pairwise(inside)):
        hint = "each time comes after the one before it, the first after `from`, the last before `to`"
        faults.append(finding("SCN406", f"the restarts of {text.id} do not part its window", entry, hint))
    return found


def _argument(
    metric: Metric, name: str, entry: Entry, signal: Unit, faults: list[Diagnostic]
) -> float | None:
    argument: Argument = next(each for each in (*metric.arguments, *WINDOW) if each.name == name)
    second, plain = parse_unit("s"), parse_unit("")
    units = {
        Kind.SIGNAL: signal,
        Kind.DIFFERENCE: signal.difference,
        Kind.TIME: second,
        Kind.NUMBER: plain,
    }
    return converted(entry, units[argument.kind], f"`{name}` of `{metric.name}`", faults)


def _crossed(
    text: RequirementText, minimum: float | None, maximum: float | None, arguments: Mapping[str, float]
) -> Iterator[Diagnostic]:
    if minimum is not None and maximum is not None and minimum > maximum:
        yield finding(
            "SCN406", f"no value lies between the bounds of {text.id}", text.minimum, "are they exchanged?"
        )
    start, end = arguments.get("from", 0.0), arguments.get("to")
    if end is not None and end < start:
        yield finding("SCN406", f"the window of {text.id} ends before it begins", text.arguments["to"])

"""Variables and terms → findings."""

from collections.abc import Iterator, Sequence

from fcl_sim.diagnostics import Severity
from fcl_sim.model import FunctionBlock, Fuzzification, Singleton, Term
from fcl_sim.proof.axes import Axis
from fcl_sim.proof.completeness import Gap
from fcl_sim.proof.coupled import whole
from fcl_sim.proof.finding import Finding, found
from fcl_sim.proof.partition import OffOne, off_one
from fcl_sim.proof.points import Point
from fcl_sim.proof.rules import asks_in_vain, said
from fcl_sim.proof.terms import (
    beyond,
    beyond_range,
    gaps_between,
    unasked,
    unconcluded,
    without_effect,
)
from fcl_sim.proof.universe import Universe
from fcl_sim.proof.witnesses import Witnesses
from fcl_sim.proof.words import interval, number, over, quoted, rules_named, seen
from fcl_sim.units import short


def told_terms(
    block: FunctionBlock, axes: Sequence[Axis], universe: Universe, gaps: Sequence[Gap] = ()
) -> Iterator[Finding]:
    """Yield the findings on variables and terms, inputs first.

    `gaps` are those of outputs: where one has all of a stretch without terms, that is told already.
    """
    idle = without_effect(block)
    for each in idle:
        message = f"`{each.name}` has no effect: no rule asks for it"
        yield found("FCL610", message, [each.span], "remove it, or use it in a rule", variable=each.name)
    silent = {each.name.casefold() for each in idle}
    own = {each.variable.casefold(): each for each in axes}
    for fuzzification in block.fuzzifications:
        name = fuzzification.variable.casefold()
        if name not in silent and name in own and fuzzification.enabled:
            points = Witnesses(block, axes, universe)
            yield from _input(block, fuzzification, own[name], points, universe)
            yield from _bare(fuzzification, own[name], points, universe, gaps)
    yield from _outputs(block)


def _input(
    block: FunctionBlock,
    fuzzification: Fuzzification,
    axis: Axis,
    points: Witnesses,
    universe: Universe,
) -> Iterator[Finding]:
    name, unit = axis.variable, universe.unit(axis.variable)
    far = beyond(axis, fuzzification, universe)
    if far:
        reach = interval(whole(axis), unit)
        names = quoted([each.name for each in far])
        message = (
            f"{names} of `{name}` {_is(far)} out of reach: `{name}` goes {reach}{_vain(block, axis, far)}"
        )
        yield found(
            "FCL611",
            message,
            [each.span for each in far],
            "move the points, or widen the universe",
            variable=name,
        )
    idle = [each for each in unasked(block, fuzzification) if each not in far]
    if idle:
        message = f"no rule asks for {quoted([each.name for each in idle])} of `{name}`"
        hint = "add the rules that are missing, or remove the terms that nobody needs"
        witness = points.term(axis, idle[0].name)
        yield found("FCL608", message, [each.span for each in idle], hint, variable=name, witness=witness)
    off = off_one(axis, fuzzification)
    if off is not None:
        yield _off_one(fuzzification, off, points.at(name, off.at), unit)


def _off_one(fuzzification: Fuzzification, off: OffOne, witness: Point | None, unit: str) -> Finding:
    name = fuzzification.variable
    at, told = number(off.at), number(off.total)
    message = f"the degrees of `{name}` add up to 1, but at {at}{f' {unit}' if unit else ''} to {told}"
    hint = "give neighbouring terms the same points"
    span = fuzzification.span
    if off.slip is not None:
        span = off.slip.term.span
        own, theirs = short(off.slip.place), short(off.slip.better)
        hint = f"the neighbours of `{off.slip.term.name}` have {theirs} for {own}"
    hint += seen(fuzzification.span, witness, thin=True)
    return found("FCL614", message, [span], hint, Severity.NOTE, variable=name, witness=witness)


def _vain(block: FunctionBlock, axis: Axis, far: Sequence[Term]) -> str:
    """Return which rules never fire because they ask for terms out of reach."""
    terms = {(axis.variable.casefold(), each.name.casefold()) for each in far}
    labels = list(dict.fromkeys(each.label for each in said(block) if asks_in_vain(each, terms)))
    return f", so that {rules_named(labels)} never fire{'s' if len(labels) == 1 else ''}" if labels else ""


def _bare(
    fuzzification: Fuzzification, axis: Axis, points: Witnesses, universe: Universe, gaps: Sequence[Gap]
) -> Iterator[Finding]:
    name, unit = axis.variable, universe.unit(axis.variable)
    sides = [
        side
        for side in gaps_between(axis, fuzzification)
        if not any(each.has_all_of(name, side) for each in gaps)
    ]
    if sides:
        where = " and ".join(over(each, unit) for each in sides)
        witness = points.inside({name: sides[0]})
        message = f"no term of `{name}` is above 0 {where}"
        hint = "let neighbouring terms overlap: the one begins to rise where the other begins to fall"
        hint += seen(fuzzification.span, witness, thin=sides[0].is_point)
        yield found("FCL612", message, [fuzzification.span], hint, variable=name, witness=witness)


def _outputs(block: FunctionBlock) -> Iterator[Finding]:
    concluded = {
        each.variable.casefold()
        for rule_block in block.rule_blocks
        for rule in rule_block.rules
        for each in rule.conclusions
    }
    for output in block.defuzzifications:
        name = output.variable
        idle = unconcluded(block, output) if name.casefold() in concluded and output.enabled else ()
        if idle:
            message = f"no rule concludes {quoted([each.name for each in idle])} of `{name}`"
            hint = "a rule may be missing, or have another conclusion than was meant"
            yield found("FCL609", message, [each.span for each in idle], hint, variable=name)
        far = beyond_range(output)
        if far and output.range is not None:
            low, high = output.range
            reach = f"RANGE ({short(low)} .. {short(high)})"
            names = f"{quoted([each.name for each in far])} of `{name}`"
            lies = f"{_is(far)} outside of" if _are_singletons(far) else f"{_has(far)} no area within"
            message = f"{names} {lies} {reach}"
            yield found(
                "FCL611", message, [each.span for each in far], "move the term, or widen RANGE", variable=name
            )


def _are_singletons(terms: Sequence[Term]) -> bool:
    return all(isinstance(each.shape, Singleton) for each in terms)


def _has(terms: Sequence[object]) -> str:
    return "has" if len(terms) == 1 else "have"


def _is(terms: Sequence[object]) -> str:
    return "is" if len(terms) == 1 else "are"

"""Variables and terms → findings."""

from collections.abc import Iterator, Sequence

from fcl_sim.diagnostics import Severity
from fcl_sim.model import FunctionBlock, Fuzzification
from fcl_sim.proof.axes import Axis
from fcl_sim.proof.coupled import whole
from fcl_sim.proof.finding import Finding, found
from fcl_sim.proof.points import Point
from fcl_sim.proof.terms import (
    beyond,
    beyond_range,
    gaps_between,
    off_one,
    unasked,
    unconcluded,
    without_effect,
)
from fcl_sim.proof.universe import Universe
from fcl_sim.proof.witnesses import Witnesses
from fcl_sim.proof.words import command, interval, number, quoted
from fcl_sim.units import short


def told_terms(block: FunctionBlock, axes: Sequence[Axis], universe: Universe) -> Iterator[Finding]:
    """Yield the findings on variables and terms, inputs first."""
    idle = without_effect(block)
    for each in idle:
        message = f"`{each.name}` has no effect: no rule asks for it"
        yield found("FCL610", message, [each.span], "remove it, or use it in a rule", variable=each.name)
    silent = {each.name.casefold() for each in idle}
    own = {each.variable.casefold(): each for each in axes}
    for fuzzification in block.fuzzifications:
        name = fuzzification.variable.casefold()
        if name not in silent and name in own and fuzzification.enabled:
            yield from _input(block, fuzzification, own[name], axes, universe)
    yield from _outputs(block)


def _input(
    block: FunctionBlock,
    fuzzification: Fuzzification,
    axis: Axis,
    axes: Sequence[Axis],
    universe: Universe,
) -> Iterator[Finding]:
    name, unit = axis.variable, universe.unit(axis.variable)
    points = Witnesses(block, axes, universe)
    far = beyond(axis, fuzzification, universe)
    if far:
        reach = interval(whole(axis), unit)
        names = quoted([each.name for each in far])
        message = f"{names} of `{name}` {_is(far)} out of reach: `{name}` goes {reach}"
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
    gaps = gaps_between(axis, fuzzification)
    if gaps:
        where = " and ".join(interval(each, unit) for each in gaps)
        witness = points.inside({name: gaps[0]})
        message = f"no term of `{name}` is above 0 where it is {where}"
        hint = "let neighbouring terms overlap: the one begins to rise where the other begins to fall"
        hint += _seen(fuzzification, witness, thin=gaps[0].is_point)
        yield found("FCL612", message, [fuzzification.span], hint, variable=name, witness=witness)
    off = off_one(axis, fuzzification)
    if off is not None:
        at = f"{number(off.at)}{f' {unit}' if unit else ''}"
        message = f"the degrees of `{name}` nearly add up to 1, but at {at} to {number(off.total)}"
        hint = "give neighbouring terms the same points"
        witness = points.at(name, off.at)
        hint = f"give neighbouring terms the same points{_seen(fuzzification, witness, thin=True)}"
        yield found(
            "FCL614", message, [fuzzification.span], hint, Severity.NOTE, variable=name, witness=witness
        )


def _seen(fuzzification: Fuzzification, witness: Point | None, *, thin: bool) -> str:
    """Return the command that shows the degrees of an input at a point."""
    if witness is None:
        return ""
    return f"; see `{command(fuzzification.span, witness, thin=thin, explain=True)}`"


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
            message = f"{quoted([each.name for each in far])} of `{name}` {_is(far)} outside of {reach}"
            yield found(
                "FCL611", message, [each.span for each in far], "move the term, or widen RANGE", variable=name
            )


def _is(terms: Sequence[object]) -> str:
    return "is" if len(terms) == 1 else "are"

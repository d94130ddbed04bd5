"""Rules beside each other → findings."""

from collections.abc import Iterator, Sequence

import numpy as np

from fcl_sim.diagnostics import Severity
from fcl_sim.fcl.write_rules import conclusion
from fcl_sim.model import FunctionBlock
from fcl_sim.proof.axes import Axis
from fcl_sim.proof.clauses import Ask
from fcl_sim.proof.coupled import whole
from fcl_sim.proof.finding import Finding, found
from fcl_sim.proof.rules import (
    Pair,
    Said,
    asks_in_vain,
    contradictory,
    dead,
    idle,
    nested,
    said,
    twice,
    without_weight,
)
from fcl_sim.proof.terms import out_of_reach
from fcl_sim.proof.universe import Universe
from fcl_sim.proof.witnesses import Witnesses
from fcl_sim.proof.words import interval, rules_named, seen


def told_rules(block: FunctionBlock, axes: Sequence[Axis], universe: Universe) -> Iterator[Finding]:
    """Yield the findings on rules of the block; one that never fires is told of that alone.

    One that never fires because it asks for a term out of reach is told with that term.
    """
    points = Witnesses(block, axes, universe)
    every = said(block)
    never = dead(block, axes, every)
    far = out_of_reach(block, axes, universe)
    for each in never:
        if not asks_in_vain(each, far):
            yield _dead(each, axes, universe)
    gone = {each.place for each in never}
    alive = [each for each in every if each.place not in gone]
    for each in without_weight(alive):
        message = f"rule {each.label} concludes nothing on `{each.conclusion.variable}`: its weight is 0"
        witness = points.rule(each.place)
        hint = f"give it a weight, or remove it{seen(each.rule.span, witness)}"
        yield found("FCL613", message, [each.conclusion.span], hint, rule=each.label, witness=witness)
    for pair in twice(alive):
        yield _twice(pair, points)
    for pair in contradictory(alive):
        yield _contradictory(pair, points)
    for group in _by_reason(idle(alive, axes)):
        yield _idle(group, points)
    for group in _by_reason(nested(alive)):
        yield _nested(group, points)


def _by_reason(pairs: Sequence[Pair]) -> Iterator[Sequence[Pair]]:
    """Yield the pairs that have the same reason together: that is one thing to tell."""
    groups: dict[tuple[int, str], list[Pair]] = {}
    for each in pairs:
        groups.setdefault((each.because.place, each.because.output), []).append(each)
    yield from groups.values()


def _dead(each: Said, axes: Sequence[Axis], universe: Universe) -> Finding:
    causes = _causes(each, axes, universe)
    message = f"rule {each.label} never fires"
    hint = "correct its condition, or remove it"
    return found(
        "FCL603", f"{message}: {causes}" if causes else message, [each.rule.span], hint, rule=each.label
    )


def _causes(each: Said, axes: Sequence[Axis], universe: Universe) -> str:
    """Return why the one alternative of a rule is impossible, where a single input shows it."""
    if each.clauses is None or len(each.clauses) != 1:
        return ""
    (clause,) = each.clauses
    for axis in axes:
        own = sorted(ask for ask in clause if ask.variable == axis.variable.casefold())
        if own and not any(ask.hedges for ask in own):
            flags = np.ones(len(axis.cells), np.bool_)
            for ask in own:
                literal = axis.literals[ask.term or None]
                flags &= (literal.fails if ask.negated else literal.holds).possibly
            if not flags.any():
                return _impossible(axis, own, universe)
    return ""


def _impossible(axis: Axis, asks: Sequence[Ask], universe: Universe) -> str:
    names = [f"{'NOT ' if each.negated else ''}{each.term}" for each in asks]
    if len(names) > 1:
        return f"no value of `{axis.variable}` is {' and '.join(names)}"
    reach = interval(whole(axis), universe.unit(axis.variable))
    return f"`{axis.variable}` goes {reach}, where it is never {names[0]}"


def _twice(pair: Pair, points: Witnesses) -> Finding:
    told, because = pair.told, pair.because
    return found(
        "FCL604",
        f"rule {told.label} says of `{told.conclusion.variable}` what rule {because.label} says already",
        [told.conclusion.span],
        "remove one of them; one of them may be meant for other terms",
        others=[(because.conclusion.span, "said here")],
        rule=told.label,
        beside=because.label,
        witness=points.rule(told.place),
    )


def _contradictory(pair: Pair, points: Witnesses) -> Finding:
    told, because = pair.told, pair.because
    other, witness = conclusion(because.conclusion), points.rule(told.place)
    hint = "both count, and the output lies between them: correct the condition or the conclusion of one"
    return found(
        "FCL605",
        f"rule {told.label} contradicts rule {because.label}: `{other}` follows from the same condition",
        [told.conclusion.span],
        hint + seen(told.rule.span, witness),
        others=[(because.conclusion.span, "the same condition")],
        rule=told.label,
        beside=because.label,
        witness=witness,
    )


def _idle(pairs: Sequence[Pair], points: Witnesses) -> Finding:
    """Return one finding for all that one rule makes idle."""
    because = pairs[0].because
    labels = _labels(pairs)
    alone = len(labels) == 1
    witness = points.rule(pairs[0].told.place)
    hint = f"remove {'it' if alone else 'them'}, or conclude what was meant"
    return found(
        "FCL606",
        f"{rules_named(labels)} {'has' if alone else 'have'} no effect on `{because.conclusion.variable}`: "
        f"rule {because.label} concludes the same, never with a smaller degree",
        [each.told.conclusion.span for each in pairs],
        hint + seen(because.rule.span, witness),
        others=[(because.conclusion.span, "this counts instead")],
        rule=labels[0] if alone else because.label,
        beside=because.label if alone else labels[0],
        witness=witness,
    )


def _labels(pairs: Sequence[Pair]) -> list[str]:
    return list(dict.fromkeys(each.told.label for each in pairs))


def _nested(pairs: Sequence[Pair], points: Witnesses) -> Finding:
    """Return one finding for a general rule, with all that it stands beside."""
    because = pairs[0].because
    labels = _labels(pairs)
    witness = points.rule(pairs[0].told.place)
    hint = "an exception does not switch the general rule off: let that ask for the other cases alone"
    return found(
        "FCL607",
        f"rule {because.label} counts, too, wherever {rules_named(labels)} "
        f"fire{'s' if len(labels) == 1 else ''}, with another conclusion on `{because.conclusion.variable}`",
        [because.conclusion.span],
        hint + seen(because.rule.span, witness),
        Severity.NOTE,
        others=[(each.told.conclusion.span, "asks for more") for each in pairs[:2]],
        rule=because.label,
        beside=labels[0],
        witness=witness,
    )

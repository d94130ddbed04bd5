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
from fcl_sim.proof.rules import Pair, Said, contradictory, dead, idle, nested, said, twice, without_weight
from fcl_sim.proof.universe import Universe
from fcl_sim.proof.witnesses import Witnesses
from fcl_sim.proof.words import interval


def told_rules(block: FunctionBlock, axes: Sequence[Axis], universe: Universe) -> Iterator[Finding]:
    """Yield the findings on rules of the block; one that never fires is told of that alone."""
    points = Witnesses(block, axes, universe)
    every = said(block)
    never = dead(block, axes, every)
    for each in never:
        yield _dead(each, axes, universe)
    gone = {each.place for each in never}
    alive = [each for each in every if each.place not in gone]
    for each in without_weight(alive):
        message = f"rule {each.label} concludes nothing on `{each.conclusion.variable}`: its weight is 0"
        yield found(
            "FCL613",
            message,
            [each.conclusion.span],
            "give it a weight, or remove it",
            rule=each.label,
            witness=points.rule(each.place),
        )
    for pair in twice(alive):
        yield _twice(pair, points)
    for pair in contradictory(alive):
        yield _contradictory(pair, points)
    for pair in idle(alive, axes):
        yield _idle(pair, points)
    yield from _nested(nested(alive), points)


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
    other = conclusion(because.conclusion)
    return found(
        "FCL605",
        f"rule {told.label} contradicts rule {because.label}: `{other}` follows from the same condition",
        [told.conclusion.span],
        "both count, and the output lies between them: remove the wrong one",
        others=[(because.conclusion.span, "the same condition")],
        rule=told.label,
        beside=because.label,
        witness=points.rule(told.place),
    )


def _idle(pair: Pair, points: Witnesses) -> Finding:
    told, because = pair.told, pair.because
    return found(
        "FCL606",
        f"rule {told.label} has no effect on `{told.conclusion.variable}`: "
        f"rule {because.label} concludes the same, never with a smaller degree",
        [told.conclusion.span],
        "remove it, or make its conclusion the one that was meant",
        others=[(because.conclusion.span, "this counts instead")],
        rule=told.label,
        beside=because.label,
        witness=points.rule(told.place),
    )


def _nested(pairs: Sequence[Pair], points: Witnesses) -> Iterator[Finding]:
    """Yield one finding for each general rule, with all that it stands beside."""
    groups: dict[tuple[int, str], list[Pair]] = {}
    for each in pairs:
        groups.setdefault((each.because.place, each.because.output), []).append(each)
    for group in groups.values():
        because = group[0].because
        labels = list(dict.fromkeys(each.told.label for each in group))
        few = ", ".join(labels[:3]) + (f" and {len(labels) - 3} more" if len(labels) > 3 else "")
        plural = "s" if len(labels) > 1 else ""
        verb = "" if plural else "s"
        yield found(
            "FCL607",
            f"rule {because.label} counts as much wherever rule{plural} {few} fire{verb}, "
            f"with another conclusion on `{because.conclusion.variable}`",
            [because.conclusion.span],
            "an exception does not switch the general rule off: ask that for the remaining terms alone",
            Severity.NOTE,
            others=[(each.told.conclusion.span, "asks for more") for each in group[:2]],
            rule=because.label,
            beside=group[0].told.label,
            witness=points.rule(group[0].told.place),
        )

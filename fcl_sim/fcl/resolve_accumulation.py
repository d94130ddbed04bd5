"""Which ACCU holds for which output (5.2.4, S8, S11, S26)."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from fcl_sim.fcl.scope import Role, Scope
from fcl_sim.fcl.tokens import Token
from fcl_sim.fcl.tree import RuleBlock, Setting
from fcl_sim.model import Accumulation, Defuzzification
from fcl_sim.model import RuleBlock as ModelRuleBlock

Own = dict[str, Accumulation]
"""The ACCU that outputs have for themselves, by their name."""


def settle(
    scope: Scope,
    sections: Sequence[RuleBlock],
    rule_blocks: Sequence[ModelRuleBlock],
    outputs: Sequence[Defuzzification],
) -> tuple[tuple[ModelRuleBlock, ...], tuple[Defuzzification, ...]]:
    """Return rule blocks and outputs with the accumulation that each has in the end.

    A rule block without ACCU takes that of its outputs where they agree. An
    output keeps an ACCU of its own only where it differs from its rule blocks'.
    """
    own = {each.variable: each.accumulation for each in outputs if each.accumulation is not None}
    concluded = [_concluded(each) for each in rule_blocks]
    settled = tuple(
        _settled(scope, section, each, variables, own)
        for section, each, variables in zip(sections, rule_blocks, concluded, strict=True)
    )
    used: dict[str, set[Accumulation]] = {}
    for section, block, variables in zip(sections, settled, concluded, strict=True):
        _check_own(scope, section, block, {each: own[each] for each in variables if each in own})
        for each in variables:
            used.setdefault(each, set()).add(block.accumulation)
    _check_agreement(scope, {each: found for each, found in used.items() if each not in own})
    return settled, tuple(
        replace(each, accumulation=None) if used.get(each.variable) == {each.accumulation} else each
        for each in outputs
    )


def _concluded(block: ModelRuleBlock) -> dict[str, None]:
    """Return the variables that a rule block concludes on, in the order of the text."""
    return dict.fromkeys(each.variable for rule in block.rules for each in rule.conclusions)


def _settled(
    scope: Scope, section: RuleBlock, block: ModelRuleBlock, concluded: Iterable[str], own: Own
) -> ModelRuleBlock:
    if _written(section) is not None or section.damaged:
        return block
    chosen = {own.get(each) for each in concluded}
    if None in chosen or not chosen:
        message = "this rule block has no ACCU: MAX is taken"
        scope.findings.warning("FCL341", message, section.name or section.opening, hint="write `ACCU: MAX;`")
        return block
    first, *others = chosen
    return block if others or first is None else replace(block, accumulation=first)


def _check_own(scope: Scope, section: RuleBlock, block: ModelRuleBlock, own: Own) -> None:
    """Warn where a rule block has another ACCU than one of its outputs has for itself (S8)."""
    setting = _written(section)
    if setting is None:
        return
    for variable, accumulation in own.items():
        if block.accumulation is not accumulation:
            message = f"`{variable}` has ACCU {accumulation} of its own, which goes before this one"
            scope.findings.warning("FCL356", message, setting.keyword)


def _check_agreement(scope: Scope, used: Mapping[str, set[Accumulation]]) -> None:
    """Warn where rule blocks that conclude on one output accumulate differently (S26)."""
    for output in (each for each in scope.variables.values() if each.role is Role.OUTPUT):
        if len(used.get(output.name, ())) > 1:
            scope.findings.warning(
                "FCL354",
                f"rule blocks with different ACCU conclude on `{output.name}`: each accumulates by its own, "
                "and MAX joins them",
                output.token,
            )


def _written(section: RuleBlock) -> Setting | None:
    """Return the ACCU of a rule block as it is written, None where there is none, or NONE."""
    for each in section.settings:
        if each.key == "ACCU" and not (isinstance(each.value, Token) and each.value.key == "NONE"):
            return each
    return None

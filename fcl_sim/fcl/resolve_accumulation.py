"""Which ACCU holds for which output (5.2.4, S8, S11, S26)."""

from collections.abc import Sequence
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
    settled = tuple(
        _settled(scope, section, each, own) for section, each in zip(sections, rule_blocks, strict=True)
    )
    _check_own(scope, sections, settled, own)
    _check_agreement(scope, settled, own)
    return settled, tuple(_reduced(each, settled) for each in outputs)


def _settled(scope: Scope, section: RuleBlock, block: ModelRuleBlock, own: Own) -> ModelRuleBlock:
    if _written(section) is not None or section.damaged:
        return block
    concluded = {each.variable for rule in block.rules for each in rule.conclusions}
    chosen = {own[each] for each in concluded if each in own}
    if len(chosen) == 1 and concluded <= set(own):
        return replace(block, accumulation=chosen.pop())
    if not (concluded and concluded <= set(own)):
        message = "this rule block has no ACCU: MAX is taken"
        scope.findings.warning("FCL341", message, section.name or section.opening, hint="write `ACCU: MAX;`")
    return block


def _check_own(
    scope: Scope, sections: Sequence[RuleBlock], rule_blocks: Sequence[ModelRuleBlock], own: Own
) -> None:
    """Warn where a rule block has another ACCU than one of its outputs has for itself (S8)."""
    for section, block in zip(sections, rule_blocks, strict=True):
        setting = _written(section)
        if setting is None:
            continue
        for variable, accumulation in own.items():
            if block.accumulation is not accumulation and _concludes(block, variable):
                scope.findings.warning(
                    "FCL356",
                    f"`{variable}` has ACCU {accumulation} of its own, which goes before this one",
                    setting.keyword,
                )


def _check_agreement(scope: Scope, rule_blocks: Sequence[ModelRuleBlock], own: Own) -> None:
    """Warn where rule blocks that conclude on one output accumulate differently (S26)."""
    for output in (each for each in scope.variables.values() if each.role is Role.OUTPUT):
        concluding = [each for each in rule_blocks if _concludes(each, output.name)]
        if output.name not in own and len({each.accumulation for each in concluding}) > 1:
            scope.findings.warning(
                "FCL354",
                f"rule blocks with different ACCU conclude on `{output.name}`: each accumulates by its own, "
                "and MAX joins them",
                output.token,
            )


def _reduced(output: Defuzzification, rule_blocks: Sequence[ModelRuleBlock]) -> Defuzzification:
    concluding = [each for each in rule_blocks if _concludes(each, output.variable)]
    if concluding and all(each.accumulation is output.accumulation for each in concluding):
        return replace(output, accumulation=None)
    return output


def _written(section: RuleBlock) -> Setting | None:
    """Return the ACCU of a rule block as it is written, None where there is none, or NONE."""
    for each in section.settings:
        if each.key == "ACCU" and not (isinstance(each.value, Token) and each.value.key == "NONE"):
            return each
    return None


def _concludes(rule_block: ModelRuleBlock, output: str) -> bool:
    return any(each.variable == output for rule in rule_block.rules for each in rule.conclusions)

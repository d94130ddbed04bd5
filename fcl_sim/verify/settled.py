"""The one form of a model in which each output has an ACCU of its own only where it tells something."""

from dataclasses import replace

from fcl_sim.model import Defuzzification, FunctionBlock, RuleBlock


def settled(block: FunctionBlock) -> FunctionBlock:
    """Return a block as the reader gives it: an output has no ACCU that all its rule blocks have (S8)."""
    outputs = tuple(_settled(block, each) for each in block.defuzzifications)
    return replace(block, defuzzifications=outputs)


def _settled(block: FunctionBlock, output: Defuzzification) -> Defuzzification:
    used = {each.accumulation for each in block.rule_blocks if output.variable.casefold() in concluded(each)}
    return replace(output, accumulation=None) if used == {output.accumulation} else output


def concluded(rule_block: RuleBlock) -> set[str]:
    """Return the variables that a rule block concludes on, in lower case."""
    return {each.variable.casefold() for rule in rule_block.rules for each in rule.conclusions}

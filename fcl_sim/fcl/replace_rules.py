"""A text with other rules: those of a rule block are replaced, all else stays as it stands."""

from collections.abc import Sequence

from fcl_sim.diagnostics import InputFault, Source
from fcl_sim.fcl.reading import read
from fcl_sim.fcl.write_rules import rule_lines
from fcl_sim.model import FunctionBlock, Rule

WIDTH = 110


def replace_rules(source: Source, block: FunctionBlock, rules: Sequence[Rule]) -> str:
    """Return the text that `block` was read from with `rules` in place of its own.

    Comments between the rules go with them. The block has one rule block, with
    a rule. InputFault with what a reader would find wrong with the new text.
    """
    (own,) = block.rule_blocks
    spans = sorted((each.span for each in own.rules if each.span), key=lambda each: each.start)
    first, last = spans[0], spans[-1]
    text = first.source.text
    margin = text[text.rfind("\n", 0, first.start) + 1 : first.start]
    indent = margin if not margin.strip() else "    "
    lines = [line for rule in rules for line in rule_lines(rule, WIDTH - len(indent))]
    written = f"\n{indent}".join(lines).removesuffix(";")  # that of the last rule stands behind its span
    made = text[: first.start] + written + text[last.end :]
    reading = read(made, source.name)
    if reading.errors:
        raise InputFault(reading.errors)
    return made

"""Labels by which a trace and a report name rules."""

from collections import Counter

from fcl_sim.model.block import FunctionBlock


def unique_labels(block: FunctionBlock) -> tuple[str, ...]:
    """Return a label for every rule, in the order of the text, no two alike.

    A rule without a label takes its place within its block; with several rule
    blocks the block's name (or place) stands before it; a repeated label gets
    ` (2)` and so on (S5).
    """
    several = len(block.rule_blocks) > 1
    labels = []
    seen: Counter[str] = Counter()
    for number, rule_block in enumerate(block.rule_blocks, 1):
        prefix = f"{rule_block.name or number}." if several else ""
        for place, rule in enumerate(rule_block.rules, 1):
            label = prefix + (rule.label or str(place))
            seen[label.casefold()] += 1
            repeated = seen[label.casefold()]
            labels.append(f"{label} ({repeated})" if repeated > 1 else label)
    return tuple(labels)

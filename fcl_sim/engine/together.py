"""Which steps of an evaluation are taken for many points together."""

from collections.abc import Iterator, Sequence

from fcl_sim.engine import program as p

FEW_RULES = 128
"""Of up to this many rules all are evaluated; of more, only those that can fire at a point."""
BY_MAX_OR_SUM = (0, 1)
"""What THEN_SUM may be."""


def together(ints: Sequence[int]) -> int:
    """Return the TOGETHER of a program with these integers (program.py).

    Rules are made for it that are conjunctions of terms with constant points,
    accumulated by MAX or sums; outputs, by CoGS of constant singletons
    accumulated by MAX.
    """
    if ints[p.RULES] > FEW_RULES or ints[p.MOVED] > 0 or not all(_is_plain(ints, at) for at in _rules(ints)):
        return p.ONE_BY_ONE
    outputs = range(ints[p.OUTPUT], ints[p.OUTPUT] + ints[p.OUTPUTS] * p.OUTPUT_SIZE, p.OUTPUT_SIZE)
    plain = all(ints[at + p.OUT_KIND] == p.BY_COGS and ints[at + p.OUT_GROUPS] == 0 for at in outputs)
    return p.ALL_TOGETHER if plain else p.UP_TO_RULES


def _rules(ints: Sequence[int]) -> Iterator[int]:
    table = range(ints[p.RULE], ints[p.RULE] + ints[p.WORDS] * p.MASK_BITS)
    return (ints[at] for at in table if ints[at] > 0)


def _is_plain(ints: Sequence[int], rule: int) -> bool:
    first = rule + p.RULE_BODY + ints[rule + p.RULE_LENGTH]
    conclusions = range(first, first + ints[rule + p.RULE_THEN] * p.THEN_SIZE, p.THEN_SIZE)
    plain = all(ints[at + p.THEN_SUM] in BY_MAX_OR_SUM for at in conclusions)
    return plain and ints[rule + p.RULE_KIND] in {p.ALL_MIN, p.ALL_PROD}

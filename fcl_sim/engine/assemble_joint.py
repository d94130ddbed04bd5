"""The table of joint cells: for every way in which cells of inputs meet, the list of what can fire there."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby
from math import prod

from fcl_sim.engine import program as p
from fcl_sim.engine.buffers import Buffers
from fcl_sim.engine.masks import Code

MOST_CELLS = 4096
"""Joint cells beyond which a table would outgrow the caches, and the time that it takes to make it."""


@dataclass(frozen=True, slots=True)
class Laid:
    """A grid as laid out, by cell: the rules that can fire, as a set, and what a joint cell's record says."""

    width: int
    rules: list[int]
    met: list[list[int]]


def put_joint(buffers: Buffers, codes: Sequence[Code], grids: Sequence[Laid]) -> int:
    """Append records and table; return where the table begins, 0 where there is none.

    There is none unless all rules are AND by MIN of terms
    with constant points and conclude without a weight on singletons with
    constant places, which are accumulated by MAX and defuzzified by CoGS.
    """
    ints = buffers.ints
    concluded = _concluded(ints, codes) if _is_plain(ints, codes, grids) else None
    if concluded is None:
        return 0
    meeting: list[tuple[int, list[int]]] = [((1 << len(codes)) - 1, [])]
    for grid in grids:
        meeting = [
            (others & rules, [*words, *met])
            for rules, met in zip(grid.rules, grid.met, strict=True)
            for others, words in meeting
        ]
    lists = {rules: _list(ints, codes, concluded, rules) for rules in {rules for rules, _ in meeting}}
    return buffers.put([buffers.put([*met, *lists[rules]]) for rules, met in meeting])


def _is_plain(ints: Sequence[int], codes: Sequence[Code], grids: Sequence[Laid]) -> bool:
    """Return whether inputs and conditions allow a table, and it is not too large."""
    plain = ints[p.BROUGHT] == 0 and ints[p.MOVED] == 0 and ints[p.SUMMARY] == 0
    plain = plain and all(code.kind == p.ALL_MIN for code in codes)
    return plain and prod(len(grid.rules) for grid in grids) <= MOST_CELLS


def _concluded(ints: Sequence[int], codes: Sequence[Code]) -> list[list[tuple[int, int]]] | None:
    """Return by output which rules conclude which of its terms, as (term, rule); None if one is not plain."""
    found: list[list[tuple[int, int]]] = [[] for _ in range(ints[p.OUTPUTS])]
    of_word = {}
    for number in range(ints[p.OUTPUTS]):
        output = ints[p.OUTPUT] + number * p.OUTPUT_SIZE
        if ints[output + p.OUT_KIND] != p.BY_COGS or ints[output + p.OUT_GROUPS] > 0:
            return None
        for term in range(ints[output + p.OUT_TERMS]):
            of_word[ints[output + p.OUT_DEGREES] + term] = number, term
    for rule in range(len(codes)):
        record = ints[ints[p.RULE] + p.rule_entry(rule)]
        first = record + p.RULE_BODY + ints[record + p.RULE_LENGTH]
        conclusions = range(first, first + ints[record + p.RULE_THEN] * p.THEN_SIZE, p.THEN_SIZE)
        for then in conclusions:
            place = of_word.get(ints[then + p.THEN_DEGREE])
            if place is None or ints[then + p.THEN_SUM] != 0 or ints[then + p.THEN_WEIGHT] != 0:
                return None
            found[place[0]].append((place[1], rule))
    return [sorted(each) for each in found]


def _list(
    ints: Sequence[int],
    codes: Sequence[Code],
    concluded: Sequence[Sequence[tuple[int, int]]],
    rules: int,
) -> list[int]:
    """Return the list of a joint cell in which `rules` can fire (program.py)."""
    words: list[int] = []
    for pairs in concluded:
        able = [(term, rule) for term, rule in pairs if rules >> rule & 1]
        terms = [(term, [rule for _, rule in own]) for term, own in groupby(able, key=lambda pair: pair[0])]
        words.append(len(terms))
        for term, own in terms:
            words += [term, len(own)]
            for rule in own:
                words += [*codes[rule].slots, p.FIRED_DEGREE - (ints[p.DEGREES] + rule)]
    return words

"""Rules become records: what they ask for, and where their conclusions accumulate."""

from collections.abc import Sequence

from fcl_sim.engine import program as p
from fcl_sim.engine.buffers import Buffers
from fcl_sim.engine.conditions import (
    AND_CODE,
    HEDGE_CODE,
    NORM_CODE,
    OR_CODE,
    Leaf,
    Look,
    Push,
    Token,
    conjunction,
    has_complements,
    postfix,
)
from fcl_sim.engine.masks import Code
from fcl_sim.engine.plan import Accumulator, Plan
from fcl_sim.model import Accumulation, AndOperator, Conclusion, FunctionBlock, Rule, RuleBlock

GROUP_KIND = {
    Accumulation.MAX: p.GROUP_MAX,
    Accumulation.BSUM: p.GROUP_BSUM,
    Accumulation.NSUM: p.GROUP_NSUM,
    Accumulation.SUM: p.GROUP_SUM,
    **dict.fromkeys(NORM_CODE, p.GROUP_NORM),
}


def code_of(rule_block: RuleBlock, rule: Rule, own: Plan) -> Code:
    """Return a rule's condition as slots, or as postfix code."""
    plain = conjunction(rule.condition)
    if plain is not None and own.slots.keys() >= set(plain):
        if len(plain) == 1:
            return Code(p.ALL_MIN, slots=(own.slots[plain[0]],) * 2)
        if rule_block.and_operator is AndOperator.MIN:
            return Code(p.ALL_MIN, slots=tuple(own.slots[leaf] for leaf in plain))
        if rule_block.and_operator is AndOperator.PROD:
            return Code(p.ALL_PROD, slots=tuple(own.slots[leaf] for leaf in plain))
    both = has_complements(rule.condition, rule_block)

    def push(leaf: Leaf) -> list[Token]:
        if leaf in own.slots:
            return [Push(own.slots[leaf], own.slots[leaf.complement] if both else own.spill)]
        look = Look(leaf.variable, leaf.term)
        return [look, p.NOT] if leaf.negated else [look]

    and_code, or_code = AND_CODE[rule_block.and_operator], OR_CODE[rule_block.or_operator]
    return Code(p.CODE, tokens=tuple(postfix(rule.condition, and_code, or_code, push)))


def put_rules(buffers: Buffers, block: FunctionBlock, own: Plan, codes: Sequence[Code]) -> int:
    """Append a record for every rule; return where the table of them begins."""
    starts: list[int] = []
    rules = [
        (number, place, rule)
        for number, rule_block in enumerate(block.rule_blocks)
        for place, rule in enumerate(rule_block.rules)
    ]
    for (number, place, rule), code in zip(rules, codes, strict=True):
        body = list(code.slots) or _words(buffers, own, code.tokens)
        then = [
            words
            for index, each in enumerate(rule.conclusions)
            for words in _then(buffers, own, (number, place, index), each)
        ]
        head = [code.kind, len(body), len(then), own.degrees + len(starts)]
        starts.append(buffers.put([*head, *body, *(word for words in then for word in words)]))
    table = [0] * (own.words * p.MASK_BITS)
    for rule_number, start in enumerate(starts):
        table[p.rule_entry(rule_number)] = start
    return buffers.put(table)


def _words(buffers: Buffers, own: Plan, tokens: Sequence[Token]) -> list[int]:
    """Return postfix code as the kernel takes it."""
    words: list[int] = []
    for token in tokens:
        if isinstance(token, Push):
            words += [token.slot, token.complement]
        elif isinstance(token, Look):
            words.append(p.LOOK - _look(buffers, own.accumulators[token.variable], token))
        else:
            words.append(token)
    return words


def _look(buffers: Buffers, accumulator: Accumulator, look: Look) -> int:
    return buffers.put((accumulator.words[look.term], *accumulation(buffers, accumulator)))


def accumulation(buffers: Buffers, accumulator: Accumulator) -> tuple[int, int, int, int]:
    """Return number of terms, first word, number of accumulations, and where their algorithms stand."""
    groups = 0 if accumulator.kinds == (Accumulation.MAX,) else len(accumulator.kinds)
    kinds = buffers.put(GROUP_KIND[kind] for kind in accumulator.kinds)
    return accumulator.count, accumulator.at, groups, kinds


def _how(kind: Accumulation) -> int:
    """Return by what a word accumulates (program.py, THEN_SUM)."""
    if kind in NORM_CODE:
        return NORM_CODE[kind] + p.AND_MIN - p.OR_MAX
    return int(kind is not Accumulation.MAX)


def _hedged(buffers: Buffers, conclusion: Conclusion, how: int) -> int:
    """Return by what a conclusion accumulates: the record of its hedges where it has some."""
    if not conclusion.hedges:
        return how
    codes = [HEDGE_CODE[hedge] for hedge in reversed(conclusion.hedges)]
    return buffers.put([how, len(codes), *codes])


def _then(
    buffers: Buffers, own: Plan, place: tuple[int, int, int], conclusion: Conclusion
) -> list[tuple[int, int, int]]:
    """Return where a conclusion accumulates: as an area, as a degree, or as both."""
    then = []
    variable = conclusion.variable.casefold()
    weight = buffers.weight(own, conclusion.weight)
    if variable in own.areas:
        target = own.areas[variable].targets[place]
        how = _hedged(buffers, conclusion, int(target.summed))
        then.append((target.word, how, weight if target.weighted else 0))
    if variable in own.accumulators:
        accumulator = own.accumulators[variable]
        word = accumulator.word(place[0], conclusion.term)
        how = _hedged(buffers, conclusion, _how(accumulator.kind(place[0])))
        then.append((word, how, weight))
    return then

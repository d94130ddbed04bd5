"""The plan of an instance's memory: which word holds what."""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from fcl_sim.engine.conditions import Leaf, leaves
from fcl_sim.engine.grid import Base, Function
from fcl_sim.model import Accumulation, Defuzzification, FunctionBlock, Fuzzification, Points, Term


@dataclass(frozen=True, slots=True, kw_only=True)
class Accumulator:
    """Where an output's degrees are accumulated.

    One group of `count` words (even: a spare one is never written) per algorithm
    in `kinds`: more than one only where rule blocks disagree (S26); `group_of`
    gives each rule block's group. `words` places a term, by its case-folded name, within a group.
    """

    at: int
    count: int
    kinds: tuple[Accumulation, ...]
    group_of: Mapping[int, int]
    words: Mapping[str, int]

    def word(self, rule_block: int, term: str) -> int:
        """Return where conclusions of a rule block on a term accumulate."""
        return self.at + self.group_of[rule_block] * self.count + self.words[term.casefold()]


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """Offsets in the instance memory; variables by their case-folded names.

    `functions` are the membership functions of each fuzzified input, with their
    slots; `spill` is a word that nobody reads.
    """

    inputs: Mapping[str, int]
    outputs: Mapping[str, int]
    degrees: int
    slots: Mapping[Leaf, int]
    functions: Mapping[str, tuple[tuple[int, Function], ...]]
    brought: tuple[str, ...]
    accumulators: Mapping[str, Accumulator]
    spill: int
    clamps: int
    rows: int
    stack: int


def plan(block: FunctionBlock) -> Plan:
    """Return the plan of `block`, in the order of the table in program.py."""
    inputs = {variable.name.casefold(): at for at, variable in enumerate(block.inputs)}
    outputs = {variable.name.casefold(): at for at, variable in enumerate(block.outputs)}
    rules = [rule for rule_block in block.rule_blocks for rule in rule_block.rules]
    degrees = len(inputs) + 2 * len(outputs)
    slots: dict[Leaf, int] = {}
    at = degrees + len(rules)
    used = {leaf for rule in rules for leaf in leaves(rule.condition)}
    functions = {}
    for each in block.fuzzifications:
        own = _functions(each, used) if each.variable.casefold() in inputs else ()
        functions[each.variable.casefold()] = tuple((at + i, function) for i, (_, function) in enumerate(own))
        slots.update((leaf, at + i) for i, (leaf, _) in enumerate(own))
        at += len(own)
    brought = _brought(block, used)
    for variable in brought:
        slots[Leaf(variable, None)] = at
        slots[Leaf(variable, None, negated=True)] = at + 1
        at += 2
    accumulators = {}
    for output in block.defuzzifications:
        accumulator = _accumulator(block, output, at)
        accumulators[output.variable.casefold()] = accumulator
        at += accumulator.count * len(accumulator.kinds)
    return Plan(
        inputs=inputs,
        outputs=outputs,
        degrees=degrees,
        slots=slots,
        functions={name: own for name, own in functions.items() if own},
        brought=brought,
        accumulators=accumulators,
        spill=at,
        clamps=at + 1,
        rows=at + 2,
        stack=at + 2 + len(functions),
    )


def _functions(fuzzification: Fuzzification, used: set[Leaf]) -> list[tuple[Leaf, Function]]:
    """Return the terms of an input, then the complements that some condition uses."""
    variable = fuzzification.variable.casefold()
    bases = [(term.name.casefold(), base_of(term)) for term in fuzzification.terms]
    plain = [(Leaf(variable, term), Function(base)) for term, base in bases]
    negated = [(Leaf(variable, term, negated=True), Function(base, negated=True)) for term, base in bases]
    return plain + [(leaf, function) for leaf, function in negated if leaf in used]


def base_of(term: Term) -> Base:
    """Return the base points of a term whose points are constant."""
    if not isinstance(term.shape, Points):
        raise TypeError(term)
    return tuple((Fraction(point.x), Fraction(point.degree)) for point in term.shape.points)


def _brought(block: FunctionBlock, used: set[Leaf]) -> tuple[str, ...]:
    """Return the inputs that conditions or weights take as degrees, in the order of their declaration."""
    taken = {leaf.variable for leaf in used if leaf.term is None}
    for rule_block in block.rule_blocks:
        for rule in rule_block.rules:
            taken |= {each.weight.casefold() for each in rule.conclusions if isinstance(each.weight, str)}
    return tuple(each.name.casefold() for each in block.inputs if each.name.casefold() in taken)


def _accumulator(block: FunctionBlock, output: Defuzzification, at: int) -> Accumulator:
    variable = output.variable.casefold()
    concluding = [
        index
        for index, rule_block in enumerate(block.rule_blocks)
        if any(each.variable.casefold() == variable for rule in rule_block.rules for each in rule.conclusions)
    ]
    kinds = [block.rule_blocks[index].accumulation for index in concluding]
    agreed = len(set(kinds)) <= 1
    return Accumulator(
        at=at,
        count=len(output.terms) + len(output.terms) % 2,
        kinds=tuple(kinds[:1] if agreed else kinds) or (Accumulation.MAX,),
        group_of={index: 0 if agreed else group for group, index in enumerate(concluding)},
        words={term.name.casefold(): word for word, term in enumerate(output.terms)},
    )

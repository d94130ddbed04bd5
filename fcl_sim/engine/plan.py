"""The plan of an instance's memory: which word holds what."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import inf

from fcl_sim.engine.conditions import Leaf, has_complements, leaves
from fcl_sim.engine.grid import Base, Function
from fcl_sim.engine.masks import summary_words
from fcl_sim.engine.plan_areas import AreaPlan, algorithms, conclusions, grouped, plan_area, points_of
from fcl_sim.engine.program import CLEARED_TOGETHER, MASK_BITS
from fcl_sim.engine.switches import is_fixed, limits_of
from fcl_sim.model import (
    Accumulation,
    Defuzzification,
    FunctionBlock,
    Fuzzification,
    Points,
    Term,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Accumulator:
    """Where the degrees of a variable are accumulated, per term; a variable without terms has the one None.

    One group of `count` words (even: a spare one is never written) per algorithm
    in `kinds`: more than one only where rule blocks disagree (S26); `group_of`
    gives each rule block's group. `words` places a term, by its case-folded name, within a group.
    """

    at: int
    count: int
    kinds: tuple[Accumulation, ...]
    group_of: Mapping[int, int]
    words: Mapping[str | None, int]

    def word(self, rule_block: int, term: str | None) -> int:
        """Return where conclusions of a rule block on a term accumulate."""
        return self.at + self.group_of[rule_block] * self.count + self.words[term and term.casefold()]

    def kind(self, rule_block: int) -> Accumulation:
        """Return the algorithm by which they accumulate."""
        return self.kinds[self.group_of[rule_block]]


@dataclass(frozen=True, slots=True)
class Moved:
    """A term of an input with moved points or a curve, and the slots of its degree and of 1 minus it.

    `limits` are the ends of where the variable is taken.
    """

    variable: str
    term: Term
    slot: int
    complement: int
    limits: tuple[float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """Offsets in the instance memory; variables by their case-folded names.

    `functions` are the membership functions of each fuzzified input whose
    points are constant, with their slots, `moved` the others; `spill` is a word
    that nobody reads. `accumulators` hold degrees of singletons, of variables
    without terms, and of what conditions ask for; `areas` are accumulated as areas.
    """

    inputs: Mapping[str, int]
    outputs: Mapping[str, int]
    degrees: int
    rules: int
    slots: Mapping[Leaf, int]
    functions: Mapping[str, tuple[tuple[int, Function], ...]]
    moved: tuple[Moved, ...]
    brought: tuple[str, ...]
    accumulators: Mapping[str, Accumulator]
    areas: Mapping[str, AreaPlan]
    spill: int
    clamps: int
    clear: int
    cells: int
    held: int
    visited: int
    rows: int
    stack: int

    @property
    def words(self) -> int:
        """Words of a mask of rules."""
        return max(1, -(-self.rules // MASK_BITS))


def plan(block: FunctionBlock) -> Plan:
    """Return the plan of `block`, in the order of the table in program.py."""
    inputs = {variable.name.casefold(): at for at, variable in enumerate(block.inputs)}
    outputs = {variable.name.casefold(): at for at, variable in enumerate(block.outputs)}
    rules = sum(len(each.rules) for each in block.rule_blocks)
    degrees = len(inputs) + 2 * len(outputs)
    slots: dict[Leaf, int] = {}
    at = degrees + rules
    used = _used(block)
    functions = {}
    moving: list[tuple[Leaf, Term, tuple[float, float]]] = []
    for each in block.fuzzifications:
        if each.variable.casefold() in inputs:
            own, others = _functions(each, used)
            name = each.variable.casefold()
            functions[name] = tuple((at + i, function) for i, (_, function) in enumerate(own))
            taken = [*(leaf for leaf, _ in own), *_pairs(leaf for leaf, _ in others)]
            slots.update((leaf, at + i) for i, leaf in enumerate(taken))
            at += len(taken)
            moving += [(*other, limits_of(block, each) or (-inf, inf)) for other in others]
    brought = _brought(block, used)
    taken = _pairs(Leaf(name, None) for name in brought)
    slots.update((leaf, at + i) for i, leaf in enumerate(taken))
    at += len(taken)
    accumulators, areas = {}, {}
    looked = {leaf.variable for leaf in used if leaf not in slots}
    for variable in _concluded(block):
        defined = [each for each in block.defuzzifications if each.variable.casefold() == variable]
        with_area = bool(defined) and has_area(defined[0])
        if with_area:
            areas[variable] = plan_area(block, defined[0], at)
            at += areas[variable].words
        if not with_area or variable in looked:
            accumulators[variable] = _accumulator(block, variable, defined, at)
            at += accumulators[variable].count * len(accumulators[variable].kinds)
    words = max(1, -(-rules // MASK_BITS))
    clear = degrees if summary_words(words) == 0 else degrees + rules
    cells = clear + -(-(at + 2 - clear) // CLEARED_TOGETHER) * CLEARED_TOGETHER
    held = cells + len(functions)
    visited = held + 1
    return Plan(
        inputs=inputs,
        outputs=outputs,
        degrees=degrees,
        rules=rules,
        slots=slots,
        functions={name: own for name, own in functions.items() if own},
        moved=tuple(
            Moved(leaf.variable, term, slots[leaf], slots[leaf.complement], limits)
            for leaf, term, limits in moving
        ),
        brought=brought,
        accumulators=accumulators,
        areas=areas,
        spill=at,
        clamps=at + 1,
        clear=clear,
        cells=cells,
        held=held,
        visited=visited,
        rows=visited + (1 + words if words > 1 else 0),
        stack=visited + (1 + words + len(functions) if words > 1 else 0),
    )


def has_area(output: Defuzzification) -> bool:
    """Return whether the terms of an output have areas; it does not mix them with singletons (S35)."""
    return any(isinstance(term.shape, Points) for term in output.terms)


def _used(block: FunctionBlock) -> set[Leaf]:
    """Return the leaves whose degrees conditions take."""
    used = set()
    for rule_block in block.rule_blocks:
        for rule in rule_block.rules:
            own = set(leaves(rule.condition))
            if has_complements(rule.condition, rule_block):
                own |= {leaf.complement for leaf in own}
            used |= own
    return used


def _pairs(leaves: Iterable[Leaf]) -> list[Leaf]:
    """Return each leaf and its complement."""
    return [each for leaf in leaves for each in (leaf, leaf.complement)]


def _functions(
    fuzzification: Fuzzification, used: set[Leaf]
) -> tuple[list[tuple[Leaf, Function]], list[tuple[Leaf, Term]]]:
    """Return the terms of an input and the complements that conditions use; and curves and moved terms."""
    variable = fuzzification.variable.casefold()
    moved = [term for term in fuzzification.terms if not is_fixed(term)]
    bases = [(term.name.casefold(), base_of(term)) for term in fuzzification.terms if term not in moved]
    plain = [(Leaf(variable, term), Function(base)) for term, base in bases]
    negated = [(Leaf(variable, term, negated=True), Function(base, negated=True)) for term, base in bases]
    own = plain + [(leaf, function) for leaf, function in negated if leaf in used]
    return own, [(Leaf(variable, term.name.casefold()), term) for term in moved]


def base_of(term: Term) -> Base:
    """Return the base points of a term whose points are constant."""
    return tuple((Fraction(point.x), Fraction(point.degree)) for point in points_of(term))


def _brought(block: FunctionBlock, used: set[Leaf]) -> tuple[str, ...]:
    """Return the inputs that conditions or weights take as degrees, in the order of their declaration."""
    taken = {leaf.variable for leaf in used if leaf.term is None}
    taken |= {each.weight.casefold() for _, _, each in conclusions(block) if isinstance(each.weight, str)}
    return tuple(each.name.casefold() for each in block.inputs if each.name.casefold() in taken)


def _concluded(block: FunctionBlock) -> list[str]:
    """Return the variables that are defuzzified, and all others that rules conclude on."""
    defined = [each.variable.casefold() for each in block.defuzzifications]
    return list(dict.fromkeys([*defined, *(each.variable.casefold() for _, _, each in conclusions(block))]))


def _accumulator(block: FunctionBlock, variable: str, defined: list[Defuzzification], at: int) -> Accumulator:
    terms: dict[str | None, None] = {}
    if defined:
        terms = dict.fromkeys(term.name.casefold() for term in defined[0].terms)
    else:
        own = [each for _, _, each in conclusions(block) if each.variable.casefold() == variable]
        terms = dict.fromkeys(each.term and each.term.casefold() for each in own)
    kinds, group_of = grouped(algorithms(block, variable))
    return Accumulator(
        at=at,
        count=len(terms) + len(terms) % 2,
        kinds=kinds,
        group_of=group_of,
        words={term: word for word, term in enumerate(terms)},
    )

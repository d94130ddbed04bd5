"""`assemble`: FunctionBlock to Program."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from math import inf, nan

import numpy as np

from fcl_sim.arithmetic.membership import FEW
from fcl_sim.engine import program as p
from fcl_sim.engine.conditions import AND_CODE, OR_CODE, Leaf, conjunction, depth, postfix
from fcl_sim.engine.grid import Cell, Grid, merge
from fcl_sim.engine.labels import unique_labels
from fcl_sim.engine.masks import Code, every, fireable, words_of
from fcl_sim.engine.plan import Accumulator, Plan, plan
from fcl_sim.engine.program import Layout, Program
from fcl_sim.engine.refuse import refuse
from fcl_sim.model import (
    Accumulation,
    AndOperator,
    Conclusion,
    Defuzzification,
    FunctionBlock,
    Rule,
    RuleBlock,
    Singleton,
    Variable,
)

GROUP_KIND = {
    Accumulation.MAX: p.GROUP_MAX,
    Accumulation.BSUM: p.GROUP_BSUM,
    Accumulation.NSUM: p.GROUP_NSUM,
}


@dataclass(frozen=True, slots=True)
class Buffers:
    """The two buffers while they grow."""

    ints: list[int] = field(default_factory=lambda: [0] * p.HEADER_SIZE)
    floats: list[float] = field(default_factory=lambda: [0.0])

    def put(self, words: Iterable[int]) -> int:
        """Append integers; return where they begin."""
        at = len(self.ints)
        self.ints.extend(words)
        return at

    def put_floats(self, numbers: Iterable[float]) -> int:
        """Append floats; return where they begin."""
        at = len(self.floats)
        self.floats.extend(numbers)
        return at


def assemble(block: FunctionBlock) -> Program:
    """Return the program of `block`.

    Raises InputFault, with every place, for what cannot be evaluated (FCL4xx).
    """
    refuse(block)
    own = plan(block)
    codes = [_code(rule_block, rule, own) for rule_block in block.rule_blocks for rule in rule_block.rules]
    buffers = Buffers()
    words = max(1, -(-len(codes) // p.MASK_BITS))
    stack = max((depth(code) for kind, code in codes if kind == p.CODE), default=0)
    cleared = -(-(own.clamps + 1 - own.degrees) // 4) * 4
    header = {
        p.RULES: len(codes),
        p.WORDS: words,
        p.ALL: buffers.put(words_of(every(codes), words)),
        p.GRIDS: len(own.functions),
        p.GRID: _grids(buffers, own, codes, words),
        p.BROUGHT: len(own.brought),
        p.BRING: buffers.put(word for name in own.brought for word in _brought(own, name)),
        p.RULE: _rules(buffers, block, own, codes),
        p.OUTPUTS: len(block.outputs),
        p.OUTPUT: _outputs(buffers, block, own),
        p.DEGREES: own.degrees,
        p.CLEARED: cleared,
        p.CLAMPS: own.clamps,
        p.ROWS: own.rows,
        p.STACK: own.stack,
    }
    for word, value in header.items():
        buffers.ints[word] = value
    return Program(
        name=block.name,
        ints=np.array(buffers.ints, np.int64),
        floats=np.array(buffers.floats, np.float64),
        initial=_initial(block, max(own.stack + stack, own.degrees + cleared)),
        input_names=tuple(each.name for each in block.inputs),
        output_names=tuple(each.name for each in block.outputs),
        rule_labels=unique_labels(block),
        layout=_layout(own),
    )


def _code(rule_block: RuleBlock, rule: Rule, own: Plan) -> Code:
    """Return the kind of a rule's condition, and its slots or postfix code."""
    plain = conjunction(rule.condition)
    if plain is not None and (len(plain) == 1 or rule_block.and_operator is AndOperator.MIN):
        return p.ALL_MIN, [own.slots[leaf] for leaf in plain]
    if plain is not None and rule_block.and_operator is AndOperator.PROD:
        return p.ALL_PROD, [own.slots[leaf] for leaf in plain]
    and_code, or_code = AND_CODE[rule_block.and_operator], OR_CODE[rule_block.or_operator]
    return p.CODE, postfix(rule.condition, and_code, or_code, own.slots.__getitem__)


def _grids(buffers: Buffers, own: Plan, codes: Sequence[Code], words: int) -> int:
    """Append the tables of every fuzzified input; return where their records begin."""
    records = []
    for variable, functions in own.functions.items():
        slots = [slot for slot, _ in functions]
        grid = merge([function for _, function in functions])
        active = [_active(cell, slots) for cell in grid.cells]
        width = max(2, *(len(each) for each in active))
        spare = [(own.spill, 0.0, 0.0, inf)]
        filled = [each + spare * (width - len(each)) for each in active]
        sets = fireable(codes, slots, grid.cells)
        rows = [
            word
            for each, rules in zip(filled, sets, strict=True)
            for word in (*(slot for slot, *_ in each), *words_of(rules, words))
        ]
        segments = [number for each in filled for _, *segment in each for number in segment]
        knots = _knots(grid)
        records += [
            own.inputs[variable],
            len(knots),
            buffers.put_floats(knots),
            width,
            buffers.put(rows),
            buffers.put_floats(segments),
        ]
    return buffers.put(records)


def _knots(grid: Grid) -> list[float]:
    """Return the knots as `cell_of` takes them."""
    knots = [float(knot) for knot in grid.knots]
    count = 4 if len(knots) <= 4 else FEW if len(knots) <= FEW else 16
    while count <= len(knots) and count > FEW:
        count *= 4
    return knots + [nan] * (count - len(knots))


def _active(cell: Cell, slots: Sequence[int]) -> list[tuple[int, float, float, float]]:
    """Return slot, origin, value and run of the functions that are not 0 all over the cell."""
    return [
        (
            slot,
            float(segment.origin),
            float(segment.value),
            inf if segment.run is None else float(segment.run),
        )
        for slot, segment, (_, high) in zip(slots, cell.segments, cell.bounds, strict=True)
        if high > 0
    ]


def _brought(own: Plan, variable: str) -> tuple[int, int, int]:
    slot, negated = own.slots[Leaf(variable, None)], own.slots[Leaf(variable, None, negated=True)]
    return own.inputs[variable], slot, negated


def _rules(buffers: Buffers, block: FunctionBlock, own: Plan, codes: Sequence[Code]) -> int:
    """Append a record for every rule; return where the table of them begins."""
    starts: list[int] = []
    rules = [(number, each, rule) for number, each in enumerate(block.rule_blocks) for rule in each.rules]
    for (number, rule_block, rule), (kind, code) in zip(rules, codes, strict=True):
        sums = int(rule_block.accumulation is not Accumulation.MAX)
        then = [
            word
            for each in rule.conclusions
            for word in (_target(own, number, each), sums, _weight(buffers, own, each))
        ]
        head = [kind, len(code), len(rule.conclusions), own.degrees + len(starts)]
        starts.append(buffers.put([*head, *code, *then]))
    table = [0] * (-(-len(starts) // p.MASK_BITS) * p.MASK_BITS)
    for rule_number, start in enumerate(starts):
        word, bit = divmod(rule_number, p.MASK_BITS)
        table[word * p.MASK_BITS + (((p.DE_BRUIJN << bit) >> 27) & 31)] = start
    return buffers.put(table)


def _target(own: Plan, rule_block: int, conclusion: Conclusion) -> int:
    if conclusion.term is None:
        raise TypeError(conclusion)
    return own.accumulators[conclusion.variable.casefold()].word(rule_block, conclusion.term)


def _weight(buffers: Buffers, own: Plan, conclusion: Conclusion) -> int:
    if isinstance(conclusion.weight, str):
        return -1 - own.slots[Leaf(conclusion.weight.casefold(), None)]
    if conclusion.weight == 1.0:
        return 0
    return buffers.put_floats([conclusion.weight])


def _outputs(buffers: Buffers, block: FunctionBlock, own: Plan) -> int:
    """Append a record for every output; return where they begin. One without DEFUZZIFY keeps its value."""
    by_name = {each.variable.casefold(): each for each in block.defuzzifications}
    records: list[int] = []
    for index, variable in enumerate(block.outputs):
        name = variable.name.casefold()
        value, active = len(own.inputs) + index, len(own.inputs) + len(own.outputs) + index
        records += [value, active, *_output(buffers, by_name.get(name), own.accumulators.get(name))]
    return buffers.put(records)


def _output(
    buffers: Buffers, output: Defuzzification | None, accumulator: Accumulator | None
) -> tuple[int, ...]:
    if output is None or accumulator is None:
        return 0, 0, 0, 0, 0, 1
    places = [float(term.shape.value) for term in output.terms if isinstance(term.shape, Singleton)]
    default = 0.0 if output.default is None else output.default
    return (
        accumulator.count,
        buffers.put_floats([*places, *[0.0] * (accumulator.count - len(places)), default]),
        accumulator.at,
        0 if accumulator.kinds == (Accumulation.MAX,) else len(accumulator.kinds),
        buffers.put(GROUP_KIND[kind] for kind in accumulator.kinds),
        int(output.default is None),
    )


def _initial(block: FunctionBlock, size: int) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    def value(variable: Variable) -> float:
        return 0.0 if variable.initial is None else float(variable.initial)

    memory = np.zeros(size)
    declared = [value(variable) for variable in (*block.inputs, *block.outputs)]
    memory[: len(declared)] = declared
    return memory


def _layout(own: Plan) -> Layout:
    def slots(*, negated: bool) -> dict[tuple[str, str], int]:
        return {
            (leaf.variable, leaf.term): slot
            for leaf, slot in own.slots.items()
            if leaf.term is not None and leaf.negated is negated
        }

    return Layout(
        terms=slots(negated=False),
        complements=slots(negated=True),
        brought={name: own.slots[Leaf(name, None)] for name in own.brought},
        accumulated={
            (variable, term): accumulator.at + word
            for variable, accumulator in own.accumulators.items()
            for term, word in accumulator.words.items()
        },
        clamps=own.clamps,
    )

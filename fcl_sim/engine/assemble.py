"""`assemble`: FunctionBlock to Program."""

from collections.abc import Sequence
from math import inf, nan, prod

import numpy as np

from fcl_sim.arithmetic.curves import CODES, PARAMETERS
from fcl_sim.arithmetic.membership import FEW, PAIR_SIZE
from fcl_sim.engine import program as p
from fcl_sim.engine.assemble_joint import Laid, put_joint
from fcl_sim.engine.assemble_outputs import Outputs, put_outputs
from fcl_sim.engine.assemble_rules import code_of, put_rules
from fcl_sim.engine.buffers import Buffers
from fcl_sim.engine.conditions import Leaf, depth
from fcl_sim.engine.grid import Cell, Grid, merge
from fcl_sim.engine.masks import Code, every, fireable, summary_words, words_of
from fcl_sim.engine.narrow import narrowed, too_large
from fcl_sim.engine.plan import Moved, Plan, plan
from fcl_sim.engine.plan_areas import points_of
from fcl_sim.engine.precision import LREAL, Precision
from fcl_sim.engine.program import Layout, Program
from fcl_sim.engine.refuse import refuse
from fcl_sim.engine.straighten import straightened
from fcl_sim.engine.switches import switched
from fcl_sim.engine.together import together
from fcl_sim.model import Curve, FunctionBlock, Variable
from fcl_sim.model.labels import unique_labels


def assemble(block: FunctionBlock, precision: Precision = LREAL) -> Program:
    """Return the program of `block`.

    Raises InputFault, with every place, for what cannot be evaluated (FCL4xx).
    """
    refuse(block)
    block = narrowed(straightened(narrowed(switched(block), precision)), precision)
    own = plan(block)
    codes = [code_of(rule_block, rule, own) for rule_block in block.rule_blocks for rule in rule_block.rules]
    buffers = Buffers()
    stack = 2 * max((depth(code.tokens) for code in codes), default=0)
    outputs = put_outputs(buffers, block, own, own.stack + stack)
    grids, laid = _grids(buffers, own, codes, precision)
    header = {
        p.RULES: len(codes),
        p.WORDS: own.words,
        p.SUMMARY: summary_words(own.words),
        p.ALL: buffers.put(words_of(every(codes), own.words)),
        p.GRIDS: len(own.functions),
        p.GRID: grids,
        p.BROUGHT: len(own.brought),
        p.BRING: buffers.put(word for name in own.brought for word in _brought(own, name)),
        p.MOVED: len(own.moved),
        p.MOVE: _moves(buffers, own),
        p.RULE: put_rules(buffers, block, own, codes),
        p.OUTPUTS: len(block.outputs),
        p.OUTPUT: outputs.at,
        p.DEGREES: own.degrees,
        p.CLEAR: own.clear,
        p.CLEARED: own.cells,
        p.CLAMPS: own.clamps,
        p.VISITED: own.visited,
        p.ROWS: own.rows,
        p.STACK: own.stack,
        p.JOINT_HELD: own.held,
        p.JOINT_PAIRS: laid[0].width // 2 if laid else 0,
        p.MORE: int(own.words > 1 or bool(own.brought) or bool(own.moved)),
    }
    for word, value in header.items():
        buffers.ints[word] = value
    buffers.ints[p.TOGETHER] = together(buffers.ints)
    buffers.ints[p.JOINT] = put_joint(buffers, codes, laid)
    buffers.floats[p.LIMIT], buffers.floats[p.TIE] = precision.limit, precision.tie
    initial = _initial(block, max(outputs.size, own.stack))
    initial[own.held] = buffers.ints[buffers.ints[p.JOINT]] if buffers.ints[p.JOINT] > 0 else 0
    with np.errstate(over="ignore"):
        floats = np.array(buffers.floats).astype(precision.dtype)
    flat = np.isinf(floats) & np.isfinite(buffers.floats)
    if flat.any() or max(len(buffers.ints), initial.size) > precision.whole:
        raise too_large(block, precision)
    return Program(
        name=block.name,
        ints=np.array(buffers.ints, np.int64),
        floats=floats,
        initial=initial.astype(precision.dtype),
        input_names=tuple(each.name for each in block.inputs),
        output_names=tuple(each.name for each in block.outputs),
        rule_labels=unique_labels(block),
        layout=_layout(own, outputs),
        curved=any(any(area.curved) for area in own.areas.values()),
    )


def _grids(
    buffers: Buffers, own: Plan, codes: Sequence[Code], precision: Precision
) -> tuple[int, list[Laid]]:
    """Append the tables of every fuzzified input; return where their records begin, and each as laid out."""
    slots_of = {variable: [slot for slot, _ in functions] for variable, functions in own.functions.items()}
    grids = {variable: merge([each for _, each in own.functions[variable]]) for variable in own.functions}
    active = {name: [_active(cell, slots_of[name]) for cell in grid.cells] for name, grid in grids.items()}
    most = max((len(each) for cells in active.values() for each in cells), default=0)
    width = max(2, most + most % 2)
    spare = [(own.spill, 0.0, 0.0, inf)]
    records: list[int] = []
    laid: list[Laid] = []
    for number, (variable, grid) in enumerate(grids.items()):
        filled = [each + spare * (width - len(each)) for each in active[variable]]
        slots = [[slot for slot, *_ in each] for each in filled]
        sets = fireable(codes, slots_of[variable], grid.cells)
        rows = [
            word for each, rules in zip(slots, sets, strict=True) for word in _row(each, rules, own.words)
        ]
        cells = [
            number
            for ends, each in zip(_edges(grid, precision), filled, strict=True)
            for number in (*ends, *_in_pairs([segment for _, *segment in each]))
        ]
        knots = _knots(grid)
        mask = own.rows + number if own.words > 1 else 0
        pieces = p.EDGES_SIZE + width // 2 * PAIR_SIZE
        cells_at = buffers.put_floats(cells)
        records += [
            own.inputs[variable],
            len(knots),
            buffers.put_floats(knots),
            width,
            buffers.put(rows),
            cells_at,
            len(rows) // len(filled),
            pieces,
            mask,
            prod(len(each.rules) for each in laid),
            own.cells + number,
            int(width > 2 or mask != 0),
        ]
        met = [[own.inputs[variable], cells_at + cell * pieces, *each] for cell, each in enumerate(slots)]
        laid.append(Laid(width, sets, met))
    return buffers.put(records), laid


def _in_pairs(segments: Sequence[Sequence[float]]) -> list[float]:
    """Return origin, value and run of segments as the kernel takes them, by pairs (arithmetic.membership)."""
    pairs = zip(segments[::2], segments[1::2], strict=True)
    return [number for pair in pairs for both in zip(*pair, strict=True) for number in both]


def _edges(grid: Grid, precision: Precision) -> list[tuple[float, float]]:
    """Return the least and the greatest number of each cell; of an empty one, the wrong way round."""
    knots = np.array([-inf, *(float(knot) for knot in grid.knots), inf], precision.dtype)
    after, before = np.nextafter(knots, precision.dtype(inf)), np.nextafter(knots, precision.dtype(-inf))
    after[0], before[-1] = -inf, inf
    edges = [(-inf, float(before[1]))]
    for knot in range(1, len(knots) - 1):
        edges += [(float(knots[knot]),) * 2, (float(after[knot]), float(before[knot + 1]))]
    return edges


def _row(slots: Sequence[int], rules: int, words: int) -> list[int]:
    """Return the row of a cell (program.py, GRID_ROWS)."""
    mask = words_of(rules, words)
    return [mask[0], *slots, *(mask if words > 1 else [])]


def _knots(grid: Grid) -> list[float]:
    """Return the knots as `cell_of` takes them."""
    knots = [float(knot) for knot in grid.knots]
    count = FEW if len(knots) < FEW else 16
    while count <= len(knots):
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


def _moves(buffers: Buffers, own: Plan) -> int:
    """Append a record for every moved term of an input; return where they begin."""

    def record(each: Moved) -> list[int]:
        if isinstance(each.term.shape, Curve):
            return _curve(buffers, own, each, each.term.shape)
        points = points_of(each.term)
        return [*_head(buffers, own, each), len(points), *buffers.spots(own, points)]

    return buffers.put(word for each in [record(moved) for moved in own.moved] for word in each)


def _head(buffers: Buffers, own: Plan, moved: Moved) -> list[int]:
    return [own.inputs[moved.variable], moved.slot, moved.complement, buffers.put_floats(moved.limits)]


def _curve(buffers: Buffers, own: Plan, moved: Moved, curve: Curve) -> list[int]:
    """Return the record of a term that is a smooth curve."""
    spare = [0] * (PARAMETERS - len(curve.parameters))
    sources = [buffers.source(own, each) for each in curve.parameters]
    return [
        *_head(buffers, own, moved),
        -1 - CODES[curve.kind],
        buffers.constant(curve.height),
        *sources,
        *spare,
    ]


def _initial(block: FunctionBlock, size: int) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    before = {each.variable.casefold(): each.default for each in block.defuzzifications if each.held}

    def value(variable: Variable) -> float:
        first = before.get(variable.name.casefold())
        if first is not None:
            return first
        return 0.0 if variable.initial is None else float(variable.initial)

    memory = np.zeros(size)
    declared = [value(variable) for variable in (*block.inputs, *block.outputs)]
    memory[: len(declared)] = declared
    return memory


def _layout(own: Plan, outputs: Outputs) -> Layout:
    def slots(*, negated: bool) -> dict[tuple[str, str], int]:
        return {
            (leaf.variable, leaf.term): slot
            for leaf, slot in own.slots.items()
            if leaf.term is not None and leaf.negated is negated
        }

    def accumulated(*, finished: bool) -> dict[tuple[str, str | None], int]:
        return {
            (variable, term): accumulator.at + word
            for variable, accumulator in own.accumulators.items()
            if finished is (variable in own.outputs and variable not in own.areas)
            for term, word in accumulator.words.items()
        }

    return Layout(
        terms=slots(negated=False),
        complements=slots(negated=True),
        brought={name: own.slots[Leaf(name, None)] for name in own.brought},
        accumulated=accumulated(finished=True),
        asked=accumulated(finished=False),
        areas=outputs.areas,
        places=outputs.places,
        clamps=own.clamps,
    )
